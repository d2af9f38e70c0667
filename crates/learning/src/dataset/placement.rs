//! Placement of a scene's vehicles: one after the other, each clear of those before it.

use artifact::scene::{Pose, SceneHeader};
use std::f64::consts::FRAC_PI_2;

/// Least gap from bumper to bumper along a lane, m.
const CLEAR_ALONG_M: f64 = 1.5;
/// Least lateral gap, m; vehicles further apart are in different lanes.
const CLEAR_ACROSS_M: f64 = 0.3;

/// A body on the road with its rotated box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BodyOnRoad {
    /// Position of the body's middle, across and along the road, m.
    pub(super) at_m: [f64; 2],
    /// Half of the box's extent across and along the road.
    half_m: [f64; 2],
    speed_mps: f64,
    /// Deviation from the lane's direction, counter-clockwise.
    yaw_rad: f64,
}

impl BodyOnRoad {
    /// Makes a body of the given half width and length; `at_m` is across and along the road.
    pub(super) fn of(at_m: [f64; 2], [side_m, front_m]: [f64; 2], speed_mps: f64, yaw_rad: f64) -> Self {
        let [sin, cos] = [yaw_rad.sin().abs(), yaw_rad.cos().abs()];
        let half_m = [side_m * cos + front_m * sin, side_m * sin + front_m * cos];
        Self { at_m, half_m, speed_mps, yaw_rad }
    }

    /// Half of its length along the road.
    pub(super) fn half_along_m(&self) -> f64 {
        self.half_m[1]
    }

    /// Whether two bodies stay clear of one another for the given time, and neither passes the other in its
    /// lane.
    pub(super) fn is_clear_of(&self, other: &Self, seconds: f64) -> bool {
        let apart_m = [0.0, seconds].map(|after_s| {
            let (own, its) = (self.after(after_s), other.after(after_s));
            [0, 1].map(|axis: usize| own[axis] - its[axis])
        });
        let clear = |axis: usize, clear_m: f64| {
            let least_m = self.half_m[axis] + other.half_m[axis] + clear_m;
            let is_one_side = apart_m[0][axis] * apart_m[1][axis] > 0.0;
            is_one_side && apart_m.iter().all(|apart| apart[axis].abs() >= least_m)
        };
        clear(0, CLEAR_ACROSS_M) || clear(1, CLEAR_ALONG_M)
    }

    fn after(&self, seconds: f64) -> [f64; 2] {
        let way_m = self.speed_mps * seconds;
        let [across_m, along_m] = self.at_m;
        [across_m + way_m * self.yaw_rad.sin(), along_m - way_m * self.yaw_rad.cos()]
    }

    /// Pose in the world, driving towards the radar.
    pub(super) fn pose(&self, base: &SceneHeader) -> Pose {
        let road = &base.dsp.road;
        let [x_m, y_m] = road.world_m(self.at_m);
        let yaw_rad = -FRAC_PI_2 - road.azimuth_rad + self.yaw_rad;
        let (sin, cos) = yaw_rad.sin_cos();
        Pose {
            position_m: [x_m, y_m, 0.0],
            yaw_rad,
            yaw_radps: 0.0,
            velocity_mps: [self.speed_mps * cos, self.speed_mps * sin, 0.0],
            acceleration_mps2: [0.0; 3],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A car of 4 m × 2 m.
    fn car(at_m: [f64; 2], speed_mps: f64) -> BodyOnRoad {
        BodyOnRoad::of(at_m, [1.0, 2.0], speed_mps, 0.0)
    }

    #[test]
    fn vehicles_of_a_lane_are_clear_from_one_and_a_half_metres_on() {
        let first = car([2.0, 30.0], 0.0);
        assert!(
            car([2.0, 35.5], 0.0).is_clear_of(&first, 0.0) && !car([2.0, 35.4], 0.0).is_clear_of(&first, 0.0)
        );
        assert!(car([2.0, 24.5], 0.0).is_clear_of(&first, 0.0), "before it as behind it");
        assert!(
            car([4.3, 30.0], 0.0).is_clear_of(&first, 0.0) && !car([4.2, 30.0], 0.0).is_clear_of(&first, 0.0)
        );
    }

    #[test]
    fn vehicles_that_meet_or_pass_within_the_time_are_not_clear() {
        let (slow, fast) = (car([2.0, 30.0], 5.0), car([2.0, 40.0], 15.0));
        assert!(fast.is_clear_of(&slow, 0.4) && !fast.is_clear_of(&slow, 0.5));
        assert!(!fast.is_clear_of(&slow, 2.0), "it would have driven through");
        assert!(car([5.75, 40.0], 15.0).is_clear_of(&slow, 2.0), "in the next lane it may");
    }

    #[test]
    fn a_body_that_is_turned_takes_more_of_the_road() {
        let turned = BodyOnRoad::of([0.0; 2], [1.0, 2.0], 0.0, FRAC_PI_2);
        // A quarter turn swaps the sides to rounding.
        assert!((turned.half_m[0] - 2.0).abs() < 1e-15 && (turned.half_along_m() - 1.0).abs() < 1e-15);
    }
}
