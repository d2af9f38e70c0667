//! Class probabilities of signatures, by boosted trees, by networks over range cells, or by both.

use crate::crops::classify::softmax;
use crate::crops::layout::check_answers;
use crate::crops::model_folder::load_model;
use crate::crops::network::Logits;
use crate::ensembles::trees;
use crate::ensembles::vehicles::Sighting;
use crate::error::ClassifierError;
use crate::networks::profile_network;
use crate::signatures::cells::{CELLS, OF_CELLS, OF_OBJECT, inputs};
use crate::signatures::features::{features, names};
use artifact::model::{Learner, ModelHeader, ProfileShape, Weights};
use artifact::settings::Class;
use artifact::signature::Signature;
use std::path::Path;

/// A trained model of signatures, ready to classify.
#[derive(Debug, Clone, PartialEq)]
pub struct SignatureClassifier {
    weights: Weights,
}

impl SignatureClassifier {
    /// Takes the parameters of a model; refused if they use inputs that this program does not have, or are
    /// malformed.
    pub fn from_model(header: &ModelHeader, weights: &Weights) -> Result<Self, ClassifierError> {
        check_answers(header)?;
        match (&header.learner, weights) {
            (Learner::BoostedTrees { features }, Weights::Trees(trees)) => {
                check_names(features, &names())?;
                trees::check(trees, names().len())?;
            }
            (Learner::ProfileNetworks(shape), Weights::Profile(networks)) => {
                check_shape(shape)?;
                profile_network::check(networks)?;
            }
            (Learner::TreesAndNetworks { features, shape }, Weights::Both { trees, networks }) => {
                check_names(features, &names())?;
                check_shape(shape)?;
                trees::check(trees, names().len())?;
                profile_network::check(networks)?;
            }
            _ => return Err(ClassifierError::OtherWeights),
        }
        Ok(Self { weights: weights.clone() })
    }

    /// Opens the classifier of a model's folder or file.
    pub fn open(folder_or_file: &Path) -> Result<Self, ClassifierError> {
        let (header, weights) = load_model(folder_or_file)?;
        Self::from_model(&header, &weights)
    }

    /// The probability of each class of [`artifact::settings::Class::ALL`]; they sum to 1.
    pub fn probabilities(&self, signature: &Signature) -> [f32; 4] {
        softmax(self.logits(signature)).map(|p| p as f32)
    }

    /// Logarithms of the probabilities, up to a constant.
    pub fn logits(&self, signature: &Signature) -> Logits {
        let row = || features(signature).into_iter().map(|(_, value)| value as f32).collect::<Vec<f32>>();
        match &self.weights {
            Weights::Trees(_) => logits_of(&self.weights, &row(), &[]),
            Weights::Profile(_) => logits_of(&self.weights, &[], &inputs(signature)),
            Weights::Both { .. } => logits_of(&self.weights, &row(), &inputs(signature)),
            Weights::Network { .. } => EVEN,
        }
    }
}

/// Logits of equal probabilities: the answer of a model that does not look at signatures.
const EVEN: Logits = [0.0; Class::ALL.len()];

/// Logits of a model for a sighting; even ones of a model that does not look at signatures.
pub fn answer(weights: &Weights, seen: &Sighting) -> Logits {
    logits_of(weights, &seen.features, &seen.cells)
}

fn logits_of(weights: &Weights, features: &[f32], cells: &[f32]) -> Logits {
    match weights {
        Weights::Trees(trees) => trees::logits(trees, features),
        Weights::Profile(networks) => profile_network::logits(networks, cells),
        Weights::Both { trees, networks } => {
            mean([trees::logits(trees, features), profile_network::logits(networks, cells)])
        }
        Weights::Network { .. } => EVEN,
    }
}

/// Mean of two answers: that of the logarithms of their probabilities, up to a constant.
pub(crate) fn mean([a, b]: [Logits; 2]) -> Logits {
    std::array::from_fn(|class| 0.5 * (a[class] + b[class]))
}

fn check_names(found: &[String], known: &[&str]) -> Result<(), ClassifierError> {
    for at in 0..known.len().max(found.len()) {
        let [found, known] =
            [found.get(at).map(String::as_str), known.get(at).copied()].map(Option::unwrap_or_default);
        if found != known {
            return Err(ClassifierError::Feature { found: found.into(), known: known.into() });
        }
    }
    Ok(())
}

fn check_shape(found: &ProfileShape) -> Result<(), ClassifierError> {
    check_names(&found.of_cells, &OF_CELLS)?;
    check_names(&found.of_object, &OF_OBJECT)?;
    if found.cells as usize != CELLS {
        let [found, known] = [found.cells as usize, CELLS].map(|cells| format!("{cells} range cells"));
        return Err(ClassifierError::Feature { found, known });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signatures::cells::shape;
    use artifact::model::BoostedTrees;

    #[test]
    fn a_model_of_any_learner_whose_rule_for_answers_is_no_share_is_refused() {
        let features = || names().into_iter().map(str::to_owned).collect();
        let learners = [
            Learner::BoostedTrees { features: features() },
            Learner::ProfileNetworks(shape()),
            Learner::TreesAndNetworks { features: features(), shape: shape() },
        ];
        let trees = BoostedTrees { prior: [0.0; 4], temperature: 1.0, trees: vec![] };
        for learner in learners {
            let (classes, attributions) = (Class::ALL.to_vec(), vec![]);
            let header = ModelHeader {
                classes,
                learner,
                least_probability: 2.0,
                frame_correlation: 0.5,
                attributions,
            };
            let refused = SignatureClassifier::from_model(&header, &Weights::Trees(trees.clone()));
            let is_by_name =
                matches!(refused, Err(ClassifierError::Setting { setting: "least_probability", .. }));
            assert!(is_by_name, "{}", header.learner.name());
        }
    }

    #[test]
    fn the_mean_of_two_answers_lies_between_them_and_of_equal_ones_is_the_same() {
        let likely = |logits: Logits| softmax(logits)[0];
        let (sure, even) = ([2.0, 0.0, 0.0, 0.0], [1.0; 4]);
        let between = likely(mean([sure, even]));
        assert!(likely(even) < between && between < likely(sure), "{between}");
        assert!((likely(mean([sure, sure])) - likely(sure)).abs() < 1e-6);
    }
}
