//! Points from peaks, and the objects that they form.

pub(crate) mod stationary; // echoes at rest
pub(crate) mod cluster_point; // properties of points for clustering
pub(crate) mod rigid_pieces; // parts of a body that drives across the line of sight
pub(crate) mod velocity_steps; // boundaries between bodies of a queue
pub(crate) mod clusters; // points of one vehicle
pub(crate) mod foreign_points; // objects of points from elsewhere
pub(crate) mod points; // the complete step from map to frame of points
