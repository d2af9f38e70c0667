//! Section of a wave front intercepted by a polygon: its solid angle, or its area across the direction of a
//! plane wave.

use crate::geometry::antenna::Antenna;
use crate::geometry::clip::doubled_area;
use glam::DVec3;

/// Solid angle of a convex polygon from an antenna, sr, or its area across the direction to it, m².
pub(crate) fn section(antenna: Antenna, points_m: impl IntoIterator<Item = DVec3>) -> f64 {
    match antenna {
        Antenna::Direction(r) => 0.5 * doubled_area(points_m).dot(r).abs(),
        Antenna::Point(p) => solid_angle_sr(points_m.into_iter().map(|point| point - p)),
    }
}

/// Solid angle of a fan of triangles, each by van Oosterom and Strackee, IEEE T-BME 30 (1983) 125, eq. (8).
fn solid_angle_sr(mut arms_m: impl Iterator<Item = DVec3>) -> f64 {
    let (Some(a), Some(mut b)) = (arms_m.next(), arms_m.next()) else { return 0.0 };
    let mut sum = 0.0;
    for c in arms_m {
        sum += triangle_sr(a, b, c);
        b = c;
    }
    sum.abs()
}

/// Signed solid angle of a triangle from the origin.
pub(crate) fn triangle_sr(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    // a·(b × c) from the differences of the corners: from afar it would be a small difference of large
    // products.
    let numerator = a.dot((b - a).cross(c - a));
    let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * numerator.atan2(denominator)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn an_octant_is_an_eighth_of_the_sphere_and_a_cube_face_a_sixth() {
        let at = |points: &[DVec3]| section(Antenna::Point(DVec3::ZERO), points.iter().copied());
        assert!((at(&[DVec3::X, DVec3::Y, DVec3::Z]) - 0.5 * PI).abs() < 1e-15);
        let face = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(y, z)| DVec3::new(1.0, y, z));
        assert!((at(&face) - 4.0 * PI / 6.0).abs() < 1e-15);
    }

    #[test]
    fn a_small_far_triangle_keeps_its_relative_precision() {
        let corners = [DVec3::ZERO, DVec3::X * 1e-3, DVec3::Y * 1e-3];
        let omega = section(Antenna::Point(DVec3::Z * 1e3), corners);
        // ½·10⁻⁶ m² at 1 km; the tilt and spread across the triangle are below 10⁻¹² of it.
        assert!((omega / 0.5e-12 - 1.0).abs() < 2e-12, "{omega:e}");
        assert_eq!(section(Antenna::Direction(DVec3::Z), corners), 0.5e-6);
    }
}
