//! Objects followed over frames.

pub(crate) mod tracker_settings; // what is expected of bodies
pub(crate) mod kalman; // place and velocity on the road
pub(crate) mod measurement; // what an object measures
pub(crate) mod velocity_bank; // filters of aliased velocities
pub(crate) mod body; // heading and box
pub(crate) mod tracks; // the tracker
