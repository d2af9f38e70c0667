//! Range-Doppler map: window, FFT over samples, window, FFT over chirps, for every transmit–receive pair.
//!
//! Computed in double precision and stored in single: the transforms are a few per cent of a frame's time either way
//! (a 12-channel map takes 4 ms), and Parseval's sum then holds to rounding (1e-15) instead of 1e-7.

use crate::axes::checked_shape;
use crate::cfar::{self, Cfar};
use crate::noncoherent::{FLOOR_BELOW_PEAK_DB, sum_over_channels};
use crate::window::taper;
use crate::{DspError, doppler_division};
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::radar::Multiplexing;
use artifact::rdm::RdmFrame;
use artifact::settings::Noise;
use artifact::units::power_from_db;
use num_complex::{Complex32, Complex64};
use rayon::prelude::*;
use rustfft::{Fft, FftPlanner};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The map of one frame, with the cells that the header's detector tested and those it found.
pub fn range_doppler(header: &CubeHeader, frame: &CubeFrame) -> Result<RdmFrame, DspError> {
    let transform = RangeDoppler::new(header)?;
    let detector = Cfar::new(header)?;
    check_samples(header, &frame.samples)?;
    let values = all_channels(header, &transform, &frame.samples)?;
    let power = sum_over_channels(&values, transform.cells());
    let assumed_floor = assumed_floor(header.noise, &power);
    let mut mask = detector.mask(&power, assumed_floor.unwrap_or(0.0));
    if header.radar.array.multiplexing == Multiplexing::Ddm {
        doppler_division::keep_true_folds(header, &transform, &frame.samples, &values, &mut mask);
    }
    Ok(RdmFrame {
        index: frame.index,
        time_s: frame.time_s,
        values,
        detections: mask.iter().filter(|m| **m == cfar::DETECTED).count() as u64,
        cells: mask.iter().filter(|m| **m != cfar::UNTESTED).count() as u64,
        mask,
        assumed_floor,
    })
}

/// Both FFTs and windows of a radar, ready for any number of channels.
pub struct RangeDoppler {
    chirps: usize,
    samples: usize,
    falling_slope: bool,
    range_taper: Vec<f64>,
    doppler_taper: Vec<f64>,
    range_fft: Arc<dyn Fft<f64>>,
    doppler_fft: Arc<dyn Fft<f64>>,
}

impl RangeDoppler {
    /// Windows and transforms that a cube's header asks for.
    pub fn new(header: &CubeHeader) -> Result<Self, DspError> {
        let [_, chirps, samples] = checked_shape(header)?;
        let mut planner = FftPlanner::new();
        Ok(Self {
            chirps,
            samples,
            falling_slope: header.radar.waveform.slope_hz_per_s < 0.0,
            range_taper: taper(header.dsp.range_window, samples)?,
            doppler_taper: taper(header.dsp.doppler_window, chirps)?,
            range_fft: planner.plan_fft_forward(samples),
            doppler_fft: planner.plan_fft_forward(chirps),
        })
    }

    /// Map `[doppler, range]` of one channel's `[chirp, sample]`, unscaled, zero velocity at N/2, range growing.
    ///
    /// `turn_cycles` is taken out per chirp first: the offset of a transmitter under Doppler division.
    pub fn channel(&self, samples: &[Complex32], turn_cycles: f64) -> Vec<Complex64> {
        let ranges = self.range_spectra(samples, turn_cycles);
        let mut map = vec![Complex64::ZERO; self.cells()];
        let mut column = vec![Complex64::ZERO; self.chirps];
        for range in 0..self.samples {
            // A falling slope puts growing ranges at falling frequencies.
            let bin = if self.falling_slope { (self.samples - range) % self.samples } else { range };
            for (chirp, value) in column.iter_mut().enumerate() {
                *value = ranges[chirp * self.samples + bin];
            }
            self.doppler_fft.process(&mut column);
            for (bin, value) in column.iter().enumerate() {
                map[(bin + self.chirps / 2) % self.chirps * self.samples + range] = *value;
            }
        }
        map
    }

    /// Cells of one channel.
    pub(crate) fn cells(&self) -> usize {
        self.chirps * self.samples
    }

    fn range_spectra(&self, samples: &[Complex32], turn_cycles: f64) -> Vec<Complex64> {
        let mut spectra = Vec::with_capacity(self.cells());
        for (chirp, row) in samples.chunks_exact(self.samples).enumerate() {
            let turn = Complex64::from_polar(1.0, -TAU * (chirp as f64 * turn_cycles).fract());
            let weight = turn * self.doppler_taper[chirp];
            let tapered = row.iter().zip(&self.range_taper);
            spectra.extend(tapered.map(|(x, w)| weight * *w * Complex64::new(f64::from(x.re), f64::from(x.im))));
        }
        self.range_fft.process(&mut spectra);
        spectra
    }
}

fn check_samples(header: &CubeHeader, samples: &[Complex32]) -> Result<(), DspError> {
    let [channels, chirps, length] = header.shape();
    let expected = channels * chirps * length;
    if samples.len() != expected {
        return Err(DspError::SampleCount { expected, found: samples.len() });
    }
    match samples.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(at) => Err(DspError::SampleNotFinite {
            channel: at / (chirps * length),
            chirp: at / length % chirps,
            sample: at % length,
        }),
    }
}

fn all_channels(
    header: &CubeHeader,
    transform: &RangeDoppler,
    samples: &[Complex32],
) -> Result<Vec<Complex32>, DspError> {
    let cells = transform.cells();
    let mut values = vec![Complex32::ZERO; header.radar.virtual_channels() * cells];
    values.par_chunks_mut(cells).enumerate().for_each(|(channel, out)| {
        let (source, turn_cycles) = doppler_division::source_of(header, channel);
        let map = transform.channel(&samples[source * cells..(source + 1) * cells], turn_cycles);
        for (narrow, wide) in out.iter_mut().zip(map) {
            *narrow = Complex32::new(wide.re as f32, wide.im as f32);
        }
    });
    match values.iter().position(|v| !v.is_finite()) {
        None => Ok(values),
        Some(at) => Err(DspError::ValueNotFinite { channel: at / cells, cell: at % cells }),
    }
}

/// A noise-free map has no noise to estimate: a floor 60 dB below its peak stands in (`docs/scenes.md`, `[noise]`).
fn assumed_floor(noise: Noise, power: &[f64]) -> Option<f64> {
    let peak = power.iter().copied().fold(0.0, f64::max);
    matches!(noise, Noise::Absent).then(|| peak * power_from_db(-FLOOR_BELOW_PEAK_DB))
}
