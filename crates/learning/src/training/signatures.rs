//! Models of signatures from datasets: `weights.model`, `metrics.json`, `curves.csv`.

use crate::training::interval_text::interval_text;
use crate::training::lone_vehicles::note_lone_vehicles;
use crate::training::settings::TrainingSettings;
use artifact::model::Model;
use artifact::{Provenance, Writer, bounded};
use classifier::{
    CURVES_FILE, ClassificationMetrics, METRICS_FILE, Sightings, SignatureTraining, TrainedModel,
    WEIGHTS_FILE,
};
use pipeline::chain::loaded_model::{classifier_failure, classifier_failure_about};
use pipeline::chain::loading;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress::Work;
use std::fmt::Write;
use std::path::PathBuf;

/// Largest file of attributions, a page of text.
const ATTRIBUTIONS_LIMIT_BYTES: u64 = 1 << 20;

/// Reads all shards, trains, writes the folder and reports the metrics.
pub(super) fn train(
    settings: &TrainingSettings,
    training: &SignatureTraining,
    datasets: &[Vec<PathBuf>],
) -> Result<(), Failure> {
    let attributions = attributions(settings)?;
    let (sightings, inputs) = loading::read_hashed(&datasets.concat(), || sightings(datasets))?;
    let work = Work::begin("training");
    let trained = training.train(&sightings, settings.seed, &mut |at, of| work.at(at, of));
    let mut trained = trained.map_err(classifier_failure)?;
    drop(work);
    note_lone_vehicles(&sightings);
    trained.header.attributions = attributions;
    save(settings, training, &trained, &provenance(settings, training, inputs)?)?;
    result_lines(&trained).iter().for_each(|line| (settings.tell)(line));
    Ok(())
}

fn sightings(datasets: &[Vec<PathBuf>]) -> Result<Sightings, Failure> {
    let mut sightings = Sightings::default();
    for (number, shards) in datasets.iter().enumerate() {
        for shard in shards {
            let added = sightings.add(number, classifier::samples_of(shard));
            added.map_err(classifier_failure_about(shard))?;
        }
    }
    Ok(sightings)
}

fn attributions(settings: &TrainingSettings) -> Result<Vec<String>, Failure> {
    let Some(file) = &settings.attributions else { return Ok(vec![]) };
    let text =
        bounded::read_text(file, ATTRIBUTIONS_LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
    Ok(text.lines().map(str::trim).filter(|line| !line.is_empty()).map(str::to_owned).collect())
}

fn provenance(
    settings: &TrainingSettings,
    training: &SignatureTraining,
    inputs: Vec<(String, String)>,
) -> Result<Provenance, Failure> {
    Ok(Provenance {
        stage: "classifier".into(),
        program_version: env!("CARGO_PKG_VERSION").into(),
        inputs,
        settings: serde_json::to_string(training).map_err(Failure::refused)?,
        seed: settings.seed,
    })
}

/// Writes the folder; the weights come last, so that they mark a complete one.
fn save(
    settings: &TrainingSettings,
    training: &SignatureTraining,
    trained: &TrainedModel,
    provenance: &Provenance,
) -> Result<(), Failure> {
    let mut metrics = serde_json::to_vec_pretty(&trained.metrics).map_err(Failure::refused)?;
    metrics.push(b'\n');
    files::write_file(&settings.out.join(METRICS_FILE), &metrics)?;
    let rounds = match training {
        SignatureTraining::Trees(_) => "trees",
        SignatureTraining::Profile(_) => "epochs",
        SignatureTraining::Both(_) => "trainings",
    };
    let mut curve = format!("{rounds},log_loss_on_unseen_vehicles\n");
    for (round, loss) in trained.curve.iter().enumerate() {
        let _ = writeln!(curve, "{},{loss:.6}", round + 1);
    }
    files::write_file(&settings.out.join(CURVES_FILE), curve.as_bytes())?;
    let mut writer = Writer::<Model>::create(&settings.out.join(WEIGHTS_FILE), provenance, &trained.header)?;
    writer.write(&trained.weights)?;
    Ok(writer.finish()?)
}

fn result_lines(trained: &TrainedModel) -> Vec<String> {
    let m = &trained.metrics;
    let line = |name: &str, part: &ClassificationMetrics| {
        let interval = interval_text(part.by_vehicle.interval);
        let (right, ece) =
            (100.0 * part.by_vehicle.mean_over_classes, 100.0 * part.evaluation.calibration.expected_error);
        let (of, vehicles) = (part.by_vehicle.answers, part.by_vehicle.vehicles);
        format!(
            "{name:<32} {right:.1} % right, mean over classes ({interval} over {vehicles} vehicles), {of} answers, calibration error {ece:.1} %"
        )
    };
    let mut lines = vec![
        line("vehicles held out, by frame", &m.unseen_vehicles),
        line("vehicles held out, by track", &m.unseen_vehicles_by_track),
    ];
    lines.extend(m.unseen_scenes.as_ref().map(|part| line("test scenes, by frame", part)));
    lines.extend(m.unseen_scenes_by_track.as_ref().map(|part| line("test scenes, by track", part)));
    lines
}
