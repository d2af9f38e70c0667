//! Accuracy below which a finer one has no use: the largest error of the method and the mesh, which no
//! `accuracy_db` reduces.

use artifact::accuracy::ModelError;
use artifact::{Accuracy, ErrorBudget};

/// The largest error that is independent of the requested accuracy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UsefulAccuracy {
    /// Name of the error, in words.
    pub(crate) name: &'static str,
    /// Relative amplitude error.
    pub(crate) amplitude: f64,
}

impl UsefulAccuracy {
    /// Finds the largest of the errors of the method and the mesh; `None` if none of them was estimated.
    ///
    /// Errors from parts of the physics that a scene's key omits (edges, road, paths between bodies,
    /// transmission) do not count: they describe the difference to another scene, and that of the road
    /// exceeds the echo of a motorcycle. Small parts drawn at random count: theirs is one of many possible
    /// echoes. Facets of a curved skin are refined to the requested accuracy, so their share counts only if
    /// it is larger: then the mesh allows no better.
    pub(crate) fn of(asked: Accuracy, error: &ErrorBudget, model: &ModelError) -> Option<Self> {
        let mesh = error.tessellation.filter(|amplitude| *amplitude > asked.amplitude());
        let all = [
            ("nodes", model.nodes),
            ("bounces", model.bounces),
            ("far field", model.far_field),
            ("small parts", model.small_parts),
            ("tessellation of the mesh", mesh),
        ];
        let known =
            all.into_iter().filter_map(|(name, amplitude)| Some(Self { name, amplitude: amplitude? }));
        let known = known.filter(|error| error.amplitude.is_finite() && error.amplitude > 0.0);
        known.max_by(|a, b| a.amplitude.total_cmp(&b.amplitude))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ASKED_DB: f64 = -20.0;

    fn found(error: ErrorBudget, model: ModelError) -> Option<UsefulAccuracy> {
        UsefulAccuracy::of(Accuracy::from_db(ASKED_DB), &error, &model)
    }

    #[test]
    fn the_largest_error_of_the_method_is_found_and_named() {
        let model = ModelError { nodes: Some(0.3), bounces: Some(0.01), ..ModelError::default() };
        let largest = UsefulAccuracy { name: "nodes", amplitude: 0.3 };
        assert_eq!(found(ErrorBudget::default(), model), Some(largest));
        let table = ModelError { far_field: Some(0.4), ..model };
        assert_eq!(found(ErrorBudget::default(), table).map(|error| error.name), Some("far field"));
        let drawn = ModelError { small_parts: Some(1.5), ..table };
        assert_eq!(found(ErrorBudget::default(), drawn).map(|error| error.name), Some("small parts"));
        assert_eq!(found(ErrorBudget::default(), ModelError::default()), None);
    }

    #[test]
    fn what_the_scene_leaves_out_is_no_error_of_the_method() {
        let model = ModelError { road: Some(3.0), between_bodies: Some(0.5), ..ModelError::default() };
        assert_eq!(found(ErrorBudget::default(), model), None);
    }

    #[test]
    fn facets_count_where_they_are_worse_than_asked_and_integrals_never() {
        let integrals = ErrorBudget { integration: Some(0.9), ..ErrorBudget::default() };
        assert_eq!(found(integrals, ModelError::default()), None);
        let facets = |amplitude| ErrorBudget { tessellation: Some(amplitude), ..integrals };
        assert_eq!(found(facets(0.09), ModelError::default()), None, "as good as asked");
        let name = found(facets(0.11), ModelError::default()).map(|error| error.name);
        assert_eq!(name, Some("tessellation of the mesh"));
    }
}
