//! Result of a training on signatures: a model whose probabilities are calibrated on held-out vehicles.

use crate::crops::network::Logits;
use crate::ensembles::cross_validation::HeldOutLogits;
use crate::ensembles::signature_classifier::answer;
use crate::ensembles::track_metrics::{
    ClassificationMetrics, fitted_correlation, metrics_by_frame_and_track,
};
use crate::ensembles::vehicles::Sightings;
use artifact::dataset::Split;
use artifact::model::{Learner, ModelHeader, Weights};
use artifact::settings::Class;
use serde::Serialize;

/// A trained model with its training results.
#[derive(Debug, Clone, PartialEq)]
pub struct TrainedModel {
    /// Header of the model: its inputs and outputs.
    pub header: ModelHeader,
    /// Parameters of the model, with their temperature.
    pub weights: Weights,
    /// Log loss on held-out vehicles after each round.
    pub curve: Vec<f64>,
    /// Metrics of the model.
    pub metrics: SignatureMetrics,
    /// Logits of each sighting by a training that never saw its vehicle or, for the test split, its scene;
    /// for crosses, which are only for training, those of the model itself.
    pub held_out_logits: Vec<Logits>,
}

/// Content of `metrics.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SignatureMetrics {
    /// Order of rows, columns and probabilities.
    pub classes: [Class; 4],
    /// Seed of the training.
    pub seed: u64,
    /// Number of trees, or of passes over the examples.
    pub rounds: usize,
    /// Temperature: the divisor of the logits.
    pub temperature: f64,
    /// Correlation between the answers of a track's frames.
    pub frame_correlation: f64,
    /// Number of ignored samples without a class.
    pub unlabelled: u64,
    /// Metrics on held-out vehicles, by frame.
    pub unseen_vehicles: ClassificationMetrics,
    /// Metrics on held-out vehicles, by track.
    pub unseen_vehicles_by_track: ClassificationMetrics,
    /// Metrics on scenes of the test split, with vehicles of other scenes; `None` without any.
    pub unseen_scenes: Option<ClassificationMetrics>,
    /// Metrics on scenes of the test split, by track; `None` without any.
    pub unseen_scenes_by_track: Option<ClassificationMetrics>,
}

/// Temperature and correlation of frames that fit the answers for held-out vehicles after a round.
pub(crate) struct ModelCalibration {
    pub(crate) temperature: f64,
    frame_correlation: f64,
    /// Answers for held-out vehicles, divided by the temperature.
    temperature_scaled: Vec<Logits>,
    curve: Vec<f64>,
}

impl ModelCalibration {
    pub(crate) fn fit(
        sightings: &Sightings,
        scored: &[usize],
        held_out: &HeldOutLogits,
        round: usize,
    ) -> Self {
        let (temperature, temperature_scaled) = held_out.temperature_scaled(round);
        let frame_correlation = fitted_correlation(&sightings.select(scored), &temperature_scaled);
        Self { temperature, frame_correlation, temperature_scaled, curve: held_out.curve() }
    }

    /// The model with its metrics.
    pub(crate) fn model(
        self,
        sightings: &Sightings,
        scored: &[usize],
        (learner, weights): (Learner, Weights),
        least_probability: f32,
        (rounds, seed): (usize, u64),
    ) -> TrainedModel {
        let mut held_out_logits: Vec<Logits> =
            sightings.all.iter().map(|seen| answer(&weights, seen)).collect();
        let test = sightings.of(&[Split::Test]);
        let of_test: Vec<Logits> = test.iter().map(|number| held_out_logits[*number]).collect();
        let correlation = self.frame_correlation;
        let of_test = (!test.is_empty())
            .then(|| metrics_by_frame_and_track(&sightings.select(&test), &of_test, correlation));
        let [unseen_scenes, unseen_scenes_by_track] = of_test.map_or([None, None], |parts| parts.map(Some));
        let [unseen_vehicles, unseen_vehicles_by_track] =
            metrics_by_frame_and_track(&sightings.select(scored), &self.temperature_scaled, correlation);
        scored
            .iter()
            .zip(&self.temperature_scaled)
            .for_each(|(number, logits)| held_out_logits[*number] = *logits);
        let metrics = SignatureMetrics {
            classes: Class::ALL,
            seed,
            rounds,
            temperature: self.temperature,
            frame_correlation: correlation,
            unlabelled: sightings.unlabelled,
            unseen_vehicles,
            unseen_vehicles_by_track,
            unseen_scenes,
            unseen_scenes_by_track,
        };
        let header = ModelHeader {
            classes: Class::ALL.to_vec(),
            learner,
            least_probability,
            frame_correlation: correlation as f32,
            attributions: vec![],
        };
        TrainedModel { header, weights, curve: self.curve, metrics, held_out_logits }
    }
}
