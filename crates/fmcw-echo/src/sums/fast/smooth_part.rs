//! Smooth part that a group of paths has in common besides their tones, represented by a few instants of a
//! frame.
//!
//! A path's IF value is its tone, e^{j2π(αn + βm)}, times a factor that varies slowly with chirp n and sample
//! m: range migration, acceleration, spreading, the element's own delay, the amplitude over the band. Divided
//! by that of the group's mean path it hardly varies, so that its values at one to a few instants represent
//! the frame ([`EmpiricalInterpolation`]). Grids of Chebyshev points represent the mean path's.

use crate::sums::fast::empirical_interpolation::{EmpiricalInterpolation, root_mean_square};
use crate::sums::fast::instants::{Instant, Link, ReceivingRadar, Tone};
use crate::sums::fast::scalar::{Scalar, rounded};
use artifact::paths::{Curve, Path};
use num_complex::{Complex, Complex64};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Smooth part of a group: x(n, m) ≈ Σ_i shape_i(n, m)·Σ_paths value(instant i)·tone, for every link.
pub(crate) struct SmoothPart {
    /// Instants at which the paths' values are computed.
    pub(crate) instants: Vec<Instant>,
    axes: [ChebyshevAxis; 2],
    /// Shapes by instant, link, grid point.
    shapes: Vec<Vec<Vec<Complex64>>>,
}

/// Request for a smooth part.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SmoothPartRequest {
    /// Root mean square error, relative to each path's maximum.
    pub(crate) error: f64,
    pub(crate) instants_max: usize,
    /// Minimum number of paths; fewer have no smooth part.
    pub(crate) paths_min: usize,
}

impl SmoothPart {
    /// Smooth part of a set of paths; `None` if more instants than allowed, or a finer grid than
    /// [`GRID_MAX`], would be needed, or if the mean path, to which all are compared, is somewhere outside
    /// the antenna pattern.
    pub(crate) fn of(
        receiving: &ReceivingRadar<'_>,
        paths: &[&Path],
        links: &[Link],
        asked: SmoothPartRequest,
    ) -> Option<Self> {
        let middle = middle_of(paths)?;
        let some = spread_over(receiving, paths);
        let axes = grid_for(receiving, &middle, &some, links, 0.5 * asked.error)?;
        let grid = points(&axes);
        let few: Vec<Link> = [0, links.len() / 2, links.len() - 1].map(|i| links[i]).to_vec();
        let of_middle = slow_values(receiving, &middle, links, &grid);
        let of_few = slow_values(receiving, &middle, &few, &grid);
        let is_heard = |value: &Complex64| value.norm() > 0.0;
        if !of_middle.iter().chain(&of_few).flatten().all(is_heard) {
            return None;
        }
        let (train, test): (Vec<_>, Vec<_>) = some.into_iter().enumerate().partition(|(i, _)| i % 2 == 0);
        let relative = |(_, path): &(usize, &Path)| {
            let values = slow_values(receiving, path, &few, &grid);
            values
                .into_iter()
                .zip(&of_few)
                .map(|(own, middle)| unit(quotient(own, middle)))
                .collect::<Vec<_>>()
        };
        let known: Vec<Vec<Complex64>> = train.iter().flat_map(relative).collect();
        let interpolation = EmpiricalInterpolation::of(&known, 0.7 * asked.error, asked.instants_max);
        let unseen: Vec<Vec<Complex64>> =
            test.iter().flat_map(relative).map(|function| interpolation.residual(&function)).collect();
        let missed = [interpolation.residual_rms, root_mean_square(&unseen)];
        // Without instants none of the sampled paths is heard, which says nothing of the others.
        if !missed.iter().all(|missed| *missed <= asked.error) || interpolation.points.is_empty() {
            return None;
        }
        let shape = |i: usize, of_link: &Vec<Complex64>| {
            let at_point = of_link[interpolation.points[i]];
            interpolation.shares[i]
                .iter()
                .zip(of_link)
                .map(|(share, value)| share * value / at_point)
                .collect()
        };
        let shapes = (0..interpolation.points.len())
            .map(|i| of_middle.iter().map(|v| shape(i, v)).collect())
            .collect();
        let instants = interpolation.points.iter().map(|&point| grid[point]).collect();
        Some(Self { instants, axes, shapes })
    }

