//! Goals that a scene is run for, and the accuracy that each requires.

use crate::quantities::accuracy::Accuracy;
use serde::{Deserialize, Serialize};

/// Accuracy of the cube, dB: a tenth of the amplitude, by convention.
const CUBE_DB: f64 = -20.0;
/// Accuracy below which cars in a queue appear and disappear, dB (`docs/validation/sensitivity.md`).
const QUEUES_DB: f64 = -20.0;

/// Result that a scene is run for; it sets the accuracy requested of the run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Goal {
    /// The echo itself, cell by cell.
    Cube,
    /// Objects of a frame: which are found, and their range, velocity, direction and lane.
    Detection,
    /// Tracks over frames: which vehicles are followed, and their position, velocity and lane.
    Tracks,
    /// Classes of objects, and their probabilities.
    Class,
}

impl Goal {
    /// All goals, the most demanding first.
    pub const ALL: [Self; 4] = [Self::Cube, Self::Detection, Self::Tracks, Self::Class];

    /// Name in scene files and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cube => "cube",
            Self::Detection => "detection",
            Self::Tracks => "tracks",
            Self::Class => "class",
        }
    }

    /// Accuracy that the result requires: that of the cube is a convention, the others are the coarsest
    /// measured that leave the result unchanged (`docs/validation/sensitivity.md`).
    pub fn accuracy(self) -> Accuracy {
        Accuracy::from_db(self.accuracy_db())
    }

    fn accuracy_db(self) -> f64 {
        match self {
            Self::Cube => CUBE_DB,
            Self::Detection | Self::Tracks | Self::Class => QUEUES_DB,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_result_needs_more_than_the_echo_itself() {
        for goal in Goal::ALL {
            assert!(goal.accuracy() >= Goal::Cube.accuracy(), "{}", goal.name());
        }
        assert!((Goal::Cube.accuracy().amplitude() - 0.1).abs() < 1e-15);
    }
}
