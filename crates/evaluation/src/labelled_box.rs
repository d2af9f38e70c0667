//! Bodies as a dataset labels them: upright boxes at a frame's middle, of which no velocity is known.

use crate::ground_outline::GroundOutline;
use crate::truth::{Truth, is_seen};
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
            sends_back: is_seen(&cube.radar, away),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame_truth::FrameTruth;
    use crate::test_object::object_at;
    use artifact::points::Object;
    use artifact::settings::{DspSettings, Noise, StaticEchoes};
    use radar::{aperture::Preset, paper};
    use std::f64::consts::FRAC_PI_2;

    /// A bus of 12 m that stands lengthwise, its front at 44 m.
    fn bus() -> LabelledBox {
        let foot_m = DVec3::new(2.0, 50.0, 0.0);
        LabelledBox { number: 7, foot_m, size_m: [12.0, 2.5, 3.0], yaw_rad: -FRAC_PI_2 }
    }

    fn cube(static_echoes: StaticEchoes) -> CubeHeader {
        let radar = paper::radar([0.0; 3], paper::waveform(512, 64), Preset::OneByFour.elements());
        let dsp = DspSettings { static_echoes, ..paper::processing() };
        CubeHeader { radar, noise: Noise::Absent, dsp, unit: Default::default() }
    }

    #[test]
    fn a_labelled_body_is_found_by_its_outline_however_fast_it_is() {
        for velocity_mps in [0.0, -9.5, 40.0] {
            let near = [Object { radial_velocity_mps: velocity_mps, ..object_at([2.0, 43.0]) }];
            let truth = FrameTruth::of_labels(&cube(StaticEchoes::Keep), &[bus()], &near);
            assert_eq!(truth.pairing.object_of, [Some(0)], "{velocity_mps} m/s");
            assert_eq!(truth.number_of(0), 7);
        }
        let far = [object_at([2.0, 40.0])];
        let truth = FrameTruth::of_labels(&cube(StaticEchoes::Keep), &[bus()], &far);
        let gospa = &truth.pairing.gospa;
        assert_eq!((gospa.missed, gospa.false_ones), (1, 1), "4 m before its front");
    }

    #[test]
    fn a_labelled_body_beyond_the_range_is_not_missed_and_one_whose_echo_was_removed_is() {
        let none = |cube: &CubeHeader, body| FrameTruth::of_labels(cube, &[body], &[]).pairing.gospa.missed;
        let cube = cube(StaticEchoes::Remove);
        assert_eq!(none(&cube, bus()), 1, "whether it moves is not known");
        let away_m = cube.radar.waveform.range_max_m() + 1.0;
        let beyond = LabelledBox { foot_m: DVec3::new(0.0, away_m, 0.0), ..bus() };
        assert_eq!(none(&cube, beyond), 0);
    }
}
