//! Objects followed over frames.

pub mod tracker_settings; // what is expected of bodies
pub mod kalman; // place and velocity on the road
pub mod measurement; // what an object measures
pub mod velocity_bank; // filters of aliased velocities
pub mod body; // heading and box
pub mod tracks; // the tracker
