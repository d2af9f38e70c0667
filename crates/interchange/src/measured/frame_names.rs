//! Names of the coordinate frames of messages.

/// The frame of world coordinates.
pub(crate) const WORLD: &str = "map";
/// The frame of the sensor: x ahead, y left, z up.
pub(crate) const SENSOR: &str = "radar";
