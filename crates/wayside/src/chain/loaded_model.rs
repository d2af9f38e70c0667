//! A classifier's model as a run uses it: what it looks at is taken from the map, its answers are kept with
//! its name.

use crate::host::failure::Failure;
use artifact::classes::ClassesHeader;
use artifact::dataset::{Crop, Sample};
use artifact::model::{Learner, ModelHeader, Weights};
use artifact::points::PointsFrame;
use artifact::rdm::RdmFrame;
use artifact::settings::Class;
use classifier::{Classifier, SignatureClassifier};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::sync::OnceLock;

/// Crops held at once: whole passes of the network, 20 MB.
const CROPS: usize = 100;

/// A classifier and what names it in a cache key.
pub struct LoadedModel {
    header: ModelHeader,
    weights: Weights,
    pub(crate) hash: String,
    ready: OnceLock<Result<Ready, String>>,
}

/// A model that answers.
enum Ready {
    Crops(Classifier),
    Signatures(SignatureClassifier),
}

impl LoadedModel {
    /// Reads a model file, or the one in a model folder.
    pub(crate) fn read(place: &Path) -> Result<Self, Failure> {
        classifier::load_model(place).map(Self::of).map_err(of_classifier)
    }

    /// Reads a model from the bytes of a model file.
    pub(crate) fn of_bytes(bytes: &'static [u8]) -> Result<Self, Failure> {
        classifier::model_of_bytes(bytes).map(Self::of).map_err(of_classifier)
    }

    fn of((header, weights): (ModelHeader, Weights)) -> Self {
        let hash = artifact::envelope::fingerprint(&(&header, &weights));
        Self { header, weights, hash, ready: OnceLock::new() }
    }

    /// Header of the `.classes` artifact: the classes that the probabilities are of.
    pub(crate) fn classes_header(&self) -> ClassesHeader {
        ClassesHeader { classes: self.header.classes.clone() }
    }

    /// Rule by which a class is told from probabilities.
    pub(crate) fn rule(&self) -> ClassRule {
        let ModelHeader { least_probability, frame_correlation, .. } = self.header;
        ClassRule { least_probability, frame_correlation }
    }

    /// Probabilities of each object of a map, in the order of the points' objects.
    pub(crate) fn classify(
        &self,
        receiver: &dsp::Receiver,
        rdm: &RdmFrame,
        points: &PointsFrame,
    ) -> Result<Vec<[f32; 4]>, Failure> {
        match (self.ready()?, &self.header.learner) {
            (Ready::Signatures(trees), _) => by_signatures(trees, receiver, rdm, points),
            (Ready::Crops(network), Learner::CropNetwork(shape)) => {
                let cropper = receiver.cropper(rdm, &shape.format).map_err(Failure::refused)?;
                by_crops(network, &cropper, points)
            }
            (Ready::Crops(_), Learner::BoostedTrees { .. }) => {
                Err(Failure::refused("trees look at no crops"))
            }
        }
    }

    /// Probabilities of the samples of a dataset.
    pub(crate) fn of_samples(&self, samples: &[Sample]) -> Result<Vec<[f32; 4]>, Failure> {
        match self.ready()? {
            Ready::Signatures(trees) => {
                Ok(samples.iter().map(|s| trees.probabilities(&s.signature)).collect())
            }
            Ready::Crops(network) => {
                let crops: Vec<Crop> = samples.iter().map(crop_of).collect::<Result<_, _>>()?;
                network.probabilities(&crops).map_err(Failure::refused)
            }
        }
    }

    fn ready(&self) -> Result<&Ready, Failure> {
        let (header, weights) = (&self.header, &self.weights);
        let build = || {
            match header.learner {
                Learner::CropNetwork(_) => Classifier::from_model(header, weights).map(Ready::Crops),
                Learner::BoostedTrees { .. } => {
                    SignatureClassifier::from_model(header, weights).map(Ready::Signatures)
                }
            }
            .map_err(|e| e.to_string())
        };
        self.ready.get_or_init(build).as_ref().map_err(Failure::refused)
    }
}

fn crop_of(sample: &Sample) -> Result<Crop, Failure> {
    let without = || {
        Failure::refused(format!(
            "sample `{}` has no image: the recipe of this dataset says crops = false",
            sample.id
        ))
    };
    sample.crop.clone().ok_or_else(without)
}

