//! Inference with networks over range cells: three blocks of convolution, rectifier and maximum of two cells,
//! then two fully connected layers; the first also takes quantities of the whole signature.
//!
//! Every sum is taken in a fixed order: equal signatures give equal bits on any number of threads.

use crate::crops::network::Logits;
use crate::error::ClassifierError;
use crate::networks::convolution::convolved;
use crate::networks::dense::connected;
use crate::networks::pooling::relu_max_pool;
use crate::signatures::cells::{CELLS, INPUTS, OF_CELLS, OF_OBJECT};
use artifact::model::{Convolution, Dense, ProfileNetwork, ProfileNetworks};
use artifact::settings::Class;

/// Mean logits of the networks for the inputs of a signature, divided by the temperature.
pub(crate) fn logits(networks: &ProfileNetworks, inputs: &[f32]) -> Logits {
    let mut sum = [0.0_f64; Class::ALL.len()];
    for member in &networks.members {
        let one = member_logits(member, inputs);
        sum.iter_mut().zip(one).for_each(|(sum, logit)| *sum += f64::from(logit));
    }
    let divisor = networks.members.len() as f64 * f64::from(networks.temperature);
    sum.map(|sum| (sum / divisor) as f32)
}

/// Logits of one network.
pub(crate) fn member_logits(network: &ProfileNetwork, inputs: &[f32]) -> Logits {
    let (of_cells, of_object) = inputs.split_at(CELLS * OF_CELLS.len());
    let (mut values, mut cells) = (of_cells.to_vec(), CELLS);
    for Convolution { weights, bias, .. } in &network.convolutions {
        let full = convolved(&values, cells, weights, bias);
        values = full.chunks_exact(cells).flat_map(relu_max_pool).collect();
        cells /= 2;
    }
    values.extend(of_object);
    let hidden = connected(&values, &network.hidden.weights, &network.hidden.bias);
    let hidden: Vec<f32> = hidden.into_iter().map(|value| value.max(0.0)).collect();
    let output = connected(&hidden, &network.output.weights, &network.output.bias);
    std::array::from_fn(|class| output[class])
}

/// Checks that the layers of every network fit each other and hold finite numbers.
pub(crate) fn check(networks: &ProfileNetworks) -> Result<(), ClassifierError> {
    let refused = |member, rule| Err(ClassifierError::ProfileNetwork { member, rule });
    if networks.members.is_empty() {
        return refused(0, "at least one network");
    }
    if !(networks.temperature.is_finite() && networks.temperature > 0.0) {
        return refused(0, "a temperature above zero");
    }
    for (number, member) in networks.members.iter().enumerate() {
        if let Some(rule) = fault(member) {
            return refused(number, rule);
        }
    }
    Ok(())
}

/// The rule that a network breaks, if any.
fn fault(network: &ProfileNetwork) -> Option<&'static str> {
    let (mut channels, mut cells) = (OF_CELLS.len(), CELLS);
    for Convolution { inputs, taps, weights, bias } in &network.convolutions {
        let (inputs, taps) = (*inputs as usize, *taps as usize);
        let fits = bias.len().checked_mul(inputs * taps) == Some(weights.len());
        if inputs != channels || taps % 2 == 0 || taps > CELLS || bias.is_empty() || !fits || cells < 2 {
            return Some("convolutions of an odd number of taps whose weights fit their inputs and outputs");
        }
        (channels, cells) = (bias.len(), cells / 2);
    }
    let fits =
        |layer: &Dense, inputs: usize| layer.bias.len().checked_mul(inputs) == Some(layer.weights.len());
    let flat = channels * cells + OF_OBJECT.len();
    let hidden = network.hidden.bias.len();
    if hidden == 0 || !fits(&network.hidden, flat) || !fits(&network.output, hidden) {
        return Some("fully connected layers whose weights fit their inputs and outputs");
    }
    if network.output.bias.len() != Class::ALL.len() {
        return Some("one output for each class");
    }
    let finite = |values: &[f32]| values.iter().all(|value| value.is_finite());
    let convolutions = network.convolutions.iter().map(|layer| finite(&layer.weights) && finite(&layer.bias));
    let dense = [&network.hidden, &network.output].map(|layer| finite(&layer.weights) && finite(&layer.bias));
    (!convolutions.chain(dense).all(|is_finite| is_finite)).then_some("weights that are finite numbers")
}

