//! Velocity folds under time and code division, resolved from the phases between slots.
//!
//! N transmitters in turn, each repeated after N·T, measure a velocity modulo λ/2NT. The transmitters' slots
//! are only T apart: an error of k folds leaves a phase of 2πk/N between one slot and the next, and the
//! channels no longer match a point echo. Every fold k = 0 … N − 1 is therefore tried on a cell, and the
//! residual power after subtracting its strongest beam is compared (the generalised likelihood ratio of one
//! echo in white noise). The remaining ambiguity is λ/2T, that of a single transmitter.
//!
//! The array determines how well this works: over all beams to which a wrong fold may turn, [`least_loss`] is
//! the part of the power that the fold must lose. Transmitters whose phases the receivers' beam can follow
//! lose little (3 × 4 contiguous: 30 %; 12 × 16: 2 %); with one receiver and transmitters in a regular row a
//! wrong fold is exactly another direction, and the two are indistinguishable. Two channels at one position
//! (a transmitter's last element on the next one's first) help: their phases must agree in any direction.
//!
//! With codes (`code_division.rs`) there are M slots and folds. A wrong fold moves power to unused codes, if
//! there are any, and otherwise exchanges transmitters; the residual of a beam in the power of all codes
//! reveals it. Transmitters that all receive an echo in one phase (M of them, straight ahead) concentrate it
//! in one slot of a block: then all folds have the same values and the same direction.

use crate::ambiguity::ambiguous_velocities::is_unambiguous;
use crate::direction::angle::{Direction, Snapshot, VirtualArray};
use crate::spectrum::code_division::in_phase;
use artifact::cube::CubeHeader;
use artifact::radar::Multiplexing;
use artifact::rdm::RdmFrame;
use num_complex::Complex64;
use radar::doppler_ambiguity::folded_mps;
use std::f64::consts::TAU;

/// Minimum log-likelihood ratio of the best fold to the next for it to be accepted. Two hypotheses that
/// differ by an expected ratio μ scatter by √2μ: the wrong one leads by 9 in at most Q(√18) = 1.1e-5 of all
/// draws (μ = 9).
pub(crate) const CERTAIN: f64 = 9.0;
/// Ratio below which (odds of 20) a velocity near zero is preferred.
const LIKELY: f64 = 3.0;

/// Residual power of each fold in one or more cells.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FoldResiduals {
    /// Velocity of the first fold, m/s.
    shown_mps: f64,
    /// Velocity from one fold to the next, m/s.
    span_mps: f64,
    /// Power that the strongest beam of each fold does not explain.
    residuals: Vec<f64>,
    /// Degrees of freedom beyond a beam's amplitude and direction.
    freedom: f64,
}

/// A chosen fold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ChosenFold {
    /// Velocity, m/s; of the remaining ambiguities of λ/2T the one nearest to zero.
    pub(crate) velocity_mps: f64,
    /// Logarithm of the likelihood ratio to the next fold.
    pub(crate) margin: f64,
    /// Whether the margin is beyond doubt, and no other velocity up to 120 km/h is indistinguishable.
    pub(crate) is_certain: bool,
}

impl FoldResiduals {
    /// Evaluates the folds, one per slot, of a cell with the apparent velocity `shown_mps`.
    pub(crate) fn of_cell(
        array: &VirtualArray,
        map: &RdmFrame,
        cell: [usize; 2],
        (shown_mps, range_m): (f64, f64),
    ) -> Self {
        let span_mps = 2.0 * array.cells().velocity_max_mps;
        let residual_of = |fold: usize| {
            let (snapshot, idle) = array.snapshot_and_idle(map, cell, shown_mps + fold as f64 * span_mps);
            residual_power(array, &snapshot, idle, range_m)
        };
        let residuals = (0..array.division().slots).map(residual_of).collect();
        Self { shown_mps, span_mps, residuals, freedom: array.division().map_channels as f64 - 2.0 }
    }

    /// Adds the folds of another cell of the same body.
    pub(crate) fn join(&mut self, other: &Self) {
        let count = self.residuals.len();
        // Fold of the other cell at about this one's velocity.
        let turns = ((self.shown_mps - other.shown_mps) / self.span_mps).round() as i64;
        for (fold, left) in self.residuals.iter_mut().enumerate() {
            *left += other.residuals[(fold as i64 + turns).rem_euclid(count as i64) as usize];
        }
        self.freedom += other.freedom;
    }

