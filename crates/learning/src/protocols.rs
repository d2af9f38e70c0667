//! Protocols: the accuracy of models of signatures, trained with several seeds, on data not used in training:
//! scenes of the test split (S), vehicles held out in turn (V, folder by folder), and datasets only for
//! testing (T). Or the paper's network by the paper's protocol (P).

mod protocol_set;
mod conditions;
mod curves;
mod paper;
mod settings;

use crate::evaluation::{confusion, predictions, shares, sightings_of};
use crate::training::{iterations_of_signatures, note_lone_vehicles};
use artifact::dataset::Split;
use artifact::settings::Class;
use classifier::{
    ClassificationMetrics, ReliabilityBin, Sighting, Sightings, SignatureTraining, TrainedModel,
    feature_similarity,
};
use conditions::{TrackConditions, conditions};
use pipeline::chain::class_rule::ClassRule;
use pipeline::chain::loaded_model::{classifier_failure, classifier_failure_about};
use pipeline::host::dataset_folders::DatasetFolder;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress::Work;
use pipeline::host::safe_text::{in_markdown, markdown_table};
use protocol_set::{HELD_OUT, Protocol, SightingFilter, answers, evaluate, name_of, of_test, of_training};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::iter;
use std::path::{Path, PathBuf};

pub use settings::ProtocolSettings;

/// Arrays with a row in the table.
const ARRAYS: [(&str, SightingFilter); 3] =
    [("all", |_| true), ("without rows", |seen| !seen.has_rows), ("with rows", |seen| seen.has_rows)];

const COLUMNS: [&str; 7] = [
    "protocol",
    "array",
    "vehicles",
    "right by frame",
    "right by track",
    "calibration error by frame",
    "by track",
];

/// Trains, evaluates and returns the page (Markdown).
///
/// # Errors
/// A sentence that names file and rule if a shard is damaged, a class is missing, or a setting does not apply
/// to the learner.
pub fn run(settings: &ProtocolSettings) -> Result<String, Failure> {
    let training = settings.learner.on_signatures();
    if training.is_some() && settings.iterations.is_some() {
        return Err(iterations_of_signatures());
    }
    let mut learned = DatasetFolder::open_all(&[&settings.datasets[..], &settings.test].concat())?;
    let tests = learned.split_off(settings.datasets.len());
    if let Some(out) = &settings.out {
        files::claim(std::slice::from_ref(out))?;
    }
    let page = match training {
        Some(training) => of_signatures(settings, &training, &learned, &tests)?,
        None => paper::page(settings, &learned)?,
    };
    settings.out.as_ref().map_or(Ok(()), |out| files::write_file(out, page.as_bytes()))?;
    Ok(page)
}

fn of_signatures(
    settings: &ProtocolSettings,
    training: &SignatureTraining,
    datasets: &[DatasetFolder],
    of_tests: &[DatasetFolder],
) -> Result<String, Failure> {
    let of_learned = conditions(datasets)?;
    let of_tested: Vec<TrackConditions> =
        of_tests.iter().map(|folder| conditions(std::slice::from_ref(folder))).collect::<Result<_, _>>()?;
    let learned = sightings_of(datasets)?;
    let tests: Vec<Sightings> =
        of_tests.iter().map(|folder| sightings_of(std::slice::from_ref(folder))).collect::<Result<_, _>>()?;
    for (folder, test) in settings.test.iter().zip(&tests) {
        learned.check_disjoint(test).map_err(classifier_failure_about(folder))?;
    }
    let mut protocols = of_training(&learned, &settings.datasets);
    let named = |folder: &PathBuf| format!("T: {} never seen", name_of(folder));
    protocols.extend(settings.test.iter().zip(&tests).map(|(folder, test)| of_test(named(folder), test)));
    let work = Work::begin("training");
    let mut trained = Vec::new();
    for seed in 1..=settings.seeds {
        let before = (seed - 1) as usize;
        let all = settings.seeds as usize;
        let one = training.train(&learned, seed, &mut |at, of| work.at(before * of + at, all * of));
        trained.push(one.map_err(classifier_failure)?);
    }
    drop(work);
    note_lone_vehicles(&learned);
    let mut page = page(&protocols, &trained);
    page += &reliability(&protocols, &trained[0]);
    page += &by_threshold(&protocols, &trained[0]);
    if let Some(held_out) = protocols.iter().find(|protocol| protocol.name == HELD_OUT) {
        page += &by_condition(held_out, &of_learned, &trained[0]);
    }
    for ((folder, test), known) in settings.test.iter().zip(&tests).zip(&of_tested) {
        page += &by_condition(&of_test(named(folder), test), known, &trained[0]);
        page += &feature_similarities(folder, &learned, test);
    }
    if settings.curves {
        let tests: Vec<(String, &Sightings)> =
            settings.test.iter().map(|folder| name_of(folder)).zip(&tests).collect();
        page += &curves::page(training, &learned, &trained[0], &tests)?;
    }
    Ok(page)
}

