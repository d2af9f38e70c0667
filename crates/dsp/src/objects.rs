//! From peaks to points and the objects that they form.

pub mod stationary; // what is at rest
pub mod cluster_member; // what clustering knows of a point
pub mod rigid_pieces; // parts of a body that drives across the line of sight
pub mod clusters; // points of one vehicle
pub mod points; // all of it: a map becomes a frame of points
#[cfg(test)]
mod test_settings; // what its tests share
