//! What the classifier says of a frame's objects.

use crate::descriptions::settings::Class;
use crate::files::envelope::Schema;
use serde::{Deserialize, Serialize};

/// The `.classes` artifact: what a cache keeps of the classifier.
pub struct Classes;

impl Schema for Classes {
    const NAME: &'static str = "classes";
    const VERSION: u32 = 1;
    type Header = ClassesHeader;
    type Frame = ClassesFrame;
}

/// What does not change from frame to frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClassesHeader {
    /// In the order of the probabilities.
    pub classes: Vec<Class>,
}

/// Classes of the objects of one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClassesFrame {
    /// Of each object, in the order of the points' objects: how probable each class is.
    pub probabilities: Vec<[f32; 4]>,
}
