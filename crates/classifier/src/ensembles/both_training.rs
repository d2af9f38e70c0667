//! Training of trees and of networks whose answers are averaged: they err on different sightings.

use crate::crops::network::Logits;
use crate::ensembles::held_out::{HeldOut, LearnedAndJudged};
use crate::ensembles::profile_training::{ProfileSettings, trained_networks};
use crate::ensembles::signature_classifier::mean_of_logarithms;
use crate::ensembles::trained::{Calibrated, Trained};
use crate::ensembles::tree_training::{TreeSettings, feature_names, trained_trees};
use crate::ensembles::vehicles::Sightings;
use crate::error::ClassifierError;
use crate::evaluation::temperature::fitted_temperature;
use crate::signatures::cells::shape;
use artifact::model::{Learner, ProfileNetworks, Weights};
use serde::Serialize;

/// Settings for training trees and networks.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct BothSettings {
    /// Settings for the trees; theirs is the least probability of an answer.
    pub trees: TreeSettings,
    /// Settings for the networks.
    pub networks: ProfileSettings,
}

/// Trains on all sightings except those of the test split; progress is reported as (rounds done, rounds in
/// all).
///
/// Each kind has its own temperature, and their mean another. The same sightings, settings and seed give the
/// same model on any number of threads.
pub fn train_both(
    sightings: &Sightings,
    settings: &BothSettings,
    seed: u64,
    heard: &mut dyn FnMut(usize, usize),
) -> Result<Trained, ClassifierError> {
    let examples = LearnedAndJudged::of(sightings)?;
    let (mut done, all) = (0, settings.trees.ticks() + settings.networks.ticks());
    let mut tick = || {
        done += 1;
        heard(done, all);
    };
    let of_trees = trained_trees(sightings, &examples, &settings.trees, seed, &mut tick);
    let of_networks = trained_networks(sightings, &examples, &settings.networks, seed, &mut tick);
    let last = of_networks.held_out.logits.len() - 1;
    let [by_trees, by_networks] =
        [(&of_trees.held_out, of_trees.best), (&of_networks.held_out, last)].map(cooled);
    let logits = by_trees.1.iter().zip(&by_networks.1).map(|(a, b)| mean_of_logarithms([*a, *b]));
    let HeldOut { classes, weights, .. } = of_trees.held_out;
    let held_out = HeldOut { logits: vec![logits.collect()], classes, weights };
    let calibrated = Calibrated::on(sightings, &examples.judged, &held_out, 0);
    let mut trees = of_trees.trees;
    trees.temperature *= by_trees.0;
    let networks = ProfileNetworks { temperature: by_networks.0, members: of_networks.members };
    let learner = Learner::TreesAndNetworks { features: feature_names(), shape: shape() };
    let rounds = trees.trees.len() + settings.networks.network.epochs as usize;
    let weights = Weights::Both { trees, networks, temperature: calibrated.temperature as f32 };
    let least = settings.trees.least_probability;
    Ok(calibrated.model(sightings, &examples.judged, (learner, weights), least, (rounds, seed)))
}

/// Temperature that fits the answers of a round, and the answers divided by it.
fn cooled((held_out, round): (&HeldOut, usize)) -> (f32, Vec<Logits>) {
    let temperature = fitted_temperature(&held_out.weighted(round)) as f32;
    (temperature, held_out.logits[round].iter().map(|logits| logits.map(|l| l / temperature)).collect())
}
