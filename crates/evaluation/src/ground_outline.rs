//! The ground that a body covers: its bounding box seen from above, rotated like the body.

use artifact::scene::{Mesh, Pose};
use glam::DVec2;

/// A rectangle on the road; that of a point target has no extent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroundOutline {
    origin_m: DVec2,
    yaw_rad: f64,
    /// Corners in body axes.
    low_m: DVec2,
    high_m: DVec2,
}

impl GroundOutline {
    /// The outline of a body's mesh at a pose.
    pub fn of_mesh(mesh: &Mesh, pose: &Pose) -> Self {
        let [low_m, high_m] = mesh.bounds_m().map(|[x, y, _]| DVec2::new(x, y));
        Self { low_m, high_m, ..Self::of_point(pose) }
    }

    /// The outline of an upright box: its middle, its length and width, and the direction of its front from
    /// world +x towards +y.
    pub fn of_box(middle_m: DVec2, size_m: DVec2, yaw_rad: f64) -> Self {
        Self { origin_m: middle_m, yaw_rad, low_m: -0.5 * size_m, high_m: 0.5 * size_m }
    }

    /// The outline of a point.
    pub fn of_point(pose: &Pose) -> Self {
        let [x_m, y_m, _] = pose.position_m;
        Self {
            origin_m: DVec2::new(x_m, y_m),
            yaw_rad: pose.yaw_rad,
            low_m: DVec2::ZERO,
            high_m: DVec2::ZERO,
        }
    }

    /// Least and greatest distance between its parts and a place.
    pub fn ranges_m(&self, place_m: DVec2) -> [f64; 2] {
        let in_body = DVec2::from_angle(-self.yaw_rad).rotate(place_m - self.origin_m);
        let farthest_m = (in_body - self.low_m).abs().max((in_body - self.high_m).abs());
        [in_body.distance(in_body.clamp(self.low_m, self.high_m)), farthest_m.length()]
    }

    /// Distance between a place and the nearest part of the outline; 0 inside.
    pub fn distance_m(&self, place_m: DVec2) -> f64 {
        self.ranges_m(place_m)[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(x_m: f64, y_m: f64, yaw_deg: f64) -> Pose {
        let yaw_rad = f64::to_radians(yaw_deg);
        Pose {
            position_m: [x_m, y_m, 0.0],
            yaw_rad,
            yaw_radps: 0.0,
            velocity_mps: [0.0; 3],
            acceleration_mps2: [0.0; 3],
        }
    }

    #[test]
    fn distances_are_to_the_nearest_side_of_the_turned_box_and_zero_inside() {
        // 12 m × 2.5 m, its front towards −y: x from 0.75 to 3.25 m, y from 44 to 56 m.
        let vertices_m = vec![[-6.0, -1.25, 0.0], [6.0, 1.25, 3.0]];
        let bus = GroundOutline::of_mesh(&Mesh { vertices_m, ..Mesh::default() }, &pose(2.0, 50.0, -90.0));
        for (place, asked_m) in [
            ([2.0, 44.0], 0.0),
            ([2.0, 50.0], 0.0),
            ([2.0, 43.0], 1.0),
            ([5.25, 50.0], 2.0),
            ([6.25, 40.0], 5.0),
        ] {
            let got_m = bus.distance_m(DVec2::from(place));
            // A rotation of numbers below 100 rounds by 100 ε at most.
            assert!((got_m - asked_m).abs() < 1e-12, "{place:?}: {got_m}, {asked_m}");
        }
        let [near_m, far_m] = bus.ranges_m(DVec2::new(2.0, 4.0));
        assert!((near_m - 40.0).abs() < 1e-12 && (far_m - 52.0_f64.hypot(1.25)).abs() < 1e-12);
        let point = GroundOutline::of_point(&pose(1.0, 2.0, 0.0));
        assert_eq!(point.distance_m(DVec2::new(4.0, 6.0)), 5.0);
    }
}
