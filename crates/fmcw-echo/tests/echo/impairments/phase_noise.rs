//! Phase noise of the oscillator, as echoes keep it.

use crate::setting::*;
use artifact::radar::{Multiplexing, PhaseNoise, Radar};
use artifact::settings::Noise;
use artifact::{Accuracy, Waveform};
use fmcw_echo::oscillator::{Oscillator, density};
use fmcw_echo::{EchoError, phase_noise, reference};
use num_complex::Complex64;
use rustfft::FftPlanner;
use std::f64::consts::{PI, TAU};

/// A 77 GHz synthesizer in silicon: −70 dBc/Hz within its loop, −92 at 1 MHz, −110 far away.
fn silicon() -> Vec<PhaseNoise> {
    [(1e4, -70.0), (1e5, -70.0), (1e6, -92.0), (1e7, -110.0)]
        .map(|(offset_hz, dbc_per_hz)| PhaseNoise { offset_hz, dbc_per_hz })
        .to_vec()
}

fn noisy(multiplexing: Multiplexing, layout: usize, chirps: u32) -> Radar {
    let mut radar = radar(Waveform { chirps, ..experiment(1) }, &presets()[layout], multiplexing);
    radar.hardware.phase_noise = silicon();
    radar
}

/// Every sample of every path from the formulas.
fn exact(radar: &Radar, paths: &[artifact::paths::Path], oscillator: &Oscillator) -> Vec<Complex64> {
    let [chirps, samples] = [radar.waveform.chirps as usize, radar.waveform.samples as usize];
    let at = |i: usize| [i / samples / chirps, i / samples % chirps, i % samples];
    let f_c = radar.waveform.centre_frequency_hz();
    let count = radar.cube_channels() * chirps * samples;
    (0..count).map(|i| reference::cube_sample(radar, f_c, paths, at(i), Some(oscillator))).collect()
}

/// The spectrum of a chirp of `samples` shows density S through |D|², D Dirichlet's kernel of a rectangular
/// window: mean of
/// |FFT|² at bin k, S told at every step of the oscillator's frame.
fn expected_power(radar: &Radar, delay_s: f64, bin: usize) -> f64 {
    let (rate_hz, samples) = (radar.waveform.sample_rate_hz, f64::from(radar.waveform.samples));
    let steps = 1 << 14;
    let step_hz = rate_hz / f64::from(steps);
    let part = |i: i32| {
        let f = f64::from(i) * step_hz;
        let off = PI * (bin as f64 / samples - f / rate_hz);
        let kernel = if off.sin().abs() < 1e-12 { samples } else { (samples * off).sin() / off.sin() };
        4.0 * density(&radar.hardware.phase_noise, f.abs())
            * (PI * f * delay_s).sin().powi(2)
            * step_hz
            * kernel
            * kernel
    };
    (1 - steps / 2..steps / 2).filter(|i| *i != 0).map(part).sum()
}

#[test]
fn beside_a_target_stands_4_l_sin_squared_pi_f_tau_and_near_targets_keep_little_of_it() {
    // 127 · 60 µs + 10 µs of 5.12 MHz are rounded up to 2¹⁶ steps; the expectation's 2¹⁴ are as fine as a
    // chirp's bins need.
    let radar = noisy(Multiplexing::Simultaneous, 0, 128);
    let (samples, seeds) = (256, 8);
    let mut plain = radar.clone();
    plain.hardware.phase_noise.clear();
    let fft = FftPlanner::new().plan_fft_forward(samples);
    let mut total_of = vec![];
    for range_m in [2.0, 15.0, 60.0] {
        let delay_s = 2.0 * range_m / 299_792_458.0;
        let mut power = vec![0.0; samples];
        for seed in 0..seeds {
            let oscillator = Oscillator::of(&radar, seed, 0, 1e-6).unwrap();
            for chirp in 0..128 {
                let turn = |n: usize| {
                    oscillator.rotation(radar.chirp_start_s(0, chirp) + n as f64 / 5.12e6, delay_s).arg()
                };
                let mut row: Vec<Complex64> = (0..samples).map(|n| Complex64::from(turn(n))).collect();
                fft.process(&mut row);
                power.iter_mut().zip(&row).for_each(|(sum, value)| *sum += value.norm_sqr());
            }
        }
        power.iter_mut().for_each(|sum| *sum /= 128.0 * seeds as f64);
        let mut worst: f64 = 0.0;
        for bin in [3, 10, 20, 50, 90, 127] {
            let expected = expected_power(&radar, delay_s, bin);
            worst = worst.max((power[bin] / expected - 1.0).abs());
            println!("{range_m} m, bin {bin}: {:.2} dB of 4·L·sin²", 10.0 * (power[bin] / expected).log10());
        }
        // Exponentially distributed, 1024 of them, chirps apart by more than slow noise is left over: 3.1 %;
        // five of those.
        assert!(worst < 5.0 / (128.0 * seeds as f64).sqrt(), "{range_m} m: {worst}");
        total_of.push(power[3]);
    }
    // At 60 kHz sin² is (πfτ)²: 2 m keep (2/60)² of what 60 m keep there, but for what leaks from far away.
    let kept_db = 10.0 * (total_of[0] / total_of[2]).log10();
    println!("2 m against 60 m at 60 kHz: {kept_db:.1} dB");
    assert!(kept_db < -25.0);
}

