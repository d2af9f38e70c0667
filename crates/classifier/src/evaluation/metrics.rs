//! Metrics of a classifier: accuracy, confusion, log loss and calibration of a set of answers.

use crate::crops::classify::softmax;
use crate::crops::network::Logits;
use crate::crops::samples::Example;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Bins of the reliability diagram over the answer's probability, which is at least ¼.
const BINS: usize = 10;
/// Normal quantile of a two-sided 95 % interval.
const QUANTILE_95: f64 = 1.959_964;

/// Metrics of the answers to a set of labelled crops.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Evaluation {
    /// Number of labelled crops.
    pub samples: u64,
    /// Share of them whose likeliest class is the true one.
    pub accuracy: f64,
    /// Wilson's 95 % interval of the accuracy (1927), for independent samples.
    pub accuracy_interval: [f64; 2],
    /// Row: true class, column: likeliest class.
    pub confusion: [[u64; 4]; 4],
    /// Accuracy on the crops of each class; `None` without any.
    pub class_accuracy: [Option<f64>; 4],
    /// Mean of −ln of the true class's probability; ln 4 = 1.386 for uniform probabilities.
    pub log_loss: f64,
    /// Calibration of the probabilities.
    pub calibration: Calibration,
    /// Accuracy by vehicle model.
    pub by_model: BTreeMap<String, ModelAccuracy>,
}

/// Reliability of the probability given to the likeliest class.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// Mean of |accuracy − confidence| over the bins, weighted by their counts (Naeini, Cooper & Hauskrecht
    /// 2015).
    pub expected_error: f64,
    /// Ten bins of equal width over 0 to 1.
    pub bins: Vec<ReliabilityBin>,
}

/// One bin of a reliability diagram.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReliabilityBin {
    /// Range of probabilities in the bin.
    pub probability: [f64; 2],
    /// Number of answers in the bin.
    pub samples: u64,
    /// Mean probability of the answers; `None` without any.
    pub confidence: Option<f64>,
    /// Share of right ones; `None` without any.
    pub accuracy: Option<f64>,
}

/// Answers on the crops of one vehicle model.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ModelAccuracy {
    /// Number of crops.
    pub samples: u64,
    /// Number of right answers.
    pub right: u64,
}

/// Compares the answers with the truth; `logits` are in the order of `examples`.
pub(crate) fn evaluation(examples: &[Example], logits: &[Logits]) -> Evaluation {
    let answers: Vec<Answer> = examples.iter().zip(logits).map(|(e, l)| Answer::new(e, *l)).collect();
    let right = answers.iter().filter(|a| a.is_right()).count() as u64;
    let confusion = confusion(&answers);
    Evaluation {
        samples: answers.len() as u64,
        accuracy: ratio(right, answers.len() as u64).unwrap_or(0.0),
        accuracy_interval: wilson_interval(right, answers.len() as u64),
        confusion,
        class_accuracy: std::array::from_fn(|c| ratio(confusion[c][c], confusion[c].iter().sum())),
        log_loss: log_loss(examples.iter().map(|e| e.class).zip(logits.iter().copied())),
        calibration: calibration(&answers),
        by_model: by_model(examples, &answers),
    }
}

/// Mean of −ln p of the true class, over pairs of class index and logits.
pub fn log_loss(answers: impl ExactSizeIterator<Item = (usize, Logits)>) -> f64 {
    let count = answers.len().max(1) as f64;
    answers.map(|(class, logits)| -log_softmax(logits.map(f64::from))[class]).sum::<f64>() / count
}

/// Share of the pairs of class index and logits in which the class has the largest logit.
pub fn accuracy(answers: impl ExactSizeIterator<Item = (usize, Logits)>) -> f64 {
    let count = answers.len().max(1) as f64;
    answers.filter(|(class, logits)| likeliest(&logits.map(f64::from)) == *class).count() as f64 / count
}

/// Logarithm of the softmax, computed without the softmax's underflow.
pub fn log_softmax(logits: [f64; 4]) -> [f64; 4] {
    let largest = logits.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = logits.iter().map(|l| (l - largest).exp()).sum();
    logits.map(|l| l - largest - sum.ln())
}

struct Answer {
    truth: usize,
    likeliest: usize,
    confidence: f64,
}

impl Answer {
    fn new(example: &Example, logits: Logits) -> Self {
        let probabilities = softmax(logits);
        let likeliest = likeliest(&probabilities);
        Self { truth: example.class, likeliest, confidence: probabilities[likeliest] }
    }

    fn is_right(&self) -> bool {
        self.truth == self.likeliest
    }
}

/// The first of the largest values.
fn likeliest(values: &[f64; 4]) -> usize {
    (1..4).fold(0, |best, i| if values[i] > values[best] { i } else { best })
}

fn confusion(answers: &[Answer]) -> [[u64; 4]; 4] {
    let mut confusion = [[0; 4]; 4];
    for answer in answers {
        confusion[answer.truth][answer.likeliest] += 1;
    }
    confusion
}

