//! Promises of saving and loading.

mod toy;

use artifact::Provenance;
use artifact::dataset::Crop;
use artifact::model::{Learner, ModelHeader, NetworkShape, Weights};
use classifier::{CURVES_FILE, Classifier, ClassifierError, METRICS_FILE, WEIGHTS_FILE, load_model};
use classifier_training::{TrainSettings, Trained, save_model, train};
use std::sync::LazyLock;
use toy::{FORMAT, SETTINGS, samples};

static TRAINED: LazyLock<Trained> = LazyLock::new(|| {
    let settings = TrainSettings { iterations: 10, ..SETTINGS };
    train(samples(200).into_iter().map(Ok), &FORMAT, &settings, 1, &mut |_| ())
        .expect("the toy task can be trained")
});

fn shape(header: &mut ModelHeader) -> Option<&mut NetworkShape> {
    match &mut header.learner {
        Learner::CropNetwork(shape) => Some(shape),
        Learner::BoostedTrees { .. } | Learner::ProfileNetworks(_) | Learner::TreesAndNetworks { .. } => None,
    }
}

fn trained_bytes() -> Option<&'static [u8]> {
    match &TRAINED.weights {
        Weights::Network { safetensors } => Some(safetensors),
        Weights::Trees(_) | Weights::Profile(_) | Weights::Both { .. } => None,
    }
}

fn crops() -> Vec<Crop> {
    samples(50).into_iter().filter_map(|s| s.crop).collect()
}

#[test]
fn a_saved_and_loaded_model_gives_identical_probabilities() {
    let folder = tempfile::tempdir().unwrap();
    save_model(folder.path(), &TRAINED, &Provenance::default()).unwrap();
    let before =
        Classifier::from_model(&TRAINED.header, &TRAINED.weights).unwrap().probabilities(&crops()).unwrap();
    let from_folder = Classifier::open(folder.path()).unwrap();
    let from_file = Classifier::open(&folder.path().join(WEIGHTS_FILE)).unwrap();
    assert_eq!(from_folder.probabilities(&crops()).unwrap(), before);
    assert_eq!(from_file.probabilities(&crops()).unwrap(), before);
    assert!(load_model(folder.path()).unwrap().1 == TRAINED.weights);
}

#[test]
fn probabilities_are_positive_and_sum_to_one() {
    let classifier = Classifier::from_model(&TRAINED.header, &TRAINED.weights).unwrap();
    for row in classifier.probabilities(&crops()).unwrap() {
        assert!(row.iter().all(|p| *p >= 0.0));
        // Four roundings to f32 of numbers below 1: half of 2⁻²³ each at most.
        assert!((row.iter().sum::<f32>() - 1.0).abs() <= 4.0 * f32::EPSILON);
    }
    assert!(classifier.probabilities(&[]).unwrap().is_empty());
}

#[test]
fn a_crop_is_answered_alike_alone_and_among_others() {
    let classifier = Classifier::from_model(&TRAINED.header, &TRAINED.weights).unwrap();
    let together = classifier.probabilities(&crops()).unwrap();
    let alone: Vec<[f32; 4]> =
        crops().into_iter().flat_map(|c| classifier.probabilities(&[c]).unwrap()).collect();
    assert_eq!(together, alone);
}

#[test]
fn a_crop_of_another_size_is_refused_by_its_index() {
    let classifier = Classifier::from_model(&TRAINED.header, &TRAINED.weights).unwrap();
    let mut crops = crops();
    crops[33].pixels.truncate(100);
    let error = classifier.probabilities(&crops).unwrap_err();
    assert!(matches!(error, ClassifierError::CropPixels { index: 33, found: 100, side: 48 }));
}

#[test]
fn metrics_and_curves_stand_beside_the_weights() {
    let folder = tempfile::tempdir().unwrap();
    save_model(folder.path(), &TRAINED, &Provenance::default()).unwrap();
    let metrics = std::fs::read_to_string(folder.path().join(METRICS_FILE)).unwrap();
    let metrics: serde_json::Value = serde_json::from_str(&metrics).unwrap();
    for split in ["train", "validation", "test"] {
        let evaluation = &metrics["splits"][split];
        assert!(evaluation["accuracy"].is_f64(), "{metrics}");
        assert_eq!(evaluation["confusion"].as_array().unwrap().len(), 4);
        assert_eq!(evaluation["calibration"]["bins"].as_array().unwrap().len(), 10);
    }
    assert_eq!(metrics["seed"], 1);
    let curves = std::fs::read_to_string(folder.path().join(CURVES_FILE)).unwrap();
    assert_eq!(curves.lines().count(), 1 + TRAINED.curves.len());
    let mut names: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|f| f.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, [CURVES_FILE, METRICS_FILE, WEIGHTS_FILE]);
}

#[test]
fn a_training_that_ends_before_its_weights_leaves_none_of_an_earlier_one() {
    let folder = tempfile::tempdir().unwrap();
    let weights = folder.path().join(WEIGHTS_FILE);
    std::fs::write(&weights, "of an earlier training").unwrap();
    // The curves, which are written between metrics and weights, have no place.
    std::fs::create_dir(folder.path().join(CURVES_FILE)).unwrap();
    assert!(save_model(folder.path(), &TRAINED, &Provenance::default()).is_err());
    assert!(folder.path().join(METRICS_FILE).exists() && !weights.exists());
}

