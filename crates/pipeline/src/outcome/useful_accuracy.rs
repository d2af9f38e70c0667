//! Accuracy beyond which a finer one buys nothing: the largest error of the method and the mesh, which no
//! `accuracy_db` makes smaller.

use artifact::accuracy::ModelError;
use artifact::{Accuracy, ErrorBudget};

/// The largest error that stays whatever accuracy is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OfUse {
    /// Name of the error, in words.
    pub(crate) name: &'static str,
    /// Relative amplitude error.
    pub(crate) amplitude: f64,
}

impl OfUse {
    /// Finds it among the errors of the method and the mesh; `None` where nothing of it was estimated.
    ///
    /// What a key of the scene leaves out (edges, road, ways between bodies, transmission) is no such error:
    /// it says of another scene what this one is not, and is larger than the echo of a motorcycle where it is
    /// the road. Facets in place of a curved skin are cut until they are as good as asked. So their share
    /// counts only where it is larger: then the mesh gives no more.
    pub(crate) fn of(asked: Accuracy, error: &ErrorBudget, model: &ModelError) -> Option<Self> {
        let mesh = error.tessellation.filter(|amplitude| *amplitude > asked.amplitude());
        let all = [
            ("nodes", model.nodes),
            ("bounces", model.bounces),
            ("far field", model.far_field),
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

    fn found(error: ErrorBudget, model: ModelError) -> Option<OfUse> {
        OfUse::of(Accuracy::from_db(ASKED_DB), &error, &model)
    }

    #[test]
    fn the_largest_error_of_the_method_is_found_and_named() {
        let model = ModelError { nodes: Some(0.3), bounces: Some(0.01), ..ModelError::default() };
        let largest = OfUse { name: "nodes", amplitude: 0.3 };
        assert_eq!(found(ErrorBudget::default(), model), Some(largest));
        let table = ModelError { far_field: Some(0.4), ..model };
        assert_eq!(found(ErrorBudget::default(), table).map(|error| error.name), Some("far field"));
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
