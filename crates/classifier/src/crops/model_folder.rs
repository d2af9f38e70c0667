//! A model on disk: `weights.model` (the artifact), `metrics.json` and `curves.csv`.

use crate::crops::classify::Classifier;
use crate::error::ClassifierError;
use artifact::Reader;
use artifact::model::{Model, ModelHeader, Weights};
use std::path::{Path, PathBuf};

/// Name of the artifact in a model folder.
pub const WEIGHTS_FILE: &str = "weights.model";
/// Name of the evaluation in a model folder.
pub const METRICS_FILE: &str = "metrics.json";
/// Name of the training curves in a model folder.
pub const CURVES_FILE: &str = "curves.csv";
/// Columns of the training curves of the paper's network.
pub const NETWORK_CURVE_COLUMNS: &str =
    "iteration,learning_rate,train_log_loss,train_accuracy,validation_log_loss,validation_accuracy";

/// Names of all files of a model folder, in the order of their writing.
pub const MODEL_FILES: [&str; 3] = [METRICS_FILE, CURVES_FILE, WEIGHTS_FILE];

/// Reads a model from its folder or from the artifact itself.
pub fn load_model(folder_or_file: &Path) -> Result<(ModelHeader, Weights), ClassifierError> {
    only_weights(Reader::open(&weights_file(folder_or_file))?)
}

/// Reads a model from the bytes of its artifact, such as one embedded in a program.
pub fn model_of_bytes(bytes: &'static [u8]) -> Result<(ModelHeader, Weights), ClassifierError> {
    only_weights(Reader::of_bytes("the model of this program", bytes)?)
}

fn only_weights(mut reader: Reader<Model>) -> Result<(ModelHeader, Weights), ClassifierError> {
    let found = reader.frames();
    match reader.next_frame()? {
        Some(weights) if found == 1 => Ok((reader.header().clone(), weights)),
        _ => Err(ClassifierError::WeightSets { found }),
    }
}

impl Classifier {
    /// [`load_model`], ready to classify.
    pub fn open(folder_or_file: &Path) -> Result<Self, ClassifierError> {
        let (header, weights) = load_model(folder_or_file)?;
        Self::from_model(&header, &weights)
    }
}

fn weights_file(folder_or_file: &Path) -> PathBuf {
    if folder_or_file.is_dir() { folder_or_file.join(WEIGHTS_FILE) } else { folder_or_file.to_owned() }
}
