//! Training of networks over range cells with probabilities calibrated for unseen vehicles: vehicles are held
//! out in turn, and the answers for them determine the temperature and the correlation between the frames of
//! a track.

use crate::ensembles::cross_validation::{
    CrossValidationSets, HeldOutLogits, cross_validate, progress_counter,
};
use crate::ensembles::trained_model::{ModelCalibration, TrainedModel};
use crate::ensembles::vehicles::Sightings;
use crate::error::ClassifierError;
use crate::networks::network_training::{Examples, NetworkSettings, trained_network};
use crate::networks::profile_network::member_logits;
use crate::signatures::cells::shape;
use artifact::model::{Learner, ProfileNetwork, ProfileNetworks, Weights};
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

impl ProfileSettings {
    /// Number of passes of all trainings together.
    pub(crate) fn ticks(&self) -> usize {
        self.network.epochs as usize * self.members * (self.folds + 1)
    }
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
    progress: &mut dyn FnMut(usize, usize),
) -> Result<TrainedModel, ClassifierError> {
    let examples = CrossValidationSets::of(sightings)?;
    let mut tick = progress_counter(settings.ticks(), progress);
    let parts = trained_networks(sightings, &examples, settings, seed, &mut tick);
    let passes = settings.network.epochs as usize;
    let calibrated = ModelCalibration::fit(sightings, &examples.scored, &parts.held_out, passes - 1);
    let temperature = calibrated.temperature as f32;
    let networks = ProfileNetworks { temperature, members: parts.members };
    let model = (Learner::ProfileNetworks(shape()), Weights::Profile(networks));
    Ok(calibrated.model(sightings, &examples.scored, model, settings.least_probability, (passes, seed)))
}

/// Networks, with the answers for held-out vehicles after each pass.
pub(crate) struct TrainedNetworks {
    pub(crate) held_out: HeldOutLogits,
    pub(crate) members: Vec<ProfileNetwork>,
}

/// Trains with vehicles held out in turn, then on all; `tick` is called after each pass.
pub(crate) fn trained_networks(
    sightings: &Sightings,
    CrossValidationSets { training, scored }: &CrossValidationSets,
    settings: &ProfileSettings,
    seed: u64,
    tick: &mut dyn FnMut(),
) -> TrainedNetworks {
    let passes = settings.network.epochs as usize;
    let member = |number: usize| seed.wrapping_add((number as u64) << 32);
    let mut train_on_fold = |kept: &[usize], asked: &[usize]| {
        let examples = examples(sightings, kept);
        let mut logits_of_rounds = vec![vec![[0.0_f32; 4]; asked.len()]; passes];
        for number in 0..settings.members {
            let mut pass = 0;
            trained_network(&examples, &settings.network, member(number), &mut |network| {
                for (sums, number) in logits_of_rounds[pass].iter_mut().zip(asked) {
                    let one = member_logits(network, &sightings.all[*number].cells);
                    sums.iter_mut().zip(one).for_each(|(sum, l)| *sum += l / settings.members as f32);
                }
                pass += 1;
                tick();
            });
        }
        logits_of_rounds
    };
    let held_out =
        cross_validate(sightings, [training, scored], [settings.folds, passes], seed, &mut train_on_fold);
    let examples = examples(sightings, training);
    let trained =
        |number: usize| trained_network(&examples, &settings.network, member(number), &mut |_| tick());
    TrainedNetworks { held_out, members: (0..settings.members).map(trained).collect() }
}

fn examples<'a>(sightings: &'a Sightings, numbers: &[usize]) -> Examples<'a> {
    let table = sightings.table(numbers);
    let inputs = numbers.iter().map(|number| sightings.all[*number].cells.as_slice()).collect();
    Examples { inputs, classes: table.classes, weights: table.weights }
}
