//! Tests of tdm, ddm and bpm against the ideal orthogonal transmitters.

use crate::setting::*;
use artifact::radar::{Multiplexing, Radar};
use artifact::units::SPEED_OF_LIGHT_MPS;
use fmcw_echo::direct_sum::DirectSum;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

fn three_by_four(multiplexing: Multiplexing, chirps: u32) -> Radar {
    radar(artifact::Waveform { chirps, ..experiment(1) }, &presets()[2], multiplexing)
}

fn samples(radar: &Radar, paths: &[artifact::paths::Path]) -> Vec<Complex64> {
    DirectSum::new(radar, radar.waveform.centre_frequency_hz(), paths).cube()
}

#[test]
fn a_still_target_looks_the_same_with_tdm_as_with_simultaneous_transmitters() {
    let still = [point([3.0, 30.0, 1.0], [0.0; 3], 1.0)];
    let [tdm, simultaneous] = [Multiplexing::Tdm, Multiplexing::Simultaneous].map(|m| three_by_four(m, 3));
    // Start times move by whole slots, d + 0·t does not: equal to the last bit of the phase.
    assert!(error_db(&samples(&tdm, &still), &samples(&simultaneous, &still)) < -250.0);
}

#[test]
fn with_tdm_chirp_m_of_transmitter_i_is_slot_m_n_tx_plus_i() {
    let moving = random_paths(31, 6);
    let (tdm, simultaneous) =
        (three_by_four(Multiplexing::Tdm, 4), three_by_four(Multiplexing::Simultaneous, 12));
    let (got, slots) = (samples(&tdm, &moving), samples(&simultaneous, &moving));
    let length = 256;
    for channel in 0..12 {
        let tx = channel / 4;
        for chirp in 0..4 {
            let slot = chirp * 3 + tx;
            let row = &got[(channel * 4 + chirp) * length..][..length];
            assert_eq!(
                row,
                &slots[(channel * 12 + slot) * length..][..length],
                "channel {channel}, chirp {chirp}"
            );
        }
    }
}

#[test]
fn with_tdm_a_target_at_10_mps_turns_1_944_rad_from_transmitter_to_transmitter() {
    let radar = three_by_four(Multiplexing::Tdm, 1);
    let (still, moving) = ([0.0; 3], [0.0, 10.0, 0.0]);
    let [still, moving] = [still, moving].map(|v| samples(&radar, &[point([0.0, 40.0, 6.0], v, 1.0)]));
    for channel in 0..12 {
        let at = channel * 256 + 128;
        let turn = (moving[at] * still[at].conj()).arg();
        // Slot i starts i·T_c later, the chirp's middle is 25 µs after that, and the wave left the target R/c
        // before (4πv(R/c)/λ = 0.0043 rad). Left out: f_c − μτ for f_c, 4e-5 of at most 4.7 rad, and the
        // elements' spread.
        let since_start_s = (channel / 4) as f64 * 60e-6 + 25e-6 - 40.0 / SPEED_OF_LIGHT_MPS;
        let expected = 4.0 * PI * 10.0 * since_start_s / radar.waveform.wavelength_m();
        let difference = (turn - expected + PI).rem_euclid(TAU) - PI;
        assert!(difference.abs() < 5e-4, "channel {channel}: {difference}");
    }
}

#[test]
fn a_ddm_receiver_hears_every_transmitter_turned_by_its_share_of_m_bands() {
    let moving = random_paths(32, 6);
    let chirps = 5;
    let (ddm, simultaneous) =
        (three_by_four(Multiplexing::Ddm, chirps), three_by_four(Multiplexing::Simultaneous, chirps));
    let (got, single) = (samples(&ddm, &moving), samples(&simultaneous, &moving));
    let row = |cube: &[Complex64], channel: usize, chirp: usize| -> Vec<Complex64> {
        cube[(channel * chirps as usize + chirp) * 256..][..256].to_vec()
    };
    assert_eq!(got.len(), 4 * chirps as usize * 256);
    let mut expected = Vec::new();
    for rx in 0..4 {
        for chirp in 0..chirps as usize {
            let transmitters: Vec<_> = (0..3).map(|tx| row(&single, tx * 4 + rx, chirp)).collect();
            // M = 4: quarter turns, j^{im}.
            let turns = [0, 1, 2].map(|tx: usize| Complex64::I.powu((tx * chirp % 4) as u32));
            let sum = |n: usize| (0..3).map(|tx| turns[tx] * transmitters[tx][n]).sum::<Complex64>();
            expected.extend((0..256).map(sum));
        }
    }
    // The turn enters the amplitude before the recurrence: rounding only, 3e-14 as for any factor
    // (superposition.rs).
    assert!(error_db(&got, &expected) < -260.0);
}

