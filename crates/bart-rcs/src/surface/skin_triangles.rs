//! Triangles that represent a mesh.

use crate::geometry::clip::doubled_area;
use crate::surface::bend::ControlHeights;
use glam::DVec3;

/// Triangles that represent a mesh.
#[derive(Debug, Default)]
pub(crate) struct SkinTriangles {
    /// Corners, body metres.
    pub(crate) triangles_m: Vec<[DVec3; 3]>,
    /// Triangle of the mesh to which each belongs.
    pub(crate) triangle_of: Vec<u32>,
    /// Unit normals at the corners: those of a smooth skin, or those stored in the file for a flat one, empty
    /// if there are none.
    pub(crate) corner_normals: Vec<[DVec3; 3]>,
    /// Heights of the skin over each triangle; empty if facets are the surface.
    pub(crate) heights_m: Vec<ControlHeights>,
    /// Relative amplitude error for which they were subdivided; 0 if they are the surface.
    pub(crate) error: f64,
    /// Root mean square area of curved facets, m²; 0 if facets are the surface.
    pub(crate) bent_area_m2: f64,
}

/// Root mean square area of the triangles over which a skin rises, m².
pub(crate) fn bent_area_m2(triangles_m: &[[DVec3; 3]], heights_m: &[ControlHeights]) -> f64 {
    let bent = triangles_m.iter().zip(heights_m).filter(|(_, heights_m)| **heights_m != [0.0; 6]);
    let squares = bent.map(|(corners_m, _)| 0.25 * doubled_area(*corners_m).length_squared());
    let (sum, count) = squares.fold((0.0, 0), |(sum, count), square| (sum + square, count + 1));
    (sum / f64::from(count.max(1))).sqrt()
}

impl SkinTriangles {
    /// Approximate memory, bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.triangles_m.len() * (2 * size_of::<[DVec3; 3]>() + size_of::<u32>())
            + self.heights_m.len() * size_of::<ControlHeights>()
    }
}
