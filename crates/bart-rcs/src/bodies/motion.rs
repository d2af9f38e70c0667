//! Motion of bodies within a frame, and of their images in moving mirrors.

use crate::bodies::road_mirror::below;
use artifact::scene::Pose;
use glam::DVec3;
use radar::motion::{pose_after, total_acceleration_mps2};

/// Velocity of a point at one instant, and its constant acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Motion {
    pub(crate) velocity_mps: DVec3,
    pub(crate) acceleration_mps2: DVec3,
}

/// Motion of a rigid body at one instant: that of its origin, and rotation about an axis through it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RigidMotion {
    pub(crate) origin_m: DVec3,
    pub(crate) of_origin: Motion,
    /// Angular velocity ω: along the vertical for a vehicle, plus along the axle for a wheel.
    pub(crate) turn_radps: DVec3,
    /// Angular acceleration, the rate of ω.
    pub(crate) turn_radps2: DVec3,
}

/// A point of a plane and the plane's normal, fixed to a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MovingPlane {
    pub(crate) point_m: DVec3,
    pub(crate) normal: DVec3,
    pub(crate) body: RigidMotion,
}

impl RigidMotion {
    pub(crate) const REST: Self = Self {
        origin_m: DVec3::ZERO,
        of_origin: Motion::REST,
        turn_radps: DVec3::ZERO,
        turn_radps2: DVec3::ZERO,
    };

    /// Motion of a body `seconds` after its pose.
    pub(crate) fn of(pose: &Pose, seconds: f64) -> Self {
        let (origin_m, of_origin) = if pose.yaw_radps == 0.0 {
            let start = Motion::from_arrays(pose.velocity_mps, pose.acceleration_mps2);
            let (at_m, velocity_mps) = start.after(DVec3::from_array(pose.position_m), seconds);
            (at_m, Motion { velocity_mps, ..start })
        } else {
            let later = pose_after(pose, seconds);
            let motion = Motion::from_arrays(later.velocity_mps, total_acceleration_mps2(&later));
            (DVec3::from_array(later.position_m), motion)
        };
        let turn_radps = DVec3::Z * pose.yaw_radps;
        Self { origin_m, of_origin, turn_radps, turn_radps2: DVec3::ZERO }
    }

    /// The same body rolling on a wheel of this radius, with its axle along `axle` (to the left).
    pub(crate) fn rolling(self, axle: DVec3, radius_m: f64) -> Self {
        let ahead = axle.cross(DVec3::Z);
        let [radps, radps2] = [
            self.of_origin.velocity_mps.dot(ahead) / radius_m,
            // The contribution of a bend is along the axle.
            self.of_origin.acceleration_mps2.dot(ahead) / radius_m,
        ];
        let turning_axle = self.turn_radps.cross(axle);
        Self {
            turn_radps: self.turn_radps + radps * axle,
            turn_radps2: self.turn_radps2 + radps2 * axle + radps * turning_axle,
            ..self
        }
    }

    /// Motion of the body's point at `at_m`: v + ω × r, a + ω × (ω × r) + ω̇ × r.
    pub(crate) fn at(&self, at_m: DVec3) -> Motion {
        if self.turn_radps == DVec3::ZERO {
            return self.of_origin;
        }
        let from_origin_m = at_m - self.origin_m;
        let gained_mps = self.turning(from_origin_m);
        Motion {
            velocity_mps: self.of_origin.velocity_mps + gained_mps,
            acceleration_mps2: self.of_origin.acceleration_mps2 + self.turning_on(from_origin_m, gained_mps),
        }
    }

    /// Rate of a vector fixed to the body: ω × v.
    fn turning(&self, vector: DVec3) -> DVec3 {
        self.turn_radps.cross(vector)
    }

    /// Second derivative of a vector fixed to the body, given its first, `turning`.
    fn turning_on(&self, vector: DVec3, turning: DVec3) -> DVec3 {
        if self.turn_radps2 == DVec3::ZERO {
            return self.turning(turning);
        }
        self.turning(turning) + self.turn_radps2.cross(vector)
    }

