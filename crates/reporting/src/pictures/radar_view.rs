//! View of one frame by one radar.

use artifact::points::PointsFrame;
use artifact::scene::{SceneFrame, SceneHeader};

/// Points of one frame that one radar saw, and the scene that there was.
pub struct Seen {
    /// The scene as the frame has it: vehicles in view are targets.
    pub view: SceneHeader,
    /// Poses of the bodies.
    pub scene: SceneFrame,
    /// Points and objects.
    pub points: PointsFrame,
}
