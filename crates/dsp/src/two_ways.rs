//! Whether an echo went out by one direction and came back by another: a ghost, made by two bodies and standing at neither.
//!
//! Between two bodies a wave runs both ways round, equally long and, with transmitters and receivers side by side, equally
//! strong (reciprocity): with t(u) and r(u) the phases of transmit and receive elements towards direction u, channels hold
//! a·(t(u)r(v) + t(v)r(u)). One body alone is u = v. Several bodies in one cell, each for itself, are sums of t(u)r(u). Which of
//! the two the channels hold is asked by likelihood: the pair has to leave less than the direct echoes that maximum likelihood
//! finds ([`crate::point_sources`]), by more than noise and its greater freedom would give it.
//!
//! That departure and arrival differ is what tells ghosts in MIMO radars (Engels, Heidenreich, Wintermantel, Stäcker, Al Kadi and
//! Zoubir, IEEE Signal Process. Mag. 38(4), 2021); it needs more than one transmit and more than one receive element along the row.

use crate::angle::{Direction, VirtualArray};
use crate::point_sources::direct_fit;
use num_complex::Complex64;

/// The two directions and how much better they explain a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoWays {
    /// Of the two bodies; elevation is taken to be that of the direct echo.
    pub directions: [Direction; 2],
    /// Log-likelihood over that of direct echoes, each less half its parameters times ln of the real samples (Schwarz 1978).
    pub evidence: f64,
}

/// Chance that noise makes a direct echo look like two ways, as far as it is a matter of noise.
const FALSE_RATE: f64 = 1e-4;
/// A pair nearer than this many beams is one direction.
const LEAST_APART_BEAMS: f64 = 0.5;
/// Steps of the search for the pair, in beams, and how often they are halved.
const STEP_BEAMS: f64 = 0.5;
const HALVINGS: usize = 7;
/// Grids of more directions than this would take longer than the rest of a detection.
const MOST_DIRECTIONS: usize = 512;

/// The pair of directions that a cell's echo went by; `None` where direct echoes explain it, or the array cannot tell. `direct` is
/// the direction of the strongest beam, `noise` the mean noise power of one channel.
pub fn two_ways(
    array: &VirtualArray,
    snapshot: &[Complex64],
    range_m: f64,
    direct: Direction,
    noise: f64,
) -> Option<TwoWays> {
    let beam = array.beams()[0];
    let rows = Rows::of(array, snapshot, range_m, direct.up)?;
    let [u, v] = rows.climbed(rows.coarse(beam)?, beam);
    let least_evidence = (4.0 / (beam * beam * FALSE_RATE)).ln();
    let alone = array.beam(snapshot, &array.steering(direct, range_m)).norm_sqr() / snapshot.len() as f64;
    // Most cells end here: one direct echo explains them as well.
    let together = rows.power(u, v);
    if (u - v).abs() < LEAST_APART_BEAMS * beam || together - alone <= least_evidence * noise || noise <= 0.0 {
        return None;
    }
    let total: f64 = snapshot.iter().map(|value| value.norm_sqr()).sum();
    let by_pair = total - together;
    let (directly, directions) = direct_fit(array, snapshot, range_m, noise);
    // Complex amplitudes and directions, with elevation where there is one.
    let axes = 1 + usize::from(direct.up.is_some());
    let [of_pair, of_direct] = [3 + axes, directions * (2 + axes)].map(|count| count as f64);
    let evidence = (directly - by_pair) / noise - 0.5 * (of_pair - of_direct) * (2.0 * snapshot.len() as f64).ln();
    let at = |right: f64| Direction { right, ..direct };
    (evidence > least_evidence).then_some(TwoWays { directions: [at(u), at(v)], evidence })
}

/// A cell's channels by transmit and receive elements.
struct Rows<'a> {
    array: &'a VirtualArray,
    /// `[transmit][receive]`.
    values: Vec<&'a [Complex64]>,
    range_m: f64,
    up: Option<f64>,
}

/// Phases that bring a wave of one direction together, of transmit and of receive elements.
struct Turns {
    right: f64,
    tx: Vec<Complex64>,
    rx: Vec<Complex64>,
}