    pub(crate) fn is_finite(&self) -> bool {
        self.origin_m.is_finite() && self.of_origin.is_finite() && self.turn_radps.is_finite()
    }

    /// Motion of the image in the road's mirror: it rotates about the vertical like the body, about a
    /// horizontal axis in the opposite sense.
    pub(crate) fn below_road(&self) -> Self {
        let (origin_m, of_origin) = (below(self.origin_m), self.of_origin.below_road());
        let [turn_radps, turn_radps2] = [self.turn_radps, self.turn_radps2].map(|turn| -below(turn));
        Self { origin_m, of_origin, turn_radps, turn_radps2 }
    }
}

impl MovingPlane {
    /// Image of a moving point, and its motion.
    ///
    /// With d = (x − p)·n the image is x − 2dn, its velocity v − 2ḋn − 2dṅ with ḋ = (v − v_p)·n + (x − p)·ṅ
    /// and ṅ = ω × n, its acceleration a − 2d̈n − 4ḋṅ − 2dn̈ with d̈ = (a − a_p)·n + 2(v − v_p)·ṅ + (x −
    /// p)·n̈.
    pub(crate) fn image(&self, at_m: DVec3, motion: Motion) -> (DVec3, Motion) {
        let (n, of_plane) = (self.normal, self.body.at(self.point_m));
        let from_plane_m = at_m - self.point_m;
        let distance_m = from_plane_m.dot(n);
        let turning = self.body.turning(n);
        let turning_on = self.body.turning_on(n, turning);
        let across_mps = motion.velocity_mps - of_plane.velocity_mps;
        let away_mps = across_mps.dot(n) + from_plane_m.dot(turning);
        let away_mps2 = (motion.acceleration_mps2 - of_plane.acceleration_mps2).dot(n)
            + 2.0 * across_mps.dot(turning)
            + from_plane_m.dot(turning_on);
        let of_image = Motion {
            velocity_mps: motion.velocity_mps - 2.0 * (away_mps * n + distance_m * turning),
            acceleration_mps2: motion.acceleration_mps2
                - 2.0 * (away_mps2 * n + 2.0 * away_mps * turning + distance_m * turning_on),
        };
        (at_m - 2.0 * distance_m * n, of_image)
    }
}

impl Motion {
    pub(crate) const REST: Self = Self { velocity_mps: DVec3::ZERO, acceleration_mps2: DVec3::ZERO };

    pub(crate) fn from_arrays(velocity_mps: [f64; 3], acceleration_mps2: [f64; 3]) -> Self {
        let [velocity_mps, acceleration_mps2] = [velocity_mps, acceleration_mps2].map(DVec3::from_array);
        Self { velocity_mps, acceleration_mps2 }
    }

    pub(crate) fn is_finite(&self) -> bool {
        self.velocity_mps.is_finite() && self.acceleration_mps2.is_finite()
    }

    /// Motion of the image in the road's mirror.
    pub(crate) fn below_road(&self) -> Self {
        self.each(below)
    }

    /// Position and velocity after `seconds` (before, if negative) of a point now at `at_m`.
    pub(crate) fn after(&self, at_m: DVec3, seconds: f64) -> (DVec3, DVec3) {
        let gained_mps = seconds * self.acceleration_mps2;
        (at_m + seconds * (self.velocity_mps + 0.5 * gained_mps), self.velocity_mps + gained_mps)
    }

    /// Weighted sum Σ w·motion.
    pub(crate) fn weighed(of: impl Iterator<Item = (f64, Self)>) -> Self {
        of.fold(Self::REST, |sum, (weight, motion)| Self {
            velocity_mps: sum.velocity_mps + weight * motion.velocity_mps,
            acceleration_mps2: sum.acceleration_mps2 + weight * motion.acceleration_mps2,
        })
    }