    /// Fold with the least residual; `noise` is that of one channel's cell.
    ///
    /// The residual of the best fold counts as noise too: a cell of several echoes fits no fold well, and is
    /// weak evidence.
    pub(crate) fn best_fold(&self, noise: f64) -> ChosenFold {
        let least = |folds: &mut dyn Iterator<Item = usize>| {
            folds.fold(None, |best: Option<usize>, f| match best {
                Some(b) if self.residuals[b] <= self.residuals[f] => Some(b),
                _ => Some(f),
            })
        };
        let best = least(&mut (0..self.residuals.len())).unwrap_or(0);
        let second = least(&mut (0..self.residuals.len()).filter(|f| *f != best)).unwrap_or(best);
        let scale = noise.max(self.residuals[best] / self.freedom.max(1.0)).max(f64::MIN_POSITIVE);
        let margin = (self.residuals[second] - self.residuals[best]) / scale;
        let slowest = (0..self.residuals.len())
            .filter(|f| self.residuals[*f] - self.residuals[best] <= LIKELY * scale)
            .min_by(|a, b| self.velocity_mps(*a).abs().total_cmp(&self.velocity_mps(*b).abs()));
        let velocity_mps = self.velocity_mps(slowest.unwrap_or(best));
        let is_certain = margin >= CERTAIN && is_unambiguous(velocity_mps, self.ambiguity_mps());
        ChosenFold { velocity_mps, margin, is_certain }
    }

    /// Velocity span λ/2T, with T from any chirp to the next, m/s.
    fn ambiguity_mps(&self) -> f64 {
        self.span_mps * self.residuals.len() as f64
    }

    fn velocity_mps(&self, fold: usize) -> f64 {
        folded_mps(self.shown_mps + fold as f64 * self.span_mps, self.ambiguity_mps())
    }
}

/// Power of a snapshot and of idle codes, less that of the strongest beam.
fn residual_power(array: &VirtualArray, snapshot: &Snapshot, idle: f64, range_m: f64) -> f64 {
    let total: f64 = snapshot.iter().map(|v| v.norm_sqr()).sum();
    let direction = array.direction(std::slice::from_ref(snapshot), range_m);
    (total + idle - array.explained_power(snapshot, direction, range_m)).max(0.0)
}

/// Smallest share of an echo's power that any wrong fold loses, over echoes from these direction cosines; 0
/// if a wrong fold is exactly another direction.
pub fn least_loss(header: &CubeHeader, directions: &[Direction], range_m: f64) -> f64 {
    let array = VirtualArray::new(header);
    let slots = array.division().slots;
    let lost = |direction: &Direction, fold: usize| {
        let echo: Snapshot =
            array.steering(*direction, range_m).into_iter().map(|turn_back| turn_back.conj()).collect();
        let power = echo.len() as f64;
        let (snapshot, idle) = misfolded(&array, echo, fold);
        residual_power(&array, &snapshot, idle, range_m) / power
    };
    let losses = directions.iter().flat_map(|d| (1..slots).map(move |fold| lost(d, fold)));
    losses.fold(1.0, f64::min)
}

/// Echo in the middle of a row, evaluated `fold` folds away, and the power that idle codes receive of it.
fn misfolded(array: &VirtualArray, echo: Snapshot, fold: usize) -> (Snapshot, f64) {
    let (division, rows) = (array.division(), array.cells().rows);
    let cycles = fold as f64 / division.slots as f64;
    if division.multiplexing == Multiplexing::Bpm {
        let mut codes = echo;
        codes.resize(division.map_channels, Complex64::ZERO);
        let mut turned = in_phase(division, &codes, [rows / 2, rows], -cycles);
        let idle = turned.split_off(division.pairs());
        return (turned, idle.iter().map(|value| value.norm_sqr()).sum());
    }
    let turned = |(channel, value): (usize, Complex64)| {
        value * Complex64::from_polar(1.0, TAU * cycles * (channel / division.receivers) as f64)
    };
    (echo.into_iter().enumerate().map(turned).collect(), 0.0)
}
