//! The sensor of a trace: its number, position and orientation.

use crate::measured::sensor_axes::SensorAxes;
use crate::osi::common::{MountingPosition, Orientation3d, Vector3d};
use artifact::Radar;

/// Number of a radar: 48 bits of the fingerprint of its position, orientation, elements and waveform, the
/// same in all traces of a radar and different for different radars. 0 without a radar.
pub(crate) fn number(radar: Option<&Radar>) -> u64 {
    let all = radar.map(|radar| {
        let mounted = (radar.position_m, radar.boresight_az_rad, radar.boresight_el_rad);
        let elements = (&radar.array.tx_half_wavelengths, &radar.array.rx_half_wavelengths);
        artifact::envelope::fingerprint(&(mounted, elements, &radar.waveform))
    });
    all.and_then(|hash| u64::from_str_radix(hash.get(..12)?, 16).ok()).unwrap_or(0)
}

/// Position and orientation of a radar in the world.
pub(crate) fn mounting(radar: &Radar) -> MountingPosition {
    let axes = SensorAxes::of(radar);
    let orientation = Orientation3d { roll: Some(0.0), pitch: Some(axes.pitch_rad), yaw: Some(axes.yaw_rad) };
    MountingPosition { position: Vector3d::of(axes.place_m.into()), orientation: Some(orientation) }
}
