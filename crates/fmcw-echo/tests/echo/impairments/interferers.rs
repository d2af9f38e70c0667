//! Other radars, against closed forms.

use crate::setting::*;
use artifact::Waveform;
use artifact::radar::{Interferer, Multiplexing, Radar, Sampling};
use artifact::settings::Noise;
use artifact::units::{SPEED_OF_LIGHT_MPS, watts_from_dbm};
use fmcw_echo::{EchoError, interference};
use num_complex::Complex64;
use rustfft::FftPlanner;
use std::f64::consts::PI;

/// Straight ahead at 80 m, the same sweep of the same length as ours, 20 µs after it.
fn interferer() -> Interferer {
    Interferer {
        position_m: [0.0, 80.0, 6.0],
        velocity_mps: [0.0; 3],
        eirp_w: watts_from_dbm(30.0),
        start_frequency_hz: 77e9,
        slope_hz_per_s: 12.5e12,
        sweep_s: 50e-6,
        chirp_interval_s: 60e-6,
        offset_s: 0.0,
    }
}

fn disturbed(layout: usize, interferers: Vec<Interferer>) -> Radar {
    let mut radar =
        radar(Waveform { chirps: 4, ..experiment(1) }, &presets()[layout], Multiplexing::Simultaneous);
    radar.hardware.interferers = interferers;
    radar
}

#[test]
fn a_crossing_lasts_the_band_over_the_difference_of_slopes_and_has_the_power_of_one_way() {
    // Falls as fast as ours rises: 5.12 MHz over 25 MHz/µs, 0.2 µs: one sample or two. A tenth of the
    // difference: ten times.
    for slope_hz_per_s in [-12.5e12, 11.25e12, 13.5e12, 14e12, 3e12] {
        let start_frequency_hz = 77e9 + (12.5e12 - slope_hz_per_s) * 22e-6;
        let radar = disturbed(0, vec![Interferer { slope_hz_per_s, start_frequency_hz, ..interferer() }]);
        let heard: Vec<f64> = interference::row(&radar, 0.0, 0, 0)
            .iter()
            .map(|x| x.norm_sqr())
            .filter(|power| *power > 0.0)
            .collect();
        // Difference f₀ − f₁ + μt − μ₁(t − τ) is 0 at (22 µs·Δμ − μ₁τ)/Δμ, within our 50 µs for all of them.
        let expected = 5.12e6 * 5.12e6 / (12.5e12 - slope_hz_per_s).abs();
        println!("slope {slope_hz_per_s:e}: {} samples, {expected:.2} by the band", heard.len());
        assert!((heard.len() as f64 - expected).abs() <= 1.0, "{} against {expected}", heard.len());
        let way = radar.waveform.wavelength_m() / (4.0 * PI * 80.0);
        let power = heard.len() as f64 * watts_from_dbm(30.0) * 10.0 * way * way;
        let energy: f64 = heard.iter().sum();
        assert!((energy / power - 1.0).abs() < 1e-12, "{energy:e} W against {power:e}");
    }
}

/// The mixer's output, 64 values a sample, passes a filter without phase that keeps beats of `band_hz` alone,
/// and is sampled then: a plain sum that knows nothing of frequencies at moments.
fn mixed_filtered_sampled(radar: &Radar, band_hz: [f64; 2]) -> Vec<Complex64> {
    let (f_s, own, other) = (radar.waveform.sample_rate_hz, radar.waveform, radar.hardware.interferers[0]);
    let (amplitude, delay_s) = (
        (other.eirp_w * 10.0).sqrt() * own.wavelength_m() / (4.0 * PI * 80.0),
        80.0 / SPEED_OF_LIGHT_MPS + other.offset_s,
    );
    let product = |k: usize| {
        let t = k as f64 / (64.0 * f_s);
        let s = t - delay_s;
        let turns = (own.start_frequency_hz + 0.5 * own.slope_hz_per_s * t) * t
            - (other.start_frequency_hz + 0.5 * other.slope_hz_per_s * s) * s;
        if s < 0.0 { Complex64::ZERO } else { amplitude * Complex64::cis(2.0 * PI * turns.fract()) }
    };
    let mut values: Vec<Complex64> = (0..64 * 256).map(product).collect();
    let mut planner = FftPlanner::new();
    planner.plan_fft_forward(values.len()).process(&mut values);
    for (k, value) in values.iter_mut().enumerate() {
        let beat_hz = (k as f64 - if k < 32 * 256 { 0.0 } else { 64.0 * 256.0 }) * f_s / 256.0;
        let is_passed = (band_hz[0]..band_hz[1]).contains(&beat_hz);
        *value *= if is_passed { 1.0 / (64.0 * 256.0) } else { 0.0 };
    }
    planner.plan_fft_inverse(values.len()).process(&mut values);
    values.into_iter().step_by(64).collect()
}