    /// Shape of an instant at a link, `[chirp][sample]`.
    pub(crate) fn shape<T: Scalar>(
        &self,
        instant: usize,
        link: usize,
        chirps: usize,
        samples: usize,
    ) -> Vec<Complex<T>> {
        let coarse = &self.shapes[instant][link];
        let [along_chirps, along_samples] = &self.axes;
        let columns = along_samples.places.len();
        let at_samples = along_samples.shares::<T>(samples);
        let rows: Vec<Vec<Complex<T>>> = coarse
            .chunks_exact(columns)
            .map(|row| weighted(&row.iter().map(|v| rounded(*v)).collect::<Vec<_>>(), &at_samples))
            .collect();
        let mut shape = Vec::with_capacity(chirps * samples);
        for shares in along_chirps.shares::<T>(chirps).chunks_exact(rows.len()) {
            let start = shape.len();
            shape.resize(start + samples, Complex::new(T::zero(), T::zero()));
            for (share, row) in shares.iter().zip(&rows) {
                shape[start..].iter_mut().zip(row).for_each(|(sum, value)| *sum = *sum + value * *share);
            }
        }
        shape
    }
}

/// Values on a coarse axis, interpolated to all points of a fine one.
fn weighted<T: Scalar>(coarse: &[Complex<T>], shares: &[T]) -> Vec<Complex<T>> {
    let at = |shares: &[T]| {
        let zero = Complex::new(T::zero(), T::zero());
        shares.iter().zip(coarse).fold(zero, |sum, (share, value)| sum + value * *share)
    };
    shares.chunks_exact(coarse.len()).map(at).collect()
}

/// Chebyshev points of one axis from 0 to `length` − 1, for polynomial interpolation.
#[derive(Debug, Clone)]
struct ChebyshevAxis {
    places: Vec<f64>,
}

impl ChebyshevAxis {
    fn new(length: usize, count: usize) -> Self {
        let half = 0.5 * (length as f64 - 1.0);
        let angle = |i: usize| PI * (i as f64 + 0.5) / count as f64;
        Self { places: (0..count).map(|i| half * (1.0 - angle(i).cos())).collect() }
    }

    /// Weight of every point for the value at 0, 1, … `length` − 1, row by row.
    fn shares<T: Scalar>(&self, length: usize) -> Vec<T> {
        (0..length).flat_map(|at| self.shares_at(at as f64)).map(T::of).collect()
    }

    /// Barycentric weights of the first kind (Berrut, Trefethen, SIAM Review 46 (2004) 501).
    fn shares_at(&self, at: f64) -> Vec<f64> {
        if let Some(hit) = self.places.iter().position(|place| *place == at) {
            return (0..self.places.len()).map(|i| if i == hit { 1.0 } else { 0.0 }).collect();
        }
        let count = self.places.len() as f64;
        let weight =
            |i: usize| (PI * (i as f64 + 0.5) / count).sin() * if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        let terms: Vec<f64> =
            self.places.iter().enumerate().map(|(i, place)| weight(i) / (at - place)).collect();
        let total: f64 = terms.iter().sum();
        terms.iter().map(|term| term / total).collect()
    }
}

/// All points of a grid, chirp by chirp.
fn points(axes: &[ChebyshevAxis; 2]) -> Vec<Instant> {
    let row = |&chirp: &f64| axes[1].places.iter().map(move |&sample| Instant { chirp, sample });
    axes[0].places.iter().flat_map(row).collect()
}

/// Maximum number of points along an axis: a phase of 20 rad takes 32 of them for 1e-8, and a body that moves
/// by M range cells in a frame has a phase of 1.6·M rad. If it moved by more than 16, as over 2.5 GHz in a
/// frame of 0.1 s, all paths were formerly summed one by one.
const GRID_MAX: usize = 64;
/// Number of points from which grids grow by an eighth at a time.
const GRID_COARSE: usize = 32;

