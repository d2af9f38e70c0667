//! A trained classifier.

use crate::Schema;
use crate::dataset::CropFormat;
use crate::settings::Class;
use serde::{Deserialize, Serialize};

/// The `.model` artifact: one record.
pub struct Model;

impl Schema for Model {
    const NAME: &'static str = "model";
    const VERSION: u32 = 1;
    const RECORD_LIMIT: u64 = 1 << 30;
    type Header = ModelHeader;
    type Frame = Weights;
}

/// What the network expects and answers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModelHeader {
    /// Crops it was trained on.
    pub format: CropFormat,
    /// Classes in the order of its outputs.
    pub classes: Vec<Class>,
    /// Name of the network's layout.
    pub architecture: String,
    /// Channels of its convolutions.
    pub channels: Vec<u32>,
    /// Side that crops are pooled to before the first convolution.
    pub input_side: u32,
}

/// Parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Weights {
    /// A safetensors file, its metadata cleared so that equal weights are equal bytes.
    pub safetensors: Vec<u8>,
}
