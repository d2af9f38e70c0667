//! Three implementations of the sum over paths.

pub mod reference; // each sample from the formulas
pub(crate) mod simd_lanes; // SIMD lanes of paths
pub(crate) mod spans; // paths of a part of a frame
pub(crate) mod closest_approach; // closest approach of a path to the antenna
pub(crate) mod chirp_segments; // parabolas of a chirp
pub mod direct_sum; // phases by a quadratic recurrence
pub(crate) mod fast; // all tones at once
