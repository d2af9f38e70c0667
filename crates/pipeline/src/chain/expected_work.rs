//! Expected work of the tracer in the frames of a scene, extrapolated from a look at a few of them.

use crate::host::failure::Failure;
use artifact::scene::{Mesh, SceneHeader, TargetKind};
use bart_rcs::ExpectedWork;
use glam::DVec3;
use std::collections::BTreeMap;
use std::sync::{Mutex, OnceLock, PoisonError};

/// Probes taken so far, by frame, and the size of the scene's meshes.
#[derive(Default)]
pub(crate) struct FrameProbes {
    taken: Mutex<BTreeMap<u32, ExpectedWork>>,
    reach_of_mesh_m: OnceLock<Vec<f64>>,
}

/// A frame's work, scaled from that of a frame that was looked at.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ScaledWork {
    pub(crate) work: ExpectedWork,
    /// Facets of this frame per facet of the other.
    pub(crate) facets: f64,
    /// Cells of this frame per cell of the other.
    pub(crate) cells: f64,
}

/// Largest number of frames that are looked at.
const PROBED_FRAMES: u32 = 3;

/// Number of frames that one look represents.
fn frames_per_probe(frames: u32) -> u32 {
    frames.div_ceil(PROBED_FRAMES).max(1)
}

/// Frames of a scene that are looked at: the first of each third.
pub(crate) fn probed_frames(frames: u32) -> impl Iterator<Item = u32> {
    (0..frames).step_by(frames_per_probe(frames) as usize)
}

impl FrameProbes {
    /// Estimates a frame's work from a look at the first frame of its third of the scene; `expected` looks at
    /// a frame, `triangles` counts the triangles in view of one.
    pub(crate) fn of(
        &self,
        header: &SceneHeader,
        index: u32,
        expected: impl FnOnce(u32) -> Result<ExpectedWork, Failure>,
        triangles: impl Fn(u32) -> usize,
    ) -> Result<ScaledWork, Failure> {
        let span = frames_per_probe(header.frames);
        let at = index / span * span;
        let known = self.taken().get(&at).copied();
        let work = match known {
            Some(work) => work,
            None => {
                let work = expected(at)?;
                *self.taken().entry(at).or_insert(work)
            }
        };
        let facets = triangles(index) as f64 / triangles(at).max(1) as f64;
        let finer = (self.cell_m(header, at) / self.cell_m(header, index)).powi(2);
        Ok(ScaledWork { work, facets, cells: facets * finer })
    }

    /// Size of a frame's largest cells, from the nearest and the fastest of its bodies.
    fn cell_m(&self, header: &SceneHeader, index: u32) -> f64 {
        let view = scene::frame_view(header, index);
        let frame = scene::snapshot(header, index);
        let reaches_m =
            self.reach_of_mesh_m.get_or_init(|| header.meshes.iter().map(Mesh::reach_m).collect());
        let position_m = DVec3::from_array(header.radar.position_m);
        let (mut nearest_m, mut fastest_mps, mut turn_radps) = (f64::INFINITY, 0.0_f64, 0.0_f64);
        for (target, pose) in view.targets.iter().zip(&frame.poses) {
            if let TargetKind::Mesh { mesh, .. } = target.kind {
                let distance_m = position_m.distance(DVec3::from_array(pose.position_m));
                let reach_m = reaches_m.get(mesh as usize).copied().unwrap_or(0.0);
                // An antenna within a body's bounding radius is usually well away from its surface.
                nearest_m = nearest_m.min((distance_m - reach_m).max(0.2 * distance_m));
                let speed_mps = DVec3::from_array(pose.velocity_mps).length();
                fastest_mps = fastest_mps.max(speed_mps + pose.yaw_radps.abs() * reach_m);
                turn_radps = turn_radps.max(pose.yaw_radps.abs());
            }
        }
        bart_rcs::largest_cell_m(&view.in_frame(index), nearest_m, fastest_mps, turn_radps)
    }

    fn taken(&self) -> std::sync::MutexGuard<'_, BTreeMap<u32, ExpectedWork>> {
        self.taken.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
