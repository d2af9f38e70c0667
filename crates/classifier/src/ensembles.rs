//! Boosted trees over features of signatures.

pub(crate) mod trees; // that answer
pub(crate) mod signature_classifier; // probabilities of signatures
pub(crate) mod boosting; // how trees learn
pub(crate) mod vehicles; // samples by vehicle: weights, folds, tracks
pub(crate) mod likeness; // of two sets of samples
pub(crate) mod tree_training; // unseen vehicles choose rounds, temperature, correlation
