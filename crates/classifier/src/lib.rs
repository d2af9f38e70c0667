//! Vehicle classes: from an object's signature by networks along range or by boosted decision trees, and from
//! its crop of the range-Doppler map by the paper's convolutional network.
//!
//! The input is a signature ([`artifact::signature::Signature`]: level, cross section, place across and
//! height of each range cell). Small one-dimensional networks take its cells as they are
//! ([`train_networks`]); or some ninety features of it ([`features()`]) go into trees ([`train_trees`]). The
//! four probabilities of either are calibrated on held-out vehicles ([`SignatureClassifier`]). The paper's
//! network is kept for the paper's protocol ([`Classifier`]): three blocks of convolution, batch
//! normalization, rectifier and maximum, then a fully connected layer, over 24 m x 8 m/s around the object in
//! grey levels. None uses lane or truth. This crate runs all three and trains the first two; the paper's
//! network is trained by the crate `classifier-training`, which needs a learning library that this crate
//! avoids.
//!
//! Probabilities are in the order of [`artifact::settings::Class::ALL`]. Read the rooms below in their order;
//! each uses only those before it.
//!
//! ```no_run
//! use artifact::signature::Signature;
//! use classifier::SignatureClassifier;
//! use std::path::Path;
//!
//! let classifier = SignatureClassifier::open(Path::new("fixtures/classifier.model"))?;
//! let [car, bus, truck, motorcycle] = classifier.probabilities(&Signature::default());
//! # let _ = (car, bus, truck, motorcycle);
//! # Ok::<(), classifier::ClassifierError>(())
//! ```

mod error; // faults of a crop, a model or a dataset
mod signatures; // features of a signature
mod crops; // the paper's network over crops of maps
mod evaluation; // metrics of answers
mod networks; // networks over range cells of signatures
mod ensembles; // trees and networks over signatures, trained on sightings

pub use crops::classify::Classifier;
pub use crops::layout::{ARCHITECTURE, CHANNELS, Layout};
pub use crops::model_folder::{
    CURVES_FILE, METRICS_FILE, MODEL_FILES, NETWORK_CURVE_COLUMNS, WEIGHTS_FILE, load_model, model_of_bytes,
};
pub use crops::network::{Logits, VARIANCE_FLOOR};
pub use crops::parameters::{Parameters, Values};
pub use crops::samples::{Example, Examples, format_of, samples_of};
pub use crops::tensor_name;
pub use ensembles::boosting::{BoostingSettings, TrainingTable, boosted};
pub use ensembles::combined_training::{CombinedSettings, train_combined};
pub use ensembles::feature_similarity::{area_under_roc, feature_similarity};
pub use ensembles::profile_training::{ProfileSettings, train_networks};
pub use ensembles::signature_classifier::{SignatureClassifier, answer};
pub use ensembles::signature_training::SignatureTraining;
pub use ensembles::track_metrics::{
    ClassificationMetrics, metrics_by_frame_and_track, track_evidence, track_logits,
};
pub use ensembles::trained_model::{SignatureMetrics, TrainedModel};
pub use ensembles::tree_training::{TreeSettings, train_trees};
pub use ensembles::trees::logits as tree_logits;
pub use ensembles::vehicles::{Sighting, Sightings, TrackKey};
pub use error::ClassifierError;
pub use evaluation::by_vehicle::{ByVehicle, ClassPrediction, by_vehicle};
pub use evaluation::evaluate::{evaluate, evaluations};
pub use evaluation::metrics::{
    Calibration, Evaluation, ModelAccuracy, ReliabilityBin, accuracy, log_loss, log_softmax,
};
pub use evaluation::split::split_of_scene;
pub use evaluation::temperature::fitted_temperature;
pub use networks::network_training::NetworkSettings;
pub use signatures::feature::Features;
pub use signatures::features::{features, names as feature_names};
