//! Training of trees and of networks whose answers are averaged: they err on different sightings.

use crate::ensembles::cross_validation::{CrossValidationSets, HeldOutLogits, progress_counter};
use crate::ensembles::profile_training::{ProfileSettings, trained_networks};
use crate::ensembles::signature_classifier::mean;
use crate::ensembles::trained_model::{ModelCalibration, TrainedModel};
use crate::ensembles::tree_training::{TreeSettings, feature_names, trained_trees};
use crate::ensembles::vehicles::Sightings;
use crate::error::ClassifierError;
use crate::signatures::cells::shape;
use artifact::model::{Learner, ProfileNetworks, Weights};
use serde::Serialize;

/// Settings for training trees and networks.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct CombinedSettings {
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
pub fn train_combined(
    sightings: &Sightings,
    settings: &CombinedSettings,
    seed: u64,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<TrainedModel, ClassifierError> {
    let examples = CrossValidationSets::of(sightings)?;
    let mut tick = progress_counter(settings.trees.ticks() + settings.networks.ticks(), progress);
    let of_trees = trained_trees(sightings, &examples, &settings.trees, seed, &mut tick);
    let of_networks = trained_networks(sightings, &examples, &settings.networks, seed, &mut tick);
    let last = of_networks.held_out.logits.len() - 1;
    let (of_tree, by_trees) = of_trees.held_out.temperature_scaled(of_trees.best);
    let (of_network, by_networks) = of_networks.held_out.temperature_scaled(last);
    let logits = by_trees.into_iter().zip(by_networks).map(|(a, b)| mean([a, b])).collect();
    let HeldOutLogits { classes, weights, .. } = of_trees.held_out;
    let held_out = HeldOutLogits { logits: vec![logits], classes, weights };
    let calibrated = ModelCalibration::fit(sightings, &examples.scored, &held_out, 0);
    let mut trees = of_trees.trees;
    trees.temperature *= (of_tree * calibrated.temperature) as f32;
    let temperature = (of_network * calibrated.temperature) as f32;
    let networks = ProfileNetworks { temperature, members: of_networks.members };
    let learner = Learner::TreesAndNetworks { features: feature_names(), shape: shape() };
    let rounds = trees.trees.len() + settings.networks.network.epochs as usize;
    let (weights, least) = (Weights::Both { trees, networks }, settings.trees.least_probability);
    Ok(calibrated.model(sightings, &examples.scored, (learner, weights), least, (rounds, seed)))
}
