//! Echoes that stand alone, estimated on the samples.

pub mod point_echo; // its samples, as a model
pub mod isolation; // whether it stands alone
pub mod refinement; // its range, velocity and direction
pub mod cramer_rao; // how well that can be done
