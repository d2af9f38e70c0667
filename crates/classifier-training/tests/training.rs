//! Promises of training.

mod toy;

use artifact::ArtifactError;
use artifact::dataset::{Sample, Split};
use artifact::settings::Class;
use classifier::{Classifier, ClassifierError, evaluate};
use classifier_training::{
    Augmentation, SplitProtocol, TrainSettings, Trained, TrainingError, train, train_with_protocol,
};
use toy::{FORMAT, SETTINGS, samples};

fn all_right(samples: Vec<Sample>) -> impl Iterator<Item = Result<Sample, ArtifactError>> {
    samples.into_iter().map(Ok)
}

fn trained(samples: Vec<Sample>, settings: &TrainSettings, seed: u64) -> Result<Trained, TrainingError> {
    train(all_right(samples), &FORMAT, settings, seed, &mut |_| ())
}

fn quick() -> TrainSettings {
    TrainSettings { iterations: 6, ..SETTINGS }
}

#[test]
fn a_toy_task_is_learned_to_more_than_95_percent_of_unseen_scenes() {
    let trained = trained(samples(800), &SETTINGS, 1).unwrap();
    let test = &trained.metrics.splits[&Split::Test];
    assert_eq!(test.samples, 160);
    assert!(test.accuracy > 0.95, "{test:?}");
    assert!(test.log_loss < 0.2, "{test:?}");
    let (first, last) = (trained.curves.first().unwrap(), trained.curves.last().unwrap());
    assert!(last.train_log_loss < 0.5 * first.train_log_loss);
    assert_eq!(last.iteration, SETTINGS.iterations);
}

#[test]
fn the_same_seed_gives_the_same_bytes_on_1_and_2_threads_and_another_seed_others() {
    let on = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| trained(samples(200), &quick(), seed).unwrap())
    };
    let one = on(1, 1);
    assert!(one == on(2, 1));
    assert!(one.weights != on(1, 2).weights);
}

#[test]
fn two_trainings_at_once_do_not_change_each_other() {
    let alone = trained(samples(200), &quick(), 1).unwrap();
    let at_once = std::thread::scope(|scope| {
        let runs = [1, 2, 1].map(|seed| scope.spawn(move || trained(samples(200), &quick(), seed).unwrap()));
        runs.map(|run| run.join().unwrap())
    });
    assert!(at_once[0] == alone && at_once[2] == alone && at_once[1] != alone);
}

#[test]
fn a_scene_in_two_splits_is_refused() {
    let mut samples = samples(200);
    let first = samples[0].split;
    let second = [Split::Train, Split::Validation].into_iter().find(|s| *s != first).unwrap();
    samples[3].split = second;
    let error = trained(samples, &quick(), 1).unwrap_err();
    let TrainingError::Classifier(ClassifierError::SceneInTwoSplits { scene: 0, first: f, second: s }) =
        error
    else {
        panic!("{error}")
    };
    assert_eq!((f, s), (first, second));
}

#[test]
fn the_same_image_in_two_splits_is_refused() {
    let mut samples = samples(200);
    let copied = samples.iter().position(|s| s.split != samples[0].split).unwrap();
    samples[copied].crop = samples[0].crop.clone();
    let expected = (samples[0].id.clone(), samples[copied].id.clone());
    let error = trained(samples, &quick(), 1).unwrap_err();
    let TrainingError::Classifier(ClassifierError::CropInTwoSplits { first, second }) = &error else {
        panic!("{error}")
    };
    assert_eq!((first, second), (&expected.0, &expected.1));
}

#[test]
fn a_sample_that_comes_twice_is_refused() {
    let mut samples = samples(200);
    samples.push(samples[7].clone());
    let error = trained(samples, &quick(), 1).unwrap_err();
    assert!(matches!(error, TrainingError::Classifier(ClassifierError::SampleTwice(id)) if id == "1/3"));
}

#[test]
fn weights_do_not_depend_on_the_test_split() {
    let mut changed = samples(200);
    for sample in changed.iter_mut().filter(|s| s.split == Split::Test) {
        sample.crop.iter_mut().for_each(|crop| crop.pixels.fill(255));
        sample.class = Some(Class::Bus);
    }
    let (with, without) =
        (trained(samples(200), &quick(), 1).unwrap(), trained(changed, &quick(), 1).unwrap());
    assert!(with.weights == without.weights);
    assert!(with.metrics.splits[&Split::Test] != without.metrics.splits[&Split::Test]);
}

#[test]
fn validation_and_test_crops_are_never_varied() {
    let wild = Augmentation { range_shift_m: 12.0, velocity_shift_mps: 4.0, gain_db: 30.0, noise_db: 20.0 };
    let trained = trained(samples(200), &TrainSettings { augmentation: wild, ..quick() }, 1).unwrap();
    let classifier = Classifier::from_model(&trained.header, &trained.weights).unwrap();
    assert_eq!(evaluate(&classifier, all_right(samples(200))).unwrap(), trained.metrics.splits);
}

