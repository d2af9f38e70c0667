//! Learning curves: trainings on parts of the scenes and of the vehicles.

use crate::protocols::protocol_set::{evaluate, of_test, of_training};
use artifact::dataset::Split;
use artifact::seed;
use classifier::{
    ClassificationMetrics, ClassifierError, Sighting, Sightings, SignatureTraining, TrainedModel,
};
use pipeline::chain::loaded_model::classifier_failure;
use pipeline::host::failure::Failure;
use pipeline::host::progress::Work;
use std::collections::BTreeSet;
use std::fmt::Write;

/// Fractions of the training data, beside the whole.
const SHARES: [f64; 3] = [0.125, 0.25, 0.5];
/// Seed of the selection of training data, and of the trainings; that of the first training on the whole.
const SEED: u64 = 1;

/// Whether a fraction of the training data includes a sighting.
type SubsetFilter = fn(&Sighting, f64) -> bool;

/// Makes one table over scenes and one over vehicles; each row except that of the `whole` is a new training.
/// `tests` are names and test data.
pub(super) fn page(
    training: &SignatureTraining,
    learned: &Sightings,
    whole: &TrainedModel,
    tests: &[(String, &Sightings)],
) -> Result<String, Failure> {
    let work = Work::begin("learning curves");
    let mut page = String::new();
    let curves: [(&str, SubsetFilter); 2] = [("scenes", includes_scene), ("vehicles", includes_vehicle)];
    for (curve, (what, includes)) in curves.into_iter().enumerate() {
        page += &heading(what, tests);
        for (at, share) in SHARES.into_iter().enumerate() {
            let part = part_of(learned, share, includes);
            let trained = training.train(&part, SEED, &mut |done, of| {
                work.at((curve * SHARES.len() + at) * of + done, 2 * SHARES.len() * of);
            });
            let row = match trained {
                Err(ClassifierError::MissingClass { class }) => format!("no {} among them |", class.name()),
                trained => row(&part, &trained.map_err(classifier_failure)?, tests),
            };
            let _ = writeln!(page, "| {share} | {row}");
        }
        let _ = writeln!(page, "| 1 | {}", row(learned, whole, tests));
    }
    Ok(page)
}

fn heading(what: &str, tests: &[(String, &Sightings)]) -> String {
    let columns: String = tests.iter().map(|(name, _)| format!(" T: {name} by track |")).collect();
    let rule = "---|".repeat(tests.len());
    format!(
        "\nLearning curve over {what}, one training each:\n\n\
         | share | scenes | vehicles | S by frame | V by frame | V by track |{columns}\n|---|---|---|---|---|---|{rule}\n"
    )
}

/// Sightings with a fraction of the training data; test data stay whole.
fn part_of(learned: &Sightings, share: f64, includes: SubsetFilter) -> Sightings {
    let mut part = learned.clone();
    part.all.retain(|seen| seen.split == Split::Test || includes(seen, share));
    part
}

fn includes_scene(seen: &Sighting, share: f64) -> bool {
    let (dataset, scene, _) = seen.track;
    is_in_share(&[dataset as u64, scene], share)
}

fn includes_vehicle(seen: &Sighting, share: f64) -> bool {
    let number = seen
        .model
        .bytes()
        .fold(seen.class as u64, |all, byte| all.wrapping_mul(257).wrapping_add(byte.into()));
    is_in_share(&[number], share)
}

/// Whether an index is in a fraction; a larger fraction includes a smaller one.
fn is_in_share(index: &[u64], share: f64) -> bool {
    let [a, b, c, d, ..] = seed::key(SEED, "protocols/curve", index);
    f64::from(u32::from_le_bytes([a, b, c, d])) < share * f64::from(u32::MAX) + 0.5
}

fn row(part: &Sightings, trained: &TrainedModel, tests: &[(String, &Sightings)]) -> String {
    let by_test =
        |(name, test): &(String, &Sightings)| evaluate(&of_test(name.clone(), test), trained, |_| true);
    let own = of_training(part, &[]);
    let of_own = |letter: &str| {
        let protocol = own.iter().find(|protocol| protocol.name.starts_with(letter))?;
        evaluate(protocol, trained, |_| true)
    };
    let right = |told: &Option<[ClassificationMetrics; 2]>, at: usize| {
        told.as_ref()
            .map_or("–".into(), |parts| format!("{:.1} %", 100.0 * parts[at].by_vehicle.mean_over_classes))
    };
    let learned = || part.all.iter().filter(|seen| seen.split != Split::Test);
    let scenes: BTreeSet<(usize, u64)> = learned().map(|seen| (seen.track.0, seen.track.1)).collect();
    let vehicles: BTreeSet<(usize, &str)> = learned().map(|seen| (seen.class, seen.model.as_str())).collect();
    let (s, v) = (of_own("S"), of_own("V"));
    let tested: String = tests.iter().map(|test| format!(" {} |", right(&by_test(test), 1))).collect();
    format!(
        "{} | {} | {} | {} | {} |{tested}",
        scenes.len(),
        vehicles.len(),
        right(&s, 0),
        right(&v, 0),
        right(&v, 1)
    )
}