/// Grid that represents the smooth part of the mean path and of those farthest from it, checked between its
/// points.
fn grid_for(
    receiving: &ReceivingRadar<'_>,
    middle: &Path,
    some: &[&Path],
    links: &[Link],
    error: f64,
) -> Option<[ChebyshevAxis; 2]> {
    let (chirps, samples) = (receiving.steps.chirps, receiving.radar.waveform.samples as usize);
    let one = [links[links.len() - 1]];
    let paths: Vec<&Path> = some.iter().take(8).copied().chain([middle]).collect();
    // Golden-ratio points, which lie between the points of any grid.
    let between: Vec<Instant> = (1..=24)
        .map(|i| {
            let part = |step: f64| (f64::from(i) * step).fract();
            Instant {
                chirp: part(0.618_034) * (chirps as f64 - 1.0),
                sample: part(0.414_214) * (samples as f64 - 1.0),
            }
        })
        .collect();
    let mut counts = [2_usize, 2];
    loop {
        let axes = [ChebyshevAxis::new(chirps, counts[0]), ChebyshevAxis::new(samples, counts[1])];
        let grid = points(&axes);
        let misses = |path: &&Path| {
            let coarse = slow_values(receiving, path, &one, &grid).remove(0);
            let exact = slow_values(receiving, path, &one, &between).remove(0);
            let size = coarse.iter().map(|v| v.norm()).fold(f64::MIN_POSITIVE, f64::max);
            let told = between.iter().map(|at| on_grid(&axes, &coarse, *at));
            told.zip(exact).map(|(told, exact)| (told - exact).norm() / size).fold(0.0, f64::max)
        };
        if paths.iter().map(misses).fold(0.0, f64::max) <= error {
            return Some(axes);
        }
        // The phase over a frame's chirps is larger than that along a chirp.
        let longer = if counts[0] <= counts[1] + 2 { 0 } else { 1 };
        counts[longer] += if counts[longer] < GRID_COARSE { 1 } else { counts[longer] / 8 };
        if counts.iter().any(|count| *count > GRID_MAX) {
            return None;
        }
    }
}

fn on_grid(axes: &[ChebyshevAxis; 2], coarse: &[Complex64], at: Instant) -> Complex64 {
    let [chirps, samples] = [axes[0].shares_at(at.chirp), axes[1].shares_at(at.sample)];
    let row =
        |row: &[Complex64]| samples.iter().zip(row).map(|(share, value)| *share * value).sum::<Complex64>();
    coarse.chunks_exact(samples.len()).zip(&chirps).map(|(values, share)| *share * row(values)).sum()
}

/// Values by link, then instant, with the path's tone removed.
fn slow_values(
    receiving: &ReceivingRadar<'_>,
    path: &Path,
    links: &[Link],
    instants: &[Instant],
) -> Vec<Vec<Complex64>> {
    let tone = receiving.tone(path);
    let mut values = vec![Vec::with_capacity(instants.len()); links.len()];
    for at in instants {
        receiving.for_each_value(path, links, *at, &mut |place, value| {
            let cycles = value.cycles - cycles_of(tone, *at, receiving.middle());
            values[place].push(value.amplitude * Complex64::cis(TAU * (cycles - cycles.round())));
        });
    }
    values
}

/// Phase of a tone, counted from the frame's middle, cycles.
pub(crate) fn cycles_of(tone: Tone, at: Instant, middle: Instant) -> f64 {
    tone.per_chirp * (at.chirp - middle.chirp) + tone.per_sample * (at.sample - middle.sample)
}

fn quotient(own: Vec<Complex64>, middle: &[Complex64]) -> Vec<Complex64> {
    own.into_iter().zip(middle).map(|(own, middle)| own / middle).collect()
}

/// Function scaled to a maximum of 1.
fn unit(function: Vec<Complex64>) -> Vec<Complex64> {
    let size = function.iter().map(|v| v.norm()).fold(0.0, f64::max);
    if size > 0.0 { function.into_iter().map(|v| v / size).collect() } else { function }
}

/// A path with the group's mean position and motion, and an amplitude of 1.
fn middle_of(paths: &[&Path]) -> Option<Path> {
    let first = *paths.first()?;
    let mean = |of: fn(&Path) -> [f64; 3]| {
        [0, 1, 2].map(|axis| paths.iter().map(|path| of(path)[axis]).sum::<f64>() / paths.len() as f64)
    };
    Some(Path {
        apparent_tx_m: mean(|p| p.apparent_tx_m),
        apparent_tx_mps: mean(|p| p.apparent_tx_mps),
        apparent_rx_m: mean(|p| p.apparent_rx_m),
        apparent_rx_mps: mean(|p| p.apparent_rx_mps),
        amplitude_m: [[Complex64::ONE; 2]; 2],
        slope_m_per_hz: [[Complex64::ZERO; 2]; 2],
        curve: Curve {
            apparent_tx_mps2: mean(|p| p.curve.apparent_tx_mps2),
            apparent_rx_mps2: mean(|p| p.curve.apparent_rx_mps2),
            ..Curve::default()
        },
        ..*first
    })
}

