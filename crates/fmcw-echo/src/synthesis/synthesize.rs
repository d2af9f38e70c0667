//! A frame of paths becomes a frame of samples: sum, f32, error measured, noise.

use crate::error::EchoError;
use crate::impairments::adc;
use crate::impairments::element_errors;
use crate::impairments::interference;
use crate::impairments::noise;
use crate::impairments::oscillator::{self, Oscillator};
use crate::sources::rcs_table::{self, TableSum};
use crate::sums::fast::fast_sum;
use crate::synthesis::admission::{check_centre_frequency, check_header, check_paths, check_samples};
use crate::synthesis::phase_noise;
use crate::synthesis::synthesis_error;
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::paths::PathsFrame;
use artifact::radar::Sampling;
use artifact::rcs::RcsFrame;
use artifact::scene::Pose;
use artifact::{Accuracy, ErrorBudget};
use num_complex::{Complex32, Complex64};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Is told the share of the work done, 0 … 1, from several threads.
pub type Progress<'a> = &'a (dyn Fn(f64) + Sync);

/// The cube of one frame, noise included; `seed` is the scene's, `centre_frequency_hz` f_c of the paths'
/// amplitudes, `accuracy` that of the sum over the paths.
///
/// The frame's error budget gets its share `synthesis` from a comparison with [`crate::sums::reference`] in
/// this run. Refuses paths that have no finite echo, radars without samples, and cubes that do not fit into a
/// file's record.
pub fn synthesize(
    header: &CubeHeader,
    seed: u64,
    frame: &PathsFrame,
    centre_frequency_hz: f64,
    accuracy: Accuracy,
    progress: Progress,
) -> Result<CubeFrame, EchoError> {
    let header = &with_drawn_errors(header.in_frame(frame.index), seed);
    check_header(header)?;
    check_centre_frequency(centre_frequency_hz)?;
    check_paths(&header.radar, frame.index, &frame.paths)?;
    let oscillator = Oscillator::of(&header.radar, seed, frame.index);
    let (radar, paths) = (&header.radar, &frame.paths);
    let mut samples = match &oscillator {
        None => fast_sum::single_cube(radar, centre_frequency_hz, paths, accuracy),
        Some(oscillator) => phase_noise::single_cube(radar, centre_frequency_hz, paths, accuracy, oscillator),
    };
    progress(1.0);
    check_samples(header, frame.index, &samples)?;
    let synthesis =
        synthesis_error::of_paths(radar, centre_frequency_hz, frame, &samples, oscillator.as_ref());
    receive(header, seed, (frame.index, frame.time_s), &mut samples)?;
    let error = frame.error.joined(ErrorBudget { synthesis, ..ErrorBudget::default() });
    Ok(CubeFrame { index: frame.index, time_s: frame.time_s, samples, error })
}

/// The cube of one frame from far-field tables, the paper's way; `poses` are those at the frame's first
/// sample, in the order that the tables' `target` counts.
///
/// The share `synthesis` of the error is that of interpolating the tables, estimated by thinning them.
/// Refuses what [`synthesize`] does, and tables of another polarization, broken shape, or that do not hold
/// the aspects needed.
pub fn synthesize_tables(
    header: &CubeHeader,
    seed: u64,
    poses: &[Pose],
    frame: &RcsFrame,
    progress: Progress,
) -> Result<CubeFrame, EchoError> {
    let header = &with_drawn_errors(header.in_frame(frame.index), seed);
    check_header(header)?;
    check_paths(&header.radar, frame.index, &rcs_table::origins(poses, frame))?;
    let oscillator = Oscillator::of(&header.radar, seed, frame.index);
    let sum = TableSum::new(&header.radar, poses, frame, oscillator.as_ref())?;
    let mut samples = rows(header, progress, |channel, chirp| sum.row(channel, chirp))?;
    check_samples(header, frame.index, &samples)?;
    let synthesis = synthesis_error::of_tables(&header.radar, poses, frame, &samples, oscillator.as_ref())?;
    receive(header, seed, (frame.index, frame.time_s), &mut samples)?;
    let error = frame.error.joined(ErrorBudget { synthesis, ..ErrorBudget::default() });
    Ok(CubeFrame { index: frame.index, time_s: frame.time_s, samples, error })
}

fn with_drawn_errors(header: CubeHeader, seed: u64) -> CubeHeader {
    CubeHeader { radar: element_errors::drawn(&header.radar, seed), ..header }
}

/// What comes to the echoes in the receiver: noise, other radars; of a real mixer one part of it all; the
/// converter.
///
/// Half of an echo's power is in that part and half of the noise's, but the echo's is shared by two lines of
/// the spectrum: 3 dB less signal to noise than complex samples have (physics.md §9).
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

/// Every row `[channel, chirp]` of a cube made by `row`, in parallel, rounded to f32.
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
    // The first fault in the order of rows, whichever thread was first.
    made.into_iter().collect::<Result<(), EchoError>>()?;
    Ok(samples)
}

/// Bytes that making one frame takes at most beside its paths: the cube and its sums, the map of one channel
/// for `snr_db`, and a row of sums for each thread.
pub fn memory_estimate_bytes(header: &CubeHeader, accuracy: Accuracy) -> u64 {
    let [channels, chirps, length] = header.shape().map(|n| n as u64);
    let cube = channels * chirps * length * size_of::<Complex32>() as u64;
    let map = 2 * chirps * length * size_of::<Complex64>() as u64;
    let row = length * (crate::sums::lanes::MAX_LANES as u64 + 1) * size_of::<Complex64>() as u64;
    // With phase noise a sum in double precision and a part of it.
    let sums = if header.radar.hardware.phase_noise.is_empty() { 0 } else { 4 * cube };
    let sum = fast_sum::memory_estimate_bytes(&header.radar, accuracy) + sums;
    cube + map
        + row * rayon::current_num_threads() as u64
        + sum
        + oscillator::memory_estimate_bytes(&header.radar)
}