#[test]
fn the_fast_sum_gets_the_accuracy_asked_for_against_every_path_with_its_own_delay() {
    for (multiplexing, layout) in [(Multiplexing::Tdm, 2), (Multiplexing::Ddm, 2), (Multiplexing::Bpm, 2)] {
        let radar = noisy(multiplexing, layout, 4);
        let oscillator = Oscillator::of(&radar, 5, 0, 1e-6).unwrap();
        let mut paths = body(91, 40, [5.75, 40.0, 0.7], [0.0, -10.0, 0.0]);
        paths.extend(body(92, 30, [2.0, 18.0, 0.7], [0.0, -15.0, 0.0]));
        let slow = exact(&radar, &paths, &oscillator);
        let f_c = radar.waveform.centre_frequency_hz();
        let ideal: Vec<Complex64> = reference::cube(&radar, f_c, &paths);
        println!("{multiplexing:?}: phase noise itself {:.1} dB", error_db(&ideal, &slow));
        for asked_db in [-20.0, -40.0, -60.0, -80.0, -100.0] {
            let got = phase_noise::cube(&radar, f_c, &paths, Accuracy::from_db(asked_db), &oscillator);
            let got = error_db(&got, &slow);
            println!("{multiplexing:?}: asked {asked_db} dB, got {got:.1} dB");
            assert!(got <= asked_db, "{multiplexing:?}: asked {asked_db}, got {got:.1}");
        }
    }
}

/// Bodies at one distance on both sides of a wide array, whose delays differ from element to element: halved
/// by range alone they would be summed path by path.
#[test]
fn bodies_on_both_sides_of_a_wide_array_have_the_error_asked_for() {
    let wide = Layout { name: "wide", tx: vec![[0.0, 0.0]], rx: vec![[0.0, 0.0], [190.0, 0.0]] };
    let mut radar =
        radar(Waveform { chirps: 2, samples: 64, ..experiment(1) }, &wide, Multiplexing::Simultaneous);
    radar.hardware.phase_noise = silicon();
    let oscillator = Oscillator::of(&radar, 5, 0, 1e-6).unwrap();
    let mut paths = body(93, 200, [14.0, 24.0, 0.7], [0.0, -10.0, 0.0]);
    paths.extend(body(94, 200, [-14.0, 24.0, 0.7], [0.0, -10.0, 0.0]));
    let (slow, f_c) = (exact(&radar, &paths, &oscillator), radar.waveform.centre_frequency_hz());
    for asked_db in [-20.0, -60.0] {
        let got = phase_noise::cube(&radar, f_c, &paths, Accuracy::from_db(asked_db), &oscillator);
        let got = error_db(&got, &slow);
        println!("asked {asked_db} dB, got {got:.1} dB");
        assert!(got < asked_db, "asked {asked_db} dB, got {got} dB");
    }
}

