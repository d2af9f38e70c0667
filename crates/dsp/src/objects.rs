//! Points made of peaks, and the objects that they form.

pub(crate) mod stationary; // what is at rest
pub(crate) mod cluster_member; // what clustering knows of a point
pub(crate) mod rigid_pieces; // parts of a body that drives across the line of sight
pub(crate) mod velocity_steps; // where one body of a queue ends and the next begins
pub(crate) mod clusters; // points of one vehicle
pub(crate) mod foreign_points; // objects of points from elsewhere
pub(crate) mod points; // all of it: a map becomes a frame of points