fn calibration(answers: &[Answer]) -> Calibration {
    let bins: Vec<ReliabilityBin> = (0..BINS).map(|bin| reliability(answers, bin)).collect();
    let gap = |b: &ReliabilityBin| Some(b.samples as f64 * (b.accuracy? - b.confidence?).abs());
    let expected_error = bins.iter().filter_map(gap).sum::<f64>() / answers.len().max(1) as f64;
    Calibration { expected_error, bins }
}

fn reliability(answers: &[Answer], bin: usize) -> ReliabilityBin {
    let bin_of = |a: &Answer| ((a.confidence * BINS as f64) as usize).min(BINS - 1);
    let inside: Vec<&Answer> = answers.iter().filter(|a| bin_of(a) == bin).collect();
    let samples = inside.len() as u64;
    let confidence: f64 = inside.iter().map(|a| a.confidence).sum();
    let right = inside.iter().filter(|a| a.is_right()).count() as u64;
    ReliabilityBin {
        probability: [bin as f64 / BINS as f64, (bin + 1) as f64 / BINS as f64],
        samples,
        confidence: (samples > 0).then(|| confidence / samples as f64),
        accuracy: ratio(right, samples),
    }
}

fn by_model(examples: &[Example], answers: &[Answer]) -> BTreeMap<String, ModelAccuracy> {
    let mut models = BTreeMap::<String, ModelAccuracy>::new();
    for (example, answer) in examples.iter().zip(answers) {
        let model = models.entry(example.model.clone()).or_default();
        model.samples += 1;
        model.right += u64::from(answer.is_right());
    }
    models
}

fn ratio(part: u64, whole: u64) -> Option<f64> {
    (whole > 0).then(|| part as f64 / whole as f64)
}

/// Centre (p + z²/2n) / (1 + z²/n), half width z/(1 + z²/n) · √(p(1−p)/n + z²/4n²).
fn wilson_interval(right: u64, samples: u64) -> [f64; 2] {
    let Some(p) = ratio(right, samples) else { return [0.0, 1.0] };
    let n = samples as f64;
    let z2 = QUANTILE_95 * QUANTILE_95;
    let centre = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
    let half = QUANTILE_95 / (1.0 + z2 / n) * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt();
    [(centre - half).max(0.0), (centre + half).min(1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example(class: usize) -> Example {
        Example { pooled: vec![], class, model: format!("model-{class}") }
    }

    /// Logits whose softmax gives `p` to `class` and the rest evenly to the others.
    fn sure(class: usize, p: f64) -> Logits {
        std::array::from_fn(|c| if c == class { p } else { (1.0 - p) / 3.0 }.ln() as f32)
    }

    #[test]
    fn a_small_table_is_counted_as_by_hand() {
        let examples = [example(0), example(0), example(1), example(3)];
        let logits = [sure(0, 0.95), sure(1, 0.55), sure(1, 0.95), sure(3, 0.95)];
        let e = evaluation(&examples, &logits);
        assert_eq!(e.confusion, [[1, 1, 0, 0], [0, 1, 0, 0], [0; 4], [0, 0, 0, 1]]);
        assert_eq!((e.samples, e.accuracy), (4, 0.75));
        assert_eq!(e.class_accuracy, [Some(0.5), Some(1.0), None, Some(1.0)]);
        assert_eq!(e.by_model["model-0"], ModelAccuracy { samples: 2, right: 1 });
        // f32 logits hold p to 1e-7 or so.
        let log_loss = -(3.0 * 0.95_f64.ln() + 0.15_f64.ln()) / 4.0;
        assert!((e.log_loss - log_loss).abs() < 1e-6);
        // Three answers of 0.95, all right: gap 0.05; one of 0.55, wrong: gap 0.55.
        assert!((e.calibration.expected_error - (3.0 * 0.05 + 0.55) / 4.0).abs() < 1e-6);
        assert_eq!(
            e.calibration.bins.iter().map(|b| b.samples).collect::<Vec<_>>(),
            [0, 0, 0, 0, 0, 1, 0, 0, 0, 3]
        );
    }

    #[test]
    fn the_interval_of_an_accuracy_is_that_of_the_textbook() {
        // Wilson's interval of 81 of 263 is 0.2553 to 0.3662 (Newcombe 1998, Table I, method 3).
        let [low, high] = wilson_interval(81, 263);
        assert!((low - 0.2553).abs() < 5e-5 && (high - 0.3662).abs() < 5e-5, "{low} {high}");
        assert_eq!(wilson_interval(0, 0), [0.0, 1.0]);
    }

    #[test]
    fn a_hopeless_logit_has_a_finite_log_loss() {
        assert!((log_softmax([0.0, 0.0, 0.0, 2000.0])[0] + 2000.0).abs() < 1e-9);
    }
}
