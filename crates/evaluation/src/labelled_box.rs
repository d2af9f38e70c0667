//! Bodies as a dataset labels them: upright boxes at a frame's middle, of which no velocity is known.

use crate::ground_outline::GroundOutline;
use crate::truth::{Truth, is_in_field_of_view};
use artifact::cube::CubeHeader;
use artifact::scene::Role;
use glam::{DVec2, DVec3};

/// A labelled body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LabelledBox {
    /// Number of the body, the same in all frames.
    pub number: u32,
    /// Middle of the lower face, world metres.
    pub foot_m: DVec3,
    /// Length, width, height.
    pub size_m: [f64; 3],
    /// Direction of its front from world +x towards +y.
    pub yaw_rad: f64,
}

impl LabelledBox {
    /// Ground truth for a radar with its settings. The velocity, which is unknown, is 0: pairing has to leave
    /// it out.
    pub(crate) fn truth(&self, cube: &CubeHeader) -> Truth {
        let away = self.foot_m - DVec3::from(cube.radar.position_m);
        let [length, width, _] = self.size_m;
        Truth {
            position_m: self.foot_m,
            outline: GroundOutline::of_box(self.foot_m.truncate(), DVec2::new(length, width), self.yaw_rad),
            range_m: away.length(),
            velocity_mps: DVec3::ZERO,
            radial_velocity_mps: 0.0,
            lane: cube.dsp.road.at(self.foot_m.to_array()),
            nearest_range_m: None,
            echo: None,
            role: Role::Target,
            returns_echo: is_in_field_of_view(&cube.radar, away),
        }
    }
}
