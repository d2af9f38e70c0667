//! The triangles that stand for a mesh.

use crate::geometry::clip::doubled_area;
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
    /// Root mean square of the areas of bent facets, m²; 0 where facets are the surface.
    pub(crate) bent_area_m2: f64,
}

/// Root mean square of the areas of the triangles over which a skin rises, m².
pub(crate) fn bent_area_m2(triangles_m: &[[DVec3; 3]], heights_m: &[ControlHeights]) -> f64 {
    let bent = triangles_m.iter().zip(heights_m).filter(|(_, heights_m)| **heights_m != [0.0; 6]);
    let squares = bent.map(|(corners_m, _)| 0.25 * doubled_area(*corners_m).length_squared());
    let (sum, count) = squares.fold((0.0, 0), |(sum, count), square| (sum + square, count + 1));
    (sum / f64::from(count.max(1))).sqrt()
}

impl SkinTriangles {
    /// Bytes held, about.
    pub(crate) fn bytes(&self) -> usize {
        self.triangles_m.len() * (2 * size_of::<[DVec3; 3]>() + size_of::<u32>())
            + self.heights_m.len() * size_of::<ControlHeights>()
    }
}
