//! Antenna patterns from tables.

use crate::setting::*;
use crate::three_sums::the_three_sums_agree;
use artifact::Accuracy;
use artifact::radar::{Multiplexing, Pattern, PatternTable, Radar};
use artifact::settings::Noise;
use fmcw_echo::direct_sum::DirectSum;
use fmcw_echo::{EchoError, fast_sum};
use std::f64::consts::PI;

/// Table of cos²: amplitude cos²(az)·cos²(el) of the front, in even steps.
fn cosine_table(steps: usize) -> PatternTable {
    let angles: Vec<f64> = (0..=steps).map(|i| PI * (i as f64 / steps as f64 - 0.5)).collect();
    let of = |angle: f64| angle.cos().powi(2);
    let amplitude = angles.iter().flat_map(|el| angles.iter().map(move |az| of(*az) * of(*el))).collect();
    PatternTable { azimuth_rad: angles.clone(), elevation_rad: angles, amplitude }
}

fn with(pattern: Pattern, multiplexing: Multiplexing) -> Radar {
    let mut radar = radar(artifact::Waveform { chirps: 16, ..experiment(1) }, &presets()[2], multiplexing);
    (radar.boresight_az_rad, radar.boresight_el_rad) = (0.1, -0.15);
    radar.array.pattern = pattern;
    radar
}

#[test]
fn a_table_of_the_cosine_gives_the_cosines_echo_to_the_interpolations_error() {
    let paths = random_paths(81, 40);
    let cube = |pattern| {
        let radar = with(pattern, Multiplexing::Tdm);
        DirectSum::new(&radar, radar.waveform.centre_frequency_hz(), &paths).cube()
    };
    let exact = cube(Pattern::Cosine { exponent: 2.0 });
    for steps in [36, 180] {
        // Of cos², third derivative 4, by both axes and both ways; relative to gains of 0.2 at least (paths
        // lie within 40° across and 35° down, cos²·cos² = 0.39).
        let h = PI / steps as f64;
        let bound_db = 20.0 * (4.0 * h.powi(3) * 4.0 / (36.0 * 3.0_f64.sqrt()) / 0.2).log10();
        let got = error_db(&cube(Pattern::Table(cosine_table(steps))), &exact);
        println!("cos² told in {steps} steps: {got:.1} dB, bound {bound_db:.1} dB");
        assert!(got <= bound_db, "{got:.1} beyond {bound_db:.1}");
    }
}

#[test]
fn the_three_sums_agree_on_a_table_under_every_multiplexing() {
    for multiplexing in [Multiplexing::Simultaneous, Multiplexing::Tdm, Multiplexing::Ddm, Multiplexing::Bpm]
    {
        let radar = with(Pattern::Table(cosine_table(36)), multiplexing);
        the_three_sums_agree(&radar, "table", 82);
    }
}

#[test]
fn behind_a_table_of_the_front_nothing_is_heard_and_a_table_with_a_back_hears_it() {
    // Straight behind the boresight of `with`.
    let (sin_az, cos_az, sin_el, cos_el) = (0.1_f64.sin(), 0.1_f64.cos(), -0.15_f64.sin(), 0.15_f64.cos());
    let position_m = [-30.0 * sin_az * cos_el, -30.0 * cos_az * cos_el, 6.0 - 30.0 * sin_el];
    let behind = [point(position_m, [0.0; 3], 1.0)];
    let level = |table: PatternTable| {
        let radar = with(Pattern::Table(table), Multiplexing::Simultaneous);
        let cube = DirectSum::new(&radar, 77.3125e9, &behind).cube();
        cube.iter().map(|x| x.norm()).fold(0.0, f64::max)
    };
    assert_eq!(level(cosine_table(36)), 0.0);
    let around = |amplitude| PatternTable {
        azimuth_rad: vec![-PI, 0.0, PI],
        elevation_rad: vec![0.0],
        amplitude: vec![amplitude, 1.0, amplitude],
    };
    let (half, one) = (level(around(0.5)), level(around(1.0)));
    // Elements lie up to 0.02 m aside, 7e-4 rad at 30 m, and the parabola 1 − ½(az/π)² falls by 1/π a radian.
    assert!((half / one - 0.25).abs() < 1e-3 * 0.25, "{}", half / one);
}

#[test]
fn a_whole_body_behind_the_array_adds_nothing_to_the_fast_sum() {
    let radar = with(Pattern::Cosine { exponent: 2.0 }, Multiplexing::Simultaneous);
    let f_c = radar.waveform.centre_frequency_hz();
    let (ahead, behind) = (
        body(84, 300, [5.75, 40.0, 0.7], [0.0, -10.0, 0.0]),
        body(85, 300, [0.0, -20.0, 0.7], [0.0, 5.0, 0.0]),
    );
    let behind: Vec<_> = behind.into_iter().map(|path| artifact::paths::Path { target: 1, ..path }).collect();
    let sum = |paths: &[_]| fast_sum::cube(&radar, f_c, paths, Accuracy::from_db(-60.0));
    assert_eq!(sum(&[&ahead[..], &behind].concat()), sum(&ahead));
    assert!(sum(&behind).iter().all(|value| value.norm() == 0.0));
}

#[test]
fn a_table_without_a_value_for_each_direction_is_refused() {
    let mut table = cosine_table(36);
    table.amplitude.pop();
    let radar = with(Pattern::Table(table), Multiplexing::Simultaneous);
    let refused = synthesized(&header(radar, Noise::Absent), 1, &frame(vec![]));
    assert_eq!(refused.unwrap_err(), EchoError::Pattern);
}
