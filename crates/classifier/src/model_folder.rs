//! A model on disk: `weights.model` (the artifact), `metrics.json` and `curves.csv`.

use crate::{Classifier, ClassifierError, CurvePoint, Trained};
use artifact::model::{Model, ModelHeader, Weights};
use artifact::whole_file::{self, Durability};
use artifact::{Provenance, Reader, Writer};
use std::path::{Path, PathBuf};

/// Name of the artifact in a model folder.
pub const WEIGHTS_FILE: &str = "weights.model";
/// Name of the evaluation in a model folder.
pub const METRICS_FILE: &str = "metrics.json";
/// Name of the training curves in a model folder.
pub const CURVES_FILE: &str = "curves.csv";

/// All files of a model folder.
pub const MODEL_FILES: [&str; 3] = [METRICS_FILE, CURVES_FILE, WEIGHTS_FILE];

/// Writes a model folder; each file is whole or not there, and the weights come last: where they are, all is.
pub fn save_model(folder: &Path, trained: &Trained, provenance: &Provenance) -> Result<(), ClassifierError> {
    let mut metrics = serde_json::to_vec_pretty(&trained.metrics)
        .map_err(|e| ClassifierError::Library { doing: "write the metrics as JSON", cause: e.into() })?;
    metrics.push(b'\n');
    whole_file::write(&folder.join(METRICS_FILE), &metrics, Durability::OnDisk)?;
    let curves = curves_csv(&trained.curves);
    whole_file::write(&folder.join(CURVES_FILE), curves.as_bytes(), Durability::OnDisk)?;
    let mut writer = Writer::<Model>::create(&folder.join(WEIGHTS_FILE), provenance, &trained.header)?;
    writer.write(&trained.weights)?;
    Ok(writer.finish()?)
}

/// Reads a model from its folder or from the artifact itself.
pub fn load_model(folder_or_file: &Path) -> Result<(ModelHeader, Weights), ClassifierError> {
    let mut reader = Reader::<Model>::open(&weights_file(folder_or_file))?;
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

fn curves_csv(curves: &[CurvePoint]) -> String {
    let header = "iteration,learning_rate,train_log_loss,train_accuracy,validation_log_loss,validation_accuracy\n";
    let line = |p: &CurvePoint| {
        let CurvePoint { iteration, learning_rate, train_log_loss, train_accuracy, .. } = p;
        let CurvePoint { validation_log_loss, validation_accuracy, .. } = p;
        format!(
            "{iteration},{learning_rate:.6},{train_log_loss:.6},{train_accuracy:.6},{validation_log_loss:.6},{validation_accuracy:.6}\n"
        )
    };
    std::iter::once(header.to_owned()).chain(curves.iter().map(line)).collect()
}
