//! A body of a view: its name, mesh and pose.

use artifact::scene::{Pose, Role, Target};
use artifact::settings::Class;
use serde::Serialize;

/// A body at its pose.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(in crate::report) struct BodyView {
    id: String,
    class: Option<&'static str>,
    is_clutter: bool,
    /// Index of the mesh; `None` for a point.
    mesh: Option<u32>,
    place_m: [f64; 3],
    yaw_rad: f64,
}

impl BodyView {
    /// The body of a target at a pose.
    pub(in crate::report) fn of(target: &Target, pose: &Pose) -> Self {
        Self {
            id: target.id.clone(),
            class: target.kind.class().map(Class::name),
            is_clutter: target.role == Role::Clutter,
            mesh: target.kind.mesh(),
            place_m: pose.position_m,
            yaw_rad: pose.yaw_rad,
        }
    }

    /// The body with its mesh at another index in the page.
    pub(in crate::report) fn with_mesh(self, place: impl Fn(u32) -> u32) -> Self {
        Self { mesh: self.mesh.map(place), ..self }
    }
}
