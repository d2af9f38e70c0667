//! Classes of a frame's objects from the classifier.

use crate::descriptions::settings::Class;
use crate::files::envelope::Schema;
use serde::{Deserialize, Serialize};

/// The `.classes` artifact: the cached output of the classifier.
pub struct Classes;

impl Schema for Classes {
    const NAME: &'static str = "classes";
    const VERSION: u32 = 1;
    type Header = ClassesHeader;
    type Frame = ClassesFrame;
}

/// Header of the artifact, the same for all frames.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClassesHeader {
    /// Classes in the order of the probabilities.
    pub classes: Vec<Class>,
}

/// Classes of the objects of one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClassesFrame {
    /// Probability of each class for each object, in the order of the points' objects.
    pub probabilities: Vec<[f32; 4]>,
}
