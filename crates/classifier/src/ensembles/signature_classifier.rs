//! Class probabilities of signatures, by boosted trees or by networks over range cells.

use crate::crops::classify::softmax;
use crate::crops::layout::check_classes;
use crate::crops::model_folder::load_model;
use crate::crops::network::Logits;
use crate::ensembles::trees;
use crate::ensembles::vehicles::Seen;
use crate::error::ClassifierError;
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
        match &self.weights {
            Weights::Trees(trees) => {
                let row: Vec<f32> = features(signature).into_iter().map(|(_, value)| value as f32).collect();
                trees::logits(trees, &row)
            }
            Weights::Profile(networks) => profile_network::logits(networks, &inputs(signature)),
            Weights::Network { .. } => EVEN,
        }
    }
}

/// Logits of equal probabilities: the answer of a model that does not look at signatures.
const EVEN: Logits = [0.0; Class::ALL.len()];

/// Logits of a model for a sighting; even ones of a model that does not look at signatures.
pub fn answer(weights: &Weights, seen: &Seen) -> Logits {
    match weights {
        Weights::Trees(trees) => trees::logits(trees, &seen.features),
        Weights::Profile(networks) => profile_network::logits(networks, &seen.cells),
        Weights::Network { .. } => EVEN,
    }
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
