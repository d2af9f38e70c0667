//! Directions of several echoes in one cell: deterministic maximum likelihood on a single snapshot.
//!
//! A map cell gives one value per channel, so no covariance can be averaged, and eigenvector methods (MUSIC,
//! ESPRIT) would have to smooth over sub-arrays, which sparse rows and elevation rows lack. Maximum
//! likelihood needs none of this: it finds the directions whose echoes leave the smallest residual (Ziskind
//! and Wax, IEEE Trans. ASSP 36 (1988) 1553, here by Gauss–Newton with the amplitudes projected out: Golub
//! and Pereyra, SIAM J. Numer. Anal. 10 (1973) 413), for any array and spherical waves. An additional echo is
//! accepted if it reduces the residual by more than noise would (generalised likelihood ratio), and by more
//! than the model of one echo can err: its amplitude differs from channel to channel as their ranges do.

use crate::direction::angle::{Direction, VirtualArray};
use crate::numerics::cholesky::solve;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// An echo in a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    /// Direction, seen from the array.
    pub direction: Direction,
    /// Power summed over channels.
    pub power: f64,
}

/// Maximum number of echoes in one cell.
pub(crate) const MOST_SOURCES: usize = 3;
/// Direction cosines along right and up of each echo.
const PARAMETERS: usize = 2 * MOST_SOURCES;
/// Probability that noise alone adds an echo to a cell.
const FALSE_SPLIT_RATE: f64 = 1e-4;
/// Share of the cell's power below which an echo is rejected: a range cell's response differs by up to −30 dB
/// along a row of 0.34 m.
const WEAKEST_SHARE: f64 = 1e-3;
/// Share of the cell's power, −50 dB, below which a residual is indistinguishable from model errors other
/// than amplitudes that differ from channel to channel.
const MODEL_ERROR: f64 = 1e-5;
/// Starting offsets left and right of an echo that may be two, in beamwidths (λ over the array's extent).
const SPLITS: [f64; 3] = [0.15, 0.4, 0.9];
/// Gauss–Newton steps: from these starts the residual settles to 1e-6 of the noise within about ten.
const GAUSS_NEWTON_STEPS: usize = 16;

/// Echoes of a cell, strongest first, at least one; `noise` is the mean noise power of one channel. Each is
/// taken to be equally strong in all channels.
pub fn sources(array: &VirtualArray, snapshot: &[Complex64], range_m: f64, noise: f64) -> Vec<Source> {
    sources_on_lobe(array, snapshot, range_m, noise, |_| 0.0)
}

/// [`sources`] of a cell in which a lone echo has the amplitude `lobe` in a channel that sees it that many
/// metres farther than the array's centre, √W; its power is summed over channels.
pub(crate) fn sources_on_lobe(
    array: &VirtualArray,
    snapshot: &[Complex64],
    range_m: f64,
    noise: f64,
    lobe: impl Fn(f64) -> f64,
) -> Vec<Source> {
    let strongest = array.direction(&[snapshot.to_vec()], range_m);
    let unexplained = MODEL_ERROR * power(snapshot) + 2.0 * variance(lobe, array, strongest, range_m);
    let least = (split_threshold(snapshot.len()) * noise).max(unexplained);
    match likeliest(array, snapshot, range_m, strongest, least) {
        Some(fit) => fit.sources(snapshot.len()),
        None => vec![Source { direction: strongest, power: 0.0 }],
    }
}

/// Residual power after subtracting the echoes of a cell that noise does not explain, and their number.
pub(crate) fn direct_fit(
    array: &VirtualArray,
    snapshot: &[Complex64],
    range_m: f64,
    noise: f64,
) -> (f64, usize) {
    let strongest = array.direction(&[snapshot.to_vec()], range_m);
    let fit = likeliest(array, snapshot, range_m, strongest, split_threshold(snapshot.len()) * noise);
    fit.map_or((power(snapshot), 0), |fit| (fit.residual_power, fit.directions.len()))
}