fn by_signatures(
    trees: &SignatureClassifier,
    receiver: &dsp::Receiver,
    rdm: &RdmFrame,
    points: &PointsFrame,
) -> Result<Vec<[f32; 4]>, Failure> {
    let signatures = receiver.signatures(rdm).map_err(Failure::refused)?;
    let objects = 0..points.objects.len() as u32;
    let of = |object| signatures.of(points, object).map(|signature| trees.probabilities(&signature));
    objects
        .into_par_iter()
        .map(of)
        .collect::<Vec<_>>()
        .into_iter()
        .collect::<Result<_, _>>()
        .map_err(Failure::refused)
}

fn by_crops(
    network: &Classifier,
    cropper: &dsp::Cropper<'_>,
    points: &PointsFrame,
) -> Result<Vec<[f32; 4]>, Failure> {
    let mut rows = Vec::with_capacity(points.objects.len());
    let objects: Vec<u32> = (0..).take(points.objects.len()).collect();
    for objects in objects.chunks(CROPS) {
        let crops: Vec<_> = objects.par_iter().map(|object| cropper.crop_among(points, *object)).collect();
        let crops = crops.into_iter().collect::<Result<Vec<_>, _>>().map_err(Failure::refused)?;
        rows.extend(network.probabilities(&crops).map_err(Failure::refused)?);
    }
    Ok(rows)
}

/// A model was refused, or the system refused it.
pub(crate) fn of_classifier(error: classifier::ClassifierError) -> Failure {
    match error {
        classifier::ClassifierError::Artifact(error) => error.into(),
        other => Failure::refused(other),
    }
}

/// Rule by which a class is told from probabilities.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct ClassRule {
    /// The likeliest class is told from here on; below it the answer is "unknown".
    pub(crate) least_probability: f32,
    /// Correlation of the frames of a track: 0 where they have nothing in common, 1 where all.
    pub(crate) frame_correlation: f32,
}

impl ClassRule {
    /// The class that is told, or "unknown".
    pub(crate) fn told(&self, probabilities: &[f32; 4]) -> Predicted {
        let likeliest =
            (0..4).fold(0, |best, i| if probabilities[i] > probabilities[best] { i } else { best });
        if probabilities[likeliest] >= self.least_probability {
            Predicted::Class(Class::ALL[likeliest])
        } else {
            Predicted::Unknown
        }
    }

    /// Probabilities of a track from the sums of their logarithms over its frames. Frames of one vehicle have
    /// much in common, so n of them count as n/(1 + (n − 1)ρ), as the mean of values of correlation ρ does.
    pub(crate) fn joined(&self, log_sums: &[f64; 4], frames: u32) -> [f32; 4] {
        let more = f64::from(frames.max(1) - 1);
        let per_frame = 1.0 / (1.0 + more * f64::from(self.frame_correlation));
        let largest = log_sums.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let powers = log_sums.map(|sum| ((sum - largest) * per_frame).exp());
        let total: f64 = powers.iter().sum();
        powers.map(|power| (power / total) as f32)
    }
}

/// Answer of a classifier about a vehicle; JSON has its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Predicted {
    /// No class is likely enough.
    Unknown,
    /// The likeliest class.
    #[serde(untagged)]
    Class(Class),
}

impl Predicted {
    /// The class as people write it, or "unknown".
    pub fn name(self) -> &'static str {
        match self {
            Self::Unknown => "unknown",
            Self::Class(class) => class.name(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_that_agree_make_a_track_surer_and_frames_that_are_the_same_do_not() {
        let p = [0.6_f64, 0.2, 0.1, 0.1];
        let joined = |frames: u32, frame_correlation: f32| {
            let rule = ClassRule { least_probability: 0.5, frame_correlation };
            rule.joined(&p.map(|p| f64::from(frames) * p.ln()), frames)[0]
        };
        assert!((joined(1, 0.5) - 0.6).abs() < 1e-6 && (joined(9, 1.0) - 0.6).abs() < 1e-6);
        // Independent: 0.6³/(0.6³ + 0.2³ + 2·0.1³).
        assert!((joined(3, 0.0) - 0.216 / 0.226).abs() < 1e-6);
        assert!(joined(3, 0.5) > 0.6 && joined(3, 0.5) < joined(3, 0.0));
    }

    #[test]
    fn a_class_that_is_not_likely_enough_is_unknown() {
        let rule = ClassRule { least_probability: 0.5, frame_correlation: 0.5 };
        assert_eq!(rule.told(&[0.1, 0.2, 0.6, 0.1]), Predicted::Class(Class::Truck));
        assert_eq!(rule.told(&[0.3, 0.2, 0.4, 0.1]), Predicted::Unknown);
    }
}
