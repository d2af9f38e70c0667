//! Velocities that look alike in a map.

pub(crate) mod ambiguous_velocities; // which do, and which no vehicle drives
pub(crate) mod time_division_folds; // told by the phases between slots
pub(crate) mod velocity_folds; // told by two sub-frames
