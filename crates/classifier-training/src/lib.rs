//! Training of the classifier's network.
//!
//! It learns from a dataset split by scene, keeps the epoch that validates best, and is calibrated so that
//! its probabilities are what they say. The weights go to the crate `classifier`, which answers without the
//! learning library that is needed here: a main job does not build it.
//!
//! Reading order: variation of crops → batches → network → training → temperature → model folder.
//!
//! ```
//! use artifact::dataset::{Crop, CropFormat, Sample, Split};
//! use artifact::settings::Class;
//! use artifact::signature::Signature;
//! use classifier::Classifier;
//! use classifier_training::{Augmentation, Schedule, TrainSettings, train};
//!
//! let format = CropFormat {
//!     side: 16,
//!     range_span_m: 24.0,
//!     velocity_span_mps: 8.0,
//!     floor_db: 0.0,
//!     ceiling_db: 50.0,
//! };
//! // Four bright rows at a height that tells the class: as easy as it gets.
//! let pixel = |n: u64, p: u64| if p / 64 == n % 4 { 220 } else { p as u8 % 50 + n as u8 };
//! let pixels = |n: u64| (0..256).map(|p| pixel(n, p)).collect();
//! let sample = |n: u64| Sample {
//!     id: n.to_string(),
//!     signature: Signature::default(),
//!     crop: Some(Crop { pixels: pixels(n), range_m: 40.0, radial_velocity_mps: 0.0 }),
//!     class: Some(Class::ALL[n as usize % 4]),
//!     model: "plain".into(),
//!     variant: 0,
//!     scene: n,
//!     target: 0,
//!     frame: 0,
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
//! let crop = Crop { pixels: pixels(66), range_m: 40.0, radial_velocity_mps: 0.0 };
//! let probabilities = classifier.probabilities(&[crop])?;
//! assert!(probabilities[0][2] > 0.5, "{probabilities:?}"); // a truck
//! # Ok::<(), classifier_training::TrainingError>(())
//! ```

mod error;
mod initial; // weights before the first crop
mod network; // the network in the learning library's terms
mod augmentation; // variation of training crops
mod split_protocol; // who trains and who tests, by the paper and beside it
mod batch_sampler; // batches of shuffled examples
mod metrics; // what is told of a training
mod training; // Adam, best epoch
mod model_folder; // weights, metrics and curves to disk

pub use augmentation::Augmentation;
pub use error::TrainingError;
pub use metrics::Metrics;
pub use model_folder::save_model;
pub use split_protocol::{COPIES, SplitProtocol};
pub use training::{CurvePoint, Progress, Schedule, TrainSettings, Trained, train, train_with_protocol};
