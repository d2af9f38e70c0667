//! What one radar saw of one frame.

use artifact::points::PointsFrame;
use artifact::scene::{SceneFrame, SceneHeader};

/// What one radar saw of one frame, and what there was.
pub(crate) struct Seen {
    pub(crate) view: SceneHeader,
    pub(crate) scene: SceneFrame,
    pub(crate) points: PointsFrame,
}
