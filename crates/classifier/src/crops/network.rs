//! Inference of the paper's network (Fig. 7): three blocks of 3 × 3 convolution, batch normalization, maximum
//! of 2 × 2 and rectifier, then a fully connected layer. It is trained in `classifier-training`, by a library
//! that a main job need not build.
//!
//! After training, batch normalization is a factor and an offset, which are merged into the convolution
//! before it. Every sum is taken in a fixed order for any number of threads: equal crops give equal bits.

use crate::crops::layout::{KERNEL_SIDE, Layout};
use crate::crops::parameters::Parameters;
use crate::crops::tensor_name;
use crate::error::ClassifierError;
use artifact::settings::Class;

/// Logits, whose softmax is the probability of each class, in the order of [`Class::ALL`].
pub type Logits = [f32; 4];

/// Constant added to a variance before its root is taken; the weights were trained with it.
pub const VARIANCE_FLOOR: f32 = 1e-5;

/// The network with its parameters.
#[derive(Debug)]
pub(crate) struct Network {
    input_side: usize,
    blocks: Vec<Block>,
    /// Weights of the last layer, `[in, class]`.
    linear: Vec<f32>,
    linear_bias: Vec<f32>,
}

/// A convolution that keeps the side, with its batch normalization merged, and the pooling after it.
#[derive(Debug)]
struct Block {
    /// Weights `[out, in, row, column]`.
    weights: Vec<f32>,
    bias: Vec<f32>,
    inputs: usize,
}

/// Square maps of several channels, `[channel, row, column]`.
struct Maps {
    side: usize,
    levels: Vec<f32>,
}

impl Network {
    /// Network with these parameters; refused if a tensor is missing.
    pub(crate) fn new(layout: &Layout, parameters: &Parameters) -> Result<Self, ClassifierError> {
        let blocks = (0..layout.channels.len()).map(|index| Block::new(index, parameters));
        Ok(Self {
            input_side: layout.input_side,
            blocks: blocks.collect::<Result<_, _>>()?,
            linear: parameters.get(tensor_name::LINEAR_WEIGHT)?.values.clone(),
            linear_bias: parameters.get(tensor_name::LINEAR_BIAS)?.values.clone(),
        })
    }

    /// Logits of grey levels `[input_side, input_side]`.
    pub(crate) fn logits(&self, pooled: &[u8]) -> Logits {
        let levels = pooled.iter().map(|level| f32::from(*level) / 255.0).collect();
        let input = Maps { side: self.input_side, levels };
        let features = self.blocks.iter().fold(input, |maps, block| block.forward(&maps));
        let mut logits: Logits = std::array::from_fn(|class| self.linear_bias[class]);
        for (feature, weights) in features.levels.iter().zip(self.linear.chunks_exact(Class::ALL.len())) {
            logits.iter_mut().zip(weights).for_each(|(logit, weight)| *logit += weight * feature);
        }
        logits
    }
}

impl Block {
    fn new(index: usize, parameters: &Parameters) -> Result<Self, ClassifierError> {
        let tensor = |name: String| parameters.get(&name).map(|tensor| tensor.values.as_slice());
        let convolution = parameters.get(&tensor_name::convolution(index))?;
        let (scale, offset) = (tensor(tensor_name::scale(index))?, tensor(tensor_name::offset(index))?);
        let (mean, variance) = (tensor(tensor_name::mean(index))?, tensor(tensor_name::variance(index))?);
        let factors: Vec<f32> = scale
            .iter()
            .zip(variance)
            .map(|(scale, variance)| scale / (variance + VARIANCE_FLOOR).sqrt())
            .collect();
        let inputs = convolution.shape[1];
        let kernels = convolution.values.chunks_exact(inputs * KERNEL_SIDE * KERNEL_SIDE);
        let weights =
            kernels.zip(&factors).flat_map(|(kernel, factor)| kernel.iter().map(move |w| w * factor));
        let bias =
            offset.iter().zip(mean).zip(&factors).map(|((offset, mean), factor)| offset - mean * factor);
        Ok(Self { weights: weights.collect(), bias: bias.collect(), inputs })
    }

    /// The maximum and the rectifier commute (both are monotonic); in this order the rectifier processes a
    /// quarter of the pixels.
    fn forward(&self, input: &Maps) -> Maps {
        let framed = input.framed(self.inputs);
        let kernels = self.weights.chunks_exact(self.inputs * KERNEL_SIDE * KERNEL_SIDE).zip(&self.bias);
        let halved =
            kernels.flat_map(|(kernel, bias)| relu_max_pool(&convolved(&framed, kernel, *bias), input.side));
        Maps { side: input.side / 2, levels: halved.collect() }
    }
}

impl Maps {
    /// The maps with a frame of zeros one pixel wide around each channel.
    fn framed(&self, channels: usize) -> Self {
        let side = self.side + KERNEL_SIDE - 1;
        let mut levels = vec![0.0; channels * side * side];
        for (channel, framed) in
            self.levels.chunks_exact(self.side * self.side).zip(levels.chunks_exact_mut(side * side))
        {
            for (row, framed) in channel.chunks_exact(self.side).zip(framed.chunks_exact_mut(side).skip(1)) {
                framed[1..=self.side].copy_from_slice(row);
            }
        }
        Self { side, levels }
    }
}

