//! Training on too few data, on none, and on false labels.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::{AtlasCase, Trial, atlas_cases};
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::extent::Extent;
use artifact::dataset::Split;
use artifact::model::Weights;
use classifier::{
    BoostingSettings, Sighting, Sightings, TrainedModel, TreeSettings, train_trees, tree_logits,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use wayside::host::failure::Failure;

pub(super) const CASES: &[AtlasCase] = atlas_cases![tiny_sets, classes_missing, labels_of_chance];

const SETTINGS: TreeSettings = TreeSettings {
    boosting: BoostingSettings {
        rounds: 60,
        depth: 3,
        learning_rate: 0.1,
        shrinkage: 2.0,
        least_weight: 5.0,
        columns: 0.2,
        rows: 0.7,
    },
    folds: 5,
    least_probability: 0.4,
};

/// A sighting whose features indicate its class up to noise of the same size; `told` is the class that they
/// indicate.
fn sighting(random: &mut ChaCha8Rng, class: usize, told: usize, vehicle: u64) -> Sighting {
    let width = classifier::feature_names().len();
    let feature = |i: usize, noise: f64| if i % 4 == told { 1.5 + noise } else { noise };
    let features = (0..width)
        .map(
            |i| if i < 8 { feature(i, 4.0 * (random.random::<f64>() - 0.5)) } else { random.random::<f64>() },
        )
        .map(|value| value as f32)
        .collect();
    let model = format!("vehicle-{class}-{vehicle}");
    Sighting {
        features,
        cells: vec![],
        class,
        model,
        track: (0, vehicle, class as u32),
        split: Split::Train,
        has_rows: false,
    }
}

fn sightings(each: u64, seed: u64, told: impl Fn(&mut ChaCha8Rng, usize) -> usize) -> Sightings {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut all = Sightings::default();
    for vehicle in 0..each {
        for class in 0..4 {
            let told = told(&mut random, class);
            all.all.push(sighting(&mut random, class, told, vehicle));
        }
    }
    all
}

/// Share of a thousand new sightings that a model classifies correctly.
fn true_accuracy(trained: &TrainedModel, of: &Sightings) -> f64 {
    let Weights::Trees(trees) = &trained.weights else { return 0.0 };
    let is_right = |seen: &&Sighting| {
        let logits = tree_logits(trees, &seen.features);
        (0..4).fold(0, |best, i| if logits[i] > logits[best] { i } else { best }) == seen.class
    };
    of.all.iter().filter(is_right).count() as f64 / of.all.len() as f64
}

fn trained(sightings: &Sightings) -> Result<TrainedModel, Failure> {
    train_trees(sightings, &SETTINGS, 1, &mut |_, _| ()).map_err(Failure::refused)
}

/// Number of training sets of one size.
const SETS: u64 = 8;

/// Compares the accuracy reported by trainings with that on a thousand new sightings: the error is the mean
/// difference of the two; the 95 % intervals cover it if at most two of eight miss the true one (0.6 % by
/// chance).
fn stated_against_true(
    trial: Trial,
    each: u64,
    fresh: &Sightings,
    told: &dyn Fn(&mut ChaCha8Rng, usize) -> usize,
) -> Result<CaseRow, Failure> {
    let (mut apart, mut missed) = (0.0, 0);
    for set in 0..SETS {
        let trained = match trained(&sightings(each, 5 + set, told)) {
            Ok(trained) => trained,
            Err(refusal) => return Ok(trial.must_refuse::<(), _>(each, Err(refusal))),
        };
        let own = &trained.metrics.unseen_vehicles.by_vehicle;
        let truth = true_accuracy(&trained, fresh);
        apart += (own.mean_over_classes - truth).abs() / SETS as f64;
        let holds = own.interval.is_some_and(|[low, high]| (low..=high).contains(&truth));
        missed += u32::from(!holds);
    }
    let statement = match missed {
        0..=2 => ErrorStatement::Remark(
            "unseen_vehicles.by_vehicle.interval holds the true accuracy in six sets of eight or more",
        ),
        _ => ErrorStatement::Missing,
    };
    Ok(trial.answered(each, apart, statement))
}

/// Very few vehicles of each class.
fn tiny_sets(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial =
        methods::TREES.trial("tiny training sets: accuracy told against true", "vehicles of each class");
    let fresh = sightings(250, 99, |_, class| class);
    let row = |each: u64| stated_against_true(trial, each, &fresh, &|_, class| class);
    [1, 2, 5, 20, 50].into_iter().map(row).collect()
}

/// A class without training data cannot be learned.
fn classes_missing(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::TREES.trial("training sets without all classes", "set");
    let without = |kept: &dyn Fn(&Sighting) -> bool| {
        let mut all = sightings(20, 5, |_, class| class);
        all.all.retain(|seen| kept(seen));
        trained(&all)
    };
    Ok(vec![
        trial.must_refuse("no motorcycle", without(&|seen| seen.class != 3)),
        trial.must_refuse("cars alone", without(&|seen| seen.class == 0)),
        trial.must_refuse("nothing", without(&|_| false)),
        trial.must_refuse("buses in the test split alone", {
            let mut all = sightings(20, 5, |_, class| class);
            all.all.iter_mut().filter(|seen| seen.class == 1).for_each(|seen| seen.split = Split::Test);
            trained(&all)
        }),
    ])
}

/// Labels independent of the features: a quarter is right by chance, and the training must not report more.
fn labels_of_chance(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial =
        methods::TREES.trial("labels by chance: accuracy told against true", "vehicles of each class");
    let chance = |random: &mut ChaCha8Rng, _: usize| random.random_range(0..4);
    let fresh = sightings(250, 98, chance);
    let row = |each: u64| stated_against_true(trial, each, &fresh, &chance);
    [10, 50].into_iter().map(row).collect()
}
