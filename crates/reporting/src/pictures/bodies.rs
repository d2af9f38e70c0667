//! True bodies of a frame for pictures, at the frame's middle as in the tables.

use artifact::scene::{Mesh, Pose, Role, SceneFrame, SceneHeader, Target, TargetKind};
use artifact::settings::Class;
use glam::DVec2;

/// A body at its pose.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub(super) name: String,
    pub(super) colour: &'static str,
    /// Meaning of the colour, for the legend.
    pub(super) kind: &'static str,
    pub(super) place_m: [f64; 3],
    /// Corners of the body's box on the ground, world x and y; none for a point.
    pub(super) corners_m: Vec<[f64; 2]>,
    /// Lowest and highest point of the body, world z, m.
    pub(super) heights_m: [f64; 2],
}

/// All bodies of a frame; `header` is the scene in this frame.
pub(super) fn bodies(header: &SceneHeader, frame: &SceneFrame) -> Vec<Body> {
    let middle_s = header.in_frame(frame.index).radar.frame_middle_s();
    let of =
        |(target, pose): (&Target, &Pose)| body(header, target, &radar::motion::pose_after(pose, middle_s));
    header.targets.iter().zip(&frame.poses).map(of).collect()
}

fn body(header: &SceneHeader, target: &Target, pose: &Pose) -> Body {
    let (colour, kind) = colour(target);
    let mesh = header.mesh_of(&target.kind);
    let foot_m = pose.position_m[2];
    let [low_m, high_m] = mesh.map_or([0.0; 2], |mesh| span(mesh, 2));
    Body {
        name: target.id.clone(),
        colour,
        kind,
        place_m: pose.position_m,
        corners_m: mesh.map(|mesh| footprint(mesh, pose)).unwrap_or_default(),
        heights_m: [foot_m + low_m, foot_m + high_m],
    }
}

/// Colour of a body by its class; clutter is darker than a body without one.
fn colour(target: &Target) -> (&'static str, &'static str) {
    match &target.kind {
        TargetKind::Mesh { .. } if target.role == Role::Clutter => ("clutter", "clutter"),
        TargetKind::Mesh { class, .. } => {
            (class_colour(*class), class.map_or("body of no class", Class::name))
        }
        TargetKind::Point { .. } => (class_colour(None), "point target"),
    }
}

fn span(mesh: &Mesh, axis: usize) -> [f64; 2] {
    let values = mesh.vertices_m.iter().map(|v| v[axis]);
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
}

/// Corners of the bounding box on the ground, world x and y.
fn footprint(mesh: &Mesh, pose: &Pose) -> Vec<[f64; 2]> {
    let ([x0, x1], [y0, y1]) = (span(mesh, 0), span(mesh, 1));
    let turn = DVec2::from_angle(pose.yaw_rad);
    let foot = DVec2::new(pose.position_m[0], pose.position_m[1]);
    [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|c| (foot + turn.rotate(DVec2::from(c))).to_array()).to_vec()
}

/// Colour of a class as `plotting` names it; grey without a class.
fn class_colour(class: Option<Class>) -> &'static str {
    class.map_or("plain", Class::name)
}
