//! Class probabilities of signatures, by boosted trees.

use crate::crops::classify::softmax;
use crate::crops::layout::check_classes;
use crate::crops::model_folder::load_model;
use crate::crops::network::Logits;
use crate::ensembles::trees::{check, logits};
use crate::error::ClassifierError;
use crate::signatures::features::{features, names};
use artifact::model::{BoostedTrees, Learner, ModelHeader, Weights};
use artifact::signature::Signature;
use std::path::Path;

/// Trained trees, ready to classify.
#[derive(Debug, Clone, PartialEq)]
pub struct SignatureClassifier {
    trees: BoostedTrees,
}

impl SignatureClassifier {
    /// Makes the trees of a model; refused if they use features that this program does not have, or are
    /// malformed.
    pub fn from_model(header: &ModelHeader, weights: &Weights) -> Result<Self, ClassifierError> {
        let (Learner::BoostedTrees { features }, Weights::Trees(trees)) = (&header.learner, weights) else {
            return Err(ClassifierError::OtherWeights);
        };
        check_classes(header)?;
        let known = names();
        for at in 0..known.len().max(features.len()) {
            let [found, known] =
                [features.get(at).map(String::as_str), known.get(at).copied()].map(Option::unwrap_or_default);
            if found != known {
                return Err(ClassifierError::Feature { found: found.into(), known: known.into() });
            }
        }
        check(trees, known.len())?;
        Ok(Self { trees: trees.clone() })
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
        let row: Vec<f32> = features(signature).into_iter().map(|(_, value)| value as f32).collect();
        logits(&self.trees, &row)
    }
}
