//! Multipath ghosts between two bodies, located at neither: echoes whose direction of departure differs from
//! that of arrival.
//!
//! Between two bodies a wave travels both ways round, over equal lengths and, with transmitters and receivers
//! side by side, with equal strength (reciprocity): with t(u) and r(u) the phases of transmit and receive
//! elements towards direction u, channels hold a·(t(u)r(v) + t(v)r(u)). A single body is u = v. Several
//! independent bodies in one cell give sums of t(u)r(u). A likelihood test decides between the two: the
//! residual of the pair must be smaller than that of the direct echoes found by maximum likelihood
//! ([`crate::direction::point_sources`]), by more than noise and its greater freedom would explain.
//!
//! Different directions of departure and arrival identify ghosts in MIMO radars (Engels, Heidenreich,
//! Wintermantel, Stäcker, Al Kadi and Zoubir, IEEE Signal Process. Mag. 38(4), 2021); this needs more than
//! one transmit and more than one receive element along the row.

use crate::direction::angle::{Direction, VirtualArray};
use crate::direction::point_sources::direct_fit;
use num_complex::Complex64;

/// A multipath ghost: the directions of departure and of arrival, travelled both ways round, and how much
/// better they explain a cell than direct echoes do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MultipathGhost {
    /// Directions of the two bodies.
    pub directions: [Direction; 2],
    /// Log-likelihood relative to that of direct echoes, each less half its number of parameters times ln of
    /// the number of real samples (Schwarz 1978).
    pub evidence: f64,
}

/// Probability that noise alone makes a direct echo look like a ghost.
const FALSE_RATE: f64 = 1e-4;
/// Separation in beamwidths below which a pair is one direction.
const LEAST_APART_BEAMS: f64 = 0.5;
/// Search step for the pair, in beamwidths.
const STEP_BEAMS: f64 = 0.5;
/// Number of climbing passes, and the factor by which each reduces the step; the last is 0.012 beamwidths.
const PASSES: usize = 7;
const SHRINKAGE: f64 = 0.6;
/// Steps of a pass: element of the pair, axis, sign.
const CLIMB_STEPS: [(usize, usize, f64); 8] = [
    (0, 0, 1.0),
    (0, 0, -1.0),
    (1, 0, 1.0),
    (1, 0, -1.0),
    (0, 1, 1.0),
    (0, 1, -1.0),
    (1, 1, 1.0),
    (1, 1, -1.0),
];
/// Wavefront curvature over the array that is neglected: it costs (2π·0.01)² of the power, −24 dB.
const FLAT_CYCLES: f64 = 0.01;
/// Maximum number of grid directions; more would take longer than the rest of a detection.
const MOST_DIRECTIONS: usize = 512;

/// Whether this array can distinguish such a pair from direct echoes: both its transmitters and its receivers
/// have several positions along the row (otherwise one end has the same phases for both directions, and the
/// pair is a sum of two direct echoes), and the row is not too long to search.
pub(crate) fn is_detectable(array: &VirtualArray) -> bool {
    let steps = (1.0 / (STEP_BEAMS * array.beams()[0])).floor();
    array.ends_have_rows() && 2.0 * steps + 1.0 <= MOST_DIRECTIONS as f64
}

/// Pair of directions that a cell's echo travelled by; `None` if direct echoes explain it, or if the array
/// cannot tell. `direct` is the direction of the strongest beam, `noise` the mean noise power of one channel.
pub fn multipath_ghost(
    array: &VirtualArray,
    snapshot: &[Complex64],
    range_m: f64,
    direct: Direction,
    noise: f64,
) -> Option<MultipathGhost> {
    let snapshot_matrix = MimoSnapshot::of(array, snapshot, range_m)?;
    let start = snapshot_matrix.coarse(direct.up)?;
    let (pair, by_waves) = snapshot_matrix.climbed(start);
    // Pairs of beams from which the best was chosen.
    let beams = array.beams().into_iter().filter(|beam| beam.is_finite());
    let least_evidence = beams.map(|beam| (2.0 / beam).powi(2)).product::<f64>().ln() - FALSE_RATE.ln();
    let alone = array.explained_power(snapshot, direct, range_m);
    // Most cells end here: one direct echo explains them equally well.
    let apart_beams = (pair[0].right - pair[1].right).abs() / array.beams()[0];
    if apart_beams < LEAST_APART_BEAMS || by_waves - alone <= least_evidence * noise || noise <= 0.0 {
        return None;
    }
    let total: f64 = snapshot.iter().map(|value| value.norm_sqr()).sum();
    let (directly, directions) = direct_fit(array, snapshot, range_m, noise);
    // Complex amplitudes and directions, including elevations if measured.
    let axes = 1 + usize::from(direct.up.is_some());
    let [of_pair, of_direct] = [2 + 2 * axes, directions * (2 + axes)].map(|count| count as f64);
    let evidence = (directly - (total - by_waves)) / noise
        - 0.5 * (of_pair - of_direct) * (2.0 * snapshot.len() as f64).ln();
    (evidence > least_evidence).then_some(MultipathGhost { directions: pair, evidence })
}

/// A cell's channels by transmit and receive elements.
struct MimoSnapshot<'a> {
    array: &'a VirtualArray,
    /// `[transmit][receive]`.
    values: Vec<&'a [Complex64]>,
    range_m: f64,
}

/// Conjugate steering vectors of one direction, for transmit and for receive elements.
struct SteeringVectors {
    direction: Direction,
    tx: Vec<Complex64>,
    rx: Vec<Complex64>,
}

