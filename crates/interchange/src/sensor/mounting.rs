//! The sensor of a trace: its number, place and orientation.

use crate::measured::sensor_axes::SensorAxes;
use crate::osi::common::{MountingPosition, Orientation3d, Vector3d};
use artifact::Radar;

/// The one sensor of a trace.
pub(crate) const SENSOR: u64 = 0;

/// Place and orientation of a radar in the world.
pub(crate) fn mounting(radar: &Radar) -> MountingPosition {
    let axes = SensorAxes::of(radar);
    let orientation = Orientation3d { roll: Some(0.0), pitch: Some(axes.pitch_rad), yaw: Some(axes.yaw_rad) };
    MountingPosition { position: Vector3d::of(axes.place_m.into()), orientation: Some(orientation) }
}
