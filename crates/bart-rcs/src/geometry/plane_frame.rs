//! Coordinates in a facet's plane.

use glam::{DVec2, DVec3};

/// Right-handed coordinates (u, v) relative to a point of a plane, u × v along its normal.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlaneFrame {
    origin_m: DVec3,
    u: DVec3,
    v: DVec3,
}

impl PlaneFrame {
    /// Coordinates relative to `origin_m`; `normal` is unit.
    pub(crate) fn new(origin_m: DVec3, normal: DVec3) -> Self {
        let u = normal.any_orthonormal_vector();
        Self { origin_m, u, v: normal.cross(u) }
    }

    /// Unit normal u × v.
    pub(crate) fn normal(&self) -> DVec3 {
        self.u.cross(self.v)
    }

    /// Coordinates of a point's perpendicular foot on the plane.
    pub(crate) fn plane_from_world(&self, x_m: DVec3) -> DVec2 {
        self.tangential(x_m - self.origin_m)
    }

    /// The point with these coordinates.
    pub(crate) fn to_world(self, coordinates_m: DVec2) -> DVec3 {
        self.origin_m + self.u * coordinates_m.x + self.v * coordinates_m.y
    }

    /// Component of a vector along the plane.
    pub(crate) fn tangential(&self, vector: DVec3) -> DVec2 {
        DVec2::new(vector.dot(self.u), vector.dot(self.v))
    }
}

/// Area of a polygon, positive if it runs counter-clockwise.
pub(crate) fn area_m2(corners_m: &[DVec2]) -> f64 {
    let Some(&first) = corners_m.first() else { return 0.0 };
    corners_m[1..].windows(2).map(|pair| 0.5 * (pair[0] - first).perp_dot(pair[1] - first)).sum()
}

/// Centroid; the mean of the corners if there is no area.
pub(crate) fn centroid_m(corners_m: &[DVec2]) -> DVec2 {
    let Some(&first) = corners_m.first() else { return DVec2::ZERO };
    let (mut area, mut moment) = (0.0, DVec2::ZERO);
    for pair in corners_m[1..].windows(2) {
        let part = (pair[0] - first).perp_dot(pair[1] - first);
        area += part;
        moment += part * (pair[0] + pair[1] - 2.0 * first) / 3.0;
    }
    let mean = || corners_m.iter().sum::<DVec2>() / corners_m.len() as f64;
    if area > 0.0 { first + moment / area } else { mean() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_of_the_plane_comes_back_and_counter_clockwise_is_positive() {
        let normal = DVec3::new(1.0, -2.0, 2.0) / 3.0;
        let frame = PlaneFrame::new(DVec3::new(1.0, 2.0, 3.0), normal);
        let corners = [DVec2::ZERO, DVec2::new(2.0, 0.0), DVec2::new(0.0, 1.0)];
        for c in corners {
            assert!((frame.plane_from_world(frame.to_world(c)) - c).length() < 1e-15);
        }
        let [a, b, c] = corners.map(|c| frame.to_world(c));
        assert!(((b - a).cross(c - a) - 2.0 * normal).length() < 1e-14);
        assert_eq!(area_m2(&corners), 1.0);
        assert!((centroid_m(&corners) - DVec2::new(2.0, 1.0) / 3.0).length() < 1e-15);
    }
}
