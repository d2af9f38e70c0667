//! Axes of a sensor: x along the boresight, y to the left, z up; azimuths are positive to the left.

use artifact::Radar;
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// Position and orientation of a sensor in the world.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SensorAxes {
    pub(crate) place_m: DVec3,
    /// Unit vectors right, ahead and up.
    axes: [DVec3; 3],
    pub(crate) yaw_rad: f64,
    /// Pitch, positive when the sensor looks down.
    pub(crate) pitch_rad: f64,
}

impl SensorAxes {
    /// Axes of a radar.
    pub(crate) fn of(radar: &Radar) -> Self {
        Self {
            place_m: radar.position_m.into(),
            axes: radar::aperture::axes(radar),
            yaw_rad: radar::aperture::boresight_yaw_rad(radar),
            pitch_rad: -radar.boresight_el_rad,
        }
    }

    /// Axes of a sensor at the origin that looks along +y, from which azimuths are counted.
    pub(crate) fn of_world() -> Self {
        let axes = radar::aperture::boresight_axes(0.0, 0.0);
        Self { place_m: DVec3::ZERO, axes, yaw_rad: FRAC_PI_2, pitch_rad: 0.0 }
    }

    /// Azimuth and elevation in the sensor's axes of a direction given from world +y towards +x and above the
    /// horizon.
    pub(crate) fn angles_of_world(&self, azimuth_rad: f64, elevation_rad: f64) -> [f64; 2] {
        let [_, ahead, _] = radar::aperture::boresight_axes(azimuth_rad, elevation_rad);
        self.angles(ahead)
    }

    /// Azimuth and elevation of a unit vector.
    pub(crate) fn angles(&self, direction: DVec3) -> [f64; 2] {
        let [right, ahead, up] = self.cosines(direction);
        [(-right).atan2(ahead), up.clamp(-1.0, 1.0).asin()]
    }

    /// Direction cosines of a unit vector along right, ahead and up.
    pub(crate) fn cosines(&self, direction: DVec3) -> [f64; 3] {
        self.axes.map(|axis| axis.dot(direction))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_boresight_is_ahead_and_what_is_to_the_left_of_it_has_a_positive_azimuth() {
        let axes = SensorAxes::of_world();
        let [azimuth, elevation] = axes.angles_of_world(0.0, 0.0);
        assert!(azimuth.abs() < 1e-15 && elevation.abs() < 1e-15);
        let [azimuth, elevation] = axes.angles_of_world(-0.3, 0.1);
        assert!((azimuth - 0.3).abs() < 1e-12 && (elevation - 0.1).abs() < 1e-12);
    }
}
