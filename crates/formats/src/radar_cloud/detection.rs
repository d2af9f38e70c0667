//! A detection in the levelled axes of its sensor, and its conversion to a point.

use crate::levelled_axes::LevelledAxes;
use artifact::cube::CubeHeader;
use artifact::points::{Height, Point};
use glam::DVec3;
use radar::cross_section::{cross_section_dbsm, snr_db_of};

/// A detection of a cloud.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Detection {
    /// Ahead, left, up of the radar, m.
    pub(crate) place_m: DVec3,
    /// Radar cross section, dBsm; 0 if unknown.
    pub(crate) section_dbsm: f64,
    /// Radial velocity, positive when the range grows, m/s.
    pub(crate) velocity_mps: f64,
}

/// Cross section of a point in dBsm; 0, as in clouds, if the noise is unknown.
fn cross_section(header: Option<&CubeHeader>, point: &Point) -> f64 {
    header.and_then(|header| cross_section_dbsm(header, point)).unwrap_or(0.0)
}

impl Detection {
    /// Converts a point to a detection.
    pub(crate) fn of(header: Option<&CubeHeader>, axes: &LevelledAxes, point: &Point) -> Self {
        Self {
            place_m: axes.of_world(point.position_m.into()),
            section_dbsm: cross_section(header, point),
            velocity_mps: point.radial_velocity_mps,
        }
    }

    /// Converts the detection to a point. Its signal-to-noise ratio follows from its cross section and place
    /// if the header specifies the noise, else it is 0 dB.
    pub(crate) fn point(&self, header: &CubeHeader, axes: &LevelledAxes, height: Height) -> Point {
        let position_m = axes.to_world(self.place_m);
        let away = position_m - axes.origin_m;
        let point = Point {
            range_m: away.length(),
            radial_velocity_mps: self.velocity_mps,
            azimuth_rad: away.x.atan2(away.y),
            elevation_rad: away.z.atan2(away.x.hypot(away.y)),
            height,
            position_m: position_m.to_array(),
            snr_db: 0.0,
            two_ways_rad: None,
            stationary: None,
            object: None,
            target: None,
            label: None,
        };
        Point { snr_db: snr_db_of(header, &point, self.section_dbsm).unwrap_or(0.0), ..point }
    }

    /// Whether all of its numbers are finite, and its place is within a radar's reach.
    pub(crate) fn is_sound(&self) -> bool {
        self.place_m.is_finite()
            && (1e-3..=PLACE_LIMIT_M).contains(&self.place_m.length())
            && self.velocity_mps.abs() <= SPEED_LIMIT_MPS
            && self.section_dbsm.abs() <= SECTION_LIMIT_DBSM
    }
}

/// Largest distance of a detection from its radar, m.
pub(crate) const PLACE_LIMIT_M: f64 = 100_000.0;
/// Largest radial speed of a detection, m/s.
const SPEED_LIMIT_MPS: f64 = 3000.0;
/// Largest magnitude of a detection's cross section, dBsm.
const SECTION_LIMIT_DBSM: f64 = 300.0;
