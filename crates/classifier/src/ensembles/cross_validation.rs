//! Answers for vehicles that a training never saw: they are held out in turn, whole.

use crate::crops::network::Logits;
use crate::ensembles::vehicles::Sightings;
use crate::error::ClassifierError;
use crate::evaluation::metrics::log_softmax;
use crate::evaluation::temperature::fitted_temperature;
use artifact::dataset::Split;
use artifact::settings::Class;
use std::collections::BTreeMap;

/// Splits that train: vehicles held out in turn validate.
pub(crate) const TRAINING_SPLITS: [Split; 2] = [Split::Train, Split::Validation];

/// Numbers of the sightings for training, and of those among them that measure the accuracy.
pub(crate) struct CrossValidationSets {
    pub(crate) training: Vec<usize>,
    pub(crate) scored: Vec<usize>,
}

impl CrossValidationSets {
    /// All sightings except those of the test split; refused if a class is missing.
    pub(crate) fn of(sightings: &Sightings) -> Result<Self, ClassifierError> {
        let training = sightings.of(&TRAINING_SPLITS);
        check_classes(sightings, &training)?;
        Ok(Self { scored: scored(sightings, &training), training })
    }
}

fn check_classes(sightings: &Sightings, training: &[usize]) -> Result<(), ClassifierError> {
    let is_seen = |class: usize| training.iter().any(|i| sightings.all[*i].class == class);
    match (0..Class::ALL.len()).find(|class| !is_seen(*class)) {
        Some(missing) => Err(ClassifierError::MissingClass { class: Class::ALL[missing] }),
        None => Ok(()),
    }
}

/// Training sightings that measure the accuracy: unmodified vehicles, if there are any. The two families of a
/// cross are rarely held out together.
fn scored(sightings: &Sightings, training: &[usize]) -> Vec<usize> {
    let plain: Vec<usize> = training.iter().copied().filter(|i| !sightings.all[*i].is_cross()).collect();
    if plain.is_empty() { training.to_vec() } else { plain }
}

/// Logits of vehicles by trainings that never saw them.
pub(crate) struct HeldOutLogits {
    /// Logits, `[round][sighting]`.
    pub(crate) logits: Vec<Vec<Logits>>,
    pub(crate) classes: Vec<usize>,
    pub(crate) weights: Vec<f64>,
}

impl HeldOutLogits {
    /// Log loss after each round.
    pub(crate) fn curve(&self) -> Vec<f64> {
        let total: f64 = self.weights.iter().sum();
        let loss = |round: &Vec<Logits>| {
            let one =
                |(i, l): (usize, &Logits)| -self.weights[i] * log_softmax(l.map(f64::from))[self.classes[i]];
            round.iter().enumerate().map(one).sum::<f64>() / total
        };
        self.logits.iter().map(loss).collect()
    }

    /// Temperature that fits the answers of a round, and the answers divided by it.
    pub(crate) fn temperature_scaled(&self, round: usize) -> (f64, Vec<Logits>) {
        let answers = self.logits[round].iter().zip(&self.classes).zip(&self.weights);
        let weighted: Vec<_> = answers.map(|((logits, class), weight)| (*class, *logits, *weight)).collect();
        let temperature = fitted_temperature(&weighted);
        (temperature, self.logits[round].iter().map(|l| l.map(|v| v / temperature as f32)).collect())
    }

    pub(crate) fn best_round(&self) -> usize {
        let curve = self.curve();
        (0..curve.len()).fold(0, |best, round| if curve[round] < curve[best] { round } else { best })
    }
}

/// Counts rounds, and reports each as (rounds done, rounds in all).
pub(crate) fn progress_counter(all: usize, progress: &mut dyn FnMut(usize, usize)) -> impl FnMut() {
    let mut done = 0;
    move || {
        done += 1;
        progress(done, all);
    }
}

/// Logits of held-out sightings after each round, `[round][sighting]`, of a training on the first numbers;
/// the second are those of the sightings to be answered.
pub(crate) type TrainOnFold<'a> = &'a mut dyn FnMut(&[usize], &[usize]) -> Vec<Vec<Logits>>;

/// Holds out each fold of vehicles once.
pub(crate) fn cross_validate(
    sightings: &Sightings,
    [training, scored]: [&[usize]; 2],
    [folds, rounds]: [usize; 2],
    seed: u64,
    train_on_fold: TrainOnFold<'_>,
) -> HeldOutLogits {
    let of_sightings = sightings.folds(training, folds, seed);
    let fold_of: BTreeMap<usize, [usize; 2]> = training.iter().copied().zip(of_sightings).collect();
    let mut logits = vec![vec![[0.0; 4]; scored.len()]; rounds];
    for fold in 0..folds {
        let out: Vec<usize> = (0..scored.len()).filter(|at| fold_of[&scored[*at]][0] == fold).collect();
        let kept: Vec<usize> = training.iter().copied().filter(|i| !fold_of[i].contains(&fold)).collect();
        let asked: Vec<usize> = out.iter().map(|at| scored[*at]).collect();
        for (all, logits_of_rounds) in logits.iter_mut().zip(train_on_fold(&kept, &asked)) {
            out.iter().zip(logits_of_rounds).for_each(|(at, logits)| all[*at] = logits);
        }
    }
    let table = sightings.table(scored);
    HeldOutLogits { logits, classes: table.classes, weights: table.weights }
}
