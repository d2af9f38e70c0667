//! Bodies that the antennas have no gain towards: a frame is made without them.
//!
//! Their echoes are zeros, and they hide nothing that is heard: between the antennas and a place ahead there
//! is nothing that is behind. Left out with them are ways from a body ahead over one behind to a body ahead
//! again, of three bounces and more.

use crate::geometry::plane::Plane;
use artifact::Radar;
use glam::DVec3;

/// Half-space behind the array, where its pattern has no gain.
pub(crate) struct BehindArray {
    /// Plane through the middle of the array, positive ahead.
    aperture: Plane,
    /// Elements stand off it by at most this, as does what moves during a frame.
    slack_m: f64,
}

impl BehindArray {
    /// Half-space behind a radar's array, if it hears nothing there; `fastest_mps` is the speed of what
    /// moves.
    pub(crate) fn of(radar: &Radar, fastest_mps: f64) -> Option<Self> {
        if radar.array.pattern.hears_behind() {
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

    /// Whether all of these places are behind the array.
    pub(crate) fn holds(&self, mut places_m: impl Iterator<Item = DVec3>) -> bool {
        places_m.all(|at_m| self.aperture.distance_m(at_m) < -self.slack_m)
    }
}
