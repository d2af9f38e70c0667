//! Expected and actual seconds and memory of a scene.

use crate::bench::predictions::child::MeasuredCost;
use crate::bench::predictions::timed_scene::TimedScene;
use wayside::chain::expectation::Expectation;
use wayside::chain::memory_estimate::MemoryLoad;

/// One scene.
pub(super) struct PredictionRow {
    pub(super) scene: TimedScene,
    pub(super) expected: Expectation,
    /// Processor seconds of the prediction.
    pub(super) look_s: f64,
    /// Memory of the largest frame by its parts, and the number of concurrent frames.
    pub(super) load: MemoryLoad,
    pub(super) at_once: usize,
    pub(super) taken: MeasuredCost,
}
