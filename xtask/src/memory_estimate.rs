//! How much memory a run is expected to hold at most: what is known of its arrays, and bounds of what the tracer finds.

use crate::chain::{Chain, echo_accuracy};
use crate::failure::Failure;
use crate::looks::Look;
use crate::memory::mib;
use crate::plan::FramePlan;
use crate::stages::Stage;
use artifact::paths::Path;
use artifact::settings::EchoMode;

/// What the program holds beside frames: code, thread stacks, the learning library's buffers (measured 40 MiB).
const PROGRAM_MIB: f64 = 48.0;

/// Bytes of a facet at rest, of a beam with what is joined on it, and of a cell with its path: of the two runs they were taken from
/// twice what was held. The paths of a frame that is split in time are held for each of its moments.
const BYTES_PER_FACET: f64 = 1500.0;
const BYTES_PER_BEAM: f64 = 1500.0;
const BYTES_PER_CELL: f64 = 2500.0;
/// Of a tile between bodies that slide past each other, for each wavelength: its paths are held for up to 33 moments.
const BYTES_PER_SLIDING_TILE: f64 = 2500.0;

impl Chain<'_> {
    /// What a frame holds at most while its plan is carried out, MiB, the program itself among it.
    pub(crate) fn memory_estimate_mib(&self, plan: &FramePlan) -> Result<f64, Failure> {
        let traced = if plan.runs(Stage::BartRcs) { self.traced_bytes(plan.index)? } else { 0.0 };
        Ok(PROGRAM_MIB + mib(self.signal_bytes()) + mib(traced as u64))
    }

    /// The same of all plans, as many side by side as are.
    pub(crate) fn memory_of_run_mib(&self, plans: &[FramePlan]) -> Result<f64, Failure> {
        let at_once = self.side_by_side(plans)? as f64;
        Ok(PROGRAM_MIB + (self.most_mib(plans)? - PROGRAM_MIB) * at_once)
    }

    /// How many frames are computed at a time: one a thread, as many as are expected to fit into the memory that they may
    /// take. A frame's own work is in parallel too; what of it is not, is done beside another frame.
    pub(crate) fn side_by_side(&self, plans: &[FramePlan]) -> Result<usize, Failure> {
        let most = rayon::current_num_threads().min(plans.len()).max(1);
        let Some(limit_mib) = crate::memory::limit_mib().filter(|_| most > 1) else { return Ok(most) };
        let fitting = (limit_mib / self.most_mib(plans)?) as usize;
        Ok(most.min(fitting).max(1))
    }

    fn most_mib(&self, plans: &[FramePlan]) -> Result<f64, Failure> {
        plans.iter().try_fold(PROGRAM_MIB, |most, plan| Ok(self.memory_estimate_mib(plan)?.max(most)))
    }

    fn traced_bytes(&self, index: u32) -> Result<f64, Failure> {
        let Look { work, facets, cells } = self.looks.of(self, index)?;
        let beams = facets * (work.beams[0] + work.beams[1]);
        let cells = match self.header.fidelity.echo {
            EchoMode::Paths => cells * work.smaller_cells,
            EchoMode::RcsTable => 0.0,
        };
        let sliding = facets * work.sliding_tiles * BYTES_PER_SLIDING_TILE;
        let of_moments = f64::from(bart_rcs::MOMENTS_MAX) * size_of::<Path>() as f64;
        let of_cells = cells * (BYTES_PER_CELL + of_moments);
        Ok(facets * work.facets * BYTES_PER_FACET + beams * BYTES_PER_BEAM + of_cells + sliding)
    }

    /// Of what follows the tracer: cubes, maps, paths of the ground.
    pub(crate) fn signal_bytes(&self) -> u64 {
        fmcw_echo::memory_estimate_bytes(&self.cube_header, echo_accuracy(self.header))
            + self.map_bytes()
            + self.ground_bytes()
    }

    /// A map in both precisions: all channels are transformed at once.
    fn map_bytes(&self) -> u64 {
        let cells: usize = artifact::rdm::shape(&self.cube_header).iter().product();
        (cells * (size_of::<num_complex::Complex32>() + size_of::<num_complex::Complex64>())) as u64
    }

    /// Paths of the ground, once for the run and once among those of the frame.
    fn ground_bytes(&self) -> u64 {
        let patches = self.header.backscatter.map_or(0, |_| fmcw_echo::ground::patches(&self.header.radar));
        (2 * patches * size_of::<Path>()) as u64
    }
}
