//! Training of trees with probabilities calibrated for unseen vehicles: vehicles are held out in turn, and
//! the answers for them determine the number of trees, the temperature, and the correlation between the
//! frames of a track.

use crate::crops::network::Logits;
use crate::crops::samples::Example;
use crate::ensembles::boosting::{BoostingSettings, Table, boosted};
use crate::ensembles::trees::{leaf, logits};
use crate::ensembles::vehicles::{Seen, Sightings, TrackKey};
use crate::error::ClassifierError;
use crate::evaluation::by_vehicle::{ByVehicle, Told, by_vehicle};
use crate::evaluation::metrics::{Evaluation, evaluation, log_softmax};
use crate::evaluation::temperature::fitted_temperature;
use crate::signatures::features::names;
use artifact::dataset::Split;
use artifact::model::{BoostedTrees, Learner, ModelHeader, Weights};
use artifact::settings::Class;
use serde::Serialize;
use std::collections::BTreeMap;

/// Settings for training trees.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TreeSettings {
    /// Settings for growing them.
    pub boosting: BoostingSettings,
    /// Number of folds of vehicles; each is held out once.
    pub folds: usize,
    /// Least probability for answering with the likeliest class: where it is more likely right than wrong.
    pub least_probability: f32,
}

impl Default for TreeSettings {
    fn default() -> Self {
        let boosting = BoostingSettings {
            rounds: 600,
            depth: 3,
            learning_rate: 0.04,
            shrinkage: 2.0,
            least_weight: 20.0,
            columns: 0.1,
            rows: 0.7,
        };
        Self { boosting, folds: 5, least_probability: 0.4 }
    }
}

/// Largest share of all sightings that a leaf may require, so that training on few works too.
const LEAST_OF_A_LEAF: f64 = 1.0 / 40.0;

impl TreeSettings {
    /// Settings with leaves suitable for this number of sightings.
    fn for_so_many(&self, sightings: usize) -> Self {
        let least_weight = self.boosting.least_weight.min(LEAST_OF_A_LEAF * sightings as f64);
        Self { boosting: BoostingSettings { least_weight, ..self.boosting }, ..*self }
    }
}

/// A trained model with its training results.
#[derive(Debug, Clone, PartialEq)]
pub struct TrainedTrees {
    /// Header of the model: its inputs and outputs.
    pub header: ModelHeader,
    /// Trees with their temperature.
    pub weights: Weights,
    /// Log loss on held-out vehicles after each round.
    pub curve: Vec<f64>,
    /// Metrics of the model.
    pub metrics: TreeMetrics,
    /// Logits of each sighting by trees that never saw its vehicle or, for the test split, its scene; for
    /// crosses, which are only for training, those of the model itself.
    pub told: Vec<Logits>,
}

/// Content of `metrics.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TreeMetrics {
    /// Order of rows, columns and probabilities.
    pub classes: [Class; 4],
    /// Seed of the training.
    pub seed: u64,
    /// Number of trees.
    pub rounds: usize,
    /// Temperature: the divisor of the logits.
    pub temperature: f64,
    /// Correlation between the answers of a track's frames.
    pub frame_correlation: f64,
    /// Number of ignored samples without a class.
    pub unlabelled: u64,
    /// Metrics on held-out vehicles, by frame.
    pub unseen_vehicles: Part,
    /// Metrics on held-out vehicles, by track.
    pub unseen_vehicles_by_track: Part,
    /// Metrics on scenes of the test split, with vehicles of other scenes; `None` without any.
    pub unseen_scenes: Option<Part>,
    /// Metrics on scenes of the test split, by track; `None` without any.
    pub unseen_scenes_by_track: Option<Part>,
}

/// Metrics of answers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Part {
    /// Mean over classes, with its spread over vehicles.
    pub by_vehicle: ByVehicle,
    /// Confusion, log loss, calibration.
    pub evaluation: Evaluation,
}

/// Trains on all sightings except those of the test split; progress is reported as (rounds done, rounds in
/// all).
///
/// The same sightings, settings and seed give the same trees on any number of threads.
pub fn train_trees(
    sightings: &Sightings,
    settings: &TreeSettings,
    seed: u64,
    heard: &mut dyn FnMut(usize, usize),
) -> Result<TrainedTrees, ClassifierError> {
    let learned = sightings.of(&[Split::Train, Split::Validation]);
    check_classes(sightings, &learned)?;
    let settings = &settings.for_so_many(learned.len());
    let (mut done, all) = (0, settings.boosting.rounds as usize * (settings.folds + MEMBERS as usize));
    let mut tick = || {
        done += 1;
        heard(done, all);
    };
    let judged = judged(sightings, &learned);
    let held_out = held_out(sightings, [&learned, &judged], settings, seed, &mut tick);
    let best = held_out.best_round();
    let temperature = fitted_temperature(&held_out.weighted(best));
    let cooled: Vec<Logits> =
        held_out.logits[best].iter().map(|l| l.map(|v| v / temperature as f32)).collect();
    let frame_correlation = fitted_correlation(&sightings.seen(&judged), &cooled);
    let boosting = BoostingSettings { rounds: best as u32 + 1, ..settings.boosting };
    let mut trees = members(&sightings.table(&learned), &boosting, seed, &mut tick);
    trees.temperature *= temperature as f32;
    let told = Fitted { seed, temperature, frame_correlation, trees: &trees };
    let metrics = told.metrics(sightings, &judged, &cooled);
    let mut told: Vec<Logits> = sightings.all.iter().map(|seen| logits(&trees, &seen.features)).collect();
    judged.iter().zip(&cooled).for_each(|(number, logits)| told[*number] = *logits);
    let (header, curve) = (header(settings, frame_correlation), held_out.curve());
    Ok(TrainedTrees { header, weights: Weights::Trees(trees), curve, metrics, told })
}