fn page(protocols: &[Protocol<'_>], trained: &[TrainedModel]) -> String {
    let mut rows = Vec::new();
    for protocol in protocols {
        for (array, filter) in ARRAYS {
            let told: Vec<[ClassificationMetrics; 2]> =
                trained.iter().filter_map(|t| evaluate(protocol, t, filter)).collect();
            if !told.is_empty() {
                rows.push(row(&protocol.name, array, &told));
            }
        }
    }
    let mut page = format!(
        "Means over {} trainings; in brackets 95 % over vehicles, and the spread of the trainings.\n\n{}",
        trained.len(),
        markdown_table(&COLUMNS, rows)
    );
    for protocol in protocols {
        if let Some([_, tracks]) = trained.first().and_then(|first| evaluate(protocol, first, |_| true)) {
            let table = confusion(&tracks.evaluation);
            let _ =
                write!(page, "\n{}, by track, seed 1, rows true, columns told:\n\n{table}", protocol.name);
        }
    }
    page
}

fn row(name: &str, array: &str, told: &[[ClassificationMetrics; 2]]) -> [String; 7] {
    let mean = |value: &dyn Fn(&[ClassificationMetrics; 2]) -> f64| {
        100.0 * told.iter().map(value).sum::<f64>() / told.len() as f64
    };
    let right = |at: usize| {
        let of = |one: &[ClassificationMetrics; 2]| one[at].by_vehicle.mean_over_classes;
        let middle = mean(&of);
        let spread = mean(&|one| (100.0 * of(one) - middle).powi(2) / 100.0);
        let end = |one: &[ClassificationMetrics; 2], end: usize| {
            one[at].by_vehicle.interval.map_or(f64::NAN, |ends| ends[end])
        };
        let [low, high] = [0, 1].map(|at_end| mean(&|one| end(one, at_end)));
        let over_vehicles = if low.is_nan() { "–".to_owned() } else { format!("{low:.0} … {high:.0}") };
        format!("{middle:.1} % ({over_vehicles}; ± {:.1})", spread.sqrt())
    };
    let error = |at: usize| format!("{:.1} %", mean(&|one| one[at].evaluation.calibration.expected_error));
    let vehicles = told[0][0].by_vehicle.vehicles.to_string();
    [name.to_owned(), array.to_owned(), vehicles, right(0), right(1), error(0), error(1)]
}

/// Reliability diagram as a table: accuracy of answers by their probability, by frame.
fn reliability(protocols: &[Protocol<'_>], trained: &TrainedModel) -> String {
    let mut table = String::from(
        "\nReliability: mean probability of the likeliest class / share of these answers that is right, % (answers), by frame, seed 1:\n\n",
    );
    for (number, protocol) in protocols.iter().enumerate() {
        let Some([frames, _]) = evaluate(protocol, trained, |_| true) else { continue };
        let bins = &frames.evaluation.calibration.bins[LEAST_BIN..];
        if number == 0 {
            let ends =
                bins.iter().map(|bin| format!("{:.1} to {:.1} |", bin.probability[0], bin.probability[1]));
            let _ = writeln!(
                table,
                "| protocol |{}\n|---|{}",
                ends.collect::<String>(),
                "---|".repeat(bins.len())
            );
        }
        let of_bin = |bin: &ReliabilityBin| match (bin.confidence, bin.accuracy) {
            (Some(told), Some(right)) => {
                format!(" {:.0} / {:.0} ({}) |", 100.0 * told, 100.0 * right, bin.samples)
            }
            _ => " – |".into(),
        };
        let _ = writeln!(table, "| {} |{}", protocol.name, bins.iter().map(of_bin).collect::<String>());
    }
    table
}

/// First bin of probability that an answer can fall into: the likeliest of four classes has at least a
/// quarter.
const LEAST_BIN: usize = 2;

/// Possible least probabilities of an answer.
const THRESHOLDS: [f32; 5] = [0.3, 0.4, 0.5, 0.6, 0.7];

/// Table of the share of each protocol's frames that are right, wrong and unknown, %, by the least
/// probability of an answer.
fn by_threshold(protocols: &[Protocol<'_>], trained: &TrainedModel) -> String {
    let line = |name: &str, cell: &dyn Fn(f32) -> String| {
        iter::once(name.to_owned()).chain(THRESHOLDS.map(cell)).collect::<Vec<_>>()
    };
    let rows = protocols.iter().map(|protocol| {
        let answers = answers(protocol, trained, |_| true);
        let answers: Vec<_> = answers.iter().map(|(seen, logits)| (seen.class, *logits)).collect();
        let rule = |least| ClassRule { least_probability: least, ..ClassRule::default() };
        line(&protocol.name, &|least| shares(&predictions(rule(least), &answers)))
    });
    let table = markdown_table(&line("protocol", &|least| format!("from {least}")), rows);
    format!(
        "\nTold right / wrong / unknown in % of the frames, by the least probability of an answer, seed 1:\n\n{table}"
    )
}

/// Table of the accuracy on a protocol's vehicles by the conditions of their sightings; those without a line
/// beside their shard have a row of their own.
fn by_condition(protocol: &Protocol<'_>, known: &TrackConditions, trained: &TrainedModel) -> String {
    let unknown = conditions::unknown();
    let mut of: BTreeMap<(usize, &str, &conditions::Bin), Protocol<'_>> = BTreeMap::new();
    for &(seen, source) in &protocol.seen {
        let conditions = known.get(&seen.track).unwrap_or(&unknown);
        for (order, (condition, value)) in conditions.iter().enumerate() {
            let empty = || Protocol { name: String::new(), seen: vec![] };
            of.entry((order, *condition, value)).or_insert_with(empty).seen.push((seen, source));
        }
    }
    if of.is_empty() {
        return String::new();
    }
    let row = |((_, condition, (_, value)), protocol): (&(usize, &str, &conditions::Bin), &Protocol<'_>)| {
        let [frames, tracks] = evaluate(protocol, trained, |_| true)?.map(|part| part.by_vehicle);
        let [right, by_track] =
            [&frames, &tracks].map(|told| format!("{:.1} %", 100.0 * told.mean_over_classes));
        let value = in_markdown(value).into_owned();
        Some([(*condition).to_owned(), value, frames.answers.to_string(), right, by_track])
    };
    let columns = ["condition", "value", "frames", "right by frame", "right by track"];
    let table = markdown_table(&columns, of.iter().filter_map(row));
    format!("\n{}, by condition, seed 1:\n\n{table}", protocol.name)
}

/// Features by which training and test are compared: level, visible extent, number of peaks, height.
const COMPARED: [&str; 4] = ["total_dbsm", "extent_m", "peaks", "height_m"];

/// Table of the similarity of features between training and test, as area under the ROC curve, class by
/// class.
fn feature_similarities(folder: &Path, learned: &Sightings, test: &Sightings) -> String {
    let has_trained = |seen: &&Sighting| seen.split != Split::Test;
    let (learned, test): (Vec<&Sighting>, Vec<&Sighting>) =
        (learned.all.iter().filter(has_trained).collect(), test.all.iter().collect());
    let rows = Class::ALL.iter().enumerate().map(|(number, class)| {
        let area = |feature| feature_similarity(feature, number, &learned, &test);
        let told = COMPARED.map(|feature| area(feature).map_or("–".into(), |area| format!("{area:.2}")));
        iter::once(class.name().to_owned()).chain(told).collect::<Vec<_>>()
    });
    let [a, b, c, d] = COMPARED;
    format!(
        "\nArea under the ROC between what trained and {}, 0.5 alike and 1 apart:\n\n{}",
        name_of(folder),
        markdown_table(&["class", a, b, c, d], rows)
    )
}
