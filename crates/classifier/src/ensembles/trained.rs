//! Result of a training on signatures: a model whose probabilities are calibrated on held-out vehicles.

use crate::crops::network::Logits;
use crate::ensembles::answers::{Part, fitted_correlation, parts};
use crate::ensembles::held_out::HeldOut;
use crate::ensembles::signature_classifier::answer;
use crate::ensembles::vehicles::Sightings;
use artifact::dataset::Split;
use artifact::model::{Learner, ModelHeader, Weights};
use artifact::settings::Class;
use serde::Serialize;

/// A trained model with its training results.
#[derive(Debug, Clone, PartialEq)]
pub struct Trained {
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
    pub told: Vec<Logits>,
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
    pub unseen_vehicles: Part,
    /// Metrics on held-out vehicles, by track.
    pub unseen_vehicles_by_track: Part,
    /// Metrics on scenes of the test split, with vehicles of other scenes; `None` without any.
    pub unseen_scenes: Option<Part>,
    /// Metrics on scenes of the test split, by track; `None` without any.
    pub unseen_scenes_by_track: Option<Part>,
}

/// Temperature and correlation of frames that fit the answers for held-out vehicles after a round.
pub(crate) struct Calibrated {
    pub(crate) temperature: f64,
    frame_correlation: f64,
    /// Answers for held-out vehicles, divided by the temperature.
    cooled: Vec<Logits>,
    curve: Vec<f64>,
}

impl Calibrated {
    pub(crate) fn on(sightings: &Sightings, judged: &[usize], held_out: &HeldOut, round: usize) -> Self {
        let (temperature, cooled) = held_out.cooled(round);
        let frame_correlation = fitted_correlation(&sightings.seen(judged), &cooled);
        Self { temperature, frame_correlation, cooled, curve: held_out.curve() }
    }

    /// The model with its metrics.
    pub(crate) fn model(
        self,
        sightings: &Sightings,
        judged: &[usize],
        (learner, weights): (Learner, Weights),
        least_probability: f32,
        (rounds, seed): (usize, u64),
    ) -> Trained {
        let mut told: Vec<Logits> = sightings.all.iter().map(|seen| answer(&weights, seen)).collect();
        let test = sightings.of(&[Split::Test]);
        let of_test: Vec<Logits> = test.iter().map(|number| told[*number]).collect();
        let correlation = self.frame_correlation;
        let of_test = (!test.is_empty()).then(|| parts(&sightings.seen(&test), &of_test, correlation));
        let [unseen_scenes, unseen_scenes_by_track] = of_test.map_or([None, None], |parts| parts.map(Some));
        let [unseen_vehicles, unseen_vehicles_by_track] =
            parts(&sightings.seen(judged), &self.cooled, correlation);
        judged.iter().zip(&self.cooled).for_each(|(number, logits)| told[*number] = *logits);
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
        Trained { header, weights, curve: self.curve, metrics, told }
    }
}
