//! Results of the whole chain by requested accuracy: cost, detections, distance from the truth, and the
//! probability of the true class.

use crate::study::chart::cost::{Measured, measured};
use crate::study::chart::scenes::Scene;
use crate::study::extent::Extent;
use serde::{Deserialize, Serialize};
use std::path::Path;
use wayside::host::failure::Failure;
use wayside::outcome::summary::TargetSummary;
use wayside::{SceneSource, Settings, Summary};

/// Results of one scene at one accuracy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::study) struct ChainResult {
    pub(super) scene: String,
    pub(super) asked_db: f64,
    /// Processor seconds of the frame including its pictures.
    pub(super) processor_s: f64,
    pub(super) peak_mib: Option<f64>,
    /// Number of detected bodies, and of those that the radar can see.
    pub(super) found: usize,
    pub(super) to_be_found: usize,
    /// Root mean square errors of the detections: range, radial velocity, place across the road.
    pub(super) errors: Option<[f64; 3]>,
    /// Mean probability of the true class over the detected vehicles.
    pub(super) probability: Option<f64>,
}

/// Accuracies for a quick chart.
const QUICK_DB: [f64; 1] = [-10.0];
const ASKED_DB: [f64; 5] = [-5.0, -10.0, -15.0, -20.0, -25.0];

/// Results of a scene at every accuracy; none if a third-party file is missing.
pub(super) fn rows(scene: &Scene, folder: &Path, extent: Extent) -> Result<Vec<ChainResult>, Failure> {
    let Some(targets) = scene.targets(folder) else { return Ok(vec![]) };
    let asked = match extent {
        Extent::Quick => &QUICK_DB[..],
        Extent::Full => &ASKED_DB[..],
    };
    asked.iter().map(|asked_db| answers(scene.name, &targets, *asked_db, folder)).collect()
}

fn answers(scene: &str, targets: &str, asked_db: f64, folder: &Path) -> Result<ChainResult, Failure> {
    let (file, out) = (folder.join("scene.toml"), folder.join("out"));
    let text = format!(
        "name = \"chart\"\n[noise]\nnoise_figure_db = 12.0\n{targets}[fidelity]\naccuracy_db = {asked_db}\n"
    );
    std::fs::write(&file, text).map_err(|e| Failure::system(&file, "write", e))?;
    let source = SceneSource { file: file.clone(), ..SceneSource::default() };
    let settings = Settings { scene: source, cache: None, ..Settings::of(&file, &out) };
    let Measured { cost, .. } = measured(|| wayside::run(&settings).map(drop))?;
    let summary = Summary::read(&out.join("summary.json"))?;
    let targets = || summary.frames.iter().flat_map(|frame| &frame.targets).filter(|t| t.found.is_some());
    let probabilities: Vec<f64> = targets()
        .filter(|target| target.estimate.is_some())
        .filter_map(|target| target.probabilities.of_class(target.class?))
        .collect();
    Ok(ChainResult {
        scene: scene.into(),
        asked_db,
        processor_s: summary.frames_processor_seconds.unwrap_or(summary.frames_seconds),
        peak_mib: cost.peak_mib,
        found: targets().filter(|target| target.found == Some(true)).count(),
        to_be_found: targets().count(),
        errors: root_mean_squares(&targets().filter_map(error).collect::<Vec<_>>()),
        probability: mean(&probabilities),
    })
}

/// Estimate minus truth: range, radial velocity, place across the road.
fn error(target: &TargetSummary) -> Option<[f64; 3]> {
    let (estimate, truth) = (target.estimate?, &target.truth);
    Some([
        estimate.range_m - truth.compared_range_m(),
        estimate.radial_velocity_mps - truth.compared_radial_velocity_mps(),
        estimate.x_m - truth.x_m,
    ])
}

fn root_mean_squares(errors: &[[f64; 3]]) -> Option<[f64; 3]> {
    let of = |i: usize| mean(&errors.iter().map(|error| error[i].powi(2)).collect::<Vec<_>>());
    Some([of(0)?.sqrt(), of(1)?.sqrt(), of(2)?.sqrt()])
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_root_mean_squares_over_what_was_found() {
        assert_eq!(root_mean_squares(&[[3.0, 0.0, 1.0], [-3.0, 0.0, -1.0]]), Some([3.0, 0.0, 1.0]));
        assert_eq!(root_mean_squares(&[]), None);
    }
}
