//! Apparent position of a path's node at mid-frame, seen from the radar's position, and the share of the
//! frame that the path represents.

use artifact::paths::{Curve, Path, Rim};
use artifact::radar::Radar;
use glam::DVec3;

/// One-way leg from an antenna to the apparent position of a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leg {
    /// Length of the leg, m.
    pub length_m: f64,
    /// Rate of change of the length, m/s, positive when it grows.
    pub rate_mps: f64,
    /// Unit vector pointing away from the radar.
    pub direction: DVec3,
}

/// Legs from the transmitter and from the receiver at mid-frame.
pub fn legs(radar: &Radar, path: &Path) -> [Leg; 2] {
    nodes(radar, path).map(|(at_m, mps)| {
        let away = at_m - DVec3::from(radar.position_m);
        let length_m = away.length();
        Leg { length_m, rate_mps: away.dot(mps) / length_m, direction: away / length_m }
    })
}

/// Apparent position and velocity of a path's node at mid-frame, as seen from the transmitter and from the
/// receiver.
pub fn nodes(radar: &Radar, path: &Path) -> [(DVec3, DVec3); 2] {
    let (curve, middle_s) = (&path.curve, radar.frame_middle_s());
    let node = |at_m: [f64; 3], mps: [f64; 3], mps2: [f64; 3]| {
        let gained = DVec3::from(mps2) * middle_s;
        let velocity = DVec3::from(mps) + gained;
        let way_m = (velocity - 0.5 * gained) * middle_s;
        let hub = (DVec3::from(at_m) + way_m, velocity);
        curve.rim.map_or(hub, |rim| on_rim(&rim, way_m, hub))
    };
    [
        node(path.apparent_tx_m, path.apparent_tx_mps, curve.apparent_tx_mps2),
        node(path.apparent_rx_m, path.apparent_rx_mps, curve.apparent_rx_mps2),
    ]
}

/// Vector from the hub of a rolling wheel to the point on its rim, after a displacement `way_m` since the
/// frame's first sample: r·(cos φ·forward + sin φ·up), φ = φ₀ − (displacement along forward)/r.
pub fn from_hub_m(rim: &Rim, way_m: DVec3) -> DVec3 {
    let forward = DVec3::from(rim.forward);
    let (sin, cos) = (rim.angle_rad - way_m.dot(forward) / rim.radius_m).sin_cos();
    rim.radius_m * (cos * forward + sin * DVec3::Z)
}

/// Position and velocity of the rim point of a wheel that has rolled `way_m`, from the position and velocity
/// of its hub: it rotates about the axle, from up towards forward, at the hub's speed over the radius.
fn on_rim(rim: &Rim, way_m: DVec3, (hub_m, hub_mps): (DVec3, DVec3)) -> (DVec3, DVec3) {
    let (forward, from_hub_m) = (DVec3::from(rim.forward), from_hub_m(rim, way_m));
    let turn_radps = DVec3::Z.cross(forward) * (hub_mps.dot(forward) / rim.radius_m);
    (hub_m + from_hub_m, hub_mps + turn_radps.cross(from_hub_m))
}

/// Mean share of the echo that a path represents, over the frame and over pairs of elements: 1 if it
/// represents all. The mean is sampled at 128 moments, evenly over the frame, and at as many pairs, evenly in
/// their order; it errs by up to a 256th of the share's total variation over them.
pub fn mean_share(radar: &Radar, path: &Path) -> f64 {
    const SAMPLES: usize = 128;
    let Curve { span, array_span, array_side, .. } = &path.curve;
    if span.is_none() && array_span.is_none() && array_side.is_none() {
        return 1.0;
    }
    let (tx, rx) = (&radar.array.tx_m, &radar.array.rx_m);
    let share = |i: usize| {
        let fraction = (i as f64 + 0.5) / SAMPLES as f64;
        let pair = (fraction * (tx.len() * rx.len()) as f64) as usize;
        path.curve.share(fraction * radar.frame_duration_s(), [tx[pair / rx.len()], rx[pair % rx.len()]])
    };
    (0..SAMPLES).map(share).sum::<f64>() / SAMPLES as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::aperture::Preset;
    use crate::paper;
    use artifact::paths::Curve;
    use std::f64::consts::FRAC_PI_2;

    /// Wheel of 0.33 m whose hub is at 30 m at mid-frame and approaches the radar at 8 m/s.
    fn wheel(angle_rad: f64) -> (Radar, Path) {
        let radar = paper::radar([0.0, 0.0, 6.0], paper::waveform(256, 128), Preset::OneByOne.elements());
        let (mps, way_m) = ([0.0, -8.0, 0.0], 8.0 * radar.frame_middle_s());
        let hub_m = [0.0, 30.0 + way_m, 0.33];
        let rim = Rim { radius_m: 0.33, forward: [0.0, -1.0, 0.0], angle_rad: angle_rad + way_m / 0.33 };
        let curve = Curve { rim: Some(rim), ..Curve::default() };
        let path = Path { curve, ..Path::of_point(hub_m, mps, Default::default()) };
        (radar, path)
    }

    #[test]
    fn the_top_of_a_wheel_is_twice_as_fast_as_its_hub_and_the_point_on_the_road_stands() {
        for (angle_rad, place_m, mps) in [
            (FRAC_PI_2, [0.0, 30.0, 0.66], [0.0, -16.0, 0.0]),
            (-FRAC_PI_2, [0.0, 30.0, 0.0], [0.0; 3]),
            (0.0, [0.0, 29.67, 0.33], [0.0, -8.0, -8.0]),
        ] {
            let (radar, path) = wheel(angle_rad);
            let [(at_m, velocity), from_receiver] = nodes(&radar, &path);
            assert_eq!((at_m, velocity), from_receiver);
            assert!((at_m - DVec3::from(place_m)).length() < 1e-12, "{at_m}");
            assert!((velocity - DVec3::from(mps)).length() < 1e-12, "{velocity}");
        }
    }
}
