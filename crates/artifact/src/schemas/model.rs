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

/// What a model looks at and answers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModelHeader {
    /// Classes in the order of its outputs.
    pub classes: Vec<Class>,
    /// What it looks at, and its shape.
    pub learner: Learner,
    /// Probability from which on the likeliest class is told; below it the answer is "unknown".
    pub least_probability: f32,
    /// What the answers of a track's frames have in common: 0 is nothing, 1 all.
    pub frame_correlation: f32,
    /// Where the vehicles come from that it learned from, a line each, as their licences ask; empty: the
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
        /// In the order of the columns that trees ask for.
        features: Vec<String>,
    },
}

impl Learner {
    /// As people write it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::CropNetwork(_) => "paper",
            Self::BoostedTrees { .. } => "trees",
        }
    }
}

/// What a network expects.
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

/// Parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Weights {
    /// A network's: a safetensors file, its metadata cleared so that equal weights are equal bytes.
    Network {
        /// The file.
        safetensors: Vec<u8>,
    },
    /// Trees.
    Trees(BoostedTrees),
}

/// Trees whose leaves are added up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoostedTrees {
    /// Logits before the first tree.
    pub prior: [f32; 4],
    /// That the sum is divided by.
    pub temperature: f32,
    /// In the order in which they were grown.
    pub trees: Vec<Tree>,
}

/// A decision tree: the first node is its root, children stand behind their parents.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tree {
    /// Of all levels.
    pub nodes: Vec<Node>,
}

/// A node of a tree.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Node {
    /// Goes on `above` where the feature is greater than the threshold, else `below`.
    Split {
        /// Number of the feature.
        feature: u32,
        /// Between two values.
        threshold: f32,
        /// Number of a node.
        below: u32,
        /// Number of a node.
        above: u32,
    },
    /// What it adds to each logit.
    Leaf([f32; 4]),
}
