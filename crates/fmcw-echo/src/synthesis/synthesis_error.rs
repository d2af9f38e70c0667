//! Error of a synthesised cube relative to its reference, measured in the run that made it.

use crate::error::EchoError;
use crate::impairments::oscillator::Oscillator;
use crate::sources::rcs_table::{self, TableSum};
use crate::sums::reference;
use artifact::Radar;
use artifact::paths::PathsFrame;
use artifact::rcs::RcsFrame;
use artifact::scene::Pose;
use artifact::seed;
use num_complex::{Complex32, Complex64};
use rand::rand_core::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// Number of samples compared: their mean power is known to 1/√48 (0.6 dB), at the cost of 48 of 400 000.
const PROBES: u64 = 48;

/// Relative error ‖x − x_ref‖/‖x_ref‖ over a few samples of the noise-free cube as stored; `None` if the
/// reference is silent.
///
/// The positions depend on the frame index alone, so that every run of a scene compares the same samples.
pub(crate) fn of_paths(
    radar: &Radar,
    centre_frequency_hz: f64,
    frame: &PathsFrame,
    samples: &[Complex32],
    oscillator: Option<&Oscillator>,
) -> Option<f64> {
    let exact = |at| reference::cube_sample(radar, centre_frequency_hz, &frame.paths, at, oscillator);
    let compare = |at: [usize; 3]| [stored(radar, samples, at), exact(at)];
    relative(&places(radar, frame.index).into_par_iter().map(compare).collect::<Vec<_>>())
}

/// Estimated interpolation error of the tables: a third of the change when they are thinned by two.
pub(crate) fn of_tables(
    radar: &Radar,
    poses: &[Pose],
    frame: &RcsFrame,
    samples: &[Complex32],
    oscillator: Option<&Oscillator>,
) -> Result<Option<f64>, EchoError> {
    let thin = rcs_table::decimate(frame);
    let thin = TableSum::new(radar, poses, &thin, oscillator)?;
    let compare = |at: [usize; 3]| Ok([thin.row(at[0], at[1])?[at[2]], stored(radar, samples, at)]);
    let pairs = places(radar, frame.index).into_iter().map(compare).collect::<Result<Vec<_>, EchoError>>()?;
    Ok(relative(&pairs).map(|difference| difference / 3.0))
}

/// Relative difference ‖first − second‖/‖second‖.
fn relative(pairs: &[[Complex64; 2]]) -> Option<f64> {
    let error: f64 = pairs.iter().map(|[got, exact]| (got - exact).norm_sqr()).sum();
    let power: f64 = pairs.iter().map(|[_, exact]| exact.norm_sqr()).sum();
    (power > 0.0).then(|| (error / power).sqrt())
}

/// Positions `[channel, chirp, sample]` of the probes.
fn places(radar: &Radar, frame: u32) -> Vec<[usize; 3]> {
    let key = seed::key(0, "fmcw-echo/synthesis-error", &[u64::from(frame)]);
    let mut stream = ChaCha8Rng::from_seed(key);
    let mut below = |bound: usize| (stream.next_u64() % bound as u64) as usize;
    let (chirps, samples) = (radar.waveform.chirps as usize, radar.waveform.samples as usize);
    (0..PROBES).map(|_| [below(radar.cube_channels()), below(chirps), below(samples)]).collect()
}

fn stored(radar: &Radar, samples: &[Complex32], [channel, chirp, sample]: [usize; 3]) -> Complex64 {
    let (chirps, length) = (radar.waveform.chirps as usize, radar.waveform.samples as usize);
    let value = samples[(channel * chirps + chirp) * length + sample];
    Complex64::new(value.re.into(), value.im.into())
}
