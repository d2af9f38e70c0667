//! Accuracy over vehicles: sightings of one vehicle are not independent trials, so its interval comes from
//! resampling vehicles.

use artifact::seed;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Serialize;
use std::collections::BTreeMap;

/// Number of bootstrap samples (Efron & Tibshirani, An Introduction to the Bootstrap, 1993, section 13.3: a
/// thousand for percentiles).
const DRAWS: u64 = 1000;

/// An answer: true class, vehicle, predicted class.
pub struct ClassPrediction<'a> {
    /// Index in [`artifact::settings::Class::ALL`].
    pub truth: usize,
    /// Vehicle model.
    pub model: &'a str,
    /// Index of the likeliest class.
    pub predicted: usize,
}

/// Mean over classes of the share of right answers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ByVehicle {
    /// Number of different vehicles.
    pub vehicles: usize,
    /// Number of answers.
    pub answers: usize,
    /// Mean over classes of the share of right answers.
    pub mean_over_classes: f64,
    /// 95 % interval over vehicles, resampled with replacement in each class. `None` if no class has two of
    /// them: every resample is then the same, without spread.
    pub interval: Option<[f64; 2]>,
}

/// Numbers of right answers and of all answers for each vehicle, by class.
type Counts = Vec<Vec<[u64; 2]>>;

/// Accuracy of answers over vehicles.
pub fn by_vehicle<'a>(answers: impl Iterator<Item = ClassPrediction<'a>>) -> ByVehicle {
    let mut of_vehicle: BTreeMap<(usize, &str), [u64; 2]> = BTreeMap::new();
    for answer in answers {
        let [right, all] = of_vehicle.entry((answer.truth, answer.model)).or_default();
        *right += u64::from(answer.predicted == answer.truth);
        *all += 1;
    }
    let own = |class: usize| of_vehicle.iter().filter(|((c, _), _)| *c == class).map(|(_, n)| *n).collect();
    let counts: Counts = (0..4).map(own).filter(|own: &Vec<_>| !own.is_empty()).collect();
    ByVehicle {
        vehicles: of_vehicle.len(),
        answers: of_vehicle.values().map(|[_, all]| *all as usize).sum(),
        mean_over_classes: mean(&counts),
        interval: counts.iter().any(|own| own.len() > 1).then(|| interval(&counts)),
    }
}

/// Percentiles of the mean over classes, over resampled vehicles.
fn interval(counts: &Counts) -> [f64; 2] {
    let mut drawn: Vec<f64> = (0..DRAWS).map(|draw| mean(&bootstrap_resample(counts, draw))).collect();
    drawn.sort_by(f64::total_cmp);
    [0.025, 0.975].map(|share| drawn[(share * (DRAWS - 1) as f64).round() as usize])
}

/// Mean over classes; 0 without any.
fn mean(counts: &Counts) -> f64 {
    let share = |vehicles: &Vec<[u64; 2]>| {
        let sum = |at: usize| vehicles.iter().map(|n| n[at]).sum::<u64>() as f64;
        sum(0) / sum(1).max(1.0)
    };
    counts.iter().map(share).sum::<f64>() / counts.len().max(1) as f64
}

fn bootstrap_resample(counts: &Counts, draw: u64) -> Counts {
    let mut random = ChaCha8Rng::from_seed(seed::key(draw, "classifier/bootstrap", &[]));
    let anew = |vehicles: &Vec<[u64; 2]>| {
        vehicles.iter().map(|_| vehicles[random.random_range(0..vehicles.len())]).collect()
    };
    counts.iter().map(anew).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vehicle_seen_a_hundred_times_does_not_narrow_the_interval() {
        let answer =
            |truth: usize, model: &'static str, predicted: usize| ClassPrediction { truth, model, predicted };
        // Two vehicles of one class, one always right and one always wrong: the mean is a half, and anything
        // may come.
        let many = (0..100).flat_map(|_| [answer(0, "a", 0), answer(0, "b", 1)]);
        let found = by_vehicle(many);
        assert_eq!((found.vehicles, found.answers, found.mean_over_classes), (2, 200, 0.5));
        assert_eq!(found.interval, Some([0.0, 1.0]));
    }

    #[test]
    fn classes_count_alike_however_many_answers_they_have_and_lone_vehicles_tell_of_no_spread() {
        let answers = (0..90).map(|_| ClassPrediction { truth: 0, model: "a", predicted: 0 });
        let found = by_vehicle(answers.chain((0..10).map(|_| ClassPrediction {
            truth: 1,
            model: "b",
            predicted: 0,
        })));
        assert_eq!((found.mean_over_classes, found.interval), (0.5, None));
    }
}
