//! The network's shape, from a model's header: names and shapes of its tensors.

use crate::crops::tensor_name;
use crate::error::ClassifierError;
use artifact::dataset::CropFormat;
use artifact::model::{Learner, ModelHeader};
use artifact::settings::Class;

/// Name of the layout in a model's [`NetworkShape`](artifact::model::NetworkShape): three blocks of 3 x 3
/// convolution, batch normalization, rectifier and 2 x 2 maximum, then one fully connected layer (the paper's
/// Fig. 7).
pub const ARCHITECTURE: &str = "3x(conv3x3-batchnorm-relu-maxpool2)-linear";
/// Default channels of the three convolutions (the paper does not give its own).
pub const CHANNELS: [u32; 3] = [8, 16, 32];
/// Largest number of channels: bounds the memory that a header can make this program allocate.
const CHANNELS_LIMIT: u32 = 512;
/// Least side of the input: three halvings must leave a pixel.
const SMALLEST_INPUT_SIDE: u32 = 8;
/// Largest side of the input: bounds the memory that a header can make this program allocate.
const LARGEST_INPUT_SIDE: u32 = 1024;
/// Side of every convolution, pixels.
pub(crate) const KERNEL_SIDE: usize = 3;

/// A checked shape of the network.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    /// Side of the input crops, pixels.
    pub crop_side: usize,
    /// Side of the pooled crops.
    pub input_side: usize,
    /// Channels of the three convolutions.
    pub channels: [usize; 3],
}

impl Layout {
    /// Reads the layout from a header; refuses those that this program cannot build.
    pub fn of(header: &ModelHeader) -> Result<Self, ClassifierError> {
        let Learner::CropNetwork(shape) = &header.learner else {
            return Err(ClassifierError::Architecture {
                found: header.learner.name().into(),
                known: ARCHITECTURE,
            });
        };
        if shape.architecture != ARCHITECTURE {
            return Err(ClassifierError::Architecture {
                found: shape.architecture.clone(),
                known: ARCHITECTURE,
            });
        }
        check_answers(header)?;
        check_sides(&shape.format, shape.input_side)?;
        let [crop_side, input_side] = [shape.format.side as usize, shape.input_side as usize];
        Ok(Self { crop_side, input_side, channels: checked_channels(&shape.channels)? })
    }

    /// Side of the maps after the third block.
    fn last_side(&self) -> usize {
        self.input_side / 2 / 2 / 2
    }

    /// Number of inputs of the fully connected layer.
    pub fn features(&self) -> usize {
        self.channels[2] * self.last_side() * self.last_side()
    }

    /// Name and shape of every tensor of the network, first layer first.
    pub fn tensors(&self) -> Vec<(String, Vec<usize>)> {
        let mut tensors = Vec::new();
        let mut inputs = 1;
        for (block, outputs) in self.channels.into_iter().enumerate() {
            tensors.push((tensor_name::convolution(block), vec![outputs, inputs, KERNEL_SIDE, KERNEL_SIDE]));
            for name in [tensor_name::scale, tensor_name::offset, tensor_name::mean, tensor_name::variance] {
                tensors.push((name(block), vec![outputs]));
            }
            inputs = outputs;
        }
        tensors.push((tensor_name::LINEAR_WEIGHT.into(), vec![self.features(), Class::ALL.len()]));
        tensors.push((tensor_name::LINEAR_BIAS.into(), vec![Class::ALL.len()]));
        tensors
    }
}

/// Refuses a model whose classes are not the four in their order, or whose rule for answers is none: a least
/// probability or a correlation of frames that is not from 0 to 1.
pub(crate) fn check_answers(header: &ModelHeader) -> Result<(), ClassifierError> {
    if header.classes != Class::ALL {
        return Err(ClassifierError::Classes { found: header.classes.clone() });
    }
    check_share("least_probability", header.least_probability)?;
    check_share("frame_correlation", header.frame_correlation)
}

fn check_share(setting: &'static str, found: f32) -> Result<(), ClassifierError> {
    if (0.0..=1.0).contains(&found) {
        return Ok(());
    }
    Err(ClassifierError::Setting { setting, rule: "from 0 to 1", found: f64::from(found) })
}

fn check_sides(format: &CropFormat, input_side: u32) -> Result<(), ClassifierError> {
    if !(SMALLEST_INPUT_SIDE..=LARGEST_INPUT_SIDE).contains(&input_side) {
        return Err(ClassifierError::Setting {
            setting: "input_side",
            rule: "from 8 to 1024 pixels",
            found: f64::from(input_side),
        });
    }
    // A header must not make a classifier expect crops that no artifact could hold (64 MiB a sample).
    if format.side < input_side || format.side > 8192 {
        return Err(ClassifierError::Setting {
            setting: "crop side",
            rule: "from input_side to 8192 pixels",
            found: f64::from(format.side),
        });
    }
    Ok(())
}

fn checked_channels(channels: &[u32]) -> Result<[usize; 3], ClassifierError> {
    match *channels {
        [a, b, c] if [a, b, c].iter().all(|n| (1..=CHANNELS_LIMIT).contains(n)) => {
            Ok([a as usize, b as usize, c as usize])
        }
        _ => Err(ClassifierError::Channels { found: channels.to_vec(), limit: CHANNELS_LIMIT }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rule_for_answers_that_is_no_share_is_refused_by_its_name() {
        let answers = |least_probability: f32, frame_correlation: f32| {
            let learner = Learner::BoostedTrees { features: vec![] };
            let (classes, attributions) = (Class::ALL.to_vec(), vec![]);
            check_answers(&ModelHeader {
                classes,
                learner,
                least_probability,
                frame_correlation,
                attributions,
            })
            .map_err(|error| error.to_string())
        };
        assert!(answers(0.0, 1.0).is_ok() && answers(1.0, 0.0).is_ok());
        let refused = |setting: &str, found: &str| Err(format!("{setting} must be from 0 to 1, is {found}"));
        assert_eq!(answers(1.5, 0.5), refused("least_probability", "1.5"));
        assert_eq!(answers(f32::NAN, 0.5), refused("least_probability", "NaN"));
        assert_eq!(answers(0.5, -0.25), refused("frame_correlation", "-0.25"));
        assert_eq!(answers(0.5, f32::INFINITY), refused("frame_correlation", "inf"));
    }
}
