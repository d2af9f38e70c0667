//! Training of trees so that what they say of vehicles they never saw is true: vehicles are held out in
//! turn, and what is told of these chooses the number of trees, the temperature, and how much the
//! frames of a track have in common.

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

/// Settings by which trees are trained.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TreeSettings {
    /// Settings by which they grow.
    pub boosting: BoostingSettings,
    /// Parts into which vehicles are dealt; each is held out once.
    pub folds: usize,
    /// The likeliest class is told from this probability on: where it is more likely right than wrong.
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

/// A leaf needs no more than this share of all sightings, so that few are learned from too.
const LEAST_OF_A_LEAF: f64 = 1.0 / 40.0;

impl TreeSettings {
    /// Settings with leaves that so many sightings can fill.
    fn for_so_many(&self, sightings: usize) -> Self {
        let least_weight = self.boosting.least_weight.min(LEAST_OF_A_LEAF * sightings as f64);
        Self { boosting: BoostingSettings { least_weight, ..self.boosting }, ..*self }
    }
}

/// A trained model and how it came about.
#[derive(Debug, Clone, PartialEq)]
pub struct TrainedTrees {
    /// Header of the model: what it looks at and what it answers.
    pub header: ModelHeader,
    /// Trees, their temperature among them.
    pub weights: Weights,
    /// Log loss on held-out vehicles after each round.
    pub curve: Vec<f64>,
    /// Measures of how good it is.
    pub metrics: TreeMetrics,
    /// Logits of each sighting by trees that never saw its vehicle, or, of the test split, its scene; of
    /// crosses, which are learned from and not judged by, those of the model itself.
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
    /// Share that the answers of a track's frames have in common.
    pub frame_correlation: f64,
    /// Samples without a class, left out.
    pub unlabelled: u64,
    /// Vehicles that were held out, frame by frame.
    pub unseen_vehicles: Part,
    /// Vehicles that were held out, by track.
    pub unseen_vehicles_by_track: Part,
    /// Scenes of the test split, of vehicles that other scenes showed; `None` without any.
    pub unseen_scenes: Option<Part>,
    /// Scenes of the test split, by track; `None` without any.
    pub unseen_scenes_by_track: Option<Part>,
}

/// Measures of how good answers are.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Part {
    /// Mean over classes, with its spread over vehicles.
    pub by_vehicle: ByVehicle,
    /// Confusion, log loss, calibration.
    pub evaluation: Evaluation,
}

/// Trains on all sightings but those of the test split; progress is told as (rounds done, rounds in all).
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

/// Trainings whose logits the model is the mean of: what one of them makes of a close case is chance (Breiman
/// 1996, bagging).
const MEMBERS: u64 = 3;

/// The sum of their trees, divided by their number.
fn members(table: &Table, settings: &BoostingSettings, seed: u64, tick: &mut dyn FnMut()) -> BoostedTrees {
    let mut all = BoostedTrees { prior: [0.0; 4], temperature: MEMBERS as f32, trees: vec![] };
    for member in 0..MEMBERS {
        // The first as trainings of one member have it.
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

    /// True class, answer and weight of each after a round.
    fn weighted(&self, round: usize) -> Vec<(usize, Logits, f64)> {
        let answers = self.logits[round].iter().zip(&self.classes).zip(&self.weights);
        answers.map(|((logits, class), weight)| (*class, *logits, *weight)).collect()
    }

    fn best_round(&self) -> usize {
        let curve = self.curve();
        (0..curve.len()).fold(0, |best, round| if curve[round] < curve[best] { round } else { best })
    }
}

/// Those of what is learned from that tell how right it is: vehicles as they are, where there are any. Both
/// families of a cross are rarely held out together.
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

/// Adds what the newest tree tells.
fn add_last<'f>(trees: &BoostedTrees, sums: &mut [Logits], features: impl Fn(usize) -> &'f [f32]) {
    let Some(tree) = trees.trees.last() else { return };
    for (at, sum) in sums.iter_mut().enumerate() {
        sum.iter_mut().zip(leaf(tree, features(at))).for_each(|(sum, value)| *sum += value);
    }
}

/// The correlation of frames at which tracks are told best, in steps of a twentieth.
fn fitted_correlation(seen: &[&Seen], logits: &[Logits]) -> f64 {
    let tracks = tracks(seen, logits);
    let loss = |correlation: f64| -> f64 {
        tracks.iter().map(|t| -log_softmax(t.joined(correlation).map(f64::from))[t.class]).sum()
    };
    let steps = (0..=20).map(|i| f64::from(i) / 20.0);
    steps.min_by(|a, b| loss(*a).total_cmp(&loss(*b))).unwrap_or(1.0)
}

/// Answers of the frames of one track together.
struct Track<'a> {
    class: usize,
    model: &'a str,
    log_sums: [f64; 4],
    frames: f64,
}

impl Track<'_> {
    /// Answers joined: n frames of correlation ρ count as n/(1 + (n − 1)ρ).
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

/// Class and answer of each track, the answers of its frames joined.
pub fn of_tracks(seen: &[&Seen], logits: &[Logits], correlation: f64) -> Vec<(usize, Logits)> {
    tracks(seen, logits).iter().map(|track| (track.class, track.joined(correlation))).collect()
}

/// Measures frame by frame, and by track.
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
