//! Echoes with the oscillator's phase noise, computed from a few sums without it.
//!
//! A path's value is rotated by e^{j[φ(T) − φ(T − τ)]}. Over the delays of a frame's paths (mostly within a
//! microsecond) the second part is smooth, of band f_s/2: it is interpolated from its values at a few delays
//! τ_k, Chebyshev points in the number that the accuracy requires. So Σ_p x_p·e^{j[φ(T) − φ(T − τ_p)]} = Σ_k
//! e^{j[φ(T) − φ(T − τ_k)]}·Σ_p ℓ_k(τ_p)·x_p, and the inner sums are fast sums of weighted paths. The delays
//! τ_k move with the paths' middle one, from pair to pair of elements and from chirp to chirp; the paths'
//! motion relative to it is bounded. If the first error is too large, paths are halved by delay; if the
//! second, by what differs most: the delay at an element and a chirp, relative to that at the first. A single
//! path is computed from the formulas.

use crate::impairments::oscillator::Oscillator;
use crate::links::multiplexing::{Transmission, row};
use crate::sums::fast::fast_sum;
use crate::sums::reference::{self, legs_at};
use artifact::paths::Path;
use artifact::{Accuracy, Radar};
use num_complex::{Complex32, Complex64};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Noise-free cube, √W, `[channel][chirp][sample]`, with the oscillator's phase, with an error of `accuracy`
/// relative to its root mean square, provided that paths do not cancel each other.
pub fn cube(
    radar: &Radar,
    centre_frequency_hz: f64,
    paths: &[Path],
    accuracy: Accuracy,
    oscillator: &Oscillator,
) -> Vec<Complex64> {
    let [chirps, samples] = [radar.waveform.chirps as usize, radar.waveform.samples as usize];
    let mut cube = vec![Complex64::ZERO; radar.cube_channels() * chirps * samples];
    let delayed: Vec<DelayedPath<'_>> = paths.iter().map(|path| DelayedPath::new(radar, path)).collect();
    let sum = PhaseNoiseSum { radar, centre_frequency_hz, oscillator, accuracy };
    sum.add(delayed, &mut cube);
    cube
}

/// [`cube`] rounded to single precision, as a cube is stored.
pub(crate) fn single_cube(
    radar: &Radar,
    centre_frequency_hz: f64,
    paths: &[Path],
    accuracy: Accuracy,
    oscillator: &Oscillator,
) -> Vec<Complex32> {
    let cube = cube(radar, centre_frequency_hz, paths, accuracy, oscillator);
    cube.into_iter().map(|value| Complex32::new(value.re as f32, value.im as f32)).collect()
}

/// A path and its delay for the array's first pair of elements at the frame's middle.
#[derive(Clone, Copy)]
struct DelayedPath<'p> {
    path: &'p Path,
    delay_s: f64,
}

impl<'p> DelayedPath<'p> {
    fn new(radar: &Radar, path: &'p Path) -> Self {
        let first = row(radar, 0, 0)[0];
        Self { path, delay_s: delay_s(path, &first, radar.frame_middle_s()) }
    }

    /// Delay at the start of a transmission beyond the one of [`Self::delay_s`].
    fn later_s(&self, transmission: &Transmission) -> f64 {
        delay_s(self.path, transmission, transmission.start_s) - self.delay_s
    }
}

struct PhaseNoiseSum<'a> {
    radar: &'a Radar,
    centre_frequency_hz: f64,
    oscillator: &'a Oscillator,
    accuracy: Accuracy,
}

/// Maximum number of delays; more cost more sums than halving the paths does.
const DELAYS_MAX: usize = 16;

