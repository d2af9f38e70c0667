//! Large walls that shade each other: outlines of shadows slide over them as they move, and from one element
//! of the array to another.

use crate::bodies::carts::{joined, parallelogram};
use crate::frames::{RADAR_M, exact, pose, scene, trace};
use artifact::paths::{Outlines, PathsFrame};
use artifact::radar::Polarization;
use artifact::scene::{Mesh, Pose, SceneFrame, SceneHeader};
use bart_rcs::{PathView, scattering_of_paths};
use glam::DVec3;
use radar::aperture::Preset;
use radar::motion::pose_after;
use radar::paper;

/// Two upright walls as long as they are high that meet at a right angle; they open towards the body's x
/// axis.
fn walls(side_m: f64) -> Mesh {
    let reach_m = side_m * std::f64::consts::FRAC_1_SQRT_2;
    let wall = |side: f64| parallelogram([0.0; 3], [reach_m, side * reach_m, 0.0], [0.0, 0.0, side_m]);
    joined(&[wall(1.0), wall(-1.0)])
}

struct Case {
    side_m: f64,
    start: Pose,
    array: Preset,
    asked_db: f64,
    bounces: u8,
}

impl Case {
    fn scene(&self) -> (SceneHeader, SceneFrame) {
        let (mut header, frame) =
            scene(&[(walls(self.side_m), self.start)], &[], self.asked_db, self.bounces);
        header.radar = paper::radar(RADAR_M, paper::waveform(256, 128), self.array.elements());
        (header, frame)
    }
}

/// Error ‖S of the paths − S‖/‖S‖ over the band, at three moments and between pairs of elements, dB.
fn error_db(scene: &(SceneHeader, SceneFrame), frame: &PathsFrame) -> f64 {
    const FREQUENCIES: u32 = 8;
    let radar = &scene.0.radar;
    let frequencies: Vec<f64> =
        (0..FREQUENCIES).map(|i| 77e9 + 0.625e9 * (f64::from(i) + 0.37) / f64::from(FREQUENCIES)).collect();
    let [sent, heard] = [&radar.array.tx_m, &radar.array.rx_m];
    let (mut error, mut power) = (0.0, 0.0);
    for i in 0..9 {
        let seconds = radar.frame_duration_s() * (i as f64 % 3.0 + 0.5) / 3.0;
        let [tx_m, rx_m] = [sent[4 * i % sent.len()], heard[(5 * i + 2) % heard.len()]];
        let view = PathView {
            transmitter_m: DVec3::from_array(tx_m),
            receiver_m: DVec3::from_array(rx_m),
            origin_m: DVec3::from_array(pose_after(&scene.1.poses[0], seconds).position_m),
            seconds,
            centre_frequency_hz: radar.waveform.centre_frequency_hz(),
        };
        let anew = exact(scene, seconds, [tx_m, rx_m], &frequencies, Polarization::Vv);
        for (f, s) in frequencies.iter().zip(anew) {
            error += (scattering_of_paths(&frame.paths, &view, *f)[0][0] - s).norm_sqr();
            power += s.norm_sqr();
        }
    }
    10.0 * f64::log10(error / power)
}

/// Corners of shadows that are fixed to the walls leave what no number of moments and places follows.
#[test]
fn outlines_that_slide_over_large_walls_meet_the_accuracy_with_few_paths() {
    let cases = [
        Case {
            side_m: 3.6,
            start: pose([-16.2, 35.9, 0.0], [5.0, -5.2, 0.0], -2.54),
            array: Preset::OneByOne,
            asked_db: -20.0,
            bounces: 1,
        },
        Case {
            side_m: 3.6,
            start: pose([-16.2, 35.9, 0.0], [5.0, -5.2, 0.0], -2.54),
            array: Preset::ThreeByFour,
            asked_db: -17.0,
            bounces: 2,
        },
        Case {
            side_m: 2.5,
            start: pose([3.5, 13.2, 0.0], [0.0, -4.7, 0.0], 3.04),
            array: Preset::TwelveBySixteen,
            asked_db: -18.0,
            bounces: 2,
        },
    ];
    for case in cases {
        let (scene, asked_db) = (case.scene(), case.asked_db);
        let frame = trace(&scene);
        let (printed, got) = (20.0 * frame.error.total().unwrap().log10(), error_db(&scene, &frame));
        let fineness = frame.trace.fineness.as_ref().unwrap();
        println!(
            "{:?}: {} paths, {} moments, {} places, asked {asked_db}, printed {printed:.1}, true {got:.1} dB",
            case.array,
            frame.paths.len(),
            fineness.moments,
            fineness.places
        );
        assert_eq!(fineness.outlines, Outlines::Sliding);
        assert!(printed <= asked_db, "asked {asked_db}, printed {printed}");
        assert!(got <= printed + 3.0, "printed {printed}, true {got}");
        assert!(frame.paths.len() < 2000, "{} paths", frame.paths.len());
    }
}
