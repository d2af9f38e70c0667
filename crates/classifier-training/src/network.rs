//! The paper's network (Fig. 7): three blocks of convolution, batch normalization, rectifier and maximum,
//! then a fully connected layer whose softmax is the probability of each class; here as it learns, by the
//! learning library.

use crate::error::TrainingError;
use artifact::settings::Class;
use burn::module::{Module, Param, RunningState};
use burn::nn::conv::{Conv2d, Conv2dConfig};
use burn::nn::pool::{MaxPool2d, MaxPool2dConfig};
use burn::nn::{BatchNorm, BatchNormConfig, Linear, LinearConfig, PaddingConfig2d};
use burn::tensor::{Device, Tensor, TensorData, activation};
use classifier::{Layout, Logits, Parameters, VARIANCE_FLOOR, Values, tensor_name as name};
use std::collections::BTreeMap;

/// The network on a device; batch normalization learns where that device differentiates.
#[derive(Module, Debug)]
pub(crate) struct Network {
    blocks: Vec<Block>,
    linear: Linear,
}

#[derive(Module, Debug)]
struct Block {
    convolution: Conv2d,
    normalization: BatchNorm,
    pooling: MaxPool2d,
}

impl Network {
    /// The network with these parameters.
    pub(crate) fn new(
        layout: &Layout,
        parameters: &Parameters,
        device: &Device,
    ) -> Result<Self, TrainingError> {
        let mut blocks = Vec::new();
        let mut inputs = 1;
        for (index, outputs) in layout.channels.into_iter().enumerate() {
            blocks.push(Block::new(index, [inputs, outputs], parameters, device)?);
            inputs = outputs;
        }
        let mut linear = LinearConfig::new(layout.features(), Class::ALL.len()).init(device);
        linear.weight = parameter(parameters, name::LINEAR_WEIGHT, device)?;
        linear.bias = Some(parameter(parameters, name::LINEAR_BIAS, device)?);
        Ok(Self { blocks, linear })
    }

    /// Grey levels from 0 to 1, `[crop, 1, row, column]`, to logits `[crop, class]`.
    pub(crate) fn forward(&self, crops: Tensor<4>) -> Tensor<2> {
        let features = self.blocks.iter().fold(crops, |x, block| block.forward(x));
        self.linear.forward(features.flatten(1, 3))
    }

    /// The parameters as they stand.
    pub(crate) fn parameters(&self) -> Result<Parameters, TrainingError> {
        let mut tensors = BTreeMap::new();
        for (index, block) in self.blocks.iter().enumerate() {
            let normalization = &block.normalization;
            tensors.insert(name::convolution(index), values(block.convolution.weight.val())?);
            tensors.insert(name::scale(index), values(normalization.gamma.val())?);
            tensors.insert(name::offset(index), values(normalization.beta.val())?);
            tensors.insert(name::mean(index), values(normalization.running_mean.value_sync())?);
            tensors.insert(name::variance(index), values(normalization.running_var.value_sync())?);
        }
        tensors.insert(name::LINEAR_WEIGHT.into(), values(self.linear.weight.val())?);
        if let Some(bias) = &self.linear.bias {
            tensors.insert(name::LINEAR_BIAS.into(), values(bias.val())?);
        }
        Ok(Parameters::new(tensors))
    }
}

impl Block {
    fn new(
        index: usize,
        channels: [usize; 2],
        parameters: &Parameters,
        device: &Device,
    ) -> Result<Self, TrainingError> {
        // No bias: the normalization behind it would take it away again.
        let mut convolution = Conv2dConfig::new(channels, [3, 3])
            .with_padding(PaddingConfig2d::Explicit(1, 1, 1, 1))
            .with_bias(false)
            .init(device);
        convolution.weight = parameter(parameters, &name::convolution(index), device)?;
        let mut normalization =
            BatchNormConfig::new(channels[1]).with_epsilon(f64::from(VARIANCE_FLOOR)).init(device);
        normalization.gamma = parameter(parameters, &name::scale(index), device)?;
        normalization.beta = parameter(parameters, &name::offset(index), device)?;
        normalization.running_mean = RunningState::new(tensor(parameters, &name::mean(index), device)?);
        normalization.running_var = RunningState::new(tensor(parameters, &name::variance(index), device)?);
        let pooling = MaxPool2dConfig::new([2, 2]).with_strides([2, 2]).init();
        Ok(Self { convolution, normalization, pooling })
    }

    fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        let normalized = self.normalization.forward(self.convolution.forward(input));
        // The maximum and the rectifier commute (both rise); in this order the rectifier sees a quarter of
        // the pixels.
        activation::relu(self.pooling.forward(normalized))
    }
}

