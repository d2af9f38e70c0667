//! What `snr_db` of a scene refers to: the peak cell of one channel's noise-free range-Doppler map.

use crate::window::{noise_bandwidth, weights};
use artifact::cube::CubeHeader;
use artifact::radar::Sampling;
use num_complex::{Complex32, Complex64};
use rustfft::FftPlanner;

/// Power of the peak cell of channel 0 over what white noise of unit power per sample makes of a cell; `None` where
/// the channel is silent.
///
/// A cell of the map holds noise of N_s·N_c·ENBW_r·ENBW_d times the power of a sample (physics.md §8: windows of unit
/// coherent gain, FFTs without scaling). With Doppler division the map of receiver 0 before its bands are taken apart
/// has the same peak and the same noise.
pub fn peak_cell_over_noise(header: &CubeHeader, samples: &[Complex32]) -> Option<f64> {
    let [_, chirps, length] = header.shape();
    let range_weights = weights(header.dsp.range_window, length);
    let doppler_weights = weights(header.dsp.doppler_window, chirps);
    let samples = samples.get(..chirps * length)?;
    // Of a real mixer half of the noise arrives, and the echo is told by one of two lines.
    let (map, arrives) = match header.radar.waveform.sampling {
        Sampling::Complex => (range_doppler(samples, &range_weights, &doppler_weights), 1.0),
        Sampling::Real => {
            let real: Vec<Complex32> = samples.iter().map(|sample| sample.re.into()).collect();
            (range_doppler(&real, &range_weights, &doppler_weights), 0.5)
        }
    };
    let peak = map.iter().map(|cell| cell.norm_sqr()).fold(0.0, f64::max);
    let noise =
        arrives * (chirps * length) as f64 * noise_bandwidth(&range_weights) * noise_bandwidth(&doppler_weights);
    (peak > 0.0).then_some(peak / noise)
}

/// Windowed two-dimensional FFT of `[chirp, sample]`, left as `[range, doppler]`.
fn range_doppler(samples: &[Complex32], range_weights: &[f64], doppler_weights: &[f64]) -> Vec<Complex64> {
    let (length, chirps) = (range_weights.len(), doppler_weights.len());
    let mut rows: Vec<Complex64> = samples
        .iter()
        .enumerate()
        .map(|(i, x)| {
            Complex64::new(x.re.into(), x.im.into()) * range_weights[i % length] * doppler_weights[i / length]
        })
        .collect();
    let mut planner = FftPlanner::new();
    planner.plan_fft_forward(length).process(&mut rows);
    let mut columns: Vec<Complex64> =
        (0..length).flat_map(|n| (0..chirps).map(move |m| (m, n))).map(|(m, n)| rows[m * length + n]).collect();
    planner.plan_fft_forward(chirps).process(&mut columns);
    columns
}