/// Fits as many echoes as reduce the residual by more than `least` each; `None` if the strongest beam's
/// direction is not visible.
fn likeliest(
    array: &VirtualArray,
    snapshot: &[Complex64],
    range_m: f64,
    strongest: Direction,
    least: f64,
) -> Option<AmplitudeFit> {
    let mut best = AmplitudeFit::new(array, snapshot, range_m, &[strongest])?;
    let total = power(snapshot);
    // Each echo takes a complex amplitude and a direction: more echoes than a third of the channels leave no
    // evidence.
    while best.directions.len() < MOST_SOURCES.min(snapshot.len() / 3) {
        // None can reduce the residual by more than all of it.
        if best.residual_power <= least {
            break;
        }
        match with_one_more_echo(array, snapshot, range_m, &best) {
            Some(more)
                if best.residual_power - more.residual_power > least
                    && more.weakest() > WEAKEST_SHARE * total =>
            {
                best = more;
            }
            _ => break,
        }
    }
    Some(best)
}

/// Variance of a lobe's amplitude over the channels' ranges to a point, half a path longer being as much
/// farther: by Gauss–Hermite's rule of three nodes.
fn variance(lobe: impl Fn(f64) -> f64, array: &VirtualArray, direction: Direction, range_m: f64) -> f64 {
    let excess_m = array.excess_m(direction, range_m);
    let count = excess_m.len() as f64;
    let mean_m = excess_m.iter().sum::<f64>() / count;
    let deviation_m = (excess_m.iter().map(|m| (m - mean_m).powi(2)).sum::<f64>() / count).sqrt();
    let nodes = [(0.0, 2.0 / 3.0), (-3f64.sqrt(), 1.0 / 6.0), (3f64.sqrt(), 1.0 / 6.0)];
    let values = nodes.map(|(node, weight)| (lobe(0.5 * (mean_m + node * deviation_m)), weight));
    let mean: f64 = values.iter().map(|(value, weight)| weight * value).sum();
    values.iter().map(|(value, weight)| weight * (value - mean).powi(2)).sum()
}

/// Cramér–Rao bound of the direction cosines of a known number of echoes: minimum standard errors of each
/// along right and up (Stoica and Nehorai, IEEE Trans. ASSP 37 (1989) 720, eq. 4.1, for one snapshot); 0
/// along axes without extent, `None` if two coincide.
pub fn least_errors(
    array: &VirtualArray,
    echoes: &[(Direction, Complex64)],
    range_m: f64,
    noise: f64,
) -> Option<Vec<[f64; 2]>> {
    let directions: Vec<Direction> = echoes.iter().map(|(direction, _)| *direction).collect();
    let steering: Vec<Vec<Complex64>> = directions.iter().map(|d| array.steering(*d, range_m)).collect();
    let sum = |c: usize| -> Complex64 {
        echoes.iter().zip(&steering).map(|((_, a), steering)| a * steering[c].conj()).sum()
    };
    let noiseless: Vec<Complex64> = (0..steering.first()?.len()).map(sum).collect();
    let slopes = AmplitudeFit::new(array, &noiseless, range_m, &directions)?.slopes(array, range_m);
    let mut information = [[0.0; PARAMETERS]; PARAMETERS];
    for (i, a) in slopes.iter().enumerate().take(PARAMETERS) {
        slopes
            .iter()
            .enumerate()
            .take(PARAMETERS)
            .for_each(|(j, b)| information[i][j] = 2.0 / noise * inner(a, b).re);
    }
    let variance = |i: usize| {
        let mut unit = [0.0; PARAMETERS];
        unit[i] = 1.0;
        solve(information, unit).map(|column| column[i])
    };
    (0..echoes.len().min(MOST_SOURCES))
        .map(|k| Some([variance(2 * k)?.sqrt(), variance(2 * k + 1)?.sqrt()]))
        .collect()
}

