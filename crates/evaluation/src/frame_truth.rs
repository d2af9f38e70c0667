//! Ground truth of one frame, made after all processing: its bodies, their objects, and the origin of each
//! point.

use crate::labelled_box::LabelledBox;
use crate::labels::Origin;
use crate::pairing::{MeasurementLimits, Pairing};
use crate::truth::{Truth, truths};
use artifact::cube::CubeHeader;
use artifact::paths::PathsFrame;
use artifact::points::Object;
use artifact::scene::{SceneFrame, SceneHeader};

/// Ground truth of a frame's detections.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameTruth {
    /// Truths in the order of the frame's poses.
    pub truths: Vec<Truth>,
    /// Pairing of the frame's truths with its objects.
    pub pairing: Pairing,
    /// Origin of each point, in the order of the points; empty if not requested, and for echoes from tables.
    pub origins: Vec<Origin>,
    /// The scene's number of each body of the frame; empty if the numbers are the same.
    pub bodies: Vec<u32>,
}

impl FrameTruth {
    /// Ground truth of a frame whose bodies are the targets of `view`; `paths` are those of its echo, if
    /// known: without them every body counts as one that returns an echo.
    pub fn of(
        view: &SceneHeader,
        frame: &SceneFrame,
        paths: Option<&PathsFrame>,
        objects: &[Object],
    ) -> Self {
        let view = view.in_frame(frame.index);
        let truths = truths(&view, frame, paths);
        let pairing = Pairing::of(&truths, objects, &MeasurementLimits::of(&view));
        Self { truths, pairing, origins: vec![], bodies: vec![] }
    }

    /// Ground truth of a frame by the labels of its bodies, which tell no velocities: objects are paired by
    /// place alone. `cube` is the radar of the frame with its settings.
    pub fn of_labels(cube: &CubeHeader, labels: &[LabelledBox], objects: &[Object]) -> Self {
        let truths: Vec<Truth> = labels.iter().map(|label| label.truth(cube)).collect();
        let pairing = Pairing::of(&truths, objects, &MeasurementLimits::by_place(&cube.radar));
        Self { truths, pairing, origins: vec![], bodies: labels.iter().map(|label| label.number).collect() }
    }

    /// The scene's number of a body of the frame.
    pub fn number_of(&self, body: usize) -> u32 {
        self.bodies.get(body).copied().unwrap_or(body as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_object::object_at;
    use artifact::settings::{DspSettings, Noise, StaticEchoes};
    use glam::DVec3;
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
