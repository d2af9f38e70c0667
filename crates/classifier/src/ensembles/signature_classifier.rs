//! Class probabilities of signatures, by boosted trees, by networks over range cells, or by both.

use crate::crops::classify::softmax;
use crate::crops::layout::check_classes;
use crate::crops::model_folder::load_model;
use crate::crops::network::Logits;
use crate::ensembles::trees;
use crate::ensembles::vehicles::Seen;
use crate::error::ClassifierError;
use crate::evaluation::metrics::log_softmax;
use crate::networks::profile_network;
use crate::signatures::cells::{inputs, shape};
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
        match (&header.learner, weights) {
            (Learner::BoostedTrees { features }, Weights::Trees(trees)) => {
                check_classes(header)?;
                check_names(features, &names())?;
                trees::check(trees, names().len())?;
            }
            (Learner::ProfileNetworks(of_model), Weights::Profile(networks)) => {
                check_classes(header)?;
                check_shape(of_model)?;
                profile_network::check(networks)?;
            }
            (
                Learner::TreesAndNetworks { features, shape: of_model },
                Weights::Both { trees, networks, temperature },
            ) => {
                check_classes(header)?;
                check_names(features, &names())?;
                check_shape(of_model)?;
                trees::check(trees, names().len())?;
                profile_network::check(networks)?;
                if !(temperature.is_finite() && *temperature > 0.0) {
                    return Err(ClassifierError::ProfileNetwork {
                        member: 0,
                        rule: "a temperature above zero",
                    });
                }
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
pub fn answer(weights: &Weights, seen: &Seen) -> Logits {
    logits_of(weights, &seen.features, &seen.cells)
}

fn logits_of(weights: &Weights, features: &[f32], cells: &[f32]) -> Logits {
    match weights {
        Weights::Trees(trees) => trees::logits(trees, features),
        Weights::Profile(networks) => profile_network::logits(networks, cells),
        Weights::Both { trees, networks, temperature } => {
            let both = [trees::logits(trees, features), profile_network::logits(networks, cells)];
            mean_of_logarithms(both).map(|logit| logit / temperature)
        }
        Weights::Network { .. } => EVEN,
    }
}

/// Mean of the logarithms of two answers' probabilities.
pub(crate) fn mean_of_logarithms(answers: [Logits; 2]) -> Logits {
    let [a, b] = answers.map(|logits| log_softmax(logits.map(f64::from)));
    std::array::from_fn(|class| (0.5 * (a[class] + b[class])) as f32)
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
    let known = shape();
    let of = |names: &[String]| names.to_vec();
    for (found, known) in
        [(of(&found.of_cells), of(&known.of_cells)), (of(&found.of_object), of(&known.of_object))]
    {
        check_names(&found, &known.iter().map(String::as_str).collect::<Vec<_>>())?;
    }
    if found.cells != known.cells {
        let told = |cells: u32| format!("{cells} range cells");
        return Err(ClassifierError::Feature { found: told(found.cells), known: told(known.cells) });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_two_answers_lies_between_them_and_of_equal_ones_is_the_same() {
        let likely = |logits: Logits| softmax(logits)[0];
        let (sure, even) = ([2.0, 0.0, 0.0, 0.0], [1.0; 4]);
        let mean = likely(mean_of_logarithms([sure, even]));
        assert!(likely(even) < mean && mean < likely(sure), "{mean}");
        assert!((likely(mean_of_logarithms([sure, sure])) - likely(sure)).abs() < 1e-6);
    }
}