/// Threshold t, in units of one channel's noise power, that solves M·t·e^{−t} = the rate: for two amplitudes
/// and a direction fitted over as many beams as channels, Pr(reduction > tσ²) ≈ M·t·e^{−t}.
fn split_threshold(channels: usize) -> f64 {
    let beams = channels as f64;
    let next = |t: f64, _| (beams * t / FALSE_SPLIT_RATE).ln();
    // Each step removes nine tenths of the error.
    (0..20).fold(10.0, next)
}

/// Best fit with one more echo: an existing one split in two, or a new one where the residual's beam is
/// strongest.
fn with_one_more_echo(
    array: &VirtualArray,
    snapshot: &[Complex64],
    range_m: f64,
    fit: &AmplitudeFit,
) -> Option<AmplitudeFit> {
    let found = array.direction(std::slice::from_ref(&fit.residual), range_m);
    let mut starts = vec![[fit.directions.as_slice(), &[found]].concat()];
    for (index, direction) in fit.directions.iter().enumerate() {
        for (axis, beam) in array.beams().into_iter().enumerate() {
            for part in SPLITS.iter().filter(|_| beam.is_finite()) {
                let [left, right] = [-0.5, 0.5].map(|side| shifted(*direction, axis, side * part * beam));
                let mut start = fit.directions.clone();
                start[index] = left;
                start.push(right);
                starts.push(start);
            }
        }
    }
    let fits = starts.iter().filter_map(|start| {
        Some(gauss_newton(array, snapshot, range_m, AmplitudeFit::new(array, snapshot, range_m, start)?))
    });
    fits.min_by(|a, b| a.residual_power.total_cmp(&b.residual_power))
}

/// Gauss–Newton with Levenberg–Marquardt damping, which never increases the residual.
fn gauss_newton(
    array: &VirtualArray,
    snapshot: &[Complex64],
    range_m: f64,
    mut fit: AmplitudeFit,
) -> AmplitudeFit {
    let mut damping = 1e-3;
    for _ in 0..GAUSS_NEWTON_STEPS {
        let moved = fit.step(array, range_m, damping).and_then(|step| {
            let at = |(i, d): (usize, &Direction)| shifted(shifted(*d, 0, step[2 * i]), 1, step[2 * i + 1]);
            let directions: Vec<Direction> = fit.directions.iter().enumerate().map(at).collect();
            AmplitudeFit::new(array, snapshot, range_m, &directions)
        });
        match moved {
            Some(moved) if moved.residual_power < fit.residual_power => {
                fit = moved;
                damping *= 0.1;
            }
            _ => damping = (damping * 30.0).max(1e-3),
        }
    }
    fit
}

fn shifted(direction: Direction, axis: usize, by: f64) -> Direction {
    match axis {
        0 => Direction { right: direction.right + by, ..direction },
        _ => Direction { up: direction.up.map(|up| up + by), ..direction },
    }
}

/// Least squares over the amplitudes of echoes from given directions, by QR (modified Gram–Schmidt).
struct AmplitudeFit {
    directions: Vec<Direction>,
    amplitudes: Vec<Complex64>,
    /// Orthonormal basis of the echoes.
    basis: Vec<Vec<Complex64>>,
    residual: Vec<Complex64>,
    residual_power: f64,
}

