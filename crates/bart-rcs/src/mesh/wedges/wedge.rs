//! A wedge: two faces that meet at a straight edge.

use glam::{DMat3, DVec3};

/// A wedge as seen from its edge. Face 1 lies along `inward[0]`; the exterior angle φ turns from there around
/// `along` to Nπ at face 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wedge {
    /// Unit vector t along the edge.
    pub(crate) along: DVec3,
    /// Unit vectors in the faces, perpendicular to the edge and away from it.
    pub(crate) inward: [DVec3; 2],
    /// Unit normals of the faces, pointing out of the wedge.
    pub(crate) normal: [DVec3; 2],
    /// Exterior angle over π, N; 2 for an open edge, 3/2 for the edge of a box.
    pub(crate) exterior: f64,
}

impl Wedge {
    /// The same wedge on a rotated body.
    pub(crate) fn turned(&self, world_from_body: DMat3) -> Self {
        let turn = |v: DVec3| world_from_body * v;
        Self {
            along: turn(self.along),
            inward: self.inward.map(turn),
            normal: self.normal.map(turn),
            ..*self
        }
    }
}
