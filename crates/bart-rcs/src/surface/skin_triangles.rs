//! The triangles that stand for a mesh.

use crate::surface::bend::ControlHeights;
use glam::DVec3;

/// Triangles that stand for a mesh.
#[derive(Debug, Default)]
pub(crate) struct SkinTriangles {
    /// Body metres.
    pub(crate) triangles_m: Vec<[DVec3; 3]>,
    /// Triangle of the mesh that each is a part of.
    pub(crate) triangle_of: Vec<u32>,
    /// Unit normals at the corners: a smooth skin's; those that the file stores for a flat one, empty where
    /// it does not.
    pub(crate) corner_normals: Vec<[DVec3; 3]>,
    /// The skin's heights over each; empty where facets are the surface.
    pub(crate) heights_m: Vec<ControlHeights>,
    /// Relative amplitude error that they were cut for; 0 where they are the surface.
    pub(crate) error: f64,
}

impl SkinTriangles {
    /// Bytes held, about.
    pub(crate) fn bytes(&self) -> usize {
        self.triangles_m.len() * (2 * size_of::<[DVec3; 3]>() + size_of::<u32>())
            + self.heights_m.len() * size_of::<ControlHeights>()
    }
}