/// Pooled grey levels of several crops as the network's input.
pub(crate) fn input(crops: &[impl AsRef<[u8]>], side: usize, device: &Device) -> Tensor<4> {
    let levels: Vec<f32> = crops.iter().flat_map(|c| c.as_ref()).map(|g| f32::from(*g) / 255.0).collect();
    Tensor::from_data(TensorData::new(levels, [crops.len(), 1, side, side]), device)
}

/// Logits `[crop, class]` as plain numbers.
pub(crate) fn logits(tensor: Tensor<2>) -> Result<Vec<Logits>, TrainingError> {
    Ok(values(tensor)?.values.as_chunks().0.to_vec())
}

fn values<const D: usize>(tensor: Tensor<D>) -> Result<Values, TrainingError> {
    let shape = tensor.dims().to_vec();
    let data = tensor.try_into_data().map_err(library("read a tensor"))?;
    let values = data.as_slice::<f32>().map_err(library("read a tensor as f32"))?.to_vec();
    Ok(Values { shape, values })
}

fn parameter<const D: usize>(
    parameters: &Parameters,
    name: &str,
    device: &Device,
) -> Result<Param<Tensor<D>>, TrainingError> {
    Ok(Param::from_tensor(tensor(parameters, name, device)?))
}

fn tensor<const D: usize>(
    parameters: &Parameters,
    name: &str,
    device: &Device,
) -> Result<Tensor<D>, TrainingError> {
    let Values { shape, values } = parameters.get(name)?.clone();
    Ok(Tensor::from_data(TensorData::new(values, shape), device))
}

fn library<E: Into<Box<dyn std::error::Error + Send + Sync>>>(
    doing: &'static str,
) -> impl FnOnce(E) -> TrainingError {
    move |cause| TrainingError::Library { doing, cause: cause.into() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::dataset::CropFormat;
    use artifact::model::{Learner, ModelHeader, NetworkShape};
    use classifier::{ARCHITECTURE, Classifier};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    fn layout(input_side: u32, channels: [u32; 3]) -> Layout {
        let format = CropFormat {
            side: input_side,
            range_span_m: 24.0,
            velocity_span_mps: 8.0,
            floor_db: 0.0,
            ceiling_db: 50.0,
        };
        let (classes, architecture) = (Class::ALL.to_vec(), ARCHITECTURE.to_owned());
        let shape = NetworkShape { format, architecture, channels: channels.to_vec(), input_side };
        let learner = Learner::CropNetwork(shape);
        let [least_probability, frame_correlation] = [0.0, 1.0];
        let attributions = vec![];
        Layout::of(&ModelHeader { classes, learner, least_probability, frame_correlation, attributions })
            .unwrap()
    }

    /// Parameters of any numbers that keep the levels of a layer near those of the one before.
    fn drawn(layout: &Layout, generator: &mut ChaCha8Rng) -> Parameters {
        let tensors = layout.tensors().into_iter().map(|(name, shape)| {
            let inputs: usize =
                if shape.len() > 1 { shape.iter().product::<usize>() / shape[0].max(4) } else { 1 };
            let least = if name.ends_with("variance") { 0.2 } else { -1.0 };
            let scale = (3.0 / inputs as f32).sqrt();
            let values =
                (0..shape.iter().product()).map(|_| scale * generator.random_range(least..1.0)).collect();
            (name, Values { shape, values })
        });
        Parameters::new(tensors.collect())
    }

    /// The network that was learned here answers in `classifier` alike: probabilities to 1e-5.
    #[test]
    fn the_classifier_answers_as_the_learning_library_does() {
        let mut generator = ChaCha8Rng::seed_from_u64(7);
        for (side, channels) in [(113, [8, 16, 32]), (32, [4, 8, 16]), (9, [1, 3, 2])] {
            let layout = layout(side, channels);
            let parameters = drawn(&layout, &mut generator);
            let crops: Vec<Vec<u8>> =
                (0..20).map(|_| (0..side * side).map(|_| generator.random()).collect()).collect();
            let device = Device::flex();
            let network = Network::new(&layout, &parameters, &device).unwrap().valid();
            let expected = logits(network.forward(input(&crops, side as usize, &device))).unwrap();
            let found = Classifier::from_parameters(layout, &parameters).unwrap().logits(&crops);
            let softmax = |l: &Logits| classifier::log_softmax(l.map(f64::from)).map(f64::exp);
            for (expected, found) in expected.iter().zip(&found) {
                for (a, b) in softmax(expected).into_iter().zip(softmax(found)) {
                    assert!((a - b).abs() < 1e-5, "{expected:?} {found:?}");
                }
            }
            // Not one answer for all: a test that could not fail.
            assert!(expected.iter().any(|l| l != &expected[0]));
        }
    }
}