#[test]
fn a_model_of_another_network_is_refused() {
    let refused = |change: fn(&mut ModelHeader)| {
        let mut header = TRAINED.header.clone();
        change(&mut header);
        Classifier::from_model(&header, &TRAINED.weights).unwrap_err()
    };
    assert!(matches!(
        refused(|h| shape(h).unwrap().architecture = "resnet".into()),
        ClassifierError::Architecture { .. }
    ));
    assert!(matches!(refused(|h| h.classes.reverse()), ClassifierError::Classes { .. }));
    assert!(matches!(
        refused(|h| h.least_probability = 1.5),
        ClassifierError::Setting { setting: "least_probability", .. }
    ));
    assert!(matches!(
        refused(|h| h.frame_correlation = -0.1),
        ClassifierError::Setting { setting: "frame_correlation", .. }
    ));
    assert!(matches!(refused(|h| shape(h).unwrap().channels = vec![4, 8]), ClassifierError::Channels { .. }));
    assert!(matches!(
        refused(|h| shape(h).unwrap().channels[1] = u32::MAX),
        ClassifierError::Channels { .. }
    ));
    assert!(matches!(refused(|h| shape(h).unwrap().channels[1] = 9), ClassifierError::TensorShape { .. }));
    assert!(matches!(refused(|h| shape(h).unwrap().input_side = 32), ClassifierError::TensorShape { .. }));
    assert!(matches!(refused(|h| shape(h).unwrap().input_side = 0), ClassifierError::Setting { .. }));
    assert!(matches!(refused(|h| shape(h).unwrap().format.side = u32::MAX), ClassifierError::Setting { .. }));
}

#[test]
fn weights_that_do_not_fit_are_refused_by_name() {
    let refused = |change: fn(&mut String)| {
        let bytes = trained_bytes().unwrap();
        let length = u64::from_le_bytes(bytes[..8].try_into().unwrap()) as usize;
        let mut header = String::from_utf8(bytes[8..8 + length].to_vec()).unwrap();
        change(&mut header);
        let mut safetensors = (header.len() as u64).to_le_bytes().to_vec();
        safetensors.extend(header.as_bytes());
        safetensors.extend(&bytes[8 + length..]);
        Classifier::from_model(&TRAINED.header, &Weights::Network { safetensors }).unwrap_err()
    };
    let renamed = refused(|h| *h = h.replace("linear.bias", "linear.bios"));
    assert!(matches!(renamed, ClassifierError::TensorUnknown(name) if name == "linear.bios"));
    let other_type =
        refused(|h| *h = h.replace("\"dtype\":\"F32\",\"shape\":[4]", "\"dtype\":\"I32\",\"shape\":[4]"));
    assert!(matches!(other_type, ClassifierError::TensorType { .. }), "{other_type}");
    let other_shape = refused(|h| *h = h.replace("[4,1,3,3]", "[1,4,3,3]"));
    assert!(matches!(other_shape, ClassifierError::TensorShape { .. }), "{other_shape}");
    let empty = Weights::Network { safetensors: b"\x02\0\0\0\0\0\0\0{}".to_vec() };
    let missing = Classifier::from_model(&TRAINED.header, &empty).unwrap_err();
    assert!(matches!(missing, ClassifierError::TensorMissing(name) if name == "blocks.0.convolution.weight"));
}

#[test]
fn a_weight_that_is_not_a_number_is_refused() {
    let mut safetensors = trained_bytes().unwrap().to_vec();
    let end = safetensors.len();
    safetensors[end - 4..].copy_from_slice(&f32::NAN.to_le_bytes());
    let error = Classifier::from_model(&TRAINED.header, &Weights::Network { safetensors }).unwrap_err();
    assert!(matches!(error, ClassifierError::TensorValue { .. }), "{error}");
}

/// Damage is refused or harmless (a flipped bit of a weight is another weight; the artifact's checksum finds
/// that one).
#[test]
fn damaged_weights_never_panic() {
    let bytes = trained_bytes().unwrap();
    let header = 8 + u64::from_le_bytes(bytes[..8].try_into().unwrap()) as usize;
    let build =
        |safetensors: Vec<u8>| Classifier::from_model(&TRAINED.header, &Weights::Network { safetensors });
    for length in (0..header + 40).chain([bytes.len() - 1]) {
        assert!(build(bytes[..length].to_vec()).is_err(), "cut to {length}");
    }
    for bit in 0..8 * header {
        let mut damaged = bytes.to_vec();
        damaged[bit / 8] ^= 1 << (bit % 8);
        let _ = build(damaged);
    }
}

#[test]
fn a_cut_or_flipped_model_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    save_model(folder.path(), &TRAINED, &Provenance::default()).unwrap();
    let file = folder.path().join(WEIGHTS_FILE);
    let bytes = std::fs::read(&file).unwrap();
    for at in (0..bytes.len()).step_by(211) {
        std::fs::write(&file, &bytes[..at]).unwrap();
        assert!(matches!(Classifier::open(&file), Err(ClassifierError::Artifact(_))), "cut to {at}");
        let mut flipped = bytes.clone();
        flipped[at] ^= 1;
        std::fs::write(&file, &flipped).unwrap();
        assert!(matches!(Classifier::open(&file), Err(ClassifierError::Artifact(_))), "byte {at} flipped");
    }
    let missing = Classifier::open(&folder.path().join("nothing.model")).unwrap_err();
    assert!(matches!(missing, ClassifierError::Artifact(e) if e.is_system()));
}
