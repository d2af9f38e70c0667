//! Points of one radar in one frame, with the true scene.

use artifact::points::PointsFrame;
use artifact::scene::{SceneFrame, SceneHeader};

/// Points of one frame from one radar, with the true scene.
pub struct RadarFrame {
    /// The scene in this frame: vehicles in view are targets.
    pub view: SceneHeader,
    /// Poses of the bodies.
    pub scene: SceneFrame,
    /// Points and objects.
    pub points: PointsFrame,
}
