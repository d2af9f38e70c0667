//! Velocity ambiguity of a map.

pub(crate) mod ambiguous_velocities; // indistinguishable velocities, and which a vehicle can drive
pub(crate) mod time_division_folds; // folds from the phases between slots
pub(crate) mod velocity_folds; // folds from two sub-frames