/// Number of trainings whose logits the model averages: a single one decides close cases by chance (Breiman
/// 1996, bagging).
const MEMBERS: u64 = 3;

/// The members' trees together, divided by their number.
fn members(table: &Table, settings: &BoostingSettings, seed: u64, tick: &mut dyn FnMut()) -> BoostedTrees {
    let mut all = BoostedTrees { prior: [0.0; 4], temperature: MEMBERS as f32, trees: vec![] };
    for member in 0..MEMBERS {
        // The first member is the same as in a training of one member.
        let one = boosted(table, settings, seed.wrapping_add(member << 32), &mut |_| {
            tick();
            true
        });
        all.trees.extend(one.trees);
    }
    all
}

/// Result of a training.
struct Fitted<'a> {
    seed: u64,
    temperature: f64,
    frame_correlation: f64,
    trees: &'a BoostedTrees,
}

impl Fitted<'_> {
    fn metrics(&self, sightings: &Sightings, judged: &[usize], held_out: &[Logits]) -> TreeMetrics {
        let test = sightings.seen(&sightings.of(&[Split::Test]));
        let told: Vec<Logits> = test.iter().map(|seen| logits(self.trees, &seen.features)).collect();
        let of_test = (!test.is_empty()).then(|| parts(&test, &told, self.frame_correlation));
        let [unseen_scenes, unseen_scenes_by_track] = of_test.map_or([None, None], |parts| parts.map(Some));
        let [unseen_vehicles, unseen_vehicles_by_track] =
            parts(&sightings.seen(judged), held_out, self.frame_correlation);
        TreeMetrics {
            classes: Class::ALL,
            seed: self.seed,
            rounds: self.trees.trees.len(),
            temperature: self.temperature,
            frame_correlation: self.frame_correlation,
            unlabelled: sightings.unlabelled,
            unseen_vehicles,
            unseen_vehicles_by_track,
            unseen_scenes,
            unseen_scenes_by_track,
        }
    }
}

fn header(settings: &TreeSettings, frame_correlation: f64) -> ModelHeader {
    ModelHeader {
        classes: Class::ALL.to_vec(),
        learner: Learner::BoostedTrees { features: names().into_iter().map(str::to_owned).collect() },
        least_probability: settings.least_probability,
        frame_correlation: frame_correlation as f32,
        attributions: vec![],
    }
}

fn check_classes(sightings: &Sightings, learned: &[usize]) -> Result<(), ClassifierError> {
    let is_seen = |class: usize| learned.iter().any(|i| sightings.all[*i].class == class);
    match (0..Class::ALL.len()).find(|class| !is_seen(*class)) {
        Some(missing) => Err(ClassifierError::MissingClass { class: Class::ALL[missing] }),
        None => Ok(()),
    }
}

/// Logits of vehicles by trees that never saw them.
struct HeldOut {
    /// Logits, `[round][sighting]`.
    logits: Vec<Vec<Logits>>,
    classes: Vec<usize>,
    weights: Vec<f64>,
}

impl HeldOut {
    fn curve(&self) -> Vec<f64> {
        let total: f64 = self.weights.iter().sum();
        let loss = |round: &Vec<Logits>| {
            let one =
                |(i, l): (usize, &Logits)| -self.weights[i] * log_softmax(l.map(f64::from))[self.classes[i]];
            round.iter().enumerate().map(one).sum::<f64>() / total
        };
        self.logits.iter().map(loss).collect()
    }

    /// True class, answer and weight of each sighting after a round.
    fn weighted(&self, round: usize) -> Vec<(usize, Logits, f64)> {
        let answers = self.logits[round].iter().zip(&self.classes).zip(&self.weights);
        answers.map(|((logits, class), weight)| (*class, *logits, *weight)).collect()
    }

    fn best_round(&self) -> usize {
        let curve = self.curve();
        (0..curve.len()).fold(0, |best, round| if curve[round] < curve[best] { round } else { best })
    }
}

/// Training sightings that measure the accuracy: unmodified vehicles, if there are any. The two families of a
/// cross are rarely held out together.
fn judged(sightings: &Sightings, learned: &[usize]) -> Vec<usize> {
    let plain: Vec<usize> = learned.iter().copied().filter(|i| !sightings.all[*i].is_cross()).collect();
    if plain.is_empty() { learned.to_vec() } else { plain }
}

