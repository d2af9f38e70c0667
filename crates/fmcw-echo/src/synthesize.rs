//! A frame of paths becomes a frame of samples: direct sum, f32, error measured, noise.

use crate::admission::{check_header, check_paths, check_samples};
use crate::direct_sum::DirectSum;
use crate::error::EchoError;
use crate::{noise, synthesis_error};
use artifact::ErrorBudget;
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::paths::PathsFrame;
use num_complex::{Complex32, Complex64};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Is told the share of the work done, 0 … 1, from several threads.
pub type Progress<'a> = &'a (dyn Fn(f64) + Sync);

/// The cube of one frame, noise included; `seed` is the scene's, `centre_frequency_hz` f_c of the paths' amplitudes.
///
/// The frame's error budget gets its share `synthesis` from a comparison with [`crate::reference`] in this run.
/// Refuses paths that have no finite echo, radars without samples, and cubes that do not fit into a file's record.
pub fn synthesize(
    header: &CubeHeader,
    seed: u64,
    frame: &PathsFrame,
    centre_frequency_hz: f64,
    progress: Progress,
) -> Result<CubeFrame, EchoError> {
    check_header(header)?;
    check_paths(&header.radar, centre_frequency_hz, frame)?;
    let sum = DirectSum::new(&header.radar, centre_frequency_hz, &frame.paths);
    let mut samples = rows(header, progress, |channel, chirp| sum.row(channel, chirp));
    check_samples(header, frame.index, &samples)?;
    let synthesis = synthesis_error::measure(&header.radar, centre_frequency_hz, frame, &samples);
    noise::add(header, seed, frame.index, &mut samples)?;
    let error = frame.error.joined(ErrorBudget { synthesis, ..ErrorBudget::default() });
    Ok(CubeFrame { index: frame.index, time_s: frame.time_s, samples, error })
}

/// Every row `[channel, chirp]` of a cube made by `row`, in parallel, rounded to f32.
pub(crate) fn rows(
    header: &CubeHeader,
    progress: Progress,
    row: impl Fn(usize, usize) -> Vec<Complex64> + Sync,
) -> Vec<Complex32> {
    let [channels, chirps, length] = header.shape();
    let mut samples = vec![Complex32::ZERO; channels * chirps * length];
    let done = AtomicUsize::new(0);
    samples.par_chunks_mut(length).enumerate().for_each(|(r, stored)| {
        for (stored, value) in stored.iter_mut().zip(row(r / chirps, r % chirps)) {
            *stored = Complex32::new(value.re as f32, value.im as f32);
        }
        progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / (channels * chirps) as f64);
    });
    samples
}

/// Bytes that making one frame takes at most beside its paths: the cube, the map of one channel for `snr_db`, and a row
/// of sums for each thread.
pub fn memory_estimate_bytes(header: &CubeHeader) -> u64 {
    let [channels, chirps, length] = header.shape().map(|n| n as u64);
    let cube = channels * chirps * length * size_of::<Complex32>() as u64;
    let map = 2 * chirps * length * size_of::<Complex64>() as u64;
    let row = length * (crate::lanes::MAX_LANES as u64 + 1) * size_of::<Complex64>() as u64;
    cube + map + row * rayon::current_num_threads() as u64
}
