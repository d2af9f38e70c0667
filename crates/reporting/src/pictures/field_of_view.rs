//! Field of view of a radar.

use artifact::radar::Radar;
use radar::aperture::horizontal;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

/// Angles left and right of the boresight, at its elevation, up to which an element's gain is within 3 dB of
/// that along the boresight; a right angle at most, because an array cannot distinguish front from back.
pub(crate) fn half_angles_rad(radar: &Radar) -> [f64; 2] {
    const ARC_STEPS: u32 = 360;
    let gain = |angle: f64| radar.array.pattern.amplitude([angle.sin(), angle.cos(), 0.0]);
    let least = FRAC_1_SQRT_2 * gain(0.0);
    [-1.0, 1.0].map(|side| {
        let angles = (1..=ARC_STEPS).map(|step| FRAC_PI_2 * f64::from(step) / f64::from(ARC_STEPS));
        angles.take_while(|angle| gain(side * angle) >= least).last().unwrap_or(0.0)
    })
}

/// World x and y of the outline: from the radar along an arc on the ground at the maximum unambiguous range
/// and back.
pub(super) fn rim_m(radar: &Radar) -> Vec<[f64; 2]> {
    let [left, right] = half_angles_rad(radar);
    let [x_m, y_m, height_m] = radar.position_m;
    let far_m = (radar.waveform.range_max_m().powi(2) - height_m * height_m).max(0.0).sqrt();
    let angles = (0..=64).map(|i| -left + (left + right) * f64::from(i) / 64.0);
    let arc = angles.map(|angle| on_ground_m(radar, radar.boresight_az_rad + angle, far_m));
    let foot = || std::iter::once([x_m, y_m]);
    foot().chain(arc).chain(foot()).collect()
}

/// World x and y of the place at a horizontal distance `far_m` ahead of a radar.
pub(super) fn ahead_m(radar: &Radar, far_m: f64) -> [f64; 2] {
    on_ground_m(radar, radar.boresight_az_rad, far_m)
}

/// World x and y of the place at a horizontal distance `far_m` from a radar, towards an azimuth.
fn on_ground_m(radar: &Radar, azimuth_rad: f64, far_m: f64) -> [f64; 2] {
    let ([x_m, y_m, _], [x, y]) = (radar.position_m, horizontal(azimuth_rad));
    [x_m + far_m * x, y_m + far_m * y]
}

/// Words of the legend about the field of view.
pub(crate) fn words(radar: &Radar) -> String {
    let [left, right] = half_angles_rad(radar).map(|angle| angle.to_degrees().round());
    let range_m = radar.waveform.range_max_m();
    match left == right {
        _ if left >= 90.0 && right >= 90.0 => {
            format!("field of view: the half-plane ahead (isotropic elements), to {range_m:.0} m")
        }
        true => format!("field of view: ±{left}° (−3 dB of an element), to {range_m:.0} m"),
        false => format!("field of view: −{left}° to {right}° (−3 dB of an element), to {range_m:.0} m"),
    }
}
