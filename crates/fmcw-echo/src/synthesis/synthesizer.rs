//! Processing stage of one radar, from frames of paths to frames of samples: sum, f32, error measurement,
//! noise.

use crate::error::EchoError;
use crate::impairments::adc;
use crate::impairments::element_errors;
use crate::impairments::interference;
use crate::impairments::noise;
use crate::impairments::oscillator::{self, Oscillator};
use crate::sources::rcs_table::{self, TableSum};
use crate::sums::fast::fast_sum;
use crate::synthesis::input_checks::{check_header, check_paths, check_samples};
use crate::synthesis::phase_noise;
use crate::synthesis::synthesis_error;
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::paths::{Path, PathsFrame};
use artifact::radar::Sampling;
use artifact::rcs::RcsFrame;
use artifact::scene::Pose;
use artifact::{Accuracy, ErrorBudget, Radar};
use num_complex::{Complex32, Complex64};
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Callback that receives the share of the work done, 0 … 1, from several threads.
pub type Progress<'a> = &'a (dyn Fn(f64) + Sync);

/// Synthesizer of the cubes of one radar: its header is checked and the errors of its elements are drawn once
/// for all frames. The frame index determines the sub-frame.
pub struct Synthesizer {
    /// Headers by sub-frame, at least one.
    headers: Vec<CubeHeader>,
    seed: u64,
    accuracy: Accuracy,
    ground: Vec<Path>,
}

impl Synthesizer {
    /// Constructs the synthesizer for cubes with this header; `seed` is the scene's, `accuracy` that of the
    /// sum over the paths ([`sum_accuracy`]), `ground` the paths of the road's own backscatter
    /// ([`crate::sources::ground`]), which are added to every frame.
    ///
    /// # Errors
    /// Radars without samples, and cubes that do not fit into a file's record.
    pub fn new(
        header: &CubeHeader,
        seed: u64,
        accuracy: Accuracy,
        ground: Vec<Path>,
    ) -> Result<Self, EchoError> {
        let drawn =
            CubeHeader { radar: element_errors::with_drawn_errors(&header.radar, seed), ..header.clone() };
        let sub_frames = 0..header.radar.schedule.sub_frames();
        let headers: Vec<CubeHeader> = sub_frames.map(|index| drawn.in_frame(index)).collect();
        headers.iter().try_for_each(check_header)?;
        Ok(Self { headers, seed, accuracy, ground })
    }

    /// Header of the frame record `index`.
    fn header(&self, index: u32) -> &CubeHeader {
        &self.headers[index as usize % self.headers.len()]
    }

    /// Paths of a frame, followed by those of the road.
    pub fn with_ground<'p>(&self, frame: &'p PathsFrame) -> Cow<'p, PathsFrame> {
        if self.ground.is_empty() {
            return Cow::Borrowed(frame);
        }
        let mut all = frame.clone();
        all.paths.extend_from_slice(&self.ground);
        Cow::Owned(all)
    }

    /// Cube of one frame, noise included; the paths' amplitudes hold for the middle of the sweep.
    ///
    /// The share `synthesis` of the frame's error budget comes from a comparison with
    /// [`crate::sums::reference`] in this run.
    ///
    /// # Errors
    /// Paths that have no finite echo, samples beyond f32.
    pub fn frame(&self, frame: &PathsFrame, progress: Progress) -> Result<CubeFrame, EchoError> {
        let (header, frame) = (self.header(frame.index), &*self.with_ground(frame));
        let (radar, paths) = (&header.radar, &frame.paths);
        check_paths(radar, frame.index, paths)?;
        let (centre_hz, accuracy) = (radar.waveform.centre_frequency_hz(), self.accuracy);
        let oscillator = self.oscillator(radar, frame.index, paths)?;
        let samples = match &oscillator {
            None => fast_sum::single_cube(radar, centre_hz, paths, accuracy),
            Some(oscillator) => phase_noise::single_cube(radar, centre_hz, paths, accuracy, oscillator),
        };
        progress(1.0);
        check_samples(header, frame.index, &samples)?;
        let error = synthesis_error::of_paths(radar, centre_hz, frame, &samples, oscillator.as_ref());
        self.received((frame.index, frame.time_s), samples, frame.error, error)
    }

    /// Cube of one frame from far-field tables, the paper's method; `poses` are those at the frame's first
    /// sample, indexed by the tables' `target`.
    ///
    /// The share `synthesis` of the error is that of interpolating the tables, estimated by thinning them.
    ///
    /// # Errors
    /// Those of [`Self::frame`], and tables with another polarization, with an invalid shape, or without the
    /// required aspects.
    pub fn frame_of_tables(
        &self,
        poses: &[Pose],
        frame: &RcsFrame,
        progress: Progress,
    ) -> Result<CubeFrame, EchoError> {
        let header = self.header(frame.index);
        let radar = &header.radar;
        let origins = rcs_table::origins(poses, frame);
        check_paths(radar, frame.index, &origins)?;
        let oscillator = self.oscillator(radar, frame.index, &origins)?;
        let sum = TableSum::new(radar, poses, frame, oscillator.as_ref())?;
        let samples = rows(header, progress, |channel, chirp| sum.row(channel, chirp))?;
        check_samples(header, frame.index, &samples)?;
        let error = synthesis_error::of_tables(radar, poses, frame, &samples, oscillator.as_ref())?;
        self.received((frame.index, frame.time_s), samples, frame.error, error)
    }

    /// Oscillator of a frame with these paths; `None` if the radar's is ideal.
    fn oscillator(&self, radar: &Radar, frame: u32, paths: &[Path]) -> Result<Option<Oscillator>, EchoError> {
        if radar.hardware.phase_noise.is_empty() {
            return Ok(None);
        }
        let longest_delay_s = phase_noise::longest_delay_s(radar, paths);
        let (needed, limit) = (oscillator::samples_of(radar, longest_delay_s), oscillator::SAMPLES_MAX);
        if needed > limit {
            return Err(EchoError::OscillatorTooLong { samples: needed as f64, limit });
        }
        Ok(Oscillator::of(radar, self.seed, frame, longest_delay_s))
    }

    /// Cube of echoes after the receiver; `synthesis` is their error.
    fn received(
        &self,
        (index, time_s): (u32, f64),
        mut samples: Vec<Complex32>,
        error: ErrorBudget,
        synthesis: Option<f64>,
    ) -> Result<CubeFrame, EchoError> {
        receive(self.header(index), self.seed, (index, time_s), &mut samples)?;
        let error = error.merged(ErrorBudget { synthesis, ..ErrorBudget::default() });
        Ok(CubeFrame { index, time_s, samples, error })
    }
}

