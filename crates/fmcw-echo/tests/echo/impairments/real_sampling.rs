//! A mixer without a Q channel.

use crate::setting::*;
use artifact::radar::Sampling;
use artifact::settings::{Noise, Window};
use num_complex::Complex64;
use rustfft::FftPlanner;

/// The samples of one frame with a still point at 23.98 m, cell 100 of 256.
fn samples(sampling: Sampling, noise: Noise, seed: u64) -> Vec<Complex64> {
    let mut header =
        header(single_channel(artifact::Waveform { chirps: 64, sampling, ..experiment(1) }), noise);
    (header.dsp.range_window, header.dsp.doppler_window) = (Window::Rect, Window::Rect);
    let range_m = 100.0 * header.radar.waveform.range_resolution_m();
    let still = frame(vec![point([0.0, range_m, 6.0], [0.0; 3], 10.0)]);
    widened(&synthesized(&header, seed, &still).unwrap().samples)
}

/// Power of the target's cell, and the mean over the cells of the same range elsewhere in Doppler.
fn cell_and_rest(samples: &[Complex64]) -> [f64; 2] {
    let mut planner = FftPlanner::new();
    let (range, doppler) = (planner.plan_fft_forward(256), planner.plan_fft_forward(64));
    let mut column: Vec<Complex64> = samples
        .chunks(256)
        .map(|row| {
            let mut row = row.to_vec();
            range.process(&mut row);
            row[100]
        })
        .collect();
    doppler.process(&mut column);
    [column[0].norm_sqr(), column[1..].iter().map(|cell| cell.norm_sqr()).sum::<f64>() / 63.0]
}

#[test]
fn real_samples_are_the_real_parts_of_complex_ones_noise_included() {
    let noise = Noise::Figure { noise_figure_db: 12.0, temperature_k: 290.0 };
    let [complex, real] = [Sampling::Complex, Sampling::Real].map(|sampling| samples(sampling, noise, 1));
    assert!(complex.iter().zip(&real).all(|(complex, real)| complex.re == real.re && real.im == 0.0));
}

#[test]
fn real_sampling_costs_3_db_and_a_ratio_asked_for_is_that_of_the_map() {
    let figure = Noise::Figure { noise_figure_db: 40.0, temperature_k: 290.0 };
    let ratio_db = |sampling, noise| {
        let signal = cell_and_rest(&samples(sampling, Noise::Absent, 0))[0];
        let seeds = 40;
        let rest: f64 = (0..seeds).map(|seed| cell_and_rest(&samples(sampling, noise, seed))[1]).sum();
        10.0 * (signal / rest * seeds as f64).log10()
    };
    // 40 · 63 cells of exponential power: 2 %, 0.09 dB; of a difference 0.12 dB. Five of them.
    let [complex, real] = [Sampling::Complex, Sampling::Real].map(|sampling| ratio_db(sampling, figure));
    println!("signal to noise {complex:.2} dB of complex samples, {real:.2} dB of real ones");
    assert!((complex - real - 10.0 * 2.0_f64.log10()).abs() < 0.6, "{complex} against {real}");
    let asked = ratio_db(Sampling::Real, Noise::SnrDb(30.0));
    println!("asked 30 dB, got {asked:.2} dB");
    assert!((asked - 30.0).abs() < 0.45, "{asked}");
}
