//! A training on signatures: trees on features, networks over range cells, or both.

use crate::ensembles::combined_training::{CombinedSettings, train_combined};
use crate::ensembles::profile_training::{ProfileSettings, train_networks};
use crate::ensembles::trained_model::TrainedModel;
use crate::ensembles::tree_training::{TreeSettings, train_trees};
use crate::ensembles::vehicles::Sightings;
use crate::error::ClassifierError;
use serde::Serialize;

/// Kind of the model to be trained, with its settings.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub enum SignatureTraining {
    /// Boosted trees on named features.
    Trees(TreeSettings),
    /// Networks over range cells.
    Profile(ProfileSettings),
    /// Both, their answers averaged.
    Both(CombinedSettings),
}

impl SignatureTraining {
    /// The settings as a training on these sightings uses them: with few, a leaf of a tree requires fewer.
    pub fn adapted_to(&self, sightings: &Sightings) -> Self {
        match self {
            Self::Trees(settings) => Self::Trees(settings.adapted_to(sightings)),
            Self::Profile(settings) => Self::Profile(*settings),
            Self::Both(settings) => {
                Self::Both(CombinedSettings { trees: settings.trees.adapted_to(sightings), ..*settings })
            }
        }
    }

    /// Trains on all sightings except those of the test split; progress is reported as (rounds done, rounds
    /// in all).
    ///
    /// The same sightings, settings and seed give the same model on any number of threads.
    pub fn train(
        &self,
        sightings: &Sightings,
        seed: u64,
        progress: &mut dyn FnMut(usize, usize),
    ) -> Result<TrainedModel, ClassifierError> {
        match self {
            Self::Trees(settings) => train_trees(sightings, settings, seed, progress),
            Self::Profile(settings) => train_networks(sightings, settings, seed, progress),
            Self::Both(settings) => train_combined(sightings, settings, seed, progress),
        }
    }
}
