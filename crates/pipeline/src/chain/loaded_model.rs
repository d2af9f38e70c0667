//! A classifier's model in a run: its inputs are taken from the map, and its answers are cached under its
//! hash.

use crate::chain::class_rule::ClassRule;
use crate::host::failure::Failure;
use artifact::classes::ClassesHeader;
use artifact::dataset::{Crop, Sample};
use artifact::model::{Learner, ModelHeader, Weights};
use artifact::points::PointsFrame;
use artifact::rdm::RdmFrame;
use classifier::{Classifier, ClassifierError, SignatureClassifier};
use rayon::prelude::*;
use std::path::Path;
use std::sync::OnceLock;

/// Crops held at once: whole passes of the network, 20 MB.
const CROPS: usize = 100;

/// A classifier and its hash for cache keys.
pub struct LoadedModel {
    header: ModelHeader,
    weights: Weights,
    hash: String,
    ready: OnceLock<Result<Ready, ClassifierError>>,
}

/// A model ready to classify.
enum Ready {
    Crops(Classifier),
    Signatures(SignatureClassifier),
}

impl LoadedModel {
    /// Reads a model file, or the one in a model folder; an unusable model is refused at once, by name.
    pub fn read(place: &Path) -> Result<Self, Failure> {
        let model = classifier::load_model(place).map(Self::of).map_err(classifier_failure_about(place))?;
        model.ready().map_err(|failure| failure.about(place))?;
        // The files beside the weights are inputs like the weights.
        let folder = if place.is_dir() { Some(place) } else { place.parent() };
        let beside =
            folder.into_iter().flat_map(|folder| classifier::MODEL_FILES.map(|name| folder.join(name)));
        beside.for_each(|file| artifact::inputs::register_path(&file));
        Ok(model)
    }

    /// Reads a model from the bytes of a model file.
    pub(crate) fn of_bytes(bytes: &'static [u8]) -> Result<Self, Failure> {
        classifier::model_of_bytes(bytes).map(Self::of).map_err(classifier_failure)
    }

    fn of((header, weights): (ModelHeader, Weights)) -> Self {
        let hash = artifact::envelope::fingerprint(&(&header, &weights));
        Self { header, weights, hash, ready: OnceLock::new() }
    }

    /// Hash of the model, for keys of a cache.
    pub fn hash(&self) -> &str {
        &self.hash
    }

    /// Header of the `.classes` artifact: the classes in the order of the probabilities.
    pub(crate) fn classes_header(&self) -> ClassesHeader {
        ClassesHeader { classes: self.header.classes.clone() }
    }

    /// Rule that decides for a class from probabilities.
    pub fn rule(&self) -> ClassRule {
        let ModelHeader { least_probability, frame_correlation, .. } = self.header;
        ClassRule { least_probability, frame_correlation }
    }

    /// Probabilities of each object of a map, in the order of the points' objects.
    pub fn classify(
        &self,
        receiver: &dsp::Receiver,
        rdm: &RdmFrame,
        points: &PointsFrame,
    ) -> Result<Vec<[f32; 4]>, Failure> {
        match (self.ready()?, &self.header.learner) {
            (Ready::Signatures(model), _) => by_signatures(model, receiver, rdm, points),
            (Ready::Crops(network), Learner::CropNetwork(shape)) => {
                let cropper = receiver.cropper(rdm, &shape.format).map_err(Failure::refused)?;
                by_crops(network, &cropper, points)
            }
            (Ready::Crops(_), _) => Err(Failure::refused("a model of signatures looks at no crops")),
        }
    }

    /// Probabilities of the samples of a dataset.
    pub fn of_samples(&self, samples: &[Sample]) -> Result<Vec<[f32; 4]>, Failure> {
        match self.ready()? {
            Ready::Signatures(model) => {
                Ok(samples.iter().map(|s| model.probabilities(&s.signature)).collect())
            }
            Ready::Crops(network) => {
                let crops: Vec<Crop> = samples.iter().map(crop_of).collect::<Result<_, _>>()?;
                network.probabilities(&crops).map_err(Failure::refused)
            }
        }
    }

    fn ready(&self) -> Result<&Ready, Failure> {
        let (header, weights) = (&self.header, &self.weights);
        let build = || match header.learner {
            Learner::CropNetwork(_) => Classifier::from_model(header, weights).map(Ready::Crops),
            Learner::BoostedTrees { .. } | Learner::ProfileNetworks(_) | Learner::TreesAndNetworks { .. } => {
                SignatureClassifier::from_model(header, weights).map(Ready::Signatures)
            }
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
    model: &SignatureClassifier,
    receiver: &dsp::Receiver,
    rdm: &RdmFrame,
    points: &PointsFrame,
) -> Result<Vec<[f32; 4]>, Failure> {
    let signatures = receiver.signatures(rdm).map_err(Failure::refused)?;
    let objects = 0..points.objects.len() as u32;
    let of = |object| signatures.of(points, object).map(|signature| model.probabilities(&signature));
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

/// Converts a classifier's refusal of the content of `place`.
pub fn classifier_failure_about(place: &Path) -> impl Fn(classifier::ClassifierError) -> Failure + '_ {
    move |error| classifier_failure(error).about(place)
}

/// Converts a classifier's error: a refused model, or an error of the system.
pub fn classifier_failure(error: classifier::ClassifierError) -> Failure {
    match error {
        classifier::ClassifierError::Artifact(error) => error.into(),
        other => Failure::refused(other),
    }
}