impl<'a> MimoSnapshot<'a> {
    /// Arranges a snapshot; `None` if one end has a single element.
    fn of(array: &'a VirtualArray, snapshot: &'a [Complex64], range_m: f64) -> Option<Self> {
        let receivers = array.division().receivers;
        let values: Vec<&[Complex64]> = snapshot.chunks_exact(receivers.max(1)).collect();
        (receivers > 1 && values.len() > 1 && array.beams()[0].is_finite()).then_some(Self {
            array,
            values,
            range_m,
        })
    }

    fn steering(&self, direction: Direction, range_m: f64) -> SteeringVectors {
        let [tx, rx] = self.array.element_steering(direction, range_m);
        SteeringVectors { direction, tx, rx }
    }

    /// Best pair on a grid over the visible region at one elevation.
    fn coarse(&self, up: Option<f64>) -> Option<[Direction; 2]> {
        let beam = self.array.beams()[0];
        let edge = (1.0 - up.unwrap_or(0.0).powi(2)).max(0.0).sqrt();
        let count = (edge / (STEP_BEAMS * beam)).floor() as i64;
        if 2 * count + 1 > MOST_DIRECTIONS as i64 {
            return None;
        }
        let direction = |i: i64| Direction { right: i as f64 * STEP_BEAMS * beam, up };
        let grid: Vec<SteeringVectors> =
            (-count..=count).map(|i| self.steering(direction(i), self.range_m)).collect();
        let from_tx: Vec<Vec<Complex64>> = grid.iter().map(|steering| self.departed(steering)).collect();
        let mut best: Option<(f64, [Direction; 2])> = None;
        for (i, u) in grid.iter().enumerate() {
            for (j, v) in grid.iter().enumerate().skip(i + 1) {
                let sum = dot(&from_tx[i], &v.rx) + dot(&from_tx[j], &u.rx);
                let power = sum.norm_sqr() / norm(u, v);
                if best.is_none_or(|(most, _)| power > most) {
                    best = Some((power, [u.direction, v.direction]));
                }
            }
        }
        best.map(|(_, pair)| pair)
    }

    /// Best pair near this one, each with its own elevation, and the power that it explains.
    ///
    /// Wavefronts are those of points at the cell's apparent range or at half of it: a flat body mirrors the
    /// other end, which appears at the length of the whole path. Over 12 × 16 elements the difference is half
    /// a radian at 50 m, over 3 × 4 nothing.
    fn climbed(&self, start: [Direction; 2]) -> ([Direction; 2], f64) {
        let curved = self.climbed_at(start, self.range_m);
        if self.array.curvature_cycles(self.range_m) < FLAT_CYCLES {
            return curved;
        }
        let flatter = self.climbed_at(start, 2.0 * self.range_m);
        if flatter.1 > curved.1 { flatter } else { curved }
    }

    /// Moves to better neighbours, with ever smaller steps.
    fn climbed_at(&self, start: [Direction; 2], range_m: f64) -> ([Direction; 2], f64) {
        let (mut pair, mut best) = (start, self.power(&start, range_m));
        let mut part = 0.5 * STEP_BEAMS;
        for _ in 0..PASSES {
            for (which, axis, side) in CLIMB_STEPS {
                let mut next = pair;
                moved(&mut next[which], axis, side * part * self.array.beams()[axis]);
                let power = self.power(&next, range_m);
                (pair, best) = if power > best { (next, power) } else { (pair, best) };
            }
            part *= SHRINKAGE;
        }
        (pair, best)
    }

    /// Power explained by the pair.
    fn power(&self, pair: &[Direction; 2], range_m: f64) -> f64 {
        if pair.iter().any(|d| d.right.powi(2) + d.up.unwrap_or(0.0).powi(2) >= 1.0) {
            return 0.0;
        }
        let [u, v] = pair.map(|direction| self.steering(direction, range_m));
        let sum = dot(&self.departed(&u), &v.rx) + dot(&self.departed(&v), &u.rx);
        sum.norm_sqr() / norm(&u, &v)
    }

    /// Signal at each receive element from departure in a direction.
    fn departed(&self, steering: &SteeringVectors) -> Vec<Complex64> {
        let mut sums = vec![Complex64::ZERO; steering.rx.len()];
        for (row, turn) in self.values.iter().zip(&steering.tx) {
            sums.iter_mut().zip(*row).for_each(|(sum, value)| *sum += value * turn);
        }
        sums
    }
}

/// Moves a direction along right (axis 0) or, if measured, along up.
fn moved(direction: &mut Direction, axis: usize, by: f64) {
    match axis {
        0 => direction.right += by,
        _ => direction.up = direction.up.map(|up| up + by),
    }
}

/// ‖t(u)r(v) + t(v)r(u)‖².
fn norm(u: &SteeringVectors, v: &SteeringVectors) -> f64 {
    let cross =
        |a: &[Complex64], b: &[Complex64]| a.iter().zip(b).map(|(a, b)| a * b.conj()).sum::<Complex64>();
    let channels = (u.tx.len() * u.rx.len()) as f64;
    (2.0 * channels + 2.0 * (cross(&u.tx, &v.tx) * cross(&v.rx, &u.rx)).re).max(1e-9 * channels)
}

fn dot(values: &[Complex64], steering: &[Complex64]) -> Complex64 {
    values.iter().zip(steering).map(|(value, turn)| value * turn).sum()
}
