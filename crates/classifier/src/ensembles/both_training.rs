//! Training of trees and of networks whose answers are averaged: they err on different sightings.

use crate::ensembles::held_out::{HeldOut, LearnedAndJudged, counted};
use crate::ensembles::profile_training::{ProfileSettings, trained_networks};
use crate::ensembles::signature_classifier::mean;
use crate::ensembles::trained::{Calibrated, Trained};
use crate::ensembles::tree_training::{TreeSettings, feature_names, trained_trees};
use crate::ensembles::vehicles::Sightings;
use crate::error::ClassifierError;
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
/// Each kind has its own temperature, times that of their mean. The same sightings, settings and seed give
/// the same model on any number of threads.
pub fn train_both(
    sightings: &Sightings,
    settings: &BothSettings,
    seed: u64,
    heard: &mut dyn FnMut(usize, usize),
) -> Result<Trained, ClassifierError> {
    let examples = LearnedAndJudged::of(sightings)?;
    let mut tick = counted(settings.trees.ticks() + settings.networks.ticks(), heard);
    let of_trees = trained_trees(sightings, &examples, &settings.trees, seed, &mut tick);
    let of_networks = trained_networks(sightings, &examples, &settings.networks, seed, &mut tick);
    let last = of_networks.held_out.logits.len() - 1;
    let (of_tree, by_trees) = of_trees.held_out.cooled(of_trees.best);
    let (of_network, by_networks) = of_networks.held_out.cooled(last);
    let logits = by_trees.into_iter().zip(by_networks).map(|(a, b)| mean([a, b])).collect();
    let HeldOut { classes, weights, .. } = of_trees.held_out;
    let held_out = HeldOut { logits: vec![logits], classes, weights };
    let calibrated = Calibrated::on(sightings, &examples.judged, &held_out, 0);
    let mut trees = of_trees.trees;
    trees.temperature *= (of_tree * calibrated.temperature) as f32;
    let temperature = (of_network * calibrated.temperature) as f32;
    let networks = ProfileNetworks { temperature, members: of_networks.members };
    let learner = Learner::TreesAndNetworks { features: feature_names(), shape: shape() };
    let rounds = trees.trees.len() + settings.networks.network.epochs as usize;
    let (weights, least) = (Weights::Both { trees, networks }, settings.trees.least_probability);
    Ok(calibrated.model(sightings, &examples.judged, (learner, weights), least, (rounds, seed)))
}
