//! Progress reporting; it never affects results.

/// A part of the work on a mesh or on a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Topology, skin and hierarchy of a mesh.
    Building,
    /// Beams; counted in facets examined and mirrors of one order.
    Tracing,
    /// Joints of one order.
    Integrating,
    /// Comparisons from which errors are measured.
    Checking,
    /// Aspects of a table.
    Aspects,
    /// Bodies of a frame, each with its table.
    Bodies,
}

/// Receiver of progress reports, from any thread.
pub trait Progress: Sync {
    /// Reports that `done` of `of` steps of a phase are done; `of` is 0 if steps cannot be counted.
    fn at(&self, phase: Phase, done: usize, of: usize);
}

/// Discards progress reports.
pub struct NoProgress;

impl Progress for NoProgress {
    fn at(&self, _: Phase, _: usize, _: usize) {}
}

impl<F: Fn(Phase, usize, usize) + Sync> Progress for F {
    fn at(&self, phase: Phase, done: usize, of: usize) {
        self(phase, done, of);
    }
}
