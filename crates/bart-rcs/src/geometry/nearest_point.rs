//! Nearest points of convex polygons and of their sides.

use glam::DVec3;

/// Whether the perpendicular foot of a point on a convex polygon's plane lies in the polygon, whose corners
/// run counter-clockwise about `normal`.
pub(crate) fn is_over(x_m: DVec3, corners_m: &[DVec3], normal: DVec3) -> bool {
    sides(corners_m).all(|(a, b)| (b - a).cross(x_m - a).dot(normal) >= 0.0)
}

/// Sides of a polygon, from corner to corner.
pub(crate) fn sides(corners_m: &[DVec3]) -> impl Iterator<Item = (DVec3, DVec3)> {
    corners_m.iter().copied().zip(corners_m.iter().copied().cycle().skip(1))
}

/// Point of a segment nearest to another; its start if it has no length.
pub(crate) fn on_segment_m(x_m: DVec3, a_m: DVec3, b_m: DVec3) -> DVec3 {
    let along = b_m - a_m;
    let share = (x_m - a_m).dot(along) / along.length_squared();
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
    a_m + share * along
}