#[test]
fn the_kept_weights_are_those_of_the_lowest_validation_loss() {
    // A third of the validation labels is wrong: the surer the network gets, the worse it validates.
    let mut samples = samples(200);
    for sample in samples.iter_mut().filter(|s| s.split == Split::Validation && s.scene % 3 == 0) {
        sample.class = Some(Class::Car);
    }
    let trained = trained(samples, &TrainSettings { iterations: 80, ..SETTINGS }, 1).unwrap();
    let lowest = trained.curves.iter().map(|p| p.validation_log_loss).fold(f64::INFINITY, f64::min);
    let kept = trained.curves.iter().find(|p| p.iteration == trained.metrics.best_iteration).unwrap();
    assert_eq!(kept.validation_log_loss, lowest);
    assert!(kept.iteration < 80, "the last epoch is the best and the test proves nothing");
    let accuracy = trained.metrics.splits[&Split::Validation].accuracy; // temperature changes no answer
    assert_eq!(accuracy, kept.validation_accuracy);
}

#[test]
fn samples_without_a_class_are_left_out_and_counted() {
    let mut samples = samples(200);
    samples[5].class = None;
    samples[6].class = None;
    let trained = trained(samples, &quick(), 1).unwrap();
    assert_eq!(trained.metrics.unlabelled, 2);
    assert_eq!(trained.metrics.splits.values().map(|e| e.samples).sum::<u64>(), 198);
}

#[test]
fn what_cannot_be_trained_is_refused_with_the_reason() {
    let without = |keep: fn(&Sample) -> bool| samples(200).into_iter().filter(keep).collect::<Vec<_>>();
    let error = trained(without(|s| s.split != Split::Validation), &quick(), 1).unwrap_err();
    assert!(matches!(error, TrainingError::EmptySplit(Split::Validation)));
    let error = trained(vec![], &quick(), 1).unwrap_err();
    assert!(matches!(error, TrainingError::EmptySplit(Split::Train)));
    let error = trained(without(|s| s.class != Some(Class::Truck)), &quick(), 1).unwrap_err();
    assert!(matches!(error, TrainingError::MissingClass(Class::Truck)));
    let mut short = samples(200);
    short[9].crop.as_mut().unwrap().pixels.pop();
    let error = trained(short, &quick(), 1).unwrap_err();
    assert!(matches!(
        error,
        TrainingError::Classifier(ClassifierError::CropPixels { index: 9, found: 2303, side: 48 })
    ));
}

#[test]
fn settings_outside_their_range_are_refused() {
    let refused = |settings: TrainSettings| match trained(samples(200), &settings, 1) {
        Err(TrainingError::Classifier(ClassifierError::Setting { setting, .. })) => setting,
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(TrainSettings { batch: 1, ..quick() }), "batch");
    assert_eq!(refused(TrainSettings { iterations: 0, ..quick() }), "iterations");
    assert_eq!(refused(TrainSettings { learning_rate: f64::NAN, ..quick() }), "learning_rate");
    assert_eq!(refused(TrainSettings { weight_decay: -1.0, ..quick() }), "weight_decay");
    assert_eq!(refused(TrainSettings { input_side: 7, ..quick() }), "input_side");
    assert_eq!(refused(TrainSettings { input_side: 49, ..quick() }), "crop side");
    let augmentation = Augmentation { gain_db: f64::INFINITY, ..Augmentation::NONE };
    assert_eq!(refused(TrainSettings { augmentation, ..quick() }), "gain_db");
}

#[test]
fn progress_tells_every_iteration_and_every_epoch() {
    let mut told = Vec::new();
    let result =
        train(all_right(samples(200)), &FORMAT, &TrainSettings { iterations: 20, ..SETTINGS }, 1, &mut |p| {
            told.push(p)
        });
    assert!(told.iter().map(|p| p.iteration).eq(1..=20));
    let epochs: Vec<_> = told.iter().filter_map(|p| p.epoch).collect();
    // 120 training samples in batches of 16: an epoch ends with iterations 8 and 16, and the last closes what
    // is left.
    assert_eq!(epochs.iter().map(|p| p.iteration).collect::<Vec<_>>(), [8, 16, 20]);
    assert_eq!(epochs, result.unwrap().curves);
}

#[test]
fn a_deal_has_the_papers_proportions_and_does_not_ask_which_splits_a_dataset_has() {
    let all =
        || all_right(samples(200)).map(|sample| sample.map(|sample| Sample { split: Split::Test, ..sample }));
    let told = train_with_protocol(all(), &FORMAT, (&quick(), SplitProtocol::Maps), 1, &mut |_| ()).unwrap();
    let counts: Vec<u64> = told.metrics.splits.values().map(|of| of.samples).collect();
    // 200 maps as 600 : 320 : 200 of 1120, four images each.
    assert_eq!(counts, [428, 228, 144]);
    let again = train_with_protocol(all(), &FORMAT, (&quick(), SplitProtocol::Maps), 1, &mut |_| ()).unwrap();
    assert!(told == again);
}
