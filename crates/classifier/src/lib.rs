//! Vehicle classes from range-Doppler crops by a convolutional network.
//!
//! A crop goes in: 24 m x 8 m/s around a detected object, 451 x 451 grey levels in fixed decibel limits
//! ([`artifact::dataset::CropFormat`]). Four probabilities come out, in the order of [`artifact::settings::Class::ALL`].
//! The network is the paper's (three blocks of convolution, batch normalization, rectifier and maximum, then a fully
//! connected layer); it learns from a dataset split by scene, keeps the epoch that validates best, and is calibrated so
//! that its probabilities are what they say. It sees levels only: neither range, nor lane, nor truth.
//!
//! Reading order: crop → [`split`](split_of_scene) → pooling → network → training → metrics → model folder.
//!
//! ```
//! use artifact::dataset::{Crop, CropFormat, Sample, Split};
//! use artifact::settings::Class;
//! use classifier::{Augmentation, Classifier, Schedule, TrainSettings, train};
//!
//! let format = CropFormat { side: 16, range_span_m: 24.0, velocity_span_mps: 8.0, floor_db: 0.0, ceiling_db: 50.0 };
//! // Four bright rows at a height that tells the class: as easy as it gets.
//! let pixels = |n: u64| (0..256_u64).map(|p| if p / 64 == n % 4 { 220 } else { p as u8 % 50 + n as u8 }).collect();
//! let sample = |n: u64| Sample {
//!     id: n.to_string(),
//!     crop: Crop { pixels: pixels(n), range_m: 40.0, radial_velocity_mps: 0.0 },
//!     class: Some(Class::ALL[n as usize % 4]),
//!     model: "plain".into(),
//!     scene: n,
//!     split: if n < 32 { Split::Train } else { Split::Validation },
//!     range_m: 40.0,
//!     radial_velocity_mps: 0.0,
//!     lane: Some(2),
//!     seed: n,
//! };
//! let settings = TrainSettings {
//!     input_side: 16,
//!     channels: [4, 8, 16],
//!     batch: 16,
//!     iterations: 40,
//!     learning_rate: 0.02,
//!     schedule: Schedule::Constant,
//!     weight_decay: 0.0,
//!     augmentation: Augmentation::NONE,
//! };
//! let trained = train((0..64).map(|n| Ok(sample(n))), &format, &settings, 1, &mut |_| ())?;
//! let classifier = Classifier::from_model(&trained.header, &trained.weights)?;
//! let probabilities = classifier.probabilities(&[sample(66).crop])?;
//! assert!(probabilities[0][2] > 0.5, "{probabilities:?}"); // a truck
//! # Ok::<(), classifier::ClassifierError>(())
//! ```

mod error;
mod split; // which scenes train, validate, test
mod pooling; // 451 x 451 averaged to the network's input
mod layout; // the network's shape, told by a model's header
mod parameters; // its numbers: drawn, read, written
mod network; // the network itself
mod samples; // a dataset at the network's resolution
mod augmentation; // variation of training crops
mod order; // in which they are taken
mod training; // Adam, best epoch
mod temperature; // calibration
mod metrics; // accuracy, confusion, log loss, reliability
mod classify; // probabilities of crops
mod model_folder; // weights, metrics and curves on disk

pub use augmentation::Augmentation;
pub use classify::Classifier;
pub use error::ClassifierError;
pub use layout::{ARCHITECTURE, CHANNELS};
pub use metrics::{Calibration, Evaluation, Metrics, ModelAccuracy, ReliabilityBin};
pub use model_folder::{CURVES_FILE, METRICS_FILE, MODEL_FILES, WEIGHTS_FILE, load_model, save_model};
pub use split::split_of_scene;
pub use training::{CurvePoint, Progress, Schedule, TrainSettings, Trained, evaluate, train};
