//! Listeners that hear how far long work is; they never change what comes out.

/// A part of the work on a mesh or on a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Topology, skin and hierarchy of a mesh.
    Building,
    /// Beams; counted are facets that are looked at, and mirrors of one order.
    Tracing,
    /// Joints of one order.
    Integrating,
    /// Comparisons that errors are measured by.
    Checking,
    /// Aspects of a table.
    Aspects,
    /// Bodies of a frame, each with its table.
    Bodies,
}

/// Hears from any thread how far work is.
pub trait Progress: Sync {
    /// `done` of `of` steps of a phase are done; `of` is 0 where steps cannot be counted.
    fn at(&self, phase: Phase, done: usize, of: usize);
}

/// Nobody listens.
pub struct Unheard;

impl Progress for Unheard {
    fn at(&self, _: Phase, _: usize, _: usize) {}
}

impl<F: Fn(Phase, usize, usize) + Sync> Progress for F {
    fn at(&self, phase: Phase, done: usize, of: usize) {
        self(phase, done, of);
    }
}
