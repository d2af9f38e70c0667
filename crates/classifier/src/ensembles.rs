//! Boosted trees and networks over signatures, and their training on sightings of vehicles.

pub(crate) mod trees; // inference of trees
pub(crate) mod vehicles; // samples by vehicle: inputs, weights, folds, tracks
pub(crate) mod signature_classifier; // probabilities of signatures
pub(crate) mod boosting; // training of trees
pub(crate) mod feature_similarity; // similarity of two sets of samples
pub(crate) mod track_metrics; // answers by frame and by track
pub(crate) mod cross_validation; // answers for vehicles held out in turn
pub(crate) mod trained_model; // temperature, correlation, metrics
pub(crate) mod tree_training; // boosted trees
pub(crate) mod profile_training; // networks over range cells
pub(crate) mod combined_training; // both, averaged
pub(crate) mod signature_training; // any of them