/// Error allowed for the sum over paths: a tenth of that of the paths themselves, and no more than −60 dB, so
/// that it stays invisible above the floor of a noise-free map.
pub fn sum_accuracy(of_paths: Accuracy) -> Accuracy {
    Accuracy::from_db((of_paths.db() - 20.0).min(-60.0))
}

/// Adds noise and other radars in the receiver; for a real mixer keeps the real part of the total; then
/// quantizes.
///
/// The real part contains half of an echo's power and half of the noise's, but the echo's is divided between
/// two lines of the spectrum: 3 dB less signal-to-noise ratio than complex samples (physics.md §9).
fn receive(
    header: &CubeHeader,
    seed: u64,
    (frame, time_s): (u32, f64),
    samples: &mut [Complex32],
) -> Result<(), EchoError> {
    noise::add(header, seed, frame, samples)?;
    interference::add(&header.radar, time_s, samples);
    check_samples(header, frame, samples)?;
    if header.radar.waveform.sampling == Sampling::Real {
        samples.iter_mut().for_each(|sample| sample.im = 0.0);
    }
    if let Some(converter) = &header.radar.hardware.adc {
        adc::convert(converter, samples);
    }
    Ok(())
}

/// Rows `[channel, chirp]` of a cube computed by `row`, in parallel, rounded to f32.
fn rows(
    header: &CubeHeader,
    progress: Progress,
    row: impl Fn(usize, usize) -> Result<Vec<Complex64>, EchoError> + Sync,
) -> Result<Vec<Complex32>, EchoError> {
    let [channels, chirps, length] = header.shape();
    let mut samples = vec![Complex32::ZERO; channels * chirps * length];
    let done = AtomicUsize::new(0);
    let made: Vec<Result<(), EchoError>> = samples
        .par_chunks_mut(length)
        .enumerate()
        .map(|(r, stored)| {
            for (stored, value) in stored.iter_mut().zip(row(r / chirps, r % chirps)?) {
                *stored = Complex32::new(value.re as f32, value.im as f32);
            }
            progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / (channels * chirps) as f64);
            Ok(())
        })
        .collect();
    // The first fault in row order, whichever thread found it.
    made.into_iter().collect::<Result<(), EchoError>>()?;
    Ok(samples)
}

/// Maximum memory for one frame besides its paths: the cube and its sums, the map of one channel for
/// `snr_db`, and a row of sums for each thread, bytes.
pub fn memory_estimate_bytes(header: &CubeHeader, accuracy: Accuracy) -> u64 {
    let [channels, chirps, length] = header.shape().map(|n| n as u64);
    let cube = channels * chirps * length * size_of::<Complex32>() as u64;
    let map = 2 * chirps * length * size_of::<Complex64>() as u64;
    let row = length * (crate::sums::simd_lanes::MAX_LANES as u64 + 1) * size_of::<Complex64>() as u64;
    // With phase noise: a sum in double precision and a part of it.
    let sums = if header.radar.hardware.phase_noise.is_empty() { 0 } else { 4 * cube };
    let sum = fast_sum::memory_estimate_bytes(&header.radar, accuracy) + sums;
    cube + map
        + row * rayon::current_num_threads() as u64
        + sum
        + oscillator::memory_estimate_bytes(&header.radar)
}