#[test]
fn what_the_phase_is_told_from_neighbours_is_its_fourier_series() {
    let mut radar = noisy(Multiplexing::Simultaneous, 0, 1);
    radar.hardware.phase_noise = vec![PhaseNoise { offset_hz: 1e6, dbc_per_hz: -80.0 }];
    let oscillator = Oscillator::of(&radar, 3, 0, 1e-6).unwrap();
    // 70 µs are rounded up to 512 samples of 5.12 MHz: the series from the values at the samples, told
    // between them.
    let (count, rate_hz) = (512, 5.12e6);
    let mut series: Vec<Complex64> =
        (0..count).map(|n| Complex64::from(oscillator.phase_rad(n as f64 / rate_hz))).collect();
    FftPlanner::new().plan_fft_forward(count).process(&mut series);
    let (mut missed, mut size) = (0.0, 0.0);
    for i in 0..200 {
        let place = f64::from(i) * 0.618_034 + 0.1;
        let term = |k: usize| {
            let signed = if k < count / 2 { k as f64 } else { k as f64 - count as f64 };
            series[k] * Complex64::cis(TAU * signed * place / count as f64) / count as f64
        };
        let exact: f64 = (0..count).filter(|k| *k != count / 2).map(|k| term(k).re).sum();
        missed += (oscillator.phase_rad(place / rate_hz) - exact).powi(2);
        size += exact * exact;
    }
    let missed_db = 10.0 * f64::log10(missed / size);
    // Eighth-order interpolation at four steps a sample leaves 43/8!·(π/4)⁸ = 1.5e-4 of the fastest part, a
    // √17th of it over all.
    println!("between neighbours: {missed_db:.1} dB");
    assert!(missed_db < -80.0);
}

/// The phase comes back after a while: an echo that takes so long, or twice, would have no noise.
#[test]
fn an_echo_from_far_beyond_a_short_frame_has_the_noise_of_its_delay() {
    let waveform = Waveform { chirps: 1, sample_rate_hz: 10e6, samples: 64, ..experiment(1) };
    let mut plain = header(single_channel(waveform), Noise::Absent);
    // What comes back to a frame of 6.4 µs after 25.6 µs, and after half of that.
    for delay_s in [25.6e-6, 12.8e-6] {
        let range_m = 0.5 * delay_s * 299_792_458.0;
        plain.radar.hardware.phase_noise.clear();
        let still = || frame(vec![point([0.0, range_m, plain.radar.position_m[2]], [0.0; 3], 10.0)]);
        let ideal = widened(&synthesized(&plain, 0, &still()).unwrap().samples);
        let mut noisy = plain.clone();
        noisy.radar.hardware.phase_noise = [(1e4, -90.0), (1e6, -100.0)]
            .map(|(offset_hz, dbc_per_hz)| PhaseNoise { offset_hz, dbc_per_hz })
            .into();
        let seeds = 400;
        let turn = |seed: u64| {
            let heard = widened(&synthesized(&noisy, seed, &still()).unwrap().samples);
            (heard[32] * ideal[32].conj()).arg()
        };
        let variance = (0..seeds).map(|seed| turn(seed).powi(2)).sum::<f64>() / seeds as f64;
        let (parts, step_hz) = (100_000, 50.0);
        let part = |i: i32| {
            let f = (f64::from(i) + 0.5) * step_hz;
            8.0 * density(&noisy.radar.hardware.phase_noise, f) * (PI * f * delay_s).sin().powi(2) * step_hz
        };
        let expected: f64 = (0..parts).map(part).sum();
        println!("{delay_s:e} s: {:.4} rad of {:.4}", variance.sqrt(), expected.sqrt());
        // Squares of 400 Gaussians: 7 % to one standard deviation, five of them.
        assert!((variance / expected - 1.0).abs() < 5.0 * (2.0 / seeds as f64).sqrt());
    }
}

#[test]
fn a_cube_with_phase_noise_follows_from_the_seed_and_knows_its_error() {
    let header = |noise: Vec<PhaseNoise>| {
        let mut header = header(single_channel(Waveform { chirps: 4, ..experiment(1) }), Noise::Absent);
        header.radar.hardware.phase_noise = noise;
        header
    };
    let still =
        || frame(vec![point([0.0, 40.0, 6.0], [0.0; 3], 10.0), point([1.0, 20.0, 6.0], [0.0; 3], 1.0)]);
    let cube = |noise, seed| synthesized(&header(noise), seed, &still());
    let [one, again, other] = [1, 1, 2].map(|seed| cube(silicon(), seed).unwrap());
    assert_eq!(one.samples, again.samples);
    assert_ne!(one.samples, other.samples);
    assert!(one.error.synthesis < Some(1e-3), "{:?}", one.error.synthesis);
    let falling = vec![silicon()[1], silicon()[0]];
    assert_eq!(cube(falling, 1).unwrap_err(), EchoError::PhaseNoise);
    let mut long = header(silicon());
    long.radar.waveform.chirp_interval_s = 1.0;
    let refused = synthesized(&long, 1, &still());
    assert!(matches!(refused, Err(EchoError::OscillatorTooLong { .. })), "{refused:?}");
}
