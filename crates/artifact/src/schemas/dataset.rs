//! Labelled signatures of objects, and crops of range-Doppler maps.

use crate::descriptions::settings::Class;
use crate::files::envelope::Schema;
use crate::schemas::signature::Signature;
use serde::{Deserialize, Serialize};

/// The `.dataset` artifact: one record per sample.
pub struct Dataset;

impl Schema for Dataset {
    const NAME: &'static str = "dataset";
    const VERSION: u32 = 2;
    const RECORD_LIMIT: u64 = 64 << 20;
    type Header = CropFormat;
    type Frame = Sample;
}

/// Scale of a crop: fixed metres, m/s and decibels, so that levels and extents stay comparable.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CropFormat {
    /// Pixels per side: 451 in the paper.
    pub side: u32,
    /// Extent along range (columns), m.
    pub range_span_m: f64,
    /// Extent along velocity (rows), m/s.
    pub velocity_span_mps: f64,
    /// Level of grey 0, dB above the map's noise.
    pub floor_db: f64,
    /// Level of grey 255, dB above the map's noise.
    pub ceiling_db: f64,
}

/// A crop of a range-Doppler map around a detected object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Crop {
    /// Grey levels, row-major `[velocity, range]`, `side`² of them; velocity grows downwards.
    pub pixels: Vec<u8>,
    /// Range of the middle column.
    pub range_m: f64,
    /// Radial velocity of the middle row.
    pub radial_velocity_mps: f64,
}

/// An object of a frame with its label.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Name of the sample, unique in the dataset.
    pub id: String,
    /// Signature of the object in its map.
    pub signature: Signature,
    /// The image; `None` in a dataset without images.
    pub crop: Option<Crop>,
    /// True class; `None` where unknown.
    pub class: Option<Class>,
    /// Vehicle model.
    pub model: String,
    /// Number of the variant of the model's dimensions.
    pub variant: u64,
    /// Scene that the sample was cut from; datasets are split by scene.
    pub scene: u64,
    /// Index of the vehicle among those of its scene.
    pub target: u32,
    /// Frame of the scene; the frames of one target form a track.
    pub frame: u32,
    /// Part of the split that the sample belongs to.
    pub split: Split,
    /// True range of the body's origin.
    pub range_m: f64,
    /// True radial velocity.
    pub radial_velocity_mps: f64,
    /// True lane.
    pub lane: Option<u8>,
    /// Seed of the scene.
    pub seed: u64,
}

/// Parts of a dataset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Split {
    /// Part to which weights are fitted.
    Train,
    /// Part by which epochs are selected.
    Validation,
    /// Part that is evaluated once, at the end.
    Test,
}
