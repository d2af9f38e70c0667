//! Complex white receiver noise as a function of (seed, frame, channel, chirp, sample).

use crate::error::EchoError;
use crate::links::snr_reference::peak_cell_over_noise;
use artifact::cube::CubeHeader;
use artifact::seed;
use artifact::settings::Noise;
use artifact::units::{BOLTZMANN_J_PER_K, power_from_db};
use num_complex::{Complex32, Complex64};
use rand::rand_core::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Adds the header's noise to a noise-free cube.
pub(crate) fn add(
    header: &CubeHeader,
    seed: u64,
    frame: u32,
    samples: &mut [Complex32],
) -> Result<(), EchoError> {
    let variance_w = variance_w(header, frame, samples)?;
    if variance_w == 0.0 {
        return Ok(());
    }
    let [_, chirps, length] = header.shape();
    samples.par_chunks_mut(length).enumerate().for_each(|(row, samples)| {
        let mut stream = NoiseStream::new(seed, frame, row / chirps, row % chirps);
        for sample in samples {
            let noise = stream.next_sample(variance_w);
            *sample += Complex32::new(noise.re as f32, noise.im as f32);
        }
    });
    Ok(())
}

/// Mean noise power of one complex sample, W.
pub fn variance_w(header: &CubeHeader, frame: u32, noise_free: &[Complex32]) -> Result<f64, EchoError> {
    match header.noise {
        Noise::Absent => Ok(0.0),
        Noise::Figure { noise_figure_db, temperature_k } => {
            thermal_variance_w(noise_figure_db, temperature_k, header.radar.waveform.sample_rate_hz)
        }
        Noise::SnrDb(snr_db) => {
            let ratio = positive("snr_db", snr_db, power_from_db(snr_db))?;
            peak_cell_over_noise(header, noise_free)
                .map(|peak| peak / ratio)
                .ok_or(EchoError::NoPeak { frame })
        }
    }
}

/// Thermal noise power k·T·F·f_s: complex samples contain the band f_s once (physics.md §9).
pub fn thermal_variance_w(
    noise_figure_db: f64,
    temperature_k: f64,
    sample_rate_hz: f64,
) -> Result<f64, EchoError> {
    let factor = positive("noise_figure_db", noise_figure_db, power_from_db(noise_figure_db))?;
    let temperature_k = positive("temperature_k", temperature_k, temperature_k)?;
    Ok(BOLTZMANN_J_PER_K * temperature_k * factor * sample_rate_hz)
}

fn positive(quantity: &'static str, given: f64, linear: f64) -> Result<f64, EchoError> {
    let usable = linear.is_finite() && linear > 0.0;
    usable.then_some(linear).ok_or(EchoError::Noise { quantity, value: given })
}

/// Noise of one row of a cube: sample n is the n-th value of the stream.
pub struct NoiseStream(ChaCha8Rng);

impl NoiseStream {
    /// Stream of a row.
    pub fn new(seed: u64, frame: u32, channel: usize, chirp: usize) -> Self {
        Self::of(seed, "fmcw-echo/noise", &[u64::from(frame), channel as u64, chirp as u64])
    }

    /// Stream for another use.
    pub(crate) fn of(seed: u64, stage: &str, index: &[u64]) -> Self {
        Self(ChaCha8Rng::from_seed(seed::key(seed, stage, index)))
    }

    /// Next complex normal value with mean power `variance_w`, by the Box–Muller transform, which takes
    /// exactly two uniform numbers per value, so that a value's position in the stream is its sample index.
    pub fn next_sample(&mut self, variance_w: f64) -> Complex64 {
        let power = -variance_w * (1.0 - self.uniform()).ln();
        Complex64::from_polar(power.sqrt(), TAU * self.uniform())
    }

    /// A uniform number in [0, 1) with 53 bits.
    fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (0.5_f64).powi(53)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thermal_noise_of_5_12_mhz_is_minus_136_9_dbw_plus_the_noise_figure() {
        for noise_figure_db in [0.0, 12.0, 14.0] {
            let dbw = 10.0 * thermal_variance_w(noise_figure_db, 290.0, 5.12e6).unwrap().log10();
            assert!((dbw - noise_figure_db + 136.9).abs() < 0.05, "{dbw}"); // physics.md §9 gives one decimal
        }
        assert!(matches!(thermal_variance_w(f64::NAN, 290.0, 1.0), Err(EchoError::Noise { .. })));
        assert!(matches!(
            thermal_variance_w(3.0, 0.0, 1.0),
            Err(EchoError::Noise { quantity: "temperature_k", .. })
        ));
    }

    #[test]
    fn the_stream_has_the_moments_of_complex_white_noise() {
        let count = 200_000;
        let mut stream = NoiseStream::new(7, 0, 0, 0);
        let values: Vec<Complex64> = (0..count).map(|_| stream.next_sample(2.0)).collect();
        let mean =
            |f: &dyn Fn(usize) -> Complex64| (0..count - 1).map(f).sum::<Complex64>() / (count - 1) as f64;
        // Standard errors over n values of power P = 2: √(P/n) of the mean, P/√n of the three second moments,
        // 2√5·P²/√n /2 = of the fourth (E|x|⁴ = 2P², var |x|⁴ = 20P⁴). Five of them are allowed.
        let five = 5.0 / (count as f64).sqrt();
        assert!(mean(&|i| values[i]).norm() < five * 2.0_f64.sqrt());
        assert!((mean(&|i| values[i].norm_sqr().into()).re - 2.0).abs() < five * 2.0);
        assert!(mean(&|i| values[i] * values[i]).norm() < five * 2.0 * 2.0_f64.sqrt()); // circular
        assert!(mean(&|i| values[i] * values[i + 1].conj()).norm() < five * 2.0); // white
        assert!(
            (mean(&|i| values[i].norm_sqr().powi(2).into()).re - 8.0).abs() < five * 20.0_f64.sqrt() * 4.0
        );
    }

    #[test]
    fn streams_of_neighbouring_rows_frames_and_seeds_differ_and_repeat() {
        let first =
            |seed, frame, channel, chirp| NoiseStream::new(seed, frame, channel, chirp).next_sample(1.0);
        let base = first(1, 2, 3, 4);
        assert_eq!(base, first(1, 2, 3, 4));
        for other in [first(2, 2, 3, 4), first(1, 3, 3, 4), first(1, 2, 4, 4), first(1, 2, 3, 5)] {
            assert_ne!(base, other);
        }
    }
}