fn held_out(
    sightings: &Sightings,
    [learned, judged]: [&[usize]; 2],
    settings: &TreeSettings,
    seed: u64,
    tick: &mut dyn FnMut(),
) -> HeldOut {
    let folds = sightings.folds(learned, settings.folds, seed);
    let fold_of: BTreeMap<usize, [usize; 2]> = learned.iter().copied().zip(folds).collect();
    let mut all = vec![vec![[0.0; 4]; judged.len()]; settings.boosting.rounds as usize];
    for fold in 0..settings.folds {
        let out: Vec<usize> = (0..judged.len()).filter(|at| fold_of[&judged[*at]][0] == fold).collect();
        let kept: Vec<usize> = learned.iter().copied().filter(|i| !fold_of[i].contains(&fold)).collect();
        let mut sums = vec![[0.0_f32; 4]; out.len()];
        boosted(&sightings.table(&kept), &settings.boosting, seed, &mut |trees| {
            add_last(trees, &mut sums, |at| &sightings.all[judged[out[at]]].features);
            out.iter().zip(&sums).for_each(|(i, sum)| all[trees.trees.len() - 1][*i] = *sum);
            tick();
            true
        });
    }
    let table = sightings.table(judged);
    HeldOut { logits: all, classes: table.classes, weights: table.weights }
}

/// Adds the logits of the newest tree.
fn add_last<'f>(trees: &BoostedTrees, sums: &mut [Logits], features: impl Fn(usize) -> &'f [f32]) {
    let Some(tree) = trees.trees.last() else { return };
    for (at, sum) in sums.iter_mut().enumerate() {
        sum.iter_mut().zip(leaf(tree, features(at))).for_each(|(sum, value)| *sum += value);
    }
}

/// The correlation of frames with the best answers for tracks, in steps of a twentieth.
fn fitted_correlation(seen: &[&Seen], logits: &[Logits]) -> f64 {
    let tracks = tracks(seen, logits);
    let loss = |correlation: f64| -> f64 {
        tracks.iter().map(|t| -log_softmax(t.joined(correlation).map(f64::from))[t.class]).sum()
    };
    let steps = (0..=20).map(|i| f64::from(i) / 20.0);
    steps.min_by(|a, b| loss(*a).total_cmp(&loss(*b))).unwrap_or(1.0)
}

/// Combined answers of the frames of one track.
struct Track<'a> {
    class: usize,
    model: &'a str,
    log_sums: [f64; 4],
    frames: f64,
}

impl Track<'_> {
    /// Combined answer: n frames of correlation ρ count as n/(1 + (n − 1)ρ).
    fn joined(&self, correlation: f64) -> Logits {
        self.log_sums.map(|sum| (sum / (1.0 + (self.frames - 1.0) * correlation)) as f32)
    }
}

fn tracks<'a>(seen: &[&'a Seen], logits: &[Logits]) -> Vec<Track<'a>> {
    let mut tracks: BTreeMap<TrackKey, Track<'a>> = BTreeMap::new();
    for (seen, logits) in seen.iter().zip(logits) {
        let new = Track { class: seen.class, model: &seen.model, log_sums: [0.0; 4], frames: 0.0 };
        let track = tracks.entry(seen.track).or_insert(new);
        let logs = log_softmax(logits.map(f64::from));
        track.log_sums.iter_mut().zip(logs).for_each(|(sum, log)| *sum += log);
        track.frames += 1.0;
    }
    tracks.into_values().collect()
}

/// Class and combined answer of each track.
pub fn of_tracks(seen: &[&Seen], logits: &[Logits], correlation: f64) -> Vec<(usize, Logits)> {
    tracks(seen, logits).iter().map(|track| (track.class, track.joined(correlation))).collect()
}

/// Metrics by frame, and by track.
pub fn parts(seen: &[&Seen], logits: &[Logits], correlation: f64) -> [Part; 2] {
    let frames: Vec<(usize, &str)> = seen.iter().map(|s| (s.class, s.model.as_str())).collect();
    let tracks = tracks(seen, logits);
    let of_tracks: Vec<(usize, &str)> = tracks.iter().map(|t| (t.class, t.model)).collect();
    let joined: Vec<Logits> = tracks.iter().map(|t| t.joined(correlation)).collect();
    [part(&frames, logits), part(&of_tracks, &joined)]
}

fn part(answers: &[(usize, &str)], logits: &[Logits]) -> Part {
    let likeliest = |l: &Logits| (0..4).fold(0, |best, i| if l[i] > l[best] { i } else { best });
    let told = answers.iter().zip(logits).map(|((truth, model), l)| Told {
        truth: *truth,
        model,
        told: likeliest(l),
    });
    let example =
        |(class, model): &(usize, &str)| Example { pooled: vec![], class: *class, model: (*model).into() };
    let examples: Vec<Example> = answers.iter().map(example).collect();
    Part { by_vehicle: by_vehicle(told), evaluation: evaluation(&examples, logits) }
}
