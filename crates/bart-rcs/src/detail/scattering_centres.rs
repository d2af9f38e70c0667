//! Scattering centres of a target by orthogonal matching pursuit over band, elements and frame.
//!
//! Pati, Rezaiifar, Krishnaprasad (1993); here every candidate is kept orthogonal to those already taken, so
//! that each step takes the centre that leaves the smallest residual (orthogonal least squares; Chen,
//! Billings, Luo (1989)). Blocks of range are fitted separately, since centres cells apart do not contribute
//! to the same samples.

use crate::detail::merged_paths::{Extents, PhaseRotations, merged};
use crate::detail::sampled_chirps::{SampledChirps, power};
use artifact::Radar;
use artifact::paths::{Amplitude, Path};
use artifact::units::SPEED_OF_LIGHT_MPS;
use num_complex::Complex64;
use rayon::prelude::*;

/// Length of a block in range cells: longer ones have more candidates per sample, shorter ones more ends.
const BLOCK_CELLS: f64 = 6.0;
/// Minimum new amplitude of a column, relative to its own: with less, its coefficient would be twenty times
/// what it adds, and cancel others.
const LEAST_NEW: f64 = 0.05;

/// Paths of one target close together in range, and the samples for their fit.
struct Block<'a> {
    paths: Vec<Path>,
    chirps: SampledChirps<'a>,
}

/// Centres of a target's paths, with a residual power of at most the share `allowed` at the fitted samples;
/// candidates are the paths merged with `spread_rad`.
///
/// Only the radar's own polarization is fitted and contained in the centres.
pub(crate) fn centres(radar: &Radar, paths: &[Path], spread_rad: f64, allowed: f64) -> Vec<Path> {
    let blocks = blocks(radar, paths);
    let fields: Vec<Vec<Complex64>> = blocks.iter().map(|block| block.chirps.field(&block.paths)).collect();
    let per_sample: Vec<f64> =
        blocks.iter().zip(&fields).map(|(b, f)| power(f) / b.chirps.len() as f64).collect();
    let allowed_per_sample = allowed * per_sample.iter().sum::<f64>() / blocks.len().max(1) as f64;
    let fitted: Vec<Vec<Path>> = blocks
        .par_iter()
        .zip(&fields)
        .map(|(block, field)| {
            let candidates = merged(radar, &block.paths, spread_rad);
            matching_pursuit(
                radar,
                &block.chirps,
                &candidates,
                field,
                allowed_per_sample * field.len() as f64,
            )
        })
        .collect();
    fitted.into_iter().flatten().collect()
}

fn blocks<'a>(radar: &'a Radar, paths: &[Path]) -> Vec<Block<'a>> {
    let extents = Extents::of(radar);
    let mut placed: Vec<(PhaseRotations, &Path)> =
        paths.iter().map(|path| (extents.turns(path), path)).collect();
    placed.sort_by(|a, b| a.0.length_m.total_cmp(&b.0.length_m));
    let block_m = BLOCK_CELLS * SPEED_OF_LIGHT_MPS / radar.waveform.bandwidth_hz().abs();
    let number = |turns: &PhaseRotations| (turns.length_m / block_m).floor() as i64;
    let of = |part: &[(PhaseRotations, &Path)]| Block {
        paths: part.iter().map(|(_, path)| **path).collect(),
        chirps: chirps(radar, part),
    };
    placed.chunk_by(|a, b| number(&a.0) == number(&b.0)).map(of).collect()
}

/// Chirps and instants for a fit: twice as many as the spread of the paths requires, and some for the ends.
fn chirps<'a>(radar: &'a Radar, paths: &[(PhaseRotations, &Path)]) -> SampledChirps<'a> {
    let extent = |of: &dyn Fn(&PhaseRotations) -> f64| {
        let (low, high) =
            paths.iter().map(|(t, _)| of(t)).fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
        high - low
    };
    let cells = extent(&|t| t.length_m) * radar.waveform.bandwidth_hz().abs() / SPEED_OF_LIGHT_MPS;
    // Between two nodes the phase of a blend turns by half a cycle at most.
    let moments = paths.iter().filter_map(|(_, path)| path.curve.span).map(|span| span.moments).max();
    let places = paths.iter().filter_map(|(_, path)| path.curve.array_span).map(|span| span.places).max();
    let blended = 0.5 * f64::from(moments.unwrap_or(0) + places.unwrap_or(0));
    let across: f64 = (0..5).map(|axis| extent(&|t| t.cycles[axis])).sum::<f64>() + blended;
    SampledChirps::new(
        radar,
        (10.0 + 4.0 * across).min(64.0) as usize,
        (8.0 + 2.0 * cells).ceil() as usize,
        0.5,
    )
}

/// Takes candidates one by one, the best first, until the residual is below `allowed` power or none helps.
fn matching_pursuit(
    radar: &Radar,
    chirps: &SampledChirps<'_>,
    candidates: &[Path],
    field: &[Complex64],
    allowed: f64,
) -> Vec<Path> {
    let mut pursuit = Pursuit::new(chirps, candidates, field);
    while power(&pursuit.left) > allowed && 2 * pursuit.taken.len() + 2 < field.len() / 2 {
        if !pursuit.take_best() {
            break;
        }
    }
    pursuit
        .coefficients()
        .into_iter()
        .map(|(index, of)| centre(radar, &candidates[index], of, chirps))
        .collect()
}

