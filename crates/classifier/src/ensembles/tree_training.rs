//! Training of trees with probabilities calibrated for unseen vehicles: vehicles are held out in turn, and
//! the answers for them determine the number of trees, the temperature, and the correlation between the
//! frames of a track.

use crate::crops::network::Logits;
use crate::ensembles::boosting::{BoostingSettings, TrainingTable, boosted};
use crate::ensembles::cross_validation::{
    CrossValidationSets, HeldOutLogits, TRAINING_SPLITS, cross_validate, progress_counter,
};
use crate::ensembles::trained_model::{ModelCalibration, TrainedModel};
use crate::ensembles::trees::leaf;
use crate::ensembles::vehicles::Sightings;
use crate::error::ClassifierError;
use crate::signatures::features::names;
use artifact::model::{BoostedTrees, Learner, Weights};
use serde::Serialize;

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
    /// Number of rounds of all trainings together, at most.
    pub(crate) fn ticks(&self) -> usize {
        self.boosting.rounds as usize * (self.folds + MEMBERS as usize)
    }

    /// Settings with leaves suitable for the number of these sightings that train.
    pub(crate) fn adapted_to(&self, sightings: &Sightings) -> Self {
        let training = sightings.of(&TRAINING_SPLITS).len();
        let least_weight = self.boosting.least_weight.min(LEAST_OF_A_LEAF * training as f64);
        Self { boosting: BoostingSettings { least_weight, ..self.boosting }, ..*self }
    }
}

/// Trains on all sightings except those of the test split; progress is reported as (rounds done, rounds in
/// all).
///
/// The same sightings, settings and seed give the same trees on any number of threads.
pub fn train_trees(
    sightings: &Sightings,
    settings: &TreeSettings,
    seed: u64,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<TrainedModel, ClassifierError> {
    let examples = CrossValidationSets::of(sightings)?;
    let mut tick = progress_counter(settings.ticks(), progress);
    let parts = trained_trees(sightings, &examples, settings, seed, &mut tick);
    let calibrated = ModelCalibration::fit(sightings, &examples.scored, &parts.held_out, parts.best);
    let mut trees = parts.trees;
    trees.temperature *= calibrated.temperature as f32;
    let rounds = trees.trees.len();
    let model = (Learner::BoostedTrees { features: feature_names() }, Weights::Trees(trees));
    Ok(calibrated.model(sightings, &examples.scored, model, settings.least_probability, (rounds, seed)))
}

/// Names of the features, for a model's header.
pub(crate) fn feature_names() -> Vec<String> {
    names().into_iter().map(str::to_owned).collect()
}

/// Trees, with the answers for held-out vehicles and the round with the best of them.
pub(crate) struct TrainedTrees {
    pub(crate) held_out: HeldOutLogits,
    pub(crate) best: usize,
    pub(crate) trees: BoostedTrees,
}

/// Trains with vehicles held out in turn, then on all; `tick` is called after each round.
pub(crate) fn trained_trees(
    sightings: &Sightings,
    CrossValidationSets { training, scored }: &CrossValidationSets,
    settings: &TreeSettings,
    seed: u64,
    tick: &mut dyn FnMut(),
) -> TrainedTrees {
    let settings = &settings.adapted_to(sightings);
    let rounds = settings.boosting.rounds as usize;
    let mut train_on_fold = |kept: &[usize], asked: &[usize]| {
        let (mut sums, mut logits_of_rounds) = (vec![[0.0_f32; 4]; asked.len()], Vec::with_capacity(rounds));
        boosted(&sightings.table(kept), &settings.boosting, seed, &mut |trees| {
            add_last(trees, &mut sums, |at| &sightings.all[asked[at]].features);
            logits_of_rounds.push(sums.clone());
            tick();
            true
        });
        logits_of_rounds
    };
    let held_out =
        cross_validate(sightings, [training, scored], [settings.folds, rounds], seed, &mut train_on_fold);
    let best = held_out.best_round();
    let boosting = BoostingSettings { rounds: best as u32 + 1, ..settings.boosting };
    let trees = members(&sightings.table(training), &boosting, seed, tick);
    TrainedTrees { held_out, best, trees }
}

/// Number of trainings whose logits the model averages: a single one decides close cases by chance (Breiman
/// 1996, bagging).
const MEMBERS: u64 = 3;

/// The members' trees together, divided by their number.
fn members(
    table: &TrainingTable,
    settings: &BoostingSettings,
    seed: u64,
    tick: &mut dyn FnMut(),
) -> BoostedTrees {
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

/// Adds the logits of the newest tree.
fn add_last<'f>(trees: &BoostedTrees, sums: &mut [Logits], features: impl Fn(usize) -> &'f [f32]) {
    let Some(tree) = trees.trees.last() else { return };
    for (at, sum) in sums.iter_mut().enumerate() {
        sum.iter_mut().zip(leaf(tree, features(at))).for_each(|(sum, value)| *sum += value);
    }
}
