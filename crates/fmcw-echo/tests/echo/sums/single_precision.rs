//! X4: what single precision costs, and where the product stores it.

use crate::setting::*;
use artifact::settings::Noise;
use artifact::units::SPEED_OF_LIGHT_MPS;
use fmcw_echo::direct_sum::DirectSum;
use fmcw_echo::multiplexing::row;
use fmcw_echo::reference::legs_at;
use num_complex::Complex64;
use radar::beat::if_cycles;
use std::f64::consts::{PI, TAU};

/// Phasors of a point from 40 m on, receding at 10 m/s, its phase in cycles made by `cycles(t, path length)`.
fn phasors(cycles: impl Fn(f64, f64) -> f64) -> Vec<Complex64> {
    let radar = single_channel(experiment(1));
    let path = point([0.0, 40.0, 6.0], [0.0, 10.0, 0.0], 1.0);
    let mut phasors = Vec::new();
    for chirp in 0..128 {
        let transmission = row(&radar, 0, chirp)[0];
        for sample in 0..256 {
            let t = f64::from(sample) / radar.waveform.sample_rate_hz;
            let legs = legs_at(&path, &transmission, transmission.start_s + t);
            phasors.push(Complex64::cis(TAU * cycles(t, legs.delay_s() * SPEED_OF_LIGHT_MPS)));
        }
    }
    phasors
}

fn cycles_of_length(t: f64, length_m: f64) -> f64 {
    if_cycles(&experiment(1), t, length_m / SPEED_OF_LIGHT_MPS)
}

#[test]
fn x4_a_path_length_in_f32_costs_all_below_minus_48_9_db() {
    let exact = phasors(|t, length_m| cycles_of_length(t, length_m).fract());
    let rounded = phasors(|t, length_m| cycles_of_length(t, f64::from(length_m as f32)).fract());
    let db = error_db(&rounded, &exact);
    // 80 m lie between 64 and 128: steps of 2⁻¹⁷ m, 1/√12 of a step rms, 2π/λ each.
    let lambda_m = experiment(1).wavelength_m();
    let derived = 20.0 * (TAU / lambda_m * 2.0_f64.powi(-17) / 12.0_f64.sqrt()).log10();
    // 32 768 samples of a uniform error: its rms is known to 0.2 %, 0.02 dB; the steps are driven through
    // slowly.
    assert!((db - derived).abs() < 0.1, "{db} against {derived}");
    assert!((db + 48.9).abs() < 0.15, "{db}");
}

#[test]
fn x4_fractional_cycles_in_f32_cost_all_below_minus_141_7_db() {
    let exact = phasors(|t, length_m| cycles_of_length(t, length_m).fract());
    let rounded = phasors(|t, length_m| f64::from(cycles_of_length(t, length_m).fract() as f32));
    let db = error_db(&rounded, &exact);
    // Cycles in ½ … 1 have steps of 2⁻²⁴, in ¼ … ½ half of that …: mean square 4/7 of 2⁻⁴⁸/12.
    let derived = 10.0 * (TAU * TAU * 4.0 / 7.0 * 2.0_f64.powi(-48) / 12.0).log10();
    assert!((db - derived).abs() < 0.1, "{db} against {derived}");
    assert!((db + 141.7).abs() < 0.15, "{db}");
}

#[test]
fn x4_the_stored_cube_loses_only_the_rounding_of_its_samples() {
    let radar = single_channel(experiment(1));
    let f_c = radar.waveform.centre_frequency_hz();
    let paths = random_paths(3, 50);
    let exact = DirectSum::new(&radar, f_c, &paths).cube();
    let stored = synthesized(&header(radar, Noise::Absent), 1, &frame(paths)).unwrap();
    let db = error_db(&widened(&stored.samples), &exact);
    // Rounding moves a number by at most 2⁻²⁴ of itself; evenly spread mantissas make it about 0.42·2⁻²⁴ rms:
    // −152 dB.
    let bound_db = 20.0 * 2.0_f64.powi(-24).log10();
    println!("f32 storage: {db:.1} dB, bound {bound_db:.1} dB");
    assert!(db < bound_db && db > bound_db - 4.0 * PI, "{db}");
}
