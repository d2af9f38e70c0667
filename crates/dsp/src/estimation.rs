//! Maximum-likelihood estimation of isolated echoes on the samples.

pub(crate) mod point_echo; // model of the echo's samples
pub(crate) mod isolation; // whether an echo is isolated
pub(crate) mod refinement; // range, velocity and direction
pub(crate) mod cramer_rao; // minimum errors of estimates
