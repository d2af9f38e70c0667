//! Expected and largest memory of a run: its arrays, whose sizes are known, and the tracer's data, which are
//! estimated.

use crate::chain::expectation::rates::{
    BYTES_PER_BEAM, BYTES_PER_CELL, BYTES_PER_CHANGING_CELL, BYTES_PER_FACET, BYTES_PER_MOVING_CELL,
    BYTES_PER_SLIDING_TILE, HELD_KINDS, PROGRAM_MIB,
};
use crate::chain::expected_work::ScaledWork;
use crate::chain::link::Chain;
use crate::chain::plan::FramePlan;
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use crate::host::memory::mib;
use crate::host::ordered_jobs::ConcurrencyLimits;
use artifact::paths::Path;
use artifact::scene::Pose;
use artifact::settings::EchoMode;
use bart_rcs::MemoryLimit;

/// Expected memory load of a frame, by its causes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MemoryLoad {
    /// Cubes, maps, paths of the ground and searches of directions.
    pub signal_mib: f64,
    /// Placed facets.
    pub facets: f64,
    /// Lit polygons.
    pub beams: f64,
    /// Lit polygons that waves reach through sheets: beside those of the frame there are as many of the paths
    /// by a road that it is asked about, and each stores the sheets it has passed.
    pub beams_through_sheets: f64,
    /// Cells of paths.
    pub cells: f64,
    /// Cells of paths where a body moves, whose paths may be held for several moments of the frame.
    pub changing_cells: f64,
    /// Tiles between bodies that slide past each other, times the wavelengths by which they slide.
    pub sliding_tiles: f64,
    /// Cells of paths between bodies that slide past each other, however far they slide.
    pub moving_cells: f64,
    /// Tiles of long polygons. As a rule terms of corners and sides are enough for these; near the radar they
    /// are not always, and cells as small as tiles take their place.
    pub long_tiles: f64,
}

/// Maximum number of cells for each tile of a long polygon: of boxes of 9 to 12 m, 6 to 19 m away at −30 dB,
/// whose cells are shared among nodes in ever finer grids, two held up to 1.9 times what one cell has.
const CELLS_PER_LONG_TILE: f64 = 3.0;

impl MemoryLoad {
    /// Least memory of a frame, MiB: signals, facets and lit polygons. The number of cells that an accuracy
    /// takes, and of paths that are dropped, is known only from tracing, which watches their growth.
    pub(crate) fn least_mib(&self) -> f64 {
        self.signal_mib + mib((self.facets * BYTES_PER_FACET + self.beams * BYTES_PER_BEAM) as u64)
    }

    /// Upper limit of the memory, MiB, without the program.
    pub(crate) fn mib(&self) -> f64 {
        let bytes = self.cells * BYTES_PER_CELL
            + self.changing_cells * BYTES_PER_CHANGING_CELL
            + self.sliding_tiles * BYTES_PER_SLIDING_TILE
            + self.moving_cells * BYTES_PER_MOVING_CELL
            + self.long_tiles * CELLS_PER_LONG_TILE * BYTES_PER_CELL;
        self.least_mib() + mib(bytes as u64)
    }

    /// Counts of the expected memory contents of a run of such frames, `at_once` of them side by side: the
    /// program, triangles as they are read, MiB of signals, facets, lit polygons, cells, cells of paths
    /// between bodies that slide past each other, and lit polygons behind sheets.
    pub fn held(&self, triangles: f64, at_once: f64) -> [f64; HELD_KINDS] {
        let Self { signal_mib, facets, beams, beams_through_sheets, cells, moving_cells, .. } = *self;
        let of_frames = [signal_mib, facets, beams, cells, moving_cells, beams_through_sheets];
        let [signals, facets, beams, cells, moving_cells, through_sheets] =
            of_frames.map(|count| count * at_once);
        [1.0, triangles, signals, facets, beams, cells, moving_cells, through_sheets]
    }
}

