//! View of one frame by one radar.

use artifact::points::PointsFrame;
use artifact::scene::{SceneFrame, SceneHeader};

/// Points of one frame that one radar saw, and the scene that there was.
pub(crate) struct Seen {
    pub(crate) view: SceneHeader,
    pub(crate) scene: SceneFrame,
    pub(crate) points: PointsFrame,
}
