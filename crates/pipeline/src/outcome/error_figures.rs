//! Error budgets in decibels, as `summary.json` and the sidecar of `rcs` hold them.

use artifact::accuracy::{ErrorBudget, ModelError};
use artifact::units::{LOWEST_DB, db_from_amplitude};
use serde::{Deserialize, Serialize};

/// Estimated numerical error, dB relative to the echo; `None` where it was not estimated or is zero.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ErrorFigures {
    /// Total of all shares.
    pub total: Option<f64>,
    /// Flat facets in place of the skin that the mesh's normals describe.
    pub tessellation: Option<f64>,
    /// Physical-optics integral over lit polygons in place of the exact one.
    pub integration: Option<f64>,
    /// Dropped beams and slivers.
    pub dropped: Option<f64>,
    /// Paths frozen for a frame while the bodies move.
    pub freezing: Option<f64>,
    /// Fewer paths in place of all that were traced.
    pub detail: Option<f64>,
    /// Echo synthesis instead of the exact sum over paths.
    pub synthesis: Option<f64>,
}

impl ErrorFigures {
    /// Levels of the numerical errors; `None` where there is none.
    pub fn of(error: &ErrorBudget) -> Self {
        Self {
            total: db(error.total()),
            tessellation: db(error.tessellation),
            integration: db(error.integration),
            dropped: db(error.dropped),
            freezing: db(error.freezing),
            detail: db(error.detail),
            synthesis: db(error.synthesis),
        }
    }

    /// The shares in the order of their names, dB.
    pub fn shares(&self) -> [(&'static str, Option<f64>); 6] {
        [
            ("detail", self.detail),
            ("dropped", self.dropped),
            ("freezing", self.freezing),
            ("integration", self.integration),
            ("synthesis", self.synthesis),
            ("tessellation", self.tessellation),
        ]
    }
}

/// Error of the physical model, dB relative to the echo; `None` where it was not estimated or is zero.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ModelErrorFigures {
    /// Bounces of higher orders than were traced.
    pub bounces: Option<f64>,
    /// Spread between the node rules of a multiple reflection.
    pub nodes: Option<f64>,
    /// Diffraction by edges.
    pub edges: Option<f64>,
    /// A far-field table in place of spherical waves.
    pub far_field: Option<f64>,
    /// Reflections by the road.
    pub road: Option<f64>,
    /// Ways that meet several bodies.
    pub between_bodies: Option<f64>,
    /// Echoes from behind sheets, where waves are not followed through them.
    pub transmission: Option<f64>,
    /// Echo of small parts that is drawn at random, relative to the echo without them.
    #[serde(default)]
    pub small_parts: Option<f64>,
    /// Shading between bodies, which far-field tables leave out: always `None`, because it is not estimated.
    #[serde(default)]
    pub shading: Option<f64>,
}

impl ModelErrorFigures {
    /// Levels of the physical model's errors; `None` for those that are zero.
    pub fn of(error: &ModelError) -> Self {
        Self {
            bounces: db(error.bounces),
            nodes: db(error.nodes),
            edges: db(error.edges),
            far_field: db(error.far_field),
            road: db(error.road),
            between_bodies: db(error.between_bodies),
            transmission: db(error.transmission),
            small_parts: db(error.small_parts),
            shading: None,
        }
    }

    /// The parts that are left out, in the order of their names, in words, dB; not the small parts, which are
    /// added.
    pub fn sources(&self) -> [(&'static str, Option<f64>); 7] {
        [
            ("between bodies", self.between_bodies),
            ("bounces", self.bounces),
            ("edges", self.edges),
            ("far field", self.far_field),
            ("nodes", self.nodes),
            ("road", self.road),
            ("transmission", self.transmission),
        ]
    }
}

/// Converts an error's amplitude relative to the echo to dB; `None` if it was not estimated or is zero,
/// because its level would be infinitely low.
pub(crate) fn db(amplitude: Option<f64>) -> Option<f64> {
    amplitude.map(db_from_amplitude).filter(|db| db.is_finite() && *db > LOWEST_DB)
}

/// Text of a level, to a tenth of a dB; "not estimated" for `None`.
pub fn decibels(db: impl Into<Option<f64>>) -> String {
    db.into().map_or("not estimated".into(), |db| format!("{db:.1} dB").replace('-', "−"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_error_at_all_and_one_that_is_not_estimated_have_no_level() {
        assert_eq!([db(None), db(Some(0.0)), db(Some(f64::INFINITY))], [None; 3]);
        assert!((db(Some(0.1)).unwrap() + 20.0).abs() < 1e-12);
        let model = ModelError { bounces: Some(0.0), nodes: Some(0.1), ..ModelError::default() };
        let told = ModelErrorFigures::of(&model);
        assert_eq!((told.bounces, told.nodes.is_some()), (None, true));
    }
}
