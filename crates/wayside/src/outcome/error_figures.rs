//! Error budgets in decibels, as `summary.json` and the sidecar of `rcs` hold them.

use artifact::accuracy::{ErrorBudget, ModelError};
use artifact::units::db_from_amplitude;
use serde_json::{Map, Value, json};

/// Of a relative amplitude; null where it is not estimated.
pub(crate) fn db(amplitude: Option<f64>) -> Value {
    amplitude.map_or(Value::Null, |a| json!(db_from_amplitude(a)))
}

/// `{total, tessellation, integration, dropped, freezing, detail, synthesis}` in dB, null where not
/// estimated.
pub(crate) fn error_db(error: &ErrorBudget) -> Value {
    let mut map = Map::new();
    map.insert("total".into(), db(error.total()));
    map.extend(error.shares().iter().map(|(name, share)| ((*name).to_owned(), db(*share))));
    map.into()
}

/// `{bounces, nodes, edges, far_field}` in dB, null where not estimated.
pub(crate) fn model_error_db(error: &ModelError) -> Value {
    error
        .sources()
        .iter()
        .map(|(name, source)| ((*name).to_owned(), db(*source)))
        .collect::<Map<_, _>>()
        .into()
}
