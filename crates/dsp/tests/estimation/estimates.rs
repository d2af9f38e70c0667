//! Refined estimates against the Cramér–Rao bound.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::bound_trials::{drawn, over_bound_db, pairs_refined, radar};
use crate::common::*;
use artifact::settings::{Refine, Window};
use dsp::Receiver;

#[test]
fn refined_estimates_of_a_lone_point_stay_within_1_db_of_the_cramer_rao_bound() {
    for (name, elements, parameters) in [("3x4", elements_3x4(), 3), ("6x8", elements_6x8(), 4)] {
        let header = radar(elements, Refine::Isolated);
        for snr_db in [15.0, 30.0] {
            let trials = if parameters == 3 { 300 } else { 150 };
            let (got_db, found) = over_bound_db(&header, snr_db, trials);
            println!("{name}, {snr_db} dB: over the bound {got_db:.2?} dB, found {found}");
            assert_eq!(found, 1.0);
            // The mean square of n normal errors strays by √(2/n): three times 0.35 dB of 300, 0.50 dB of
            // 150.
            let strays_db = 3.0 * 10.0 / std::f64::consts::LN_10 * (2.0 / trials as f64).sqrt();
            for got_db in &got_db[..parameters] {
                assert!(got_db.abs() < 1.0 + strays_db, "{name} at {snr_db} dB: {got_db}");
            }
        }
    }
}

#[test]
fn refined_estimates_under_time_doppler_and_code_division_have_no_bias() {
    use artifact::radar::Multiplexing;
    for multiplexing in [Multiplexing::Simultaneous, Multiplexing::Tdm, Multiplexing::Ddm, Multiplexing::Bpm]
    {
        let mut header = radar(elements_3x4(), Refine::Isolated);
        header.radar.array.multiplexing = multiplexing;
        header.dsp.range_window = Window::Hann;
        header.noise = NOISE_12_DB;
        let receiver = Receiver::new(&header).unwrap();
        // 60 dB over the noise of a cell: what is left is the model's error, below a hundredth of a cell.
        for seed in 0..20 {
            let mut target = drawn(&header, 1e6, seed);
            target.velocity_mps = target.velocity_mps.map(|v| 0.3 * v);
            let cube = cube(&header, &[target], seed);
            let map = receiver.range_doppler(&cube).unwrap();
            let point = receiver.detect_refined(&map, &cube).unwrap().points[0];
            let (range_m, velocity_mps, _) = truth(&header, &target);
            let range_cells = (point.range_m - range_m) / header.radar.waveform.range_resolution_m();
            let velocity_cells =
                (point.radial_velocity_mps - velocity_mps) / header.radar.velocity_resolution_mps();
            assert!(
                range_cells.abs() < 0.01 && velocity_cells.abs() < 0.01,
                "{multiplexing:?}, {seed}: {range_cells}, {velocity_cells}"
            );
        }
    }
}

#[test]
fn an_equal_echo_anywhere_near_leaves_those_refined_within_1_db_of_their_bound() {
    let header = radar(elements_3x4(), Refine::Isolated);
    // Same direction from unresolved to far, other velocities, other directions in the same cell; apart in
    // both ways.
    let apart = [[0.6, 0.0, 0.0], [3.0, 0.0, 0.0], [24.0, 0.0, 0.0], [0.0, 8.0, 0.0], [0.0, 0.0, 1.5]];
    for (apart, least_refined) in apart.map(|a| (a, 0.0)).into_iter().chain([([24.0, 8.0, 0.0], 0.95)]) {
        let pairs = pairs_refined(&header, 25.0, 100, apart);
        let got_db = pairs.over_bound_db;
        println!("{apart:?} apart: {:.2} refined, over the bound {got_db:.2?} dB", pairs.refined);
        // Few refined stray by 4.34·√(2/n) dB, three times; the leakage may add 0.4 dB to the 1 dB of a lone
        // one.
        let count = pairs.refined * pairs.found * 100.0;
        let strays_db = 3.0 * 10.0 / std::f64::consts::LN_10 * (2.0 / count).sqrt();
        assert!(pairs.refined >= least_refined, "{apart:?}: {}", pairs.refined);
        assert!(count < 1.0 || got_db[..3].iter().all(|db| *db < 1.4 + strays_db), "{apart:?}: {got_db:?}");
    }
}

#[test]
fn a_point_beside_another_is_left_as_its_peak_says() {
    // 50 dB over the noise: what they leak into each other is far above it.
    let pair = [30.0, 36.0].map(|y| target([0.0, y, 6.0], [0.0, -2.0, 0.0], 1e4));
    let place = |refine: Refine| {
        let header = radar(elements_3x4(), refine);
        let cube = cube(&header, &pair, 1);
        Receiver::new(&header).unwrap().process(&cube).unwrap().1
    };
    assert_eq!(place(Refine::Isolated), place(Refine::Off));
}
