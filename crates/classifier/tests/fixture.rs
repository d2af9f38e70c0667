//! Promises of classifying, of the project's own model.
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use artifact::dataset::Crop;
use classifier::{Classifier, ClassifierError, WEIGHTS_FILE, load_model};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::path::{Path, PathBuf};

fn model() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/paper-network.model")
}

fn classifier() -> Classifier {
    Classifier::open(&model()).unwrap()
}

/// Bright squares of several sizes on dark noise.
fn crops(classifier: &Classifier) -> Vec<Crop> {
    let side = classifier.layout().crop_side;
    let mut generator = ChaCha8Rng::seed_from_u64(3);
    let mut crop = |number: usize| {
        let width = 5 + 9 * number;
        let begin = generator.random_range(0..side - width);
        let lit = |at: usize| (begin..begin + width).contains(&at);
        let level =
            |at: usize| if lit(at / side) && lit(at % side) { 200 } else { generator.random_range(0..60) };
        Crop { pixels: (0..side * side).map(level).collect(), range_m: 40.0, radial_velocity_mps: 0.0 }
    };
    (0..24).map(&mut crop).collect()
}

#[test]
fn probabilities_are_positive_and_sum_to_one() {
    let classifier = classifier();
    for row in classifier.probabilities(&crops(&classifier)).unwrap() {
        assert!(row.iter().all(|p| *p >= 0.0));
        // Four roundings to f32 of numbers below 1: half of 2⁻²³ each at most.
        assert!((row.iter().sum::<f32>() - 1.0).abs() <= 4.0 * f32::EPSILON);
    }
    assert!(classifier.probabilities(&[]).unwrap().is_empty());
}

#[test]
fn a_crop_is_answered_alike_alone_among_others_and_on_any_number_of_threads() {
    let classifier = classifier();
    let crops = crops(&classifier);
    let together = classifier.probabilities(&crops).unwrap();
    let alone: Vec<[f32; 4]> =
        crops.iter().flat_map(|c| classifier.probabilities(std::slice::from_ref(c)).unwrap()).collect();
    assert_eq!(together, alone);
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(one_thread.install(|| classifier.probabilities(&crops).unwrap()), together);
    assert!(together.iter().any(|row| row != &together[0]), "one answer for all");
}

#[test]
fn the_first_crop_of_another_size_is_refused_by_its_index() {
    let classifier = classifier();
    let mut crops = crops(&classifier);
    crops[13].pixels.truncate(100);
    crops[20].pixels.clear();
    let error = classifier.probabilities(&crops).unwrap_err();
    assert!(matches!(error, ClassifierError::CropPixels { index: 13, found: 100, .. }), "{error}");
}

#[test]
fn a_model_is_read_from_its_file_and_from_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(model(), folder.path().join(WEIGHTS_FILE)).unwrap();
    assert!(load_model(folder.path()).unwrap() == load_model(&model()).unwrap());
}
