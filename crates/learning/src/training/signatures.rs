//! Models of signatures from datasets: `weights.model`, `metrics.json`, `curves.csv`.

use crate::training::interval_text::interval_text;
use crate::training::lone_vehicles::note_lone_vehicles;
use crate::training::settings::TrainingSettings;
use artifact::model::Model;
use artifact::{Provenance, Writer, bounded};
use classifier::{
    CURVES_FILE, ClassificationMetrics, METRICS_FILE, MODEL_FILES, Sightings, SignatureTraining,
    TrainedModel, WEIGHTS_FILE,
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
    let provenance = provenance(settings, &training.adapted_to(&sightings), inputs)?;
    save(settings, training, &trained, &provenance)?;
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

/// Origin of a model: the training's settings as they were used.
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

/// Columns of the curves of trees, of networks over range cells, and of both.
pub(super) const CURVE_COLUMNS: [&str; 3] = [
    "trees,log_loss_on_unseen_vehicles",
    "epochs,log_loss_on_unseen_vehicles",
    "trainings,log_loss_on_unseen_vehicles",
];

/// Writes the folder; the weights come last, so that they mark a complete one. Those of an earlier training
/// are removed first: beside the metrics of this one they would be taken for its own.
fn save(
    settings: &TrainingSettings,
    training: &SignatureTraining,
    trained: &TrainedModel,
    provenance: &Provenance,
) -> Result<(), Failure> {
    let mut metrics = serde_json::to_vec_pretty(&trained.metrics).map_err(Failure::refused)?;
    metrics.push(b'\n');
    files::remove_outdated(MODEL_FILES.iter().rev().map(|name| settings.out.join(name)))?;
    files::write_file(&settings.out.join(METRICS_FILE), &metrics)?;
    let [trees, epochs, trainings] = CURVE_COLUMNS;
    let columns = match training {
        SignatureTraining::Trees(_) => trees,
        SignatureTraining::Profile(_) => epochs,
        SignatureTraining::Both(_) => trainings,
    };
    let mut curve = format!("{columns}\n");
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training::settings::Learner;
    use artifact::dataset::{Sample, Split};
    use artifact::settings::Class;
    use artifact::signature::{Signature, SignatureCell};
    use classifier::{BoostingSettings, TreeSettings};

    /// Two sightings of two vehicles of each class, as long as their class tells.
    fn seen() -> Sightings {
        let sample = |number: usize| Sample {
            id: number.to_string(),
            signature: Signature {
                range_m: 40.0 + number as f64,
                cell_m: 0.12,
                points: 1,
                cells: vec![
                    SignatureCell { level_db: 30.0, ..SignatureCell::default() };
                    10 + 20 * (number % 4)
                ],
                ..Signature::default()
            },
            crop: None,
            class: Some(Class::ALL[number % 4]),
            model: format!("{}-{}", number % 4, number / 8),
            variant: 0,
            scene: number as u64,
            target: 0,
            frame: 0,
            split: Split::Train,
            range_m: 40.0 + number as f64,
            radial_velocity_mps: 0.0,
            lane: None,
            seed: 1,
        };
        let mut seen = Sightings::default();
        seen.add(0, (0..16).map(|number| Ok(sample(number)))).unwrap();
        seen
    }

    fn settings(out: PathBuf) -> TrainingSettings<'static> {
        TrainingSettings {
            datasets: vec![],
            out,
            learner: Learner::Trees,
            seed: 1,
            iterations: None,
            attributions: None,
            tell: &|_| (),
        }
    }

    fn training() -> SignatureTraining {
        let trees = TreeSettings::default();
        let boosting = BoostingSettings { rounds: 2, ..trees.boosting };
        SignatureTraining::Trees(TreeSettings { boosting, folds: 2, ..trees })
    }

    #[test]
    fn a_training_that_ends_before_its_weights_leaves_none_of_an_earlier_one() {
        let folder = tempfile::tempdir().unwrap();
        let (settings, training) = (settings(folder.path().to_owned()), training());
        let trained = training.train(&seen(), 1, &mut |_, _| ()).unwrap();
        let weights = folder.path().join(WEIGHTS_FILE);
        std::fs::write(&weights, "of an earlier training").unwrap();
        // The curves, which are written between metrics and weights, have no place.
        std::fs::create_dir(folder.path().join(CURVES_FILE)).unwrap();
        assert!(save(&settings, &training, &trained, &Provenance::default()).is_err());
        assert!(folder.path().join(METRICS_FILE).exists() && !weights.exists());
    }

    #[test]
    fn the_origin_of_a_model_tells_the_settings_as_they_were_used() {
        let (settings, seen) = (settings(PathBuf::new()), seen());
        let told = provenance(&settings, &training().adapted_to(&seen), vec![]).unwrap().settings;
        // A fortieth of sixteen sightings.
        assert!(told.contains("\"least_weight\":0.4,"), "{told}");
    }
}