impl PhaseNoiseSum<'_> {
    fn add(&self, mut paths: Vec<DelayedPath<'_>>, cube: &mut [Complex64]) {
        match paths[..] {
            [] => return,
            [lone] => return self.add_exactly(lone.path, cube),
            _ => {}
        }
        match (self.delays(&paths), self.unlike_delays(&paths)) {
            (Some(delays), None) => {
                let all = delays.0.iter().enumerate();
                return all.for_each(|(k, _)| self.add_weighted(&paths, &delays, k, cube));
            }
            (Some(_), Some(transmission)) => {
                let later_s = |path: &DelayedPath<'_>| path.later_s(&transmission);
                paths.sort_by(|a, b| later_s(a).total_cmp(&later_s(b)));
            }
            (None, _) => paths.sort_by(|a, b| a.delay_s.total_cmp(&b.delay_s)),
        }
        let far = paths.split_off(paths.len() / 2);
        self.add(paths, cube);
        self.add(far, cube);
    }

    fn delays(&self, paths: &[DelayedPath<'_>]) -> Option<Delays> {
        Delays::of(&ProbeTimes::new(self.radar, self.oscillator), paths, 0.25 * self.accuracy.amplitude())
    }

    /// Adds the contribution of one delay over all paths.
    fn add_weighted(&self, paths: &[DelayedPath<'_>], delays: &Delays, k: usize, cube: &mut [Complex64]) {
        let weighted = |delayed: &DelayedPath<'_>| {
            let share = delays.shares(delayed.delay_s)[k];
            let scaled = |of: [[Complex64; 2]; 2]| of.map(|row| row.map(|value| share * value));
            let Path { amplitude_m, slope_m_per_hz, .. } = *delayed.path;
            Path { amplitude_m: scaled(amplitude_m), slope_m_per_hz: scaled(slope_m_per_hz), ..*delayed.path }
        };
        let weighted: Vec<Path> = paths.iter().map(weighted).collect();
        // Weights of up to 16 Chebyshev delays add up to 2.7 at most: 2.7 · 0.2 of the requested error.
        let accuracy = self.accuracy.share(0.2);
        let part = fast_sum::cube(self.radar, self.centre_frequency_hz, &weighted, accuracy);
        let middle = paths[paths.len() / 2];
        let later_s = delays.0[k] - middle.delay_s;
        let [chirps, samples] = [self.radar.waveform.chirps as usize, self.radar.waveform.samples as usize];
        let rows = cube.par_chunks_mut(samples).zip(part.par_chunks(samples));
        rows.enumerate().for_each(|(r, (total, part))| {
            let turns =
                self.rotations(middle.path, later_s, &row(self.radar, r / chirps, r % chirps), samples);
            total.iter_mut().zip(part).zip(turns).for_each(|((sum, value), turn)| *sum += turn * value);
        });
    }

    /// Factors e^{j[φ(T) − φ(T − τ)]} of a chirp's samples, with τ the middle path's delay there plus
    /// `later_s`.
    fn rotations(&self, middle: &Path, later_s: f64, row: &[Transmission], samples: usize) -> Vec<Complex64> {
        let transmission = &row[row.len() / 2];
        let start_s = transmission.start_s;
        let half_chirp_s = 0.5 * samples as f64 / self.radar.waveform.sample_rate_hz;
        let delay_s = delay_s(middle, transmission, start_s + half_chirp_s) + later_s;
        let now = self.oscillator.phases_rad(start_s, samples);
        let then = self.oscillator.phases_rad(start_s - delay_s, samples);
        now.iter().zip(then).map(|(now, then)| Complex64::cis(now - then)).collect()
    }

    /// Elements and chirp at which the paths' delays differ most from the middle one's, beyond what they
    /// differ by for the first pair at the frame's middle; `None` if the oscillator tolerates that.
    fn unlike_delays(&self, paths: &[DelayedPath<'_>]) -> Option<Transmission> {
        let allowed_s = 0.25 * self.accuracy.amplitude() / self.oscillator.rate_rms_rad_per_s();
        let middle = paths[paths.len() / 2];
        let [channels, chirps] = [self.radar.cube_channels(), self.radar.waveform.chirps as usize];
        let corners: Vec<Transmission> = [0, channels - 1]
            .iter()
            .flat_map(|c| [0, chirps - 1].map(|m| row(self.radar, *c, m)))
            .flatten()
            .collect();
        let apart_s = |transmission: &Transmission| {
            let of_middle_s = middle.later_s(transmission);
            paths.iter().map(|path| (path.later_s(transmission) - of_middle_s).abs()).fold(0.0, f64::max)
        };
        let apart: Vec<f64> = corners.par_iter().map(apart_s).collect();
        let (worst_s, transmission) = apart.into_iter().zip(corners).max_by(|a, b| a.0.total_cmp(&b.0))?;
        (worst_s > allowed_s).then_some(transmission)
    }

    fn add_exactly(&self, path: &Path, cube: &mut [Complex64]) {
        let [chirps, samples] = [self.radar.waveform.chirps as usize, self.radar.waveform.samples as usize];
        cube.par_chunks_mut(samples).enumerate().for_each(|(r, row)| {
            for (n, sample) in row.iter_mut().enumerate() {
                let at = [r / chirps, r % chirps, n];
                let (f_c, path) = (self.centre_frequency_hz, std::slice::from_ref(path));
                *sample += reference::cube_sample(self.radar, f_c, path, at, Some(self.oscillator));
            }
        });
    }
}

/// Maximum echo delay at the start or end of the frame, for the array's first pair of elements.
pub(crate) fn longest_delay_s(radar: &Radar, paths: &[Path]) -> f64 {
    let first = row(radar, 0, 0)[0];
    let ends_s = [0.0, radar.frame_duration_s()];
    let delays_s = paths.iter().flat_map(|path| ends_s.map(|time_s| delay_s(path, &first, time_s)));
    delays_s.fold(0.0, f64::max)
}

fn delay_s(path: &Path, transmission: &Transmission, time_s: f64) -> f64 {
    legs_at(path, transmission, time_s).delay_s() + transmission.line_delay_s
}

/// Times of a frame at which an interpolation is tested.
struct ProbeTimes<'a> {
    oscillator: &'a Oscillator,
    duration_s: f64,
}

