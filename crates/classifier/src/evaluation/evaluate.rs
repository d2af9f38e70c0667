//! Evaluation of a classifier on a dataset.

use crate::crops::classify::Classifier;
use crate::crops::samples::Examples;
use crate::error::ClassifierError;
use crate::evaluation::metrics::{Evaluation, evaluation};
use artifact::ArtifactError;
use artifact::dataset::{Sample, Split};
use std::collections::BTreeMap;

/// Evaluates a classifier on each split of these samples, without those that have no class.
pub fn evaluate(
    classifier: &Classifier,
    samples: impl Iterator<Item = Result<Sample, ArtifactError>>,
) -> Result<BTreeMap<Split, Evaluation>, ClassifierError> {
    Ok(evaluations(classifier, &Examples::read(samples, classifier.layout())?))
}

/// Evaluates a classifier on each split of examples; an empty split has no evaluation.
pub fn evaluations(classifier: &Classifier, examples: &Examples) -> BTreeMap<Split, Evaluation> {
    let splits = [Split::Train, Split::Validation, Split::Test].map(|split| (split, examples.of(split)));
    let of = |(split, examples): (Split, &[_])| (split, evaluation(examples, &classifier.logits(examples)));
    splits.into_iter().filter(|(_, examples)| !examples.is_empty()).map(of).collect()
}