/// One output channel, `[row, column]`, from all channels with their frames.
fn convolved(framed: &Maps, kernel: &[f32], bias: f32) -> Vec<f32> {
    let side = framed.side + 1 - KERNEL_SIDE;
    let mut channel = vec![bias; side * side];
    for (at, row) in channel.chunks_exact_mut(side).enumerate() {
        let inputs = framed.levels.chunks_exact(framed.side * framed.side);
        for (input, kernel) in inputs.zip(kernel.chunks_exact(KERNEL_SIDE * KERNEL_SIDE)) {
            let lines = input.chunks_exact(framed.side).skip(at);
            for (line, weights) in lines.zip(kernel.chunks_exact(KERNEL_SIDE)) {
                add_weighed(row, line, weights);
            }
        }
    }
    channel
}

/// Adds to every pixel of a row the weighted pixels of a framed line beside it.
fn add_weighed(row: &mut [f32], line: &[f32], weights: &[f32]) {
    for (shift, weight) in weights.iter().enumerate() {
        row.iter_mut().zip(&line[shift..]).for_each(|(sum, level)| *sum += weight * level);
    }
}

/// The largest of every 2 × 2 pixels and zero; an odd last row and column are ignored.
fn relu_max_pool(channel: &[f32], side: usize) -> Vec<f32> {
    let rows = channel.chunks_exact(side).collect::<Vec<_>>();
    let pair = |pair: &[&[f32]]| -> Vec<f32> {
        let columns = pair[0].chunks_exact(2).zip(pair[1].chunks_exact(2));
        columns.map(|(a, b)| a[0].max(a[1]).max(b[0]).max(b[1]).max(0.0)).collect()
    };
    rows.chunks_exact(2).flat_map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crops::parameters::Values;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    const LAYOUT: Layout = Layout { crop_side: 30, input_side: 21, channels: [3, 4, 2] };

    /// Parameters of any numbers, variances above zero.
    fn drawn() -> Parameters {
        let mut generator = ChaCha8Rng::seed_from_u64(5);
        let tensors = LAYOUT.tensors().into_iter().map(|(name, shape)| {
            let least = if name.ends_with("variance") { 0.1 } else { -1.0 };
            let values = (0..shape.iter().product()).map(|_| generator.random_range(least..1.0)).collect();
            (name, Values { shape, values })
        });
        Parameters::new(tensors.collect())
    }

    /// Each layer as its textbook writes it, in double precision, nothing folded into another.
    fn reference(parameters: &Parameters, pooled: &[u8]) -> [f64; 4] {
        let of = |name: &str| -> Vec<f64> {
            parameters.get(name).unwrap().values.iter().map(|v| f64::from(*v)).collect()
        };
        let mut side = LAYOUT.input_side;
        let mut maps = vec![pooled.iter().map(|g| f64::from(*g) / 255.0).collect::<Vec<f64>>()];
        for (block, outputs) in LAYOUT.channels.into_iter().enumerate() {
            let kernel = of(&tensor_name::convolution(block));
            let [scale, offset] = [tensor_name::scale(block), tensor_name::offset(block)].map(|n| of(&n));
            let [mean, variance] = [tensor_name::mean(block), tensor_name::variance(block)].map(|n| of(&n));
            let inputs = maps.len();
            let level = |map: &[f64], row: isize, column: isize| {
                let inside = |i: isize| (0..side as isize).contains(&i);
                if inside(row) && inside(column) { map[row as usize * side + column as usize] } else { 0.0 }
            };
            let answer = |out: usize, row: usize, column: usize| {
                let mut sum = 0.0;
                for (input, map) in maps.iter().enumerate() {
                    for k in 0..9 {
                        let at = [row + k / 3, column + k % 3].map(|i| i as isize - 1);
                        sum += kernel[(out * inputs + input) * 9 + k] * level(map, at[0], at[1]);
                    }
                }
                let normal = (sum - mean[out]) / (variance[out] + 1e-5).sqrt();
                (scale[out] * normal + offset[out]).max(0.0)
            };
            let half = side / 2;
            let largest = |out: usize, row: usize, column: usize| {
                (0..4).map(|i| answer(out, 2 * row + i / 2, 2 * column + i % 2)).fold(0.0, f64::max)
            };
            let next: Vec<Vec<f64>> = (0..outputs)
                .map(|out| (0..half * half).map(|p| largest(out, p / half, p % half)).collect())
                .collect();
            (maps, side) = (next, half);
        }
        let (weights, bias) = (of(tensor_name::LINEAR_WEIGHT), of(tensor_name::LINEAR_BIAS));
        let features: Vec<f64> = maps.concat();
        std::array::from_fn(|class| {
            bias[class] + features.iter().enumerate().map(|(i, f)| weights[4 * i + class] * f).sum::<f64>()
        })
    }

    #[test]
    fn the_network_answers_as_its_layers_are_written_in_textbooks() {
        let (parameters, mut generator) = (drawn(), ChaCha8Rng::seed_from_u64(6));
        let network = Network::new(&LAYOUT, &parameters).unwrap();
        for _ in 0..20 {
            let pooled: Vec<u8> = (0..21 * 21).map(|_| generator.random()).collect();
            let expected = reference(&parameters, &pooled);
            let largest = expected.iter().fold(1.0_f64, |most, l| most.max(l.abs()));
            for (logit, expected) in network.logits(&pooled).into_iter().zip(expected) {
                assert!((f64::from(logit) - expected).abs() < 1e-5 * largest, "{logit} {expected}");
            }
        }
    }

    #[test]
    fn an_odd_row_and_column_are_left_out_and_nothing_is_below_zero() {
        assert_eq!(relu_max_pool(&[1.0, -2.0, 9.0, -3.0, 4.0, 9.0, 9.0, 9.0, 9.0], 3), [4.0]);
        assert_eq!(relu_max_pool(&[-1.0, -2.0, -3.0, -4.0], 2), [0.0]);
    }
}
