//! Rotating wheels as separate bodies: they are listed after the bodies of their scene, with their hubs on
//! vehicles that roll without slipping.
//!
//! A frame is traced with separate wheels, so that whatever lights or shades them is treated as for any
//! bodies in relative motion (`crate::frame::blends`); afterwards their paths are assigned to their
//! vehicles again.

use crate::bodies::models::Models;
use artifact::paths::PathsFrame;
use artifact::scene::{Pose, SceneFrame, SceneHeader, Target, TargetKind};
use glam::{DMat3, DVec3};
use std::borrow::Cow;
use std::iter::repeat_n;

/// A scene and a frame of it with every rotating wheel as a separate body.
pub(crate) struct SeparateWheels<'a> {
    pub(crate) view: Cow<'a, SceneHeader>,
    pub(crate) frame: Cow<'a, SceneFrame>,
    /// Index of the vehicle of each wheel, in the order of the wheels.
    vehicles: Vec<u32>,
}

impl<'a> SeparateWheels<'a> {
    /// Separates the wheels; the scene is unchanged if none rotates.
    pub(crate) fn of(models: &Models, view: &'a SceneHeader, frame: &'a SceneFrame) -> Self {
        let vehicles = models.vehicles_of_wheels(view);
        if vehicles.is_empty() || frame.poses.len() != view.targets.len() {
            return Self { view: Cow::Borrowed(view), frame: Cow::Borrowed(frame), vehicles: vec![] };
        }
        let (mut apart, mut posed) = (view.clone(), frame.clone());
        for (target, pose) in view.targets.iter().zip(&frame.poses) {
            for (number, (mesh, hub_m)) in models.wheels_of(target).enumerate() {
                apart.targets.push(wheel_target(target, number, mesh, hub_m));
                posed.poses.push(pose_at(pose, hub_m));
            }
        }
        Self { view: Cow::Owned(apart), frame: Cow::Owned(posed), vehicles }
    }

    /// Paths of a frame, with those of wheels assigned to their vehicles.
    pub(crate) fn joined(&self, frame: PathsFrame) -> PathsFrame {
        if self.vehicles.is_empty() {
            return frame;
        }
        let bodies = self.view.targets.len() - self.vehicles.len();
        let vehicle = |body: u32| match (body as usize).checked_sub(bodies) {
            Some(wheel) => self.vehicles.get(wheel).copied().unwrap_or(body),
            None => body,
        };
        let mut joined = frame.renumbered(vehicle);
        let of_wheels = joined.nearest_range_m.split_off(bodies.min(joined.nearest_range_m.len()));
        for (range_m, vehicle) in of_wheels.into_iter().zip(&self.vehicles) {
            let of_vehicle = &mut joined.nearest_range_m[*vehicle as usize];
            *of_vehicle = (*of_vehicle).into_iter().chain(range_m).reduce(f64::min);
        }
        joined
    }
}

impl Models {
    /// Index of the vehicle of each rotating wheel of a scene.
    pub(crate) fn vehicles_of_wheels(&self, view: &SceneHeader) -> Vec<u32> {
        let of = |(vehicle, target): (u32, &Target)| repeat_n(vehicle, self.wheels_of(target).count());
        (0..).zip(&view.targets).flat_map(of).collect()
    }
}

fn wheel_target(vehicle: &Target, number: usize, mesh: u32, hub_m: DVec3) -> Target {
    Target {
        id: format!("{} wheel {}", vehicle.id, number + 1),
        role: vehicle.role,
        kind: TargetKind::Mesh { class: None, model: String::new(), mesh },
        start: pose_at(&vehicle.start, hub_m),
    }
}

/// Pose of a body whose origin is a point of another, and follows its turning in a bend.
fn pose_at(pose: &Pose, at_m: DVec3) -> Pose {
    let from_origin_m = DMat3::from_rotation_z(pose.yaw_rad) * at_m;
    let gained_mps = (DVec3::Z * pose.yaw_radps).cross(from_origin_m);
    Pose {
        position_m: (DVec3::from_array(pose.position_m) + from_origin_m).to_array(),
        velocity_mps: (DVec3::from_array(pose.velocity_mps) + gained_mps).to_array(),
        ..*pose
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::motion::IN_A_BEND;
    use radar::motion::pose_after;

    #[test]
    fn a_hub_goes_where_its_vehicle_takes_it() {
        let pose = IN_A_BEND;
        let at_m = DVec3::new(1.4, 0.7, 0.3);
        let hub = pose_at(&pose, at_m);
        for seconds in [0.01, 0.3, 1.0] {
            let later = pose_after(&pose, seconds);
            let carried = pose_at(&later, at_m);
            let own = pose_after(&hub, seconds);
            for (own, carried) in
                [(own.position_m, carried.position_m), (own.velocity_mps, carried.velocity_mps)]
            {
                let miss = (DVec3::from_array(own) - DVec3::from_array(carried)).length();
                assert!(miss < 1e-12, "{seconds}: {miss}");
            }
        }
    }
}
