//! Where the vehicles of a scene stand: one after the other, each where it keeps clear of those before it.

use artifact::scene::{Pose, SceneHeader};
use std::f64::consts::FRAC_PI_2;

/// From bumper to bumper along a lane, m.
const CLEAR_ALONG_M: f64 = 1.5;
/// Beside one another, m; what is further apart across is in another lane.
const CLEAR_ACROSS_M: f64 = 0.3;

/// A body on the road, its box turned as it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// Of the middle, across and along the road.
    pub(super) at_m: [f64; 2],
    /// Half of the box's extent across and along the road.
    half_m: [f64; 2],
    speed_mps: f64,
    /// Off the lane's direction, counter-clockwise.
    yaw_rad: f64,
}

impl Place {
    /// A body of that half width and length; `at_m` is across and along the road.
    pub(super) fn of(at_m: [f64; 2], [side_m, front_m]: [f64; 2], speed_mps: f64, yaw_rad: f64) -> Self {
        let [sin, cos] = [yaw_rad.sin().abs(), yaw_rad.cos().abs()];
        let half_m = [side_m * cos + front_m * sin, side_m * sin + front_m * cos];
        Self { at_m, half_m, speed_mps, yaw_rad }
    }

    /// Half of what it takes along the road.
    pub(super) fn half_along_m(&self) -> f64 {
        self.half_m[1]
    }

    /// Whether they keep clear of one another for so long, and neither passes the other in its lane.
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

    /// In the world, on its way towards the radar.
    pub(super) fn pose(&self, base: &SceneHeader) -> Pose {
        let road = &base.dsp.road;
        let [x_m, y_m] = road.world_m(self.at_m);
        let yaw_rad = -FRAC_PI_2 - road.azimuth_rad + self.yaw_rad;
        let (sin, cos) = yaw_rad.sin_cos();
        Pose {
            position_m: [x_m, y_m, 0.0],
            yaw_rad,
            velocity_mps: [self.speed_mps * cos, self.speed_mps * sin, 0.0],
            acceleration_mps2: [0.0; 3],
        }
    }
}
