//! Requested accuracy and estimated error.
//!
//! The error of an amplitude over a set of values (frequencies, aspects, cells) is e = ‖S − S_ref‖₂ /
//! ‖S_ref‖₂, complex, without prior alignment or scaling; 20·log₁₀ e in dB (`docs/conventions.md`).

use crate::quantities::units::{amplitude_from_db, db_from_amplitude};
use serde::{Deserialize, Serialize};

/// Relative amplitude error that a stage may make against the same physics at convergence.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, Deserialize)]
pub struct Accuracy {
    amplitude: f64,
}

impl Accuracy {
    /// Accuracy from a level in dB: −20 dB allows an error of 10 % of the amplitude.
    pub fn from_db(db: f64) -> Self {
        Self { amplitude: amplitude_from_db(db) }
    }

    /// Allowed error as a fraction of the amplitude.
    pub fn amplitude(self) -> f64 {
        self.amplitude
    }

    /// Allowed error in dB.
    pub fn db(self) -> f64 {
        db_from_amplitude(self.amplitude)
    }

    /// A fraction of this error, for one source among several.
    pub fn share(self, fraction: f64) -> Self {
        Self { amplitude: self.amplitude * fraction }
    }
}

/// Estimated numerical error of one run: relative amplitude errors by source, `None` where not estimated.
///
/// Every figure is computed by the run that prints it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ErrorBudget {
    /// Flat facets in place of the skin that the mesh's normals describe.
    pub tessellation: Option<f64>,
    /// Physical-optics integral over lit polygons in place of the exact one.
    pub integration: Option<f64>,
    /// Discarded beams and slivers.
    pub dropped: Option<f64>,
    /// Paths frozen for a frame while the bodies move.
    pub freezing: Option<f64>,
    /// Fewer paths in place of all traced ones.
    pub detail: Option<f64>,
    /// Echo synthesis in place of the exact sum over paths.
    pub synthesis: Option<f64>,
}

impl ErrorBudget {
    /// The shares, named as in `summary.json`.
    pub fn shares(&self) -> [(&'static str, Option<f64>); 6] {
        [
            ("tessellation", self.tessellation),
            ("integration", self.integration),
            ("dropped", self.dropped),
            ("freezing", self.freezing),
            ("detail", self.detail),
            ("synthesis", self.synthesis),
        ]
    }

    /// Root of the sum of squares of the estimated shares (their phases are independent); `None` if there are
    /// none.
    pub fn total(&self) -> Option<f64> {
        let squares: Vec<f64> = self.shares().iter().filter_map(|(_, e)| e.map(|e| e * e)).collect();
        (!squares.is_empty()).then(|| squares.iter().sum::<f64>().sqrt())
    }

    /// This budget with the shares that `later` has estimated replaced.
    pub fn merged(self, later: Self) -> Self {
        Self {
            tessellation: later.tessellation.or(self.tessellation),
            integration: later.integration.or(self.integration),
            dropped: later.dropped.or(self.dropped),
            freezing: later.freezing.or(self.freezing),
            detail: later.detail.or(self.detail),
            synthesis: later.synthesis.or(self.synthesis),
        }
    }
}

/// Error of the physical model from what it omits: relative amplitude errors by source, `None` where not
/// estimated.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ModelError {
    /// Bounce orders above those traced.
    pub bounces: Option<f64>,
    /// Spread between the node rules of a multiple reflection; on average a lower bound on that model's
    /// error.
    pub nodes: Option<f64>,
    /// Diffraction by edges.
    pub edges: Option<f64>,
    /// A far-field table in place of spherical waves.
    pub far_field: Option<f64>,
    /// Reflections by the road.
    pub road: Option<f64>,
    /// Paths over several bodies.
    pub between_bodies: Option<f64>,
    /// Echoes from behind sheets, where waves are not traced through them.
    pub transmission: Option<f64>,
    /// Echo of small parts that is drawn at random in place of a mesh that has them: the model's share of the
    /// computed echo.
    pub small_parts: Option<f64>,
}

impl ModelError {
    /// The sources, named as in `summary.json`.
    pub fn sources(&self) -> [(&'static str, Option<f64>); 8] {
        [
            ("bounces", self.bounces),
            ("nodes", self.nodes),
            ("edges", self.edges),
            ("far_field", self.far_field),
            ("road", self.road),
            ("between_bodies", self.between_bodies),
            ("transmission", self.transmission),
            ("small_parts", self.small_parts),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minus_twenty_db_is_ten_percent() {
        assert!((Accuracy::from_db(-20.0).amplitude() - 0.1).abs() < 1e-15);
        assert!((Accuracy::from_db(-37.0).db() + 37.0).abs() < 1e-12);
    }

    #[test]
    fn a_budget_adds_its_shares_as_independent_errors_and_says_when_it_knows_none() {
        assert_eq!(ErrorBudget::default().total(), None);
        let budget = ErrorBudget { integration: Some(3e-2), dropped: Some(4e-2), ..Default::default() };
        assert!((budget.total().unwrap() - 5e-2).abs() < 1e-15);
        let merged = budget.merged(ErrorBudget { synthesis: Some(1.0), ..Default::default() });
        assert_eq!((merged.integration, merged.synthesis), (Some(3e-2), Some(1.0)));
    }
}
