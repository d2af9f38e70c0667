//! Bodies in the half-space without antenna gain, which frames omit.
//!
//! Their echoes are zero, and they hide nothing that is received: nothing behind the antennas lies between
//! them and a place ahead. Paths from a body ahead via one behind to a body ahead, of three bounces and more,
//! are omitted with them.

use crate::geometry::plane::Plane;
use artifact::Radar;
use glam::DVec3;

/// Half-space behind the array, where its pattern has no gain.
pub(crate) struct BehindArray {
    /// Plane through the centre of the array, positive ahead.
    aperture: Plane,
    /// Maximum distance of elements from the plane, including motion during a frame.
    slack_m: f64,
}

impl BehindArray {
    /// Half-space behind a radar's array, if it has no gain there; `fastest_mps` is the maximum speed of
    /// moving bodies.
    pub(crate) fn of(radar: &Radar, fastest_mps: f64) -> Option<Self> {
        if radar.array.pattern.radiates_behind() {
            return None;
        }
        let [_, normal, _] = radar::aperture::axes(radar);
        let centre = DVec3::from_array(radar.position_m);
        let elements = radar.array.tx_m.iter().chain(&radar.array.rx_m);
        let aside =
            elements.map(|at_m| normal.dot(DVec3::from_array(*at_m) - centre).abs()).fold(0.0, f64::max);
        let slack_m = aside + fastest_mps * radar.frame_duration_s();
        Some(Self { aperture: Plane { normal, offset_m: normal.dot(centre) }, slack_m })
    }

    /// Whether all of these positions are behind the array.
    pub(crate) fn holds(&self, mut places_m: impl Iterator<Item = DVec3>) -> bool {
        places_m.all(|at_m| self.aperture.distance_m(at_m) < -self.slack_m)
    }
}