impl<'a> Rows<'a> {
    /// `None` where one end has a single element.
    fn of(array: &'a VirtualArray, snapshot: &'a [Complex64], range_m: f64, up: Option<f64>) -> Option<Self> {
        let receivers = array.receivers();
        let values: Vec<&[Complex64]> = snapshot.chunks_exact(receivers.max(1)).collect();
        (receivers > 1 && values.len() > 1 && array.beams()[0].is_finite()).then_some(Self {
            array,
            values,
            range_m,
            up,
        })
    }

    fn turns(&self, right: f64) -> Turns {
        let direction = Direction { right, up: self.up };
        let [tx, rx] = self.array.element_turns(direction, self.range_m);
        Turns { right, tx, rx }
    }

    /// The best pair of a grid over all that is visible.
    fn coarse(&self, beam: f64) -> Option<[f64; 2]> {
        let edge = (1.0 - self.up.unwrap_or(0.0).powi(2)).max(0.0).sqrt();
        let count = (edge / (STEP_BEAMS * beam)).floor() as i64;
        if 2 * count + 1 > MOST_DIRECTIONS as i64 {
            return None;
        }
        let grid: Vec<Turns> = (-count..=count).map(|i| self.turns(i as f64 * STEP_BEAMS * beam)).collect();
        let from_tx: Vec<Vec<Complex64>> = grid.iter().map(|turns| self.departed(turns)).collect();
        let mut best = (-1.0, [0.0; 2]);
        for (i, u) in grid.iter().enumerate() {
            for (j, v) in grid.iter().enumerate().skip(i + 1) {
                let sum = dot(&from_tx[i], &v.rx) + dot(&from_tx[j], &u.rx);
                let power = sum.norm_sqr() / norm(u, v);
                best = if power > best.0 { (power, [u.right, v.right]) } else { best };
            }
        }
        (best.0 >= 0.0).then_some(best.1)
    }

    /// Steps to neighbours as long as they are better, ever smaller.
    fn climbed(&self, [mut u, mut v]: [f64; 2], beam: f64) -> [f64; 2] {
        let mut best = self.power(u, v);
        let mut step = 0.5 * STEP_BEAMS * beam;
        for _ in 0..HALVINGS {
            for [du, dv] in [[step, 0.0], [-step, 0.0], [0.0, step], [0.0, -step]] {
                let power = self.power(u + du, v + dv);
                if power > best {
                    (best, u, v) = (power, u + du, v + dv);
                }
            }
            step *= 0.6;
        }
        [u, v]
    }

    /// Power that the pair explains.
    fn power(&self, u: f64, v: f64) -> f64 {
        if u.abs().max(v.abs()) >= 1.0 {
            return 0.0;
        }
        let (u, v) = (self.turns(u), self.turns(v));
        let sum = dot(&self.departed(&u), &v.rx) + dot(&self.departed(&v), &u.rx);
        sum.norm_sqr() / norm(&u, &v)
    }

    /// For each receive element what left towards a direction.
    fn departed(&self, turns: &Turns) -> Vec<Complex64> {
        let mut sums = vec![Complex64::ZERO; turns.rx.len()];
        for (row, turn) in self.values.iter().zip(&turns.tx) {
            sums.iter_mut().zip(*row).for_each(|(sum, value)| *sum += value * turn);
        }
        sums
    }
}

/// ‖t(u)r(v) + t(v)r(u)‖².
fn norm(u: &Turns, v: &Turns) -> f64 {
    let cross = |a: &[Complex64], b: &[Complex64]| a.iter().zip(b).map(|(a, b)| a * b.conj()).sum::<Complex64>();
    let channels = (u.tx.len() * u.rx.len()) as f64;
    (2.0 * channels + 2.0 * (cross(&u.tx, &v.tx) * cross(&v.rx, &u.rx)).re).max(1e-9 * channels)
}

fn dot(values: &[Complex64], turns: &[Complex64]) -> Complex64 {
    values.iter().zip(turns).map(|(value, turn)| value * turn).sum()
}