const _: () = assert!(INPUTS == CELLS * OF_CELLS.len() + OF_OBJECT.len());

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    fn drawn() -> ProfileNetworks {
        let mut random = ChaCha8Rng::seed_from_u64(4);
        let mut some =
            |count: usize| (0..count).map(|_| random.random_range(-0.5..0.5)).collect::<Vec<f32>>();
        let mut convolutions = Vec::new();
        for (inputs, outputs, taps) in [(OF_CELLS.len(), 5, 5), (5, 3, 3)] {
            let (weights, bias) = (some(outputs * inputs * taps), some(outputs));
            convolutions.push(Convolution { inputs: inputs as u32, taps: taps as u32, weights, bias });
        }
        let flat = 3 * CELLS / 4 + OF_OBJECT.len();
        let hidden = Dense { weights: some(6 * flat), bias: some(6) };
        let output = Dense { weights: some(24), bias: some(4) };
        ProfileNetworks { temperature: 2.0, members: vec![ProfileNetwork { convolutions, hidden, output }] }
    }

    /// Each layer as its textbook writes it, in double precision.
    fn reference(network: &ProfileNetwork, inputs: &[f32]) -> Vec<f64> {
        let wide = |values: &[f32]| values.iter().map(|v| f64::from(*v)).collect::<Vec<f64>>();
        let mut maps: Vec<Vec<f64>> = inputs[..CELLS * OF_CELLS.len()].chunks(CELLS).map(wide).collect();
        for layer in &network.convolutions {
            let (taps, cells) = (layer.taps as isize, maps[0].len() as isize);
            let value = |output: usize, cell: isize| {
                let mut sum = f64::from(layer.bias[output]);
                for (input, map) in maps.iter().enumerate() {
                    for tap in 0..taps {
                        let at = cell + tap - taps / 2;
                        let weight =
                            layer.weights[(output * maps.len() + input) * taps as usize + tap as usize];
                        sum +=
                            if (0..cells).contains(&at) { f64::from(weight) * map[at as usize] } else { 0.0 };
                    }
                }
                sum.max(0.0)
            };
            let next = |output: usize| -> Vec<f64> {
                (0..cells / 2).map(|cell| value(output, 2 * cell).max(value(output, 2 * cell + 1))).collect()
            };
            maps = (0..layer.bias.len()).map(next).collect();
        }
        let dense = |layer: &Dense, row: &[f64]| -> Vec<f64> {
            let of = |(weights, bias): (&[f32], &f32)| {
                f64::from(*bias) + weights.iter().zip(row).map(|(w, x)| f64::from(*w) * x).sum::<f64>()
            };
            layer.weights.chunks(row.len()).zip(&layer.bias).map(of).collect()
        };
        let flat = [maps.concat(), wide(&inputs[CELLS * OF_CELLS.len()..])].concat();
        let hidden: Vec<f64> = dense(&network.hidden, &flat).into_iter().map(|v| v.max(0.0)).collect();
        dense(&network.output, &hidden)
    }

    #[test]
    fn the_networks_answer_as_their_layers_are_written_in_textbooks() {
        let (networks, mut random) = (drawn(), ChaCha8Rng::seed_from_u64(6));
        check(&networks).unwrap();
        for _ in 0..20 {
            let inputs: Vec<f32> = (0..INPUTS).map(|_| random.random_range(-1.0..1.0)).collect();
            let expected = reference(&networks.members[0], &inputs);
            for (logit, expected) in logits(&networks, &inputs).into_iter().zip(expected) {
                assert!((2.0 * f64::from(logit) - expected).abs() < 1e-5, "{logit} {expected}");
            }
        }
    }

    #[test]
    fn networks_whose_layers_do_not_fit_are_refused() {
        type Damage = fn(&mut ProfileNetworks);
        let damages: [Damage; 8] = [
            |n| n.members.clear(),
            |n| n.temperature = 0.0,
            |n| n.members[0].convolutions[1].inputs = 4,
            |n| n.members[0].convolutions[0].taps = 4,
            |n| n.members[0].convolutions[0].weights.truncate(3),
            |n| n.members[0].hidden.weights.truncate(3),
            |n| n.members[0].output.bias.truncate(3),
            |n| n.members[0].output.weights[3] = f32::NAN,
        ];
        for damage in damages {
            let mut networks = drawn();
            damage(&mut networks);
            assert!(matches!(check(&networks), Err(ClassifierError::ProfileNetwork { member: 0, .. })));
        }
    }
}
