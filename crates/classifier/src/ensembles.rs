//! Boosted trees over features of signatures.

pub(crate) mod trees; // inference
pub(crate) mod signature_classifier; // probabilities of signatures
pub(crate) mod boosting; // training of trees
pub(crate) mod vehicles; // samples by vehicle: weights, folds, tracks
pub(crate) mod likeness; // similarity of two sets of samples
pub(crate) mod tree_training; // rounds, temperature, correlation from held-out vehicles
