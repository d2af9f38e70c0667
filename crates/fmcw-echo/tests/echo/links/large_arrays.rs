//! Each element has its own spherical wave; what a plane wave across the array would cost.

use crate::setting::*;
use artifact::radar::{Multiplexing, Radar};
use artifact::{Accuracy, Waveform};
use fmcw_echo::direct_sum::DirectSum;
use fmcw_echo::fast_sum;
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Bound of the phase that a plane wave leaves out at an element δ off the centre, a leg of length r in
/// direction d̂: 2π/λ·(|δ|² − (d̂·δ)²)/2r, and of the next order |δ|³/2r² (from the centre: Taylor's |r·d̂ −
/// δ|).
fn bound_rad(radar: &Radar, offset_m: DVec3, to_target_m: DVec3) -> f64 {
    let (r, d) = (to_target_m.length(), to_target_m.normalize_or_zero());
    let curvature_m = (offset_m.length_squared() - d.dot(offset_m).powi(2)) / (2.0 * r);
    TAU / radar.waveform.wavelength_m() * (curvature_m + offset_m.length().powi(3) / (2.0 * r * r))
}

/// Phase of the samples between the chirp's middle at a channel and the plane wave from the array's centre.
fn curvature_rad(radar: &Radar, cube: &[Complex64], at_m: DVec3, channel: usize) -> f64 {
    let (receivers, centre_m) = (radar.array.rx_m.len(), DVec3::from_array(radar.position_m));
    let (samples, chirps) = (radar.waveform.samples as usize, radar.waveform.chirps as usize);
    let to_target_m = at_m - centre_m;
    let (r, d) = (to_target_m.length(), to_target_m / to_target_m.length());
    let tx = DVec3::from_array(radar.array.tx_m[channel / receivers]) - centre_m;
    let rx = DVec3::from_array(radar.array.rx_m[channel % receivers]) - centre_m;
    let tau = (2.0 * r - d.dot(tx + rx)) / artifact::units::SPEED_OF_LIGHT_MPS;
    let w = &radar.waveform;
    let t = (samples / 2) as f64 / w.sample_rate_hz;
    let cycles = w.start_frequency_hz * tau + w.slope_hz_per_s * (t * tau - 0.5 * tau * tau);
    (cube[channel * chirps * samples + samples / 2] * Complex64::cis(-TAU * cycles.fract())).arg()
}

#[test]
fn a_plane_wave_would_err_by_its_bound_and_no_sum_takes_one() {
    // Presets in the order of their size; at 25 m straight ahead and 35° aside.
    for layout in &presets()[2..] {
        let radar = radar(Waveform { chirps: 1, ..experiment(1) }, layout, Multiplexing::Simultaneous);
        let f_c = radar.waveform.centre_frequency_hz();
        for at_m in [DVec3::new(0.0, 25.0, 6.0), DVec3::new(14.3, 20.5, 1.0)] {
            let path = [point(at_m.to_array(), [0.0; 3], 1.0)];
            let direct = DirectSum::new(&radar, f_c, &path).cube();
            let fast = fast_sum::cube(&radar, f_c, &path, Accuracy::from_db(-60.0));
            let centre_m = DVec3::from_array(radar.position_m);
            let (mut worst, mut worst_bound) = (0.0_f64, 0.0_f64);
            for channel in 0..radar.virtual_channels() {
                let receivers = radar.array.rx_m.len();
                let ends = [radar.array.tx_m[channel / receivers], radar.array.rx_m[channel % receivers]];
                let bound: f64 = ends
                    .iter()
                    .map(|end| bound_rad(&radar, DVec3::from_array(*end) - centre_m, at_m - centre_m))
                    .sum();
                for cube in [&direct, &fast] {
                    let got = curvature_rad(&radar, cube, at_m, channel).abs();
                    assert!(
                        got <= bound + 1e-6,
                        "{}: channel {channel} errs by {got}, bound {bound}",
                        layout.name
                    );
                    worst = worst.max(got);
                }
                worst_bound = worst_bound.max(bound);
            }
            println!(
                "{}: a plane wave errs by {worst:.4} rad, bound {worst_bound:.4} rad, at {at_m}",
                layout.name
            );
            // The bound is no more than what the elements' own waves are: none of it is thrown away.
            assert!(worst > 0.9 * worst_bound, "{}: {worst} of {worst_bound}", layout.name);
        }
    }
}
