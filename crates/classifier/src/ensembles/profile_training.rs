//! Training of networks over range cells with probabilities calibrated for unseen vehicles: vehicles are held
//! out in turn, and the answers for them determine the temperature and the correlation between the frames of
//! a track.

use crate::ensembles::held_out::{check_classes, held_out, judged};
use crate::ensembles::trained::{Calibrated, Trained};
use crate::ensembles::vehicles::Sightings;
use crate::error::ClassifierError;
use crate::networks::network_training::{Examples, NetworkSettings, trained_network};
use crate::networks::profile_network::of_member;
use crate::signatures::cells::shape;
use artifact::dataset::Split;
use artifact::model::{Learner, ProfileNetworks, Weights};
use serde::Serialize;

/// Settings for training networks over range cells.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ProfileSettings {
    /// Settings for each of them.
    pub network: NetworkSettings,
    /// Number of trainings whose logits the model averages.
    pub members: usize,
    /// Number of folds of vehicles; each is held out once.
    pub folds: usize,
    /// Least probability for answering with the likeliest class: where it is more likely right than wrong.
    pub least_probability: f32,
}

impl Default for ProfileSettings {
    fn default() -> Self {
        let network = NetworkSettings {
            channels: [16, 16, 32],
            taps: [5, 5, 3],
            hidden: 64,
            dropped: 0.4,
            epochs: 15,
            batch: 64,
            least_steps: 300,
            rate: 3e-3,
            weight_decay: 0.03,
            smoothing: 0.05,
        };
        Self { network, members: 3, folds: 5, least_probability: 0.4 }
    }
}

/// Trains on all sightings except those of the test split; progress is reported as (passes done, passes in
/// all).
///
/// Held-out vehicles are answered by as many networks as the model has. The same sightings, settings and seed
/// give the same networks on any number of threads.
pub fn train_networks(
    sightings: &Sightings,
    settings: &ProfileSettings,
    seed: u64,
    heard: &mut dyn FnMut(usize, usize),
) -> Result<Trained, ClassifierError> {
    let learned = sightings.of(&[Split::Train, Split::Validation]);
    check_classes(sightings, &learned)?;
    let passes = settings.network.epochs as usize;
    let (mut done, all) = (0, passes * settings.members * (settings.folds + 1));
    let mut tick = || {
        done += 1;
        heard(done, all);
    };
    let judged = judged(sightings, &learned);
    let member = |number: usize| seed.wrapping_add((number as u64) << 32);
    let mut of_fold = |kept: &[usize], asked: &[usize]| {
        let examples = examples(sightings, kept);
        let mut told = vec![vec![[0.0_f32; 4]; asked.len()]; passes];
        for number in 0..settings.members {
            let mut pass = 0;
            trained_network(&examples, &settings.network, member(number), &mut |network| {
                for (sums, number) in told[pass].iter_mut().zip(asked) {
                    let one = of_member(network, &sightings.all[*number].cells);
                    sums.iter_mut().zip(one).for_each(|(sum, l)| *sum += l / settings.members as f32);
                }
                pass += 1;
                tick();
            });
        }
        told
    };
    let held_out = held_out(sightings, [&learned, &judged], [settings.folds, passes], seed, &mut of_fold);
    let calibrated = Calibrated::on(sightings, &judged, &held_out, passes - 1);
    let examples = examples(sightings, &learned);
    let trained =
        |number: usize| trained_network(&examples, &settings.network, member(number), &mut |_| tick());
    let members = (0..settings.members).map(trained).collect();
    let networks = ProfileNetworks { temperature: calibrated.temperature as f32, members };
    let model = (Learner::ProfileNetworks(shape()), Weights::Profile(networks));
    Ok(calibrated.model(sightings, &judged, model, settings.least_probability, (passes, seed)))
}

fn examples<'a>(sightings: &'a Sightings, numbers: &[usize]) -> Examples<'a> {
    let table = sightings.table(numbers);
    let inputs = numbers.iter().map(|number| sightings.all[*number].cells.as_slice()).collect();
    Examples { inputs, classes: table.classes, weights: table.weights }
}
