//! Chirps at changing intervals, and sub-frames.

use crate::setting::*;
use crate::three_sums::the_three_sums_agree;
use artifact::radar::{Multiplexing, Radar};
use artifact::settings::Noise;
use artifact::units::SPEED_OF_LIGHT_MPS;
use artifact::{Accuracy, Waveform};
use fmcw_echo::direct_sum::DirectSum;
use fmcw_echo::{EchoError, fast_sum};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Delays of three chirps that take turns: intervals of 60 µs and 7, −2 and −5 µs.
const STAGGER_S: [f64; 3] = [0.0, 7e-6, 5e-6];

fn staggered(preset: usize, multiplexing: Multiplexing, chirps: u32) -> Radar {
    let mut radar = radar(Waveform { chirps, ..experiment(1) }, &presets()[preset], multiplexing);
    radar.schedule.stagger_s = STAGGER_S.to_vec();
    radar
}

#[test]
fn a_staggered_chirp_turns_by_the_way_driven_up_to_its_own_start() {
    let radar = staggered(0, Multiplexing::Simultaneous, 7);
    let moving = [point([0.0, 40.0, 6.0], [0.0, 10.0, 0.0], 1.0)];
    let samples = DirectSum::new(&radar, radar.waveform.centre_frequency_hz(), &moving).cube();
    let middle = |chirp: usize| samples[chirp * 256 + 128];
    for chirp in 1..7 {
        let start_s = chirp as f64 * 60e-6 + STAGGER_S[chirp % 3];
        assert_eq!(radar.chirp_start_s(0, chirp), start_s);
        // Phase 2π(f_c − μτ)Δτ − πμΔτ², Δτ the change of the delay; leaving and scattering times move Δτ by
        // v/c of it, 1e-6 rad.
        let tau = 2.0 * (40.0 + 10.0 * (25e-6 - 40.0 / SPEED_OF_LIGHT_MPS)) / SPEED_OF_LIGHT_MPS;
        let later_s = 2.0 * 10.0 * start_s / SPEED_OF_LIGHT_MPS;
        let cycles = (radar.waveform.centre_frequency_hz() - 12.5e12 * (tau + 0.5 * later_s)) * later_s;
        let turn = (middle(chirp) * middle(0).conj()).arg();
        let difference = (turn - TAU * cycles + PI).rem_euclid(TAU) - PI;
        assert!(difference.abs() < 2e-6, "chirp {chirp}: {difference:e} rad");
    }
}

#[test]
fn the_three_sums_agree_on_staggered_chirps() {
    for multiplexing in [Multiplexing::Simultaneous, Multiplexing::Tdm, Multiplexing::Ddm, Multiplexing::Bpm]
    {
        let radar = staggered(2, multiplexing, 32);
        the_three_sums_agree(&radar, "staggered", 51);
    }
}

#[test]
fn a_record_of_a_sub_frame_is_the_frame_of_a_radar_with_its_interval() {
    let mut header = header(
        radar(Waveform { chirps: 8, ..experiment(1) }, &presets()[1], Multiplexing::Tdm),
        Noise::Absent,
    );
    header.radar.schedule.sub_frame_intervals_s = vec![60e-6, 85e-6];
    let paths = random_paths(53, 5);
    let cube = |header: &artifact::cube::CubeHeader, index: u32| {
        let frame = artifact::paths::PathsFrame { index, ..frame(paths.clone()) };
        synthesized(header, 1, &frame).unwrap().samples
    };
    for (index, interval_s) in [(0, 60e-6), (1, 85e-6), (2, 60e-6), (5, 85e-6)] {
        let mut alone = header.clone();
        alone.radar.schedule.sub_frame_intervals_s.clear();
        alone.radar.waveform.chirp_interval_s = interval_s;
        assert_eq!(cube(&header, index), cube(&alone, index), "record {index}");
    }
    assert_eq!(header.radar.sub_frame_start_s(5), 8.0 * 60e-6);
    assert_eq!(header.radar.cycle_duration_s(), 8.0 * 60e-6 + 8.0 * 85e-6);
}

#[test]
fn a_chirp_within_another_is_refused() {
    for stagger_s in [vec![0.0, 11e-6], vec![0.0, -11e-6], vec![1e-6, 0.0], vec![0.0, f64::NAN]] {
        let mut header = header(staggered(0, Multiplexing::Simultaneous, 4), Noise::Absent);
        header.radar.schedule.stagger_s = stagger_s;
        let refused = synthesized(&header, 1, &frame(vec![]));
        assert!(matches!(refused, Err(EchoError::Stagger { .. })), "{refused:?}");
    }
}

#[test]
fn more_delays_than_chirps_are_frames_of_one_chirp() {
    let mut radar = staggered(0, Multiplexing::Simultaneous, 3);
    radar.schedule.stagger_s = vec![0.0, 1e-6, 3e-6, 2e-6, 5e-6];
    let (f_c, body) =
        (radar.waveform.centre_frequency_hz(), body(54, 300, [5.75, 40.0, 0.7], [0.0, -10.0, 0.0]));
    let exact: Vec<Complex64> = DirectSum::new(&radar, f_c, &body).cube();
    assert!(error_db(&fast_sum::cube(&radar, f_c, &body, Accuracy::from_db(-60.0)), &exact) <= -60.0);
}
