//! Results that a scene is run for, and the accuracy that each needs.

use crate::quantities::accuracy::Accuracy;
use serde::{Deserialize, Serialize};

/// Tenth of the amplitude, an agreement.
const CUBE_DB: f64 = -20.0;
/// Accuracy below which cars in a queue come and go, dB (`docs/validation/sensitivity.md`).
const QUEUES_DB: f64 = -20.0;

/// Result that a scene is run for; the accuracy asked of the run is the one that it needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Goal {
    /// Echo itself, cell by cell.
    Cube,
    /// Objects of a frame: which are found, and their range, velocity, direction and lane.
    Detection,
    /// Tracks over frames: which are followed, and their place, velocity and lane.
    Tracks,
    /// Classes of objects, and their probabilities.
    Class,
}

impl Goal {
    /// Every goal, the most demanding first.
    pub const ALL: [Self; 4] = [Self::Cube, Self::Detection, Self::Tracks, Self::Class];

    /// Name as people write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cube => "cube",
            Self::Detection => "detection",
            Self::Tracks => "tracks",
            Self::Class => "class",
        }
    }

    /// Accuracy that the result needs: the cube's is an agreement, the others are the coarsest of those
    /// measured that leave the result as it is (`docs/validation/sensitivity.md`).
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