#[test]
fn a_bpm_receiver_hears_every_transmitter_with_its_sign_at_the_slots_own_start() {
    let moving = random_paths(33, 6);
    let (blocks, slots, length) = (3, 4, 256);
    let coded = three_by_four(Multiplexing::Bpm, blocks as u32);
    let ideal = three_by_four(Multiplexing::Simultaneous, (blocks * slots) as u32);
    let (got, single) = (samples(&coded, &moving), samples(&ideal, &moving));
    // Three transmitters, four slots: rows of Sylvester's matrix, written out.
    let signs = [[1.0, 1.0, 1.0, 1.0], [1.0, -1.0, 1.0, -1.0], [1.0, 1.0, -1.0, -1.0]];
    let mut expected = Vec::new();
    for (slot, rx) in (0..slots).flat_map(|slot| (0..4).map(move |rx| (slot, rx))) {
        for block in 0..blocks {
            let row = |tx: usize| {
                &single[((tx * 4 + rx) * blocks * slots + block * slots + slot) * length..][..length]
            };
            let sum = |n: usize| (0..3).map(|tx| signs[tx][slot] * row(tx)[n]).sum::<Complex64>();
            expected.extend((0..length).map(sum));
        }
    }
    // Rounding only, as with Doppler division.
    assert!(error_db(&got, &expected) < -260.0);
}

#[test]
fn bpm_rows_of_a_moving_point_are_the_signed_sums_of_their_closed_form() {
    let radar = three_by_four(Multiplexing::Bpm, 8);
    let (f_c, velocity_mps) = (radar.waveform.centre_frequency_hz(), 14.0);
    let path = point([1.0, 33.0, 2.0], [0.0, velocity_mps, 0.0], 1.0);
    let place = |t: f64| glam::DVec3::new(1.0, 33.0 + velocity_mps * t, 2.0);
    let w = radar.waveform;
    // √(P_tG_tG_r σ λ²/(4π)³)/(L₁L₂)·e^{j2π[f₀τ + μtτ − ½μτ²]}, the point where it scattered.
    let echo = |tx: usize, rx: usize, start_s: f64, n: usize| {
        let (t, c) = (n as f64 / w.sample_rate_hz, SPEED_OF_LIGHT_MPS);
        let [p_t, p_r] = [radar.array.tx_m[tx], radar.array.rx_m[rx]].map(glam::DVec3::from_array);
        let back_m = (0..5).fold(0.0, |back_m: f64, _| place(start_s + t - back_m / c).distance(p_r));
        let there_m = place(start_s + t - back_m / c).distance(p_t);
        let tau = (there_m + back_m) / c;
        let power = radar.link.transmit_power_w * 10.0_f64.powf(radar.link.antenna_gain_db / 5.0);
        let amplitude = (power * w.wavelength_m().powi(2) / (4.0 * PI).powi(3)).sqrt() / (there_m * back_m);
        let cycles = w.start_frequency_hz * tau + w.slope_hz_per_s * (t * tau - 0.5 * tau * tau);
        Complex64::from_polar(amplitude, TAU * cycles.fract())
    };
    let signs = [[1.0, 1.0, 1.0, 1.0], [1.0, -1.0, 1.0, -1.0], [1.0, 1.0, -1.0, -1.0]];
    let fast = fmcw_echo::fast_sum::cube(&radar, f_c, &[path], artifact::Accuracy::from_db(-120.0));
    for (name, cube) in [("direct", samples(&radar, &[path])), ("fast", fast)] {
        let mut worst = 0.0_f64;
        for (r, row) in cube.chunks_exact(256).enumerate() {
            let (slot, rx, block) = (r / 8 / 4, r / 8 % 4, r % 8);
            let start_s = (block * 4 + slot) as f64 * w.chirp_interval_s;
            for n in [0, 100, 255] {
                let parts = [0, 1, 2].map(|tx: usize| signs[tx][slot] * echo(tx, rx, start_s, n));
                let exact: Complex64 = parts.iter().sum();
                worst = worst.max((row[n] - exact).norm() / parts[0].norm());
            }
        }
        println!("bpm, {name} sum: worst of all rows {worst:.1e} of one transmitter's echo, asked 1e-6");
        assert!(worst < 1e-6, "{name}: {worst:e}");
    }
}
