//! Headers of a scene's artifacts, and its bodies as these number them: the scene's targets, then every
//! vehicle of its traffic that is in view in some frame.

use crate::host::provenance_checks;
use artifact::cube::CubeHeader;
use artifact::paths::PathsHeader;
use artifact::points::PointsHeader;
use artifact::rcs::RcsHeader;
use artifact::scene::{SceneHeader, TargetKind};
use artifact::settings::Class;

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

/// Header of the `.points` artifact of a run, whose points know whose they are.
pub fn points_header_with_truth(scene: &SceneHeader, cube: &CubeHeader) -> PointsHeader {
    PointsHeader { targets: body_ids(scene), classes: body_classes(scene), ..points_header(cube) }
}

/// Ids of all bodies.
pub fn body_ids(scene: &SceneHeader) -> Vec<String> {
    provenance_checks::body_ids(scene).cloned().collect()
}

/// Classes of the same, where they are told.
fn body_classes(scene: &SceneHeader) -> Vec<Option<Class>> {
    let vehicles = scene.traffic.iter().flat_map(|traffic| &traffic.vehicles).map(|vehicle| &vehicle.kind);
    let class = |kind: &TargetKind| match kind {
        TargetKind::Mesh { class, .. } => *class,
        TargetKind::Point { .. } => None,
    };
    scene.targets.iter().map(|target| &target.kind).chain(vehicles).map(class).collect()
}