/// Sample of a group's paths: those with the smallest and the largest tones, and others between, alternately.
fn spread_over<'p>(receiving: &ReceivingRadar<'_>, paths: &[&'p Path]) -> Vec<&'p Path> {
    let tones: Vec<Tone> = paths.par_iter().map(|path| receiving.tone(path)).collect();
    let extreme = |of: fn(&Tone) -> f64| {
        let by = |a: &usize, b: &usize| of(&tones[*a]).total_cmp(&of(&tones[*b]));
        [(0..paths.len()).min_by(by), (0..paths.len()).max_by(by)]
    };
    let ends = [extreme(|t| t.per_chirp), extreme(|t| t.per_sample)].concat().into_iter().flatten();
    let step = paths.len().div_ceil(SPREAD).max(1);
    // Both ends twice: they belong to the training and the test set.
    let picked: Vec<usize> = ends.flat_map(|i| [i, i]).chain((0..paths.len()).step_by(step)).collect();
    picked.into_iter().map(|i| paths[i]).collect()
}

/// Number of paths sampled from a group.
const SPREAD: usize = 48;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sums::fast::equidistant_chirps::EquidistantChirps;
    use crate::sums::fast::instants::Link;
    use crate::sums::fast::test_path::path_by;
    use artifact::radar::Radar;
    use radar::aperture::Preset;
    use radar::paper;

    /// Waveform of experiment 3 from one element.
    fn radar() -> Radar {
        paper::radar([0.0; 3], paper::waveform(512, 128), Preset::OneByOne.elements())
    }

    /// Claim X5: a body of 5 m whose points differ by ±0.3 m/s, straight ahead and so far away that only the
    /// bilinear phase remains.
    #[test]
    fn x5_one_two_and_three_instants_leave_39_78_and_116_db() {
        let radar = radar();
        let steps = EquidistantChirps::of(&radar).remove(0);
        let receiving = ReceivingRadar::new(&radar, radar.waveform.centre_frequency_hz(), steps);
        let fraction = |i: usize, step: f64| (i as f64 * step).fract() - 0.5;
        let path = |i: usize| {
            let at_m = [0.0, 2e5 + 5.0 * fraction(i, 0.618_034), 0.0];
            path_by(at_m, [0.0, -10.0 + 0.6 * fraction(i, 0.732_051), 0.0])
        };
        let paths: Vec<Path> = (1..=200).map(path).collect();
        let paths: Vec<&Path> = paths.iter().collect();
        let axes = [ChebyshevAxis::new(128, 9), ChebyshevAxis::new(512, 9)];
        // Equidistant points, so that the mean over points is that over the frame.
        let even = |axis: &ChebyshevAxis, length: f64| ChebyshevAxis {
            places: (0..axis.places.len())
                .map(|i| length * (i as f64 + 0.5) / axis.places.len() as f64)
                .collect(),
        };
        let grid = points(&[even(&axes[0], 127.0), even(&axes[1], 511.0)]);
        let one = [Link { tx: 0, rx: 0 }];
        let middle = slow_values(&receiving, &middle_of(&paths).unwrap(), &one, &grid).remove(0);
        let functions: Vec<Vec<Complex64>> = paths
            .iter()
            .map(|path| unit(quotient(slow_values(&receiving, path, &one, &grid).remove(0), &middle)))
            .collect();
        for (instants, known_db) in [(1, -39.0), (2, -78.0), (3, -116.0)] {
            let interpolation = EmpiricalInterpolation::of(&functions, 0.0, instants);
            let got_db = 20.0 * interpolation.residual_rms.log10();
            println!("X5: {instants} instants leave {got_db:.1} dB, known {known_db} dB");
            assert!((got_db - known_db).abs() < 3.0 || got_db < known_db);
        }
    }
}
