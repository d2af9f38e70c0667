//! Motion of bodies within a frame, and of their images in mirrors that move themselves.

use crate::bodies::road_mirror::below;
use artifact::scene::Pose;
use glam::DVec3;

/// Velocity at one instant, and an acceleration that stays as it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Motion {
    pub(crate) velocity_mps: DVec3,
    pub(crate) acceleration_mps2: DVec3,
}

impl Motion {
    pub(crate) const REST: Self = Self { velocity_mps: DVec3::ZERO, acceleration_mps2: DVec3::ZERO };

    /// Motion of a body `seconds` after its pose.
    pub(crate) fn of(pose: &Pose, seconds: f64) -> Self {
        let start = Self::from_arrays(pose.velocity_mps, pose.acceleration_mps2);
        Self { velocity_mps: start.after(DVec3::ZERO, seconds).1, ..start }
    }

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

    /// Motion of the image in a plane with the normal n that moves by v_p: a point's velocity v turns into
    /// v − 2((v − v_p)·n)n, and so does its acceleration, as n does not turn.
    pub(crate) fn mirrored(&self, mirror: &Self, n: DVec3) -> Self {
        let turned = |v: DVec3, of_mirror: DVec3| v - 2.0 * (v - of_mirror).dot(n) * n;
        Self {
            velocity_mps: turned(self.velocity_mps, mirror.velocity_mps),
            acceleration_mps2: turned(self.acceleration_mps2, mirror.acceleration_mps2),
        }
    }

    /// Place and velocity, `seconds` later (earlier, where negative), of a point that is at `at_m` now.
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
    Motion::of(pose, 0.0).after(DVec3::from_array(pose.position_m), seconds).0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Comparison with the mirror images of both ends of a second, made of places alone.
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
        let seen = point.mirrored(&plane, n);
        for t in [-0.7, 0.3, 1.0] {
            assert!((place(&seen, image(0.0), t) - image(t)).length() < 1e-14, "{t}");
            let (was_m, was_mps) = seen.after(image(0.0), -t);
            assert!((was_m - image(-t)).length() < 1e-14);
            assert!((was_mps - (image(1e-6 - t) - image(-1e-6 - t)) / 2e-6).length() < 1e-8);
        }
    }
}
