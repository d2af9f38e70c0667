//! Tracking of objects over frames.

pub(crate) mod tracker_settings; // models of bodies and detector
pub(crate) mod kalman; // position and velocity on the road
pub(crate) mod measurement; // measurements from objects
pub(crate) mod velocity_bank; // filters of aliased velocities
pub(crate) mod body; // heading and box
pub(crate) mod tracks; // the tracker
