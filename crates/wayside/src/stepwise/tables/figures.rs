//! S and the figures beside it.

use artifact::{Accuracy, ErrorBudget, ModelError};
use bart_rcs::{FarFieldError, MirrorRefinement, RcsResult, RcsSeconds};
use num_complex::Complex64;
use pipeline::outcome::verdict::Verdict;

/// S in metres with its errors, by any method; figures that a method lacks keep their defaults.
#[derive(Default)]
pub(crate) struct RcsTable {
    /// Scattering amplitude S, row-major `[frequency, elevation, azimuth]`, phase at the body's origin.
    pub(crate) amplitude_m: Vec<Complex64>,
    /// Number of beams by order of their tree.
    pub(crate) beams: Vec<u64>,
    /// Work by phase, s.
    pub(crate) seconds: RcsSeconds,
    /// Whether S is mere rounding relative to the other polarizations.
    pub(crate) vanishes: bool,
    /// Numerical error over the table.
    pub(crate) error: ErrorBudget,
    /// Errors of the physical model.
    pub(crate) model_error: ModelError,
    /// Spread of the node rules by order, relative to S.
    pub(crate) node_spread: Vec<f64>,
    /// Bound of what dropped beams scatter, relative to S.
    pub(crate) dropped_at_most: Option<f64>,
    /// Mirrors that were followed.
    pub(crate) mirrors: Option<MirrorRefinement>,
    /// Error of the table at the ranges of a road.
    pub(crate) far_field: Option<FarFieldError>,
    /// Number of aspects that an interrupted run had done.
    pub(crate) cached: usize,
}

impl RcsTable {
    /// Table of a result of BART.
    pub(crate) fn of_bart(result: RcsResult) -> Self {
        Self {
            amplitude_m: result.amplitude_m,
            beams: result.beams,
            seconds: result.seconds,
            vanishes: result.vanishes,
            error: result.error,
            model_error: result.model_error,
            node_spread: result.node_spread,
            dropped_at_most: Some(result.dropped_at_most),
            mirrors: Some(result.mirrors),
            far_field: result.far_field,
            cached: 0,
        }
    }

    /// Whether the table is as accurate as asked for.
    pub(crate) fn verdict(&self, accuracy_db: f64) -> Verdict {
        Verdict::of(Accuracy::from_db(accuracy_db), &self.error).with_model_error(&self.model_error)
    }
}