/// A crossing of 131 samples through the filter that echoes of all ranges of the map pass: beats from 0 to
/// f_s of complex samples (their negatives where our sweep falls), ±f_s/2 of real ones.
#[test]
fn what_is_heard_of_a_crossing_is_a_plain_sum_in_time_through_the_band_of_the_echoes() {
    let f_s = 5.12e6;
    let cases = [
        (Sampling::Complex, 1.0, [0.0, f_s]),
        (Sampling::Complex, -1.0, [-f_s, 0.0]),
        (Sampling::Real, 1.0, [-0.5 * f_s, 0.5 * f_s]),
    ];
    for (sampling, sign, band_hz) in cases {
        let crossing = Interferer {
            slope_hz_per_s: sign * 12.3e12,
            start_frequency_hz: 77e9 + sign * 5e6,
            ..interferer()
        };
        let mut radar = disturbed(0, vec![crossing]);
        radar.waveform.sampling = sampling;
        radar.waveform.slope_hz_per_s = sign * 12.5e12;
        let (heard, plain) = (interference::row(&radar, 0.0, 0, 0), mixed_filtered_sampled(&radar, band_hz));
        let energy = |row: &[Complex64]| row.iter().map(|x| x.norm_sqr()).sum::<f64>();
        let apart: Vec<Complex64> = heard.iter().zip(&plain).map(|(a, b)| a - b).collect();
        let (error, level) = (energy(&apart) / energy(&plain), energy(&heard) / energy(&plain));
        println!("{sampling:?}, {sign}: error {:.1} dB, level {level:.4}", 10.0 * error.log10());
        // Left: ringing at both ends of the band.
        assert!(error < 0.05 && (level - 1.0).abs() < 0.02, "{sampling:?}: {error}, {level}");
    }
}

#[test]
fn an_equal_slope_is_a_target_at_half_the_way_and_half_the_lateness() {
    // f₀ + μt − f₁ − μ(t − τ − late): μ·(τ + late), as of an echo from c/2 of both. The second and the third
    // are beyond half of the map's 61.4 m.
    let near = Interferer { position_m: [0.0, 20.0, 6.0], ..interferer() };
    for offset_s in [60e-9, 150e-9, 330e-9] {
        let radar = disturbed(0, vec![Interferer { offset_s, ..near }]);
        let mut row = interference::row(&radar, 0.0, 0, 1);
        FftPlanner::new().plan_fft_forward(256).process(&mut row);
        let peak = (0..256).max_by(|a, b| row[*a].norm_sqr().total_cmp(&row[*b].norm_sqr())).unwrap();
        let ghost_m = 0.5 * (20.0 + SPEED_OF_LIGHT_MPS * offset_s);
        let cell = ghost_m / radar.waveform.range_resolution_m();
        println!("ghost at {ghost_m:.2} m, cell {cell:.2}, peak in {peak}");
        assert!((peak as f64 - cell).abs() <= 0.5 + 1e-9 && row[peak].norm_sqr() > 0.0);
    }
    // The band ends at the sample rate, a ghost at 61.4 m, and on the other side at 0.
    for offset_s in [400e-9, -100e-9] {
        let beyond = disturbed(0, vec![Interferer { offset_s, ..near }]);
        assert!(interference::row(&beyond, 0.0, 0, 1).iter().all(|x| *x == Complex64::ZERO));
    }
}

