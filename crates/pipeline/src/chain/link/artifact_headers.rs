//! Headers of a scene's artifacts, and its bodies in their numbering: the scene's targets, then every vehicle
//! of its traffic that is in view in some frame.

use artifact::cube::CubeHeader;
use artifact::paths::PathsHeader;
use artifact::points::PointsHeader;
use artifact::rcs::RcsHeader;
use artifact::scene::SceneHeader;

/// Header of the `.paths` artifact.
pub fn paths_header(scene: &SceneHeader) -> PathsHeader {
    PathsHeader {
        radar: scene.radar.clone(),
        centre_frequency_hz: scene.radar.waveform.centre_frequency_hz(),
        targets: body_ids(scene),
    }
}

/// Header of the `.rcs` artifact.
pub fn rcs_header(scene: &SceneHeader) -> RcsHeader {
    RcsHeader { radar: Some(scene.radar.clone()), targets: body_ids(scene) }
}

/// Header of the `.points` artifact, without truth.
pub(crate) fn points_header(cube: &CubeHeader) -> PointsHeader {
    PointsHeader { cube: Some(cube.clone()), targets: vec![], classes: vec![] }
}

/// Header of the `.points` artifact of a run, with the true origins of points.
pub fn points_header_with_truth(scene: &SceneHeader, cube: &CubeHeader) -> PointsHeader {
    let classes = scene.bodies().map(|(_, kind)| kind.class()).collect();
    PointsHeader { targets: body_ids(scene), classes, ..points_header(cube) }
}

/// Ids of all bodies.
pub fn body_ids(scene: &SceneHeader) -> Vec<String> {
    scene.bodies().map(|(id, _)| id.clone()).collect()
}
