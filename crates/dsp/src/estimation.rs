//! Echoes that stand alone, estimated on the samples.

pub(crate) mod point_echo; // its samples, as a model
pub(crate) mod isolation; // whether it stands alone
pub(crate) mod refinement; // its range, velocity and direction
pub(crate) mod cramer_rao; // how well that can be done
