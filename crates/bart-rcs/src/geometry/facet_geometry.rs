//! A triangle with its plane.

use crate::geometry::plane::Plane;
use artifact::paths::Facet;
use glam::DVec3;

/// A triangle in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacetGeometry {
    /// Corners, world metres, in the mesh's winding.
    pub corners_m: [DVec3; 3],
    /// Plane through the corners; its unit normal follows the winding. A zero normal marks a triangle without
    /// a plane: it neither scatters nor hides.
    pub plane: Plane,
    /// Area, m².
    pub area_m2: f64,
    /// Target, and triangle in its mesh, which may have been subdivided into several facets.
    pub id: Facet,
}

impl FacetGeometry {
    /// Unit normal by the winding, or zero.
    pub fn normal(&self) -> DVec3 {
        self.plane.normal
    }

    /// Whether the triangle spans a plane.
    pub fn has_plane(&self) -> bool {
        self.plane.normal != DVec3::ZERO
    }

    /// Facet with the plane through its corners.
    pub(crate) fn of_triangle(corners_m: [DVec3; 3], id: Facet) -> Self {
        let [a, b, c] = corners_m;
        let plane = Plane::of_triangle(&corners_m).unwrap_or(Plane { normal: DVec3::ZERO, offset_m: 0.0 });
        Self { corners_m, plane, area_m2: 0.5 * (b - a).cross(c - a).length(), id }
    }

    /// Removes the plane of a triangle whose height, and so its normal, is mere rounding.
    pub(crate) fn refuse_if_thinner_than(&mut self, height_m: f64) {
        let [a, b, c] = self.corners_m;
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        if 2.0 * self.area_m2 <= height_m * longest {
            self.plane = Plane { normal: DVec3::ZERO, offset_m: 0.0 };
        }
    }
}
