//! Vehicle classes from range-Doppler crops by a convolutional network.
//!
//! A crop goes in: 24 m x 8 m/s around a detected object, 451 x 451 grey levels in fixed decibel limits
//! ([`artifact::dataset::CropFormat`]). Four probabilities come out, in the order of
//! [`artifact::settings::Class::ALL`]. The network is the paper's (three blocks of convolution, batch
//! normalization, rectifier and maximum, then a fully connected layer). It sees levels only: neither range,
//! nor lane, nor truth. Here it answers; the crate `classifier-training` makes its weights, and needs a
//! learning library for that which this one does without.
//!
//! Reading order is that of the rooms below; each uses only those that stand before it. Of crops: pooling →
//! network → probabilities → evaluation.
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

mod error; // what can be wrong with a crop, a model or a dataset
mod signatures; // what of them tells the class
mod crops; // the network over them
mod evaluation; // how good answers are
mod ensembles; // boosted trees over features of signatures

pub use crops::classify::Classifier;
pub use crops::layout::{ARCHITECTURE, CHANNELS, Layout};
pub use crops::model_folder::{
    CURVES_FILE, METRICS_FILE, MODEL_FILES, WEIGHTS_FILE, load_model, model_of_bytes,
};
pub use crops::network::{Logits, VARIANCE_FLOOR};
pub use crops::parameters::{Parameters, Values};
pub use crops::samples::{Example, Examples, format_of, samples_of};
pub use crops::tensor_name;
pub use ensembles::boosting::{BoostingSettings, Table, boosted};
pub use ensembles::likeness::{area_under_roc, likeness};
pub use ensembles::signature_classifier::SignatureClassifier;
pub use ensembles::tree_training::{Part, TrainedTrees, TreeMetrics, TreeSettings, parts, train_trees};
pub use ensembles::trees::logits as tree_logits;
pub use ensembles::vehicles::{Seen, Sightings, TrackKey};
pub use error::ClassifierError;
pub use evaluation::by_vehicle::{ByVehicle, Told, by_vehicle};
pub use evaluation::evaluate::{evaluate, evaluations};
pub use evaluation::metrics::{
    Calibration, Evaluation, ModelAccuracy, ReliabilityBin, accuracy, log_loss, log_softmax,
};
pub use evaluation::split::split_of_scene;
pub use evaluation::temperature::fitted_temperature;
pub use signatures::feature::Features;
pub use signatures::features::{features, names as feature_names};
