//! A trained model to disk: `weights.model` (the artifact), `metrics.json` and `curves.csv`.

use crate::error::TrainingError;
use crate::training::{CurvePoint, Trained};
use artifact::atomic_file::{self, Durability};
use artifact::model::Model;
use artifact::{ArtifactError, Fault, Provenance, Writer};
use classifier::{CURVES_FILE, METRICS_FILE, MODEL_FILES, NETWORK_CURVE_COLUMNS, WEIGHTS_FILE};
use std::path::Path;

/// Writes a model folder; each file is whole or not there, and the weights come last: where they are, all is.
/// Those of an earlier training are removed first: beside the metrics of this one they would be taken for its
/// own.
pub fn save_model(folder: &Path, trained: &Trained, provenance: &Provenance) -> Result<(), TrainingError> {
    let mut metrics = serde_json::to_vec_pretty(&trained.metrics)
        .map_err(|e| TrainingError::Library { doing: "write the metrics as JSON", cause: e.into() })?;
    metrics.push(b'\n');
    MODEL_FILES.iter().rev().try_for_each(|name| remove_outdated(&folder.join(name)))?;
    atomic_file::write(&folder.join(METRICS_FILE), &metrics, Durability::OnDisk)?;
    let curves = curves_csv(&trained.curves);
    atomic_file::write(&folder.join(CURVES_FILE), curves.as_bytes(), Durability::OnDisk)?;
    let mut writer = Writer::<Model>::create(&folder.join(WEIGHTS_FILE), provenance, &trained.header)?;
    writer.write(&trained.weights)?;
    Ok(writer.finish()?)
}

/// Removes a file of an earlier training; a symbolic link stays, and its target is emptied.
fn remove_outdated(place: &Path) -> Result<(), TrainingError> {
    // The writer reports a place that cannot be replaced.
    if !place.is_file() {
        return Ok(());
    }
    atomic_file::check(place)?;
    if place.is_symlink() {
        return Ok(atomic_file::write(place, b"", Durability::OnDisk)?);
    }
    let fault = |cause| Fault::System { doing: "remove", cause };
    Ok(std::fs::remove_file(place)
        .map_err(|cause| ArtifactError { file: place.to_owned(), fault: fault(cause) })?)
}

fn curves_csv(curves: &[CurvePoint]) -> String {
    let header = format!("{NETWORK_CURVE_COLUMNS}\n");
    let line = |p: &CurvePoint| {
        let CurvePoint { iteration, learning_rate, train_log_loss, train_accuracy, .. } = p;
        let CurvePoint { validation_log_loss, validation_accuracy, .. } = p;
        format!(
            "{iteration},{learning_rate:.6},{train_log_loss:.6},{train_accuracy:.6},{validation_log_loss:.6},{validation_accuracy:.6}\n"
        )
    };
    std::iter::once(header).chain(curves.iter().map(line)).collect()
}
