//! A trained classifier.

use crate::descriptions::settings::Class;
use crate::files::envelope::Schema;
use crate::schemas::dataset::CropFormat;
use serde::{Deserialize, Serialize};

/// The `.model` artifact: one record.
pub struct Model;

impl Schema for Model {
    const NAME: &'static str = "model";
    const VERSION: u32 = 2;
    const RECORD_LIMIT: u64 = 1 << 30;
    type Header = ModelHeader;
    type Frame = Weights;
}

/// Header of a model: what it looks at and what it answers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModelHeader {
    /// Classes in the order of its outputs.
    pub classes: Vec<Class>,
    /// Kind of the model, what it looks at, and its shape.
    pub learner: Learner,
    /// Probability from which on the likeliest class is told; below it the answer is "unknown".
    pub least_probability: f32,
    /// Share that the answers of a track's frames have in common: 0 is nothing, 1 all.
    pub frame_correlation: f32,
    /// Sources of the vehicles that it learned from, a line each, as their licences ask; empty: the
    /// project's own.
    pub attributions: Vec<String>,
}

/// Kinds of models.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Learner {
    /// The paper's network on crops.
    CropNetwork(NetworkShape),
    /// Boosted decision trees on features of signatures, by their names.
    BoostedTrees {
        /// Names of the features, in the order of the columns that trees ask for.
        features: Vec<String>,
    },
}

impl Learner {
    /// Name as people write it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::CropNetwork(_) => "paper",
            Self::BoostedTrees { .. } => "trees",
        }
    }
}

/// Shape of a network and of the crops that it expects.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NetworkShape {
    /// Crops it was trained on.
    pub format: CropFormat,
    /// Name of the network's layout.
    pub architecture: String,
    /// Channels of its convolutions.
    pub channels: Vec<u32>,
    /// Side that crops are pooled to before the first convolution.
    pub input_side: u32,
}

/// Parameters of a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Weights {
    /// A network's: a safetensors file, its metadata cleared so that equal weights are equal bytes.
    Network {
        /// The file.
        safetensors: Vec<u8>,
    },
    /// Boosted trees.
    Trees(BoostedTrees),
}

/// Trees whose leaves are added up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoostedTrees {
    /// Logits before the first tree.
    pub prior: [f32; 4],
    /// Divisor of the sum of logits.
    pub temperature: f32,
    /// Trees in the order in which they were grown.
    pub trees: Vec<Tree>,
}

/// A decision tree: the first node is its root, children stand behind their parents.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tree {
    /// Nodes of all levels.
    pub nodes: Vec<Node>,
}

/// A node of a tree.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Node {
    /// Goes on at `above` where the feature is greater than the threshold, else at `below`.
    Split {
        /// Number of the feature.
        feature: u32,
        /// Threshold between two values of the feature.
        threshold: f32,
        /// Number of the node for values up to the threshold.
        below: u32,
        /// Number of the node for greater values.
        above: u32,
    },
    /// Addends to the logits.
    Leaf([f32; 4]),
}