    fn each(&self, of: impl Fn(DVec3) -> DVec3) -> Self {
        Self { velocity_mps: of(self.velocity_mps), acceleration_mps2: of(self.acceleration_mps2) }
    }
}

/// Position of a body's origin `seconds` after its pose.
pub(crate) fn position_m(pose: &Pose, seconds: f64) -> DVec3 {
    RigidMotion::of(pose, seconds).origin_m
}

/// Pose of a body that brakes in a bend.
#[cfg(test)]
pub(crate) const IN_A_BEND: Pose = Pose {
    position_m: [2.0, 20.0, 0.0],
    yaw_rad: 0.4,
    yaw_radps: 0.8,
    velocity_mps: [3.0, -9.0, 0.5],
    acceleration_mps2: [1.0, -3.0, 0.2],
};

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;

    /// Comparison with the mirror images at both ends of a second, computed from positions alone.
    #[test]
    fn motion_in_a_moving_mirror_is_that_of_the_image() {
        let n = DVec3::new(0.36, 0.48, 0.8);
        let point = Motion {
            velocity_mps: DVec3::new(3.0, -9.0, 0.5),
            acceleration_mps2: DVec3::new(0.4, 7.0, -1.0),
        };
        let plane = Motion {
            velocity_mps: DVec3::new(-2.0, 4.0, 1.0),
            acceleration_mps2: DVec3::new(1.0, -3.0, 0.2),
        };
        let place = |of: &Motion, start: DVec3, t: f64| {
            start + t * (of.velocity_mps + 0.5 * t * of.acceleration_mps2)
        };
        let (x, p) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(-1.0, 0.5, 0.0));
        let image = |t: f64| {
            let (x, p) = (place(&point, x, t), place(&plane, p, t));
            x - 2.0 * (x - p).dot(n) * n
        };
        let body = RigidMotion { origin_m: p, of_origin: plane, ..RigidMotion::REST };
        let (at_m, seen) = MovingPlane { point_m: p, normal: n, body }.image(x, point);
        assert!((at_m - image(0.0)).length() < 1e-14);
        for t in [-0.7, 0.3, 1.0] {
            assert!((place(&seen, image(0.0), t) - image(t)).length() < 1e-14, "{t}");
            let (was_m, was_mps) = seen.after(image(0.0), -t);
            assert!((was_m - image(-t)).length() < 1e-14);
            assert!((was_mps - (image(1e-6 - t) - image(-1e-6 - t)) / 2e-6).length() < 1e-8);
        }
    }

    /// Differences of images computed from positions alone, in a mirror on a body that drives through a bend.
    #[test]
    fn motion_in_a_mirror_that_turns_is_that_of_the_image() {
        let pose = IN_A_BEND;
        let of_point = Motion::from_arrays([-2.0, 4.0, 1.0], [0.4, 7.0, -1.0]);
        let at = |t: f64| {
            let (body, turn) = (RigidMotion::of(&pose, t), DMat3::from_rotation_z(pose.yaw_radps * t));
            let normal = turn * DVec3::new(0.36, 0.48, 0.8);
            let point_m = body.origin_m + turn * DVec3::new(-1.0, 0.5, 0.3);
            let (x_m, mps) = of_point.after(DVec3::new(1.0, 15.0, 3.0), t);
            MovingPlane { point_m, normal, body }.image(x_m, Motion { velocity_mps: mps, ..of_point })
        };
        const STEP_S: f64 = 1e-4;
        let [(before_m, _), (now_m, seen), (after_m, _)] = [-STEP_S, 0.0, STEP_S].map(at);
        let mps = (after_m - before_m) / (2.0 * STEP_S);
        let mps2 = (after_m + before_m - 2.0 * now_m) / (STEP_S * STEP_S);
        assert!((seen.velocity_mps - mps).length() < 1e-6, "{} {mps}", seen.velocity_mps);
        assert!((seen.acceleration_mps2 - mps2).length() < 1e-5, "{} {mps2}", seen.acceleration_mps2);
    }
}