fn centre(
    radar: &Radar,
    candidate: &Path,
    [value, slope]: [Complex64; 2],
    chirps: &SampledChirps<'_>,
) -> Path {
    let (p, q) = radar.array.polarization.indices();
    let alone = |x: Complex64| {
        let mut amplitude = Amplitude::default();
        amplitude[p][q] = x;
        amplitude
    };
    Path { amplitude_m: alone(value), slope_m_per_hz: alone(slope / chirps.half_band_hz()), ..*candidate }
}

/// An orthonormal direction among the samples, and the candidate's column from which it was made.
struct Direction {
    column: (usize, usize),
    unit: Vec<Complex64>,
}

struct Pursuit {
    /// Columns of the candidates: value, slope.
    columns: Vec<[Vec<Complex64>; 2]>,
    /// Columns less their projections on the directions.
    new: Vec<[Vec<Complex64>; 2]>,
    taken: Vec<usize>,
    directions: Vec<Direction>,
    field: Vec<Complex64>,
    left: Vec<Complex64>,
}

impl Pursuit {
    fn new(chirps: &SampledChirps<'_>, candidates: &[Path], field: &[Complex64]) -> Self {
        let columns: Vec<_> = candidates.iter().map(|path| chirps.columns(path)).collect();
        Self {
            new: columns.clone(),
            columns,
            taken: vec![],
            directions: vec![],
            field: field.to_vec(),
            left: field.to_vec(),
        }
    }

    /// Takes the candidate that leaves the smallest residual; returns false if none reduces it.
    fn take_best(&mut self) -> bool {
        let gains = (0..self.columns.len()).map(|i| (i, self.gain(i)));
        let greater = |best: (usize, f64), one: (usize, f64)| if one.1 > best.1 { one } else { best };
        let best = gains.reduce(greater).filter(|(_, gain)| *gain > 0.0).map(|(index, _)| index);
        let Some(best) = best else { return false };
        self.taken.push(best);
        for column in 0..2 {
            if let Some(unit) = self.unit(best, column) {
                self.add_direction(Direction { column: (best, column), unit });
            }
        }
        true
    }

    /// Power by which a candidate would reduce the residual.
    fn gain(&self, index: usize) -> f64 {
        if self.taken.contains(&index) {
            return 0.0;
        }
        let Some(value) = self.unit(index, 0) else { return 0.0 };
        let of_value = dot(&value, &self.left);
        let slope = &self.new[index][1];
        let rest = subtract_scaled(slope, &value, dot(&value, slope));
        let norm = power(&rest);
        let least = LEAST_NEW.powi(2) * power(&self.columns[index][1]);
        let of_slope = if norm > least { dot(&rest, &self.left).norm_sqr() / norm } else { 0.0 };
        of_value.norm_sqr() + of_slope
    }

    /// New part of a column, with length 1; `None` if it is too small.
    fn unit(&self, index: usize, column: usize) -> Option<Vec<Complex64>> {
        let (new, whole) = (&self.new[index][column], &self.columns[index][column]);
        let norm = power(new).sqrt();
        (norm > LEAST_NEW * power(whole).sqrt()).then(|| new.iter().map(|x| x / norm).collect())
    }

    fn add_direction(&mut self, direction: Direction) {
        let unit = &direction.unit;
        self.left = subtract_scaled(&self.left, unit, dot(unit, &self.left));
        for column in self.new.iter_mut().flatten() {
            *column = subtract_scaled(column, unit, dot(unit, column));
        }
        self.directions.push(direction);
    }

    /// Least-squares coefficients of the directions' columns: QR factors are available, so only back
    /// substitution remains. Both directions of a candidate are consecutive.
    fn coefficients(&self) -> Vec<(usize, [Complex64; 2])> {
        let column = |d: &Direction| &self.columns[d.column.0][d.column.1];
        let mut rest = self.field.clone();
        let mut found: Vec<(usize, [Complex64; 2])> = Vec::new();
        for direction in self.directions.iter().rev() {
            let (unit, (index, which)) = (&direction.unit, direction.column);
            let coefficient = dot(unit, &rest) / dot(unit, column(direction));
            rest = subtract_scaled(&rest, column(direction), coefficient);
            if found.last().is_none_or(|(last, _)| *last != index) {
                found.push((index, [Complex64::ZERO; 2]));
            }
            if let Some((_, of)) = found.last_mut() {
                of[which] = coefficient;
            }
        }
        found.reverse();
        found
    }
}

/// Product aᴴb.
fn dot(a: &[Complex64], b: &[Complex64]) -> Complex64 {
    a.iter().zip(b).map(|(a, b)| a.conj() * b).sum()
}

/// Difference x − share·y.
fn subtract_scaled(x: &[Complex64], y: &[Complex64], share: Complex64) -> Vec<Complex64> {
    x.iter().zip(y).map(|(x, y)| x - share * y).collect()
}
