//! Vehicle classes from range-Doppler crops by a convolutional network.
//!
//! A crop goes in: 24 m x 8 m/s around a detected object, 451 x 451 grey levels in fixed decibel limits
//! ([`artifact::dataset::CropFormat`]). Four probabilities come out, in the order of [`artifact::settings::Class::ALL`].
//! The network is the paper's (three blocks of convolution, batch normalization, rectifier and maximum, then a fully
//! connected layer). It sees levels only: neither range, nor lane, nor truth. Here it answers; the crate `classifier-training`
//! makes its weights, and needs a learning library for that which this one does without.
//!
//! Reading order: crop → pooling → network → probabilities → evaluation.
//!
//! ```no_run
//! use artifact::dataset::Crop;
//! use classifier::Classifier;
//! use std::path::Path;
//!
//! let classifier = Classifier::open(Path::new("fixtures/classifier.model"))?;
//! let side = classifier.layout().crop_side;
//! let black = Crop { pixels: vec![0; side * side], range_m: 40.0, radial_velocity_mps: 0.0 };
//! let [car, bus, truck, motorcycle] = classifier.probabilities(&[black])?[0];
//! # let _ = (car, bus, truck, motorcycle);
//! # Ok::<(), classifier::ClassifierError>(())
//! ```

mod error;
mod profile; // the visible cells of a signature
mod feature; // names and numbers
mod bands; // heights and widths along it
mod peaks; // its strongest places
mod features; // what of them tells the class
mod split; // which scenes train, validate, test
mod pooling; // 451 x 451 averaged to the network's input
mod layout; // the network's shape, told by a model's header
mod parameters; // its numbers: read, written
mod network; // the network itself
mod classify; // probabilities of crops
mod temperature; // calibration
mod trees; // boosted trees that answer
mod signature_classifier; // probabilities of signatures
mod boosting; // how trees learn
mod vehicles; // samples by vehicle: weights, folds, tracks
mod likeness; // of two sets of samples
mod by_vehicle; // accuracy with its spread over vehicles
mod tree_training; // unseen vehicles choose rounds, temperature, correlation
mod samples; // a dataset at the network's resolution
mod metrics; // accuracy, confusion, log loss, reliability
mod evaluate; // of a dataset
mod model_folder; // weights, metrics and curves on disk

pub use boosting::{BoostingSettings, Table, boosted};
pub use by_vehicle::{ByVehicle, Told, by_vehicle};
pub use classify::Classifier;
pub use error::ClassifierError;
pub use evaluate::{evaluate, evaluations};
pub use feature::Features;
pub use features::{features, names as feature_names};
pub use layout::{ARCHITECTURE, CHANNELS, Layout};
pub use likeness::{area_under_roc, likeness};
pub use metrics::{Calibration, Evaluation, ModelAccuracy, ReliabilityBin, accuracy, log_loss, log_softmax};
pub use model_folder::{CURVES_FILE, METRICS_FILE, MODEL_FILES, WEIGHTS_FILE, load_model, model_of_bytes};
pub use network::{Logits, VARIANCE_FLOOR};
pub use parameters::{Parameters, Values, tensor_name};
pub use samples::{Example, Examples, format_of, samples_of};
pub use signature_classifier::SignatureClassifier;
pub use split::split_of_scene;
pub use temperature::fitted_temperature;
pub use tree_training::{Part, TrainedTrees, TreeMetrics, TreeSettings, parts, train_trees};
pub use trees::logits as tree_logits;
pub use vehicles::{Seen, Sightings, TrackKey};
