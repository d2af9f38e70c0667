//! A trained classifier.

use crate::descriptions::settings::Class;
use crate::files::envelope::Schema;
use crate::schemas::dataset::CropFormat;
use serde::{Deserialize, Serialize};

/// The `.model` artifact: a single record.
pub struct Model;

impl Schema for Model {
    const NAME: &'static str = "model";
    const VERSION: u32 = 3;
    const RECORD_LIMIT: u64 = 1 << 30;
    type Header = ModelHeader;
    type Frame = Weights;
}

/// Header of a model: its inputs and outputs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModelHeader {
    /// Classes in the order of the outputs.
    pub classes: Vec<Class>,
    /// Kind of the model, its inputs and its shape.
    pub learner: Learner,
    /// Minimum probability of the likeliest class; below it the answer is "unknown".
    pub least_probability: f32,
    /// Correlation of the answers over a track's frames, from 0 (independent) to 1 (identical).
    pub frame_correlation: f32,
    /// Sources of the vehicles in the training set, one line each, as their licences require; empty if only
    /// the project's own were used.
    pub attributions: Vec<String>,
}

/// Kinds of models.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Learner {
    /// The paper's network on crops.
    CropNetwork(NetworkShape),
    /// Boosted decision trees on named features of signatures.
    BoostedTrees {
        /// Names of the features, in the order of the trees' column numbers.
        features: Vec<String>,
    },
    /// One-dimensional networks over the range cells of signatures.
    ProfileNetworks(ProfileShape),
    /// Both of them, their answers averaged.
    TreesAndNetworks {
        /// Names of the features, in the order of the trees' column numbers.
        features: Vec<String>,
        /// Inputs of the networks.
        shape: ProfileShape,
    },
}

impl Learner {
    /// Name in files and messages.
    pub fn name(&self) -> &'static str {
        match self {
            Self::CropNetwork(_) => "paper",
            Self::BoostedTrees { .. } => "trees",
            Self::ProfileNetworks(_) => "profile",
            Self::TreesAndNetworks { .. } => "both",
        }
    }
}

/// Shape of a network and of its input crops.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NetworkShape {
    /// Format of the crops in the training set.
    pub format: CropFormat,
    /// Name of the network's architecture.
    pub architecture: String,
    /// Numbers of channels of the convolutions.
    pub channels: Vec<u32>,
    /// Side length to which crops are pooled before the first convolution.
    pub input_side: u32,
}

/// Inputs of the networks over range cells.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ProfileShape {
    /// Number of range cells, from some cells before the object's nearest point on.
    pub cells: u32,
    /// Names of the quantities of each cell, in the order of the channels.
    pub of_cells: Vec<String>,
    /// Names of the quantities of the whole signature, behind the cells.
    pub of_object: Vec<String>,
}

/// Parameters of a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Weights {
    /// A network's weights: a safetensors file with cleared metadata, so that equal weights are equal bytes.
    Network {
        /// Content of the file.
        safetensors: Vec<u8>,
    },
    /// Boosted trees.
    Trees(BoostedTrees),
    /// Networks over range cells, whose logits are averaged.
    Profile(ProfileNetworks),
    /// Trees and networks, whose logits are averaged.
    Both {
        /// Boosted trees.
        trees: BoostedTrees,
        /// Networks over range cells.
        networks: ProfileNetworks,
    },
}

/// Networks of several trainings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ProfileNetworks {
    /// Divisor of the mean logits.
    pub temperature: f32,
    /// One network of each training.
    pub members: Vec<ProfileNetwork>,
}

/// Blocks of convolution, rectifier and maximum of two cells, then two fully connected layers with a
/// rectifier between them; the first also takes the quantities of the whole signature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ProfileNetwork {
    /// Convolutions along range, with their batch normalization merged.
    pub convolutions: Vec<Convolution>,
    /// First fully connected layer.
    pub hidden: Dense,
    /// Second fully connected layer: its outputs are the logits.
    pub output: Dense,
}

/// A convolution along range that keeps the number of cells; beyond the ends there are zeros.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Convolution {
    /// Number of input channels.
    pub inputs: u32,
    /// Number of taps, odd.
    pub taps: u32,
    /// Weights `[output, input, tap]`.
    pub weights: Vec<f32>,
    /// Bias of each output.
    pub bias: Vec<f32>,
}

/// A fully connected layer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Dense {
    /// Weights `[output, input]`.
    pub weights: Vec<f32>,
    /// Bias of each output.
    pub bias: Vec<f32>,
}

/// Trees whose leaves are summed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoostedTrees {
    /// Logits before the first tree.
    pub prior: [f32; 4],
    /// Divisor of the summed logits.
    pub temperature: f32,
    /// Trees in training order.
    pub trees: Vec<Tree>,
}

/// A decision tree: the first node is the root, children follow their parents.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tree {
    /// Nodes of all levels.
    pub nodes: Vec<Node>,
}

/// A node of a tree.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Node {
    /// Continues at `above` where the feature exceeds the threshold, else at `below`.
    Split {
        /// Index of the feature.
        feature: u32,
        /// Threshold between two values of the feature.
        threshold: f32,
        /// Index of the node for values up to the threshold.
        below: u32,
        /// Index of the node for greater values.
        above: u32,
    },
    /// Addends to the logits.
    Leaf([f32; 4]),
}