/// At 340 m/s and slopes that differ by 3e-4, what the interferer moves within a chirp shifts the end of the
/// crossing by half a hundred samples: all that lie within the band are heard.
#[test]
fn a_crossing_of_nearly_equal_slopes_is_whole_though_the_interferer_moves() {
    let (own_slope, slope_hz_per_s, speed_mps) = (0.244_140_625e12, 0.244_213_867_187_5e12, 340.0);
    let moving = Interferer {
        position_m: [0.0, 300.0, 6.0],
        velocity_mps: [0.0, speed_mps, 0.0],
        slope_hz_per_s,
        start_frequency_hz: 76.999_340_392_635_74e9,
        sweep_s: 24_576e-6,
        chirp_interval_s: 26_214.4e-6,
        offset_s: -1.000_692_285_594_456e-6,
        ..interferer()
    };
    let mut radar = disturbed(0, vec![moving]);
    radar.waveform = Waveform {
        start_frequency_hz: 77e9,
        slope_hz_per_s: own_slope,
        sample_rate_hz: 1e6,
        samples: 16_384,
        chirps: 1,
        sampling: Sampling::Real,
        ..radar.waveform
    };
    let row = interference::row(&radar, 0.0, 0, 0);
    let is_heard = |n: &usize| {
        let t = *n as f64 * 1e-6;
        // The way of the wave that arrives at t: R(t − τ) = cτ.
        let delay_s = (300.0 + speed_mps * t) / (SPEED_OF_LIGHT_MPS + speed_mps);
        let s = t - moving.offset_s - delay_s;
        let apart_hz = (77e9 - moving.start_frequency_hz) + own_slope * t - slope_hz_per_s * s;
        (0.0..moving.sweep_s).contains(&s) && apart_hz.abs() < 0.5e6
    };
    let (heard, expected) =
        (row.iter().filter(|x| x.norm() > 0.0).count(), (0..16_384).filter(is_heard).count());
    println!("{heard} samples of {expected}");
    assert!(heard.abs_diff(expected) <= 2, "{heard} of {expected}");
}

/// A chirp of 65 s against chirps of a tenth of a microsecond: 655 million of them arrive, and each of our
/// 65,536 samples hears one at most.
#[test]
fn of_chirps_far_shorter_than_a_sample_each_sample_hears_its_own() {
    let short = Interferer {
        velocity_mps: [0.0, -1.0, 0.0],
        slope_hz_per_s: 1e9,
        sweep_s: 0.08e-6,
        chirp_interval_s: 0.1e-6,
        ..interferer()
    };
    let mut radar = disturbed(0, vec![short]);
    radar.waveform =
        Waveform { slope_hz_per_s: 10.0, sample_rate_hz: 1e3, samples: 65_536, chirps: 1, ..radar.waveform };
    let start = std::time::Instant::now();
    let row = interference::row(&radar, 0.0, 0, 0);
    assert!(start.elapsed().as_secs() < 5, "{:?}", start.elapsed());
    let (mut heard, mut sum) = (0, 0.0);
    for (n, sample) in row.iter().enumerate() {
        let t = n as f64 * 1e-3;
        // The way of the wave that arrives at t: R(t − τ) = cτ.
        let delay_s = (80.0 - t) / (SPEED_OF_LIGHT_MPS - 1.0);
        let s = (t - delay_s).rem_euclid(0.1e-6);
        let edge = [0.0, 0.08e-6, 0.1e-6].iter().any(|edge| (s - edge).abs() < 1e-12);
        let apart_hz = 10.0 * t - 1e9 * s;
        if edge || apart_hz.abs() < 1.0 {
            continue;
        }
        let is_heard = s < 0.08e-6 && (0.0..1e3).contains(&apart_hz);
        assert_eq!(*sample != Complex64::ZERO, is_heard, "sample {n}, {s} s into a chirp");
        heard += usize::from(is_heard);
        let way = radar.waveform.wavelength_m() / (4.0 * PI * (80.0 - (t - delay_s)));
        sum += if is_heard { sample.norm_sqr() / (watts_from_dbm(30.0) * 10.0 * way * way) } else { 0.0 };
    }
    println!("{heard} samples heard of 65536");
    assert!(heard > 10_000 && (sum / heard as f64 - 1.0).abs() < 1e-9, "{heard} heard, {sum}");
}

