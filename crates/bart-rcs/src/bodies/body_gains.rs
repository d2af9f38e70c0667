//! Antenna gains towards each body, which weight its echo.
//!
//! Paths have the amplitudes of antennas of unit gain, and the echo weights them by the pattern. Errors count
//! as received: a truck beside the beam that scatters ten times as much as the car in it contributes almost
//! nothing to the echo, nor to knowledge of the error of the car's echo. One gain represents each body, on
//! the paths and on their reference alike, so that the comparison itself has no error from it.

use crate::bodies::models::Models;
use crate::bodies::motion::RigidMotion;
use crate::run_control::error::BartError;
use artifact::Radar;
use artifact::paths::Path;
use artifact::radar::Pattern;
use artifact::scene::{Pose, SceneFrame, SceneHeader, Target};
use glam::{DMat3, DVec3};
use radar::aperture::{axes, pattern_amplitude};

/// Amplitude gains of an element, one-way, by the bodies of a scene.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct BodyGains {
    /// Gains by body; empty if the gain is one in every direction.
    of_body: Vec<f64>,
}

/// Maximum angle subtended at the antenna by the parts of a triangle, rad, and the maximum number of parts
/// along each side.
const PART_RAD: f64 = 0.035;
const PARTS_MAX: f64 = 16.0;

impl BodyGains {
    /// Gains towards the bodies of a frame, at its middle.
    pub(crate) fn of(models: &Models, header: &SceneHeader, frame: &SceneFrame) -> Result<Self, BartError> {
        if header.radar.array.pattern == Pattern::Isotropic {
            return Ok(Self::default());
        }
        let of = |(target, pose): (&Target, &Pose)| {
            let model = models.of(target)?;
            let triangles_m = model.as_ref().map_or(&[][..], |model| &model.skin.triangles_m);
            Ok(towards(&header.radar, pose, triangles_m))
        };
        let of_body = header.targets.iter().zip(&frame.poses).map(of).collect::<Result<_, BartError>>()?;
        Ok(Self { of_body })
    }

    /// Whether the gain is one towards every body.
    pub(crate) fn are_one(&self) -> bool {
        self.of_body.is_empty()
    }

    /// Product of both ends' gains for a path whose first and last bodies are these.
    pub(crate) fn of_way(&self, ends: [u32; 2]) -> f64 {
        ends.iter().map(|body| self.of_body.get(*body as usize).copied().unwrap_or(1.0)).product()
    }

    /// Product of both ends' gains for a path.
    pub(crate) fn of_path(&self, path: &Path) -> f64 {
        match path.sequence() {
            [] => self.of_way([path.target; 2]),
            [first, .., last] => self.of_way([first.body, last.body]),
            [only] => self.of_way([only.body; 2]),
        }
    }

    /// Largest product of both ends' gains.
    pub(crate) fn largest(&self) -> f64 {
        let largest = self.of_body.iter().copied().fold(0.0, f64::max);
        if self.are_one() { 1.0 } else { largest * largest }
    }
}

/// Gain whose fourth power, like that of an echo's power, is the mean over the surface of a body; over its
/// position if it has no surface.
fn towards(radar: &Radar, pose: &Pose, triangles_m: &[[DVec3; 3]]) -> f64 {
    let seconds = radar.frame_middle_s();
    let origin_m = RigidMotion::of(pose, seconds).origin_m;
    let world_from_body = DMat3::from_rotation_z(pose.yaw_rad + pose.yaw_radps * seconds);
    let (axes, antenna_m) = (axes(radar), DVec3::from_array(radar.position_m));
    let gain = |at_m: DVec3| {
        let direction = (at_m - antenna_m).try_normalize().unwrap_or(axes[1]);
        pattern_amplitude(radar, &axes, direction)
    };
    let (mut sum, mut area_m2) = (0.0, 0.0);
    for corners in triangles_m {
        let [a, b, c] = corners.map(|corner| origin_m + world_from_body * corner);
        let (u, v) = (b - a, c - a);
        let distance_m = ((a + b + c) / 3.0).distance(antenna_m);
        let longest_m = u.length().max(v.length()).max(b.distance(c));
        let parts = (longest_m / (PART_RAD * distance_m)).ceil().clamp(1.0, PARTS_MAX);
        let of_part = 0.5 * u.cross(v).length() / (parts * parts);
        for [along, across] in middles(parts as u32) {
            sum += of_part * gain(a + along * u + across * v).powi(4);
            area_m2 += of_part;
        }
    }
    if area_m2 > 0.0 { (sum / area_m2).sqrt().sqrt() } else { gain(origin_m) }
}

/// Centres of the equal triangles into which a triangle is divided, as shares of two of its sides.
fn middles(parts: u32) -> impl Iterator<Item = [f64; 2]> {
    let of = move |thirds: u32| f64::from(thirds) / f64::from(3 * parts);
    let upright = (0..parts).flat_map(move |i| (0..parts - i).map(move |j| [3 * i + 1, 3 * j + 1]));
    let turned = (1..parts).flat_map(move |i| (1..=parts - i).map(move |j| [3 * i - 1, 3 * j - 1]));
    upright.chain(turned).map(move |place| place.map(of))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_triangle_cover_it_evenly() {
        for parts in [1, 2, 5] {
            let places: Vec<[f64; 2]> = middles(parts).collect();
            assert_eq!(places.len() as u32, parts * parts);
            let mean = |axis: usize| places.iter().map(|p| p[axis]).sum::<f64>() / places.len() as f64;
            assert!((mean(0) - 1.0 / 3.0).abs() < 1e-12 && (mean(1) - 1.0 / 3.0).abs() < 1e-12, "{places:?}");
            assert!(places.iter().all(|[u, v]| *u > 0.0 && *v > 0.0 && u + v < 1.0), "{places:?}");
        }
    }
}
