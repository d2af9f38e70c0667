//! Ends of a wave: an antenna at finite range or a direction at infinite range, real or mirrored.

use crate::geometry::plane::Plane;
use glam::{DQuat, DVec3};

/// Source or destination of a wave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Antenna {
    /// An antenna at finite range, world metres: spherical waves.
    Point(DVec3),
    /// Infinitely far away along this unit vector r̂ (from the body to the antenna): plane waves.
    Direction(DVec3),
}

impl Antenna {
    /// Image behind a facet's plane: p' = p − 2((p − x_A)·n)n, or r̂' = r̂ − 2(r̂·n)n.
    pub fn mirrored(self, plane: &Plane) -> Self {
        match self {
            Self::Point(p) => Self::Point(p - 2.0 * plane.distance_m(p) * plane.normal),
            Self::Direction(r) => Self::Direction(r - 2.0 * r.dot(plane.normal) * plane.normal),
        }
    }

    /// Antenna rotated about the world's origin.
    pub(crate) fn turned(self, by: DQuat) -> Self {
        match self {
            Self::Point(p) => Self::Point(by * p),
            Self::Direction(r) => Self::Direction(by * r),
        }
    }

    /// Unit vector of travel at `x_m`, away from the antenna; zero at the antenna itself.
    pub fn travel_direction_at(self, x_m: DVec3) -> DVec3 {
        -self.towards(x_m).try_normalize().unwrap_or(DVec3::ZERO)
    }

    /// Path length from the antenna to `x_m`, m; for a direction it is counted from the plane through the
    /// world's origin, −r̂·x.
    pub fn path_length_m(self, x_m: DVec3) -> f64 {
        match self {
            Self::Point(p) => p.distance(x_m),
            Self::Direction(r) => -r.dot(x_m),
        }
    }

    /// Distance over which the wave has spread at `x_m`, m; infinite for a direction.
    pub fn range_m(self, x_m: DVec3) -> f64 {
        match self {
            Self::Point(p) => p.distance(x_m),
            Self::Direction(_) => f64::INFINITY,
        }
    }

    /// Vector from `x_m` to the antenna (metres), or r̂ (unit) for a direction.
    pub(crate) fn towards(self, x_m: DVec3) -> DVec3 {
        match self {
            Self::Point(p) => p - x_m,
            Self::Direction(r) => r,
        }
    }

    /// Whether every coordinate is finite and a direction is not zero.
    pub(crate) fn is_sound(self) -> bool {
        match self {
            Self::Point(p) => p.is_finite(),
            Self::Direction(r) => r.is_finite() && r != DVec3::ZERO,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_image_is_as_far_from_every_point_of_the_mirror_as_the_antenna() {
        let normal = DVec3::new(1.0, 2.0, -2.0) / 3.0;
        let plane = Plane { normal, offset_m: 0.7 };
        let p = DVec3::new(3.0, -1.0, 0.5);
        let on_mirror = 0.7 * normal + normal.any_orthonormal_vector() * 4.0;
        let Antenna::Point(image) = Antenna::Point(p).mirrored(&plane) else { unreachable!() };
        assert!((image.distance(on_mirror) - p.distance(on_mirror)).abs() < 1e-14);
        assert!((plane.distance_m(image) + plane.distance_m(p)).abs() < 1e-14);
    }

    #[test]
    fn a_far_point_and_its_direction_agree_in_travel_and_in_differences_of_length() {
        let r = DVec3::new(0.36, 0.48, 0.8);
        let (far, direction) = (Antenna::Point(r * 1e6), Antenna::Direction(r));
        let (x, y) = (DVec3::new(1.0, -2.0, 0.5), DVec3::new(-0.5, 0.1, 2.0));
        // Curvature of the wavefront: |x|²/2R ≈ 5e-6 m; parallax |x|/R ≈ 3e-6 rad.
        let difference = |a: Antenna| a.path_length_m(x) - a.path_length_m(y);
        assert!((difference(far) - difference(direction)).abs() < 6e-6);
        assert!((far.travel_direction_at(x) - direction.travel_direction_at(x)).length() < 4e-6);
    }
}
