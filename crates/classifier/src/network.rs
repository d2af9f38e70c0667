//! The paper's network (Fig. 7): three blocks of convolution, batch normalization, rectifier and maximum, then a fully
//! connected layer whose softmax is the probability of each class.

use crate::ClassifierError;
use crate::layout::{Layout, name};
use crate::parameters::{Parameters, Values};
use artifact::settings::Class;
use burn::module::{Module, Param, RunningState};
use burn::nn::conv::{Conv2d, Conv2dConfig};
use burn::nn::pool::{MaxPool2d, MaxPool2dConfig};
use burn::nn::{BatchNorm, BatchNormConfig, Linear, LinearConfig, PaddingConfig2d};
use burn::tensor::{Device, Tensor, TensorData, activation};
use std::collections::BTreeMap;

/// Logits of one crop, in the order of [`Class::ALL`].
pub(crate) type Logits = [f32; 4];

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
    pub(crate) fn new(layout: &Layout, parameters: &Parameters, device: &Device) -> Result<Self, ClassifierError> {
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
    pub(crate) fn parameters(&self) -> Result<Parameters, ClassifierError> {
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
    ) -> Result<Self, ClassifierError> {
        // No bias: the normalization behind it would take it away again.
        let mut convolution = Conv2dConfig::new(channels, [3, 3])
            .with_padding(PaddingConfig2d::Explicit(1, 1, 1, 1))
            .with_bias(false)
            .init(device);
        convolution.weight = parameter(parameters, &name::convolution(index), device)?;
        let mut normalization = BatchNormConfig::new(channels[1]).init(device);
        normalization.gamma = parameter(parameters, &name::scale(index), device)?;
        normalization.beta = parameter(parameters, &name::offset(index), device)?;
        normalization.running_mean = RunningState::new(tensor(parameters, &name::mean(index), device)?);
        normalization.running_var = RunningState::new(tensor(parameters, &name::variance(index), device)?);
        let pooling = MaxPool2dConfig::new([2, 2]).with_strides([2, 2]).init();
        Ok(Self { convolution, normalization, pooling })
    }

    fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        let normalized = self.normalization.forward(self.convolution.forward(input));
        // The maximum and the rectifier commute (both rise); in this order the rectifier sees a quarter of the pixels.
        activation::relu(self.pooling.forward(normalized))
    }
}

/// Pooled grey levels of several crops as the network's input.
pub(crate) fn input(crops: &[impl AsRef<[u8]>], side: usize, device: &Device) -> Tensor<4> {
    let levels: Vec<f32> = crops.iter().flat_map(|c| c.as_ref()).map(|g| f32::from(*g) / 255.0).collect();
    Tensor::from_data(TensorData::new(levels, [crops.len(), 1, side, side]), device)
}

/// Logits `[crop, class]` as plain numbers.
pub(crate) fn logits(tensor: Tensor<2>) -> Result<Vec<Logits>, ClassifierError> {
    Ok(values(tensor)?.values.as_chunks().0.to_vec())
}

fn values<const D: usize>(tensor: Tensor<D>) -> Result<Values, ClassifierError> {
    let shape = tensor.dims().to_vec();
    let data = tensor.try_into_data().map_err(library("read a tensor"))?;
    let values = data.as_slice::<f32>().map_err(library("read a tensor as f32"))?.to_vec();
    Ok(Values { shape, values })
}

fn parameter<const D: usize>(
    parameters: &Parameters,
    name: &str,
    device: &Device,
) -> Result<Param<Tensor<D>>, ClassifierError> {
    Ok(Param::from_tensor(tensor(parameters, name, device)?))
}

fn tensor<const D: usize>(parameters: &Parameters, name: &str, device: &Device) -> Result<Tensor<D>, ClassifierError> {
    let Values { shape, values } = parameters.get(name)?.clone();
    Ok(Tensor::from_data(TensorData::new(values, shape), device))
}

fn library<E: Into<Box<dyn std::error::Error + Send + Sync>>>(
    doing: &'static str,
) -> impl FnOnce(E) -> ClassifierError {
    move |cause| ClassifierError::Library { doing, cause: cause.into() }
}
