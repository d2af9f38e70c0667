//! Measures that are told of a training.

use artifact::dataset::Split;
use artifact::settings::Class;
use classifier::Evaluation;
use serde::Serialize;
use std::collections::BTreeMap;

/// Content of `metrics.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Metrics {
    /// Order of rows, columns and probabilities.
    pub classes: [Class; 4],
    /// Seed of the training.
    pub seed: u64,
    /// Numbers in the weights.
    pub parameters: u64,
    /// Iteration whose weights were kept: the lowest log loss on the validation split.
    pub best_iteration: u32,
    /// Temperature that the logits were divided by (it is inside the weights).
    pub temperature: f64,
    /// Samples without a class, left out.
    pub unlabelled: u64,
    /// One for each split that has samples.
    pub splits: BTreeMap<Split, Evaluation>,
}