/// An interferer of our slope whose chirps follow each other at our chirps' interval is a still target: its
/// phase is the same from chirp to chirp, also hours after the scene's first sample, where times are told to
/// 2 ps, a seventh of a turn at 77 GHz.
#[test]
fn an_interferer_keeps_its_phase_from_chirp_to_chirp_after_hours() {
    let radar =
        disturbed(0, vec![Interferer { offset_s: 60e-9, position_m: [0.0, 20.0, 6.0], ..interferer() }]);
    let interval_s = radar.waveform.chirp_interval_s;
    for time_s in [0.0, 150_000_000.0 * interval_s] {
        let rows: Vec<Vec<Complex64>> =
            (0..4).map(|chirp| interference::row(&radar, time_s, 0, chirp)).collect();
        for pair in rows.windows(2) {
            let turn = (pair[1][100] * pair[0][100].conj()).arg();
            assert!(turn.abs() < 1e-4, "{turn} rad from chirp to chirp at {time_s} s");
        }
    }
}

#[test]
fn interferers_add_and_come_from_their_direction() {
    let sine: f64 = 0.3;
    let aside = [80.0 * sine, 80.0 * (1.0 - sine * sine).sqrt(), 6.0];
    // 3 MHz higher: μτ of 80 m and the difference of slopes cross the band within 22 µs.
    let start_frequency_hz = 77.003e9;
    let one = Interferer { position_m: aside, slope_hz_per_s: 12.4e12, start_frequency_hz, ..interferer() };
    let other = Interferer { slope_hz_per_s: 12.6e12, velocity_mps: [0.0, -20.0, 0.0], ..interferer() };
    let of = |interferers: Vec<Interferer>, channel| {
        interference::row(&disturbed(2, interferers), 0.3, channel, 2)
    };
    for channel in [0, 5, 11] {
        let (both, [a, b]) = (of(vec![one, other], channel), [one, other].map(|i| of(vec![i], channel)));
        assert!(a.iter().chain(&b).filter(|x| **x != Complex64::ZERO).count() > 100);
        for ((both, a), b) in both.iter().zip(a).zip(b) {
            assert_eq!(*both, a + b);
        }
    }
    // Half a wavelength further right: e^{−jπu}, as an echo has it. Left out: the wavefront's curvature and f
    // for f_c, 0.01 rad.
    let rows: Vec<Vec<Complex64>> = (0..4).map(|channel| of(vec![one], channel)).collect();
    let n = (0..256).find(|n| rows.iter().all(|row| row[*n] != Complex64::ZERO)).unwrap();
    for pair in rows.windows(2) {
        let turn = (pair[1][n] * pair[0][n].conj()).arg();
        assert!((turn + PI * sine).abs() < 0.01, "{turn}");
    }
}

#[test]
fn an_interferer_is_in_the_cube_beside_echoes_and_noise_and_refused_where_it_means_nothing() {
    let radar = disturbed(0, vec![Interferer { slope_hz_per_s: 12.4e12, ..interferer() }]);
    let cube = |radar: &Radar| {
        let header = header(radar.clone(), Noise::Figure { noise_figure_db: 12.0, temperature_k: 290.0 });
        synthesized(&header, 1, &frame(vec![point([0.0, 40.0, 6.0], [0.0; 3], 10.0)]))
    };
    let (with, without) = (cube(&radar).unwrap().samples, cube(&disturbed(0, vec![])).unwrap().samples);
    for chirp in 0..4 {
        let heard = interference::row(&radar, 0.0, 0, chirp);
        for (n, heard) in heard.iter().enumerate() {
            let [with, without] = [&with, &without].map(|cube| widened(&cube[chirp * 256 + n..][..1])[0]);
            // One sum in f32.
            assert!(
                (with - without - heard).norm() <= 1.2e-7 * (with.norm() + without.norm() + heard.norm())
            );
        }
    }
    let wrong = [
        Interferer { position_m: radar.position_m, ..interferer() },
        Interferer { eirp_w: f64::NAN, ..interferer() },
        Interferer { chirp_interval_s: 0.0, ..interferer() },
        Interferer { sweep_s: 61e-6, ..interferer() },
    ];
    for wrong in wrong {
        let refused = cube(&disturbed(0, vec![wrong]));
        assert!(matches!(refused, Err(EchoError::Interferer { index: 0, .. })), "{refused:?}");
    }
}