impl AmplitudeFit {
    /// Fits the amplitudes; `None` if a direction is not visible or two are indistinguishable.
    fn new(
        array: &VirtualArray,
        snapshot: &[Complex64],
        range_m: f64,
        directions: &[Direction],
    ) -> Option<Self> {
        let visible = |d: &Direction| d.right.powi(2) + d.up.unwrap_or(0.0).powi(2) < 1.0;
        directions.iter().all(visible).then_some(())?;
        let (mut basis, mut triangle): (Vec<Vec<Complex64>>, Vec<Vec<Complex64>>) = (vec![], vec![]);
        for direction in directions {
            let mut echo: Vec<Complex64> =
                array.steering(*direction, range_m).iter().map(|turn| turn.conj()).collect();
            let mut column: Vec<Complex64> = basis.iter().map(|q| project_out(q, &mut echo)).collect();
            let left = power(&echo).sqrt();
            // Closer than 1/2000 of a beamwidth the amplitudes exceed a thousand times the echo.
            (left > 1e-3 * (snapshot.len() as f64).sqrt()).then_some(())?;
            echo.iter_mut().for_each(|v| *v /= left);
            column.push(left.into());
            basis.push(echo);
            triangle.push(column);
        }
        let mut residual = snapshot.to_vec();
        let mut amplitudes: Vec<Complex64> = basis.iter().map(|q| project_out(q, &mut residual)).collect();
        for i in (0..amplitudes.len()).rev() {
            let known: Complex64 = (i + 1..amplitudes.len()).map(|k| triangle[k][i] * amplitudes[k]).sum();
            amplitudes[i] = (amplitudes[i] - known) / triangle[i][i];
        }
        let residual_power = power(&residual);
        Some(Self { directions: directions.to_vec(), amplitudes, basis, residual, residual_power })
    }

    /// Step of all directions, [right, up] of each, that lowers the residual to first order.
    fn step(&self, array: &VirtualArray, range_m: f64, damping: f64) -> Option<[f64; PARAMETERS]> {
        let slopes = self.slopes(array, range_m);
        let mut matrix = [[0.0; PARAMETERS]; PARAMETERS];
        let mut right = [0.0; PARAMETERS];
        for (i, a) in slopes.iter().enumerate() {
            right[i] = inner(a, &self.residual).re;
            for (j, b) in slopes.iter().enumerate() {
                matrix[i][j] = inner(a, b).re * if i == j { 1.0 + damping } else { 1.0 };
            }
        }
        solve(matrix, right)
    }

    /// Derivatives of the echoes with respect to each direction cosine, without what the amplitudes can
    /// absorb.
    fn slopes(&self, array: &VirtualArray, range_m: f64) -> Vec<Vec<Complex64>> {
        let of_echo = |(direction, amplitude): (&Direction, &Complex64)| {
            let steering = array.steering(*direction, range_m);
            let excess = array.excess_slopes_m(*direction, range_m);
            [0, 1].map(|axis: usize| {
                let per_cosine = |(turn, excess): (&Complex64, &[f64; 2])| {
                    turn.conj() * amplitude * Complex64::new(0.0, TAU * excess[axis] / array.wavelength_m())
                };
                let mut slope: Vec<Complex64> = steering.iter().zip(&excess).map(per_cosine).collect();
                self.basis.iter().for_each(|q| {
                    project_out(q, &mut slope);
                });
                slope
            })
        };
        self.directions.iter().zip(&self.amplitudes).flat_map(of_echo).collect()
    }

    fn weakest(&self) -> f64 {
        let powers = self.amplitudes.iter().map(|a| a.norm_sqr() * self.residual.len() as f64);
        powers.fold(f64::INFINITY, f64::min)
    }

    fn sources(&self, channels: usize) -> Vec<Source> {
        let source = |(direction, amplitude): (&Direction, &Complex64)| Source {
            direction: *direction,
            power: amplitude.norm_sqr() * channels as f64,
        };
        let mut sources: Vec<Source> = self.directions.iter().zip(&self.amplitudes).map(source).collect();
        sources.sort_by(|a, b| b.power.total_cmp(&a.power));
        sources
    }
}

/// Inner product qᴴ·v.
fn inner(q: &[Complex64], v: &[Complex64]) -> Complex64 {
    q.iter().zip(v).map(|(a, b)| a.conj() * b).sum()
}

/// Removes the component along a unit vector from `v` and returns it.
fn project_out(q: &[Complex64], v: &mut [Complex64]) -> Complex64 {
    let part = inner(q, v);
    v.iter_mut().zip(q).for_each(|(v, q)| *v -= part * q);
    part
}

fn power(values: &[Complex64]) -> f64 {
    values.iter().map(|v| v.norm_sqr()).sum()
}