/// Number of probes: the root mean square over them is known to 1/√256.
const PROBES: u32 = 128;

impl<'a> ProbeTimes<'a> {
    fn new(radar: &Radar, oscillator: &'a Oscillator) -> Self {
        Self { oscillator, duration_s: radar.frame_duration_s() }
    }

    /// Factors e^{−jφ(T − τ)} at every probed time T.
    fn rotations(&self, delay_s: f64) -> Vec<Complex64> {
        // Golden-ratio points: evenly spread without a common period.
        let moment_s = |i: u32| (f64::from(i) * 0.618_033_988_749_895).fract() * self.duration_s;
        (0..PROBES).map(|i| Complex64::cis(-self.oscillator.phase_rad(moment_s(i) - delay_s))).collect()
    }
}

/// Delays from which the oscillator's phase is interpolated over all delays of a set of paths.
struct Delays(Vec<f64>);

impl Delays {
    /// Finds the smallest number of delays that leaves `error`, root mean square over the frame, at the worst
    /// delay between them; `None` if too many would be needed.
    fn of(probes: &ProbeTimes<'_>, paths: &[DelayedPath<'_>], error: f64) -> Option<Self> {
        let all_s = paths.iter().map(|path| path.delay_s);
        let (first, last) = (all_s.clone().fold(f64::INFINITY, f64::min), all_s.fold(0.0, f64::max));
        let chebyshev = |count: usize| {
            let place = |k: usize| 0.5 * (1.0 - (PI * (k as f64 + 0.5) / count as f64).cos());
            Self((0..count).map(|k| first + place(k) * (last - first)).collect())
        };
        (1..=DELAYS_MAX).map(chebyshev).find(|delays| delays.residual_rms(probes, first, last) <= error)
    }

    /// Root mean square error at the worst of several test delays.
    fn residual_rms(&self, probes: &ProbeTimes<'_>, first: f64, last: f64) -> f64 {
        let known: Vec<Vec<Complex64>> = self.0.iter().map(|delay_s| probes.rotations(*delay_s)).collect();
        let between = 2 * self.0.len();
        let missed = |i: usize| {
            let delay_s = first + (last - first) * i as f64 / between as f64;
            let (exact, shares) = (probes.rotations(delay_s), self.shares(delay_s));
            let square = |(moment, exact): (usize, &Complex64)| {
                let told: Complex64 =
                    known.iter().zip(&shares).map(|(known, share)| known[moment] * share).sum();
                (told - exact).norm_sqr()
            };
            (exact.iter().enumerate().map(square).sum::<f64>() / exact.len() as f64).sqrt()
        };
        (0..=between).map(missed).fold(0.0, f64::max)
    }

    /// Lagrange weights.
    fn shares(&self, delay_s: f64) -> Vec<f64> {
        let share = |k: usize| {
            let others = self.0.iter().enumerate().filter(|(other, _)| *other != k);
            others.map(|(_, other)| (delay_s - other) / (self.0[k] - other)).product()
        };
        (0..self.0.len()).map(share).collect()
    }
}