impl Chain<'_> {
    /// Upper limit of the memory while a frame's plan is carried out, MiB, with the program itself.
    pub fn memory_estimate_mib(&self, plan: &FramePlan) -> Result<f64, Failure> {
        Ok(PROGRAM_MIB + self.load(plan)?.mib())
    }

    /// Least memory while a frame's plan is carried out, MiB, with the program itself.
    pub(crate) fn least_memory_mib(&self, plan: &FramePlan) -> Result<f64, Failure> {
        Ok(PROGRAM_MIB + self.load(plan)?.least_mib())
    }

    /// Upper limit of the memory of a run of these plans, MiB: the program, and the largest frame for each
    /// held frame; and counts of the expected contents ([`MemoryLoad::held`]).
    pub(crate) fn memory_of_run(&self, plans: &[FramePlan]) -> Result<(f64, [f64; HELD_KINDS]), Failure> {
        let ConcurrencyLimits { workers, held } = self.frames_at_once(plans)?;
        let largest = self.largest_load(plans)?;
        let triangles: usize = self.header.meshes.iter().map(|mesh| mesh.triangles.len()).sum();
        let most_mib = PROGRAM_MIB + largest.mib() * held as f64;
        Ok((most_mib, largest.held(triangles as f64, workers as f64)))
    }

    /// Number of frames computed at a time, one per thread, and held, one more, which is written meanwhile:
    /// as many as are expected to fit into the allowed memory. The work within a frame is parallel too; its
    /// serial parts run beside other frames.
    pub fn frames_at_once(&self, plans: &[FramePlan]) -> Result<ConcurrencyLimits, Failure> {
        let threads = rayon::current_num_threads().min(plans.len()).max(1);
        let most = if threads > 1 { threads + 1 } else { 1 };
        let of_held = |held: usize| ConcurrencyLimits { workers: threads.min(held), held };
        let Some(limit_mib) = self.memory().mib().filter(|_| threads > 1) else { return Ok(of_held(most)) };
        let fitting = (limit_mib / (PROGRAM_MIB + self.largest_load(plans)?.mib())) as usize;
        Ok(of_held(most.min(fitting).max(1)))
    }

    /// Memory allowed for tracing one of these frames: an equal part, for each traced frame, of the memory
    /// left by the program and by the cubes and maps of the other held frames.
    pub(crate) fn tracing_share(
        &self,
        ConcurrencyLimits { workers, held }: ConcurrencyLimits,
    ) -> MemoryLimit {
        let of_others_mib = mib(self.signal_bytes()) * held.saturating_sub(1) as f64;
        self.memory().reduced_by(PROGRAM_MIB + of_others_mib).limit().share_of(workers)
    }

    /// Load of the frame with the largest expected memory.
    pub fn largest_load(&self, plans: &[FramePlan]) -> Result<MemoryLoad, Failure> {
        plans.iter().try_fold(MemoryLoad::default(), |most, plan| {
            let load = self.load(plan)?;
            Ok(if load.mib() > most.mib() { load } else { most })
        })
    }

    fn load(&self, plan: &FramePlan) -> Result<MemoryLoad, Failure> {
        let signal = MemoryLoad { signal_mib: mib(self.signal_bytes()), ..MemoryLoad::default() };
        if !plan.runs(Stage::BartRcs) {
            return Ok(signal);
        }
        let ScaledWork { work, facets, cells } = self.scaled_work(plan.index)?;
        let bodies = MemoryLoad {
            facets: facets * work.facets,
            beams: facets * (work.beams[0] + work.beams[1]),
            beams_through_sheets: facets * work.beams_through_sheets,
            ..signal
        };
        Ok(match self.header.fidelity.echo {
            EchoMode::RcsTable => bodies,
            EchoMode::Paths => MemoryLoad {
                cells: cells * work.smaller_cells,
                changing_cells: if self.moves(plan.index) { cells * work.smaller_cells } else { 0.0 },
                sliding_tiles: facets * work.sliding_tiles,
                moving_cells: cells * work.moving_cells,
                long_tiles: facets * work.long_tiles,
                ..bodies
            },
        })
    }

    /// Whether any body of a frame moves.
    fn moves(&self, index: u32) -> bool {
        let poses = scene::snapshot(self.header, index).poses;
        let moves = |pose: &Pose| {
            pose.velocity_mps != [0.0; 3] || pose.acceleration_mps2 != [0.0; 3] || pose.yaw_radps != 0.0
        };
        poses.iter().any(moves)
    }

    /// Bytes of the data after the tracer: cubes, maps, paths of the ground, searches of directions.
    fn signal_bytes(&self) -> u64 {
        let accuracy = fmcw_echo::sum_accuracy(self.header.fidelity.accuracy);
        fmcw_echo::memory_estimate_bytes(self.cube_header(), accuracy)
            + self.map_bytes()
            + self.ground_bytes()
            + self.direction_bytes()
    }

    /// Bytes of a map in both precisions: all channels are transformed at once.
    fn map_bytes(&self) -> u64 {
        let cells: usize = artifact::rdm::shape(self.cube_header()).iter().product();
        (cells * (size_of::<num_complex::Complex32>() + size_of::<num_complex::Complex64>())) as u64
    }

    /// Bytes of the searches of echoes' directions, one per thread.
    fn direction_bytes(&self) -> u64 {
        rayon::current_num_threads() as u64 * dsp::angle::search_bytes(&self.header.radar)
    }

    /// Bytes of the ground's paths, once for the run and once among those of the frame.
    fn ground_bytes(&self) -> u64 {
        let patches = self.header.backscatter.map_or(0, |_| fmcw_echo::ground::patches(&self.header.radar));
        (2 * patches * size_of::<Path>()) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::host::memory::Allowance;

    #[test]
    fn the_share_of_a_frame_leaves_room_for_the_cubes_and_maps_of_the_others() {
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/intersection.toml");
        let options = scene::ReadOptions::names_only();
        let header = scene::read(&file, &options).unwrap();
        let chain = Chain::of(&header, None, None, Allowance::of(Some(2000)));
        let (limit_bytes, program_bytes) = (2000 << 20, 48 << 20);
        let of_frame = chain.signal_bytes();
        assert!(of_frame > 1 << 20, "{of_frame} bytes of cubes and maps");
        for (workers, held) in [(1, 1), (2, 3), (4, 4)] {
            let left = limit_bytes - program_bytes - (held as u64 - 1) * of_frame;
            let share = chain.tracing_share(ConcurrencyLimits { workers, held });
            assert_eq!(share, MemoryLimit::of_bytes(left / workers as u64), "{workers} of {held}");
        }
    }
}
