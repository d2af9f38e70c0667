//! Bodies before an array so wide that its ends see other outlines on them than its middle: paths of a frame
//! against the same bodies traced and integrated anew for pairs of its elements.

use crate::bodies::car;
use crate::frames::{RADAR_M, exact, pose, scene, trace};
use artifact::paths::PathsFrame;
use artifact::radar::Polarization;
use artifact::scene::{SceneFrame, SceneHeader};
use bart_rcs::{FrameSurroundings, PathView, Tracer, scattering_of_paths};
use glam::DVec3;
use radar::aperture::Preset;
use radar::paper;

type Scene = (SceneHeader, SceneFrame);

/// Place of the car, to which R is counted.
const ORIGIN_M: [f64; 3] = [3.0, 25.0, 0.0];
const FREQUENCIES: u32 = 8;

/// A car at rest before 192 channels, two bounces.
fn at_rest(accuracy_db: f64) -> Scene {
    let body = (car(8).mesh(), pose(ORIGIN_M, [0.0; 3], -1.4));
    let (mut header, frame) = scene(&[body], &[], accuracy_db, 2);
    header.radar = paper::radar(RADAR_M, paper::waveform(256, 32), Preset::TwelveBySixteen.elements());
    (header, frame)
}

fn places(frame: &PathsFrame) -> u32 {
    frame.trace.fineness.as_ref().unwrap().places
}

fn frequencies_hz() -> Vec<f64> {
    (0..FREQUENCIES).map(|i| 77e9 + 0.625e9 * (f64::from(i) + 0.37) / f64::from(FREQUENCIES)).collect()
}

/// Pairs of elements spread over the array.
fn pairs_m(scene: &Scene) -> Vec<[[f64; 3]; 2]> {
    let array = &scene.0.radar.array;
    (0..12).map(|tx| [array.tx_m[tx], array.rx_m[(5 * tx + 2) % 16]]).collect()
}

/// Error ‖S of the paths − S‖/‖S‖ over pairs and frequencies, dB.
fn error_db(scene: &Scene, frame: &PathsFrame) -> f64 {
    let seconds = scene.0.radar.frame_middle_s();
    let (mut error, mut power) = (0.0, 0.0);
    for [tx_m, rx_m] in pairs_m(scene) {
        let view = PathView {
            transmitter_m: DVec3::from_array(tx_m),
            receiver_m: DVec3::from_array(rx_m),
            origin_m: DVec3::from_array(ORIGIN_M),
            seconds,
            centre_frequency_hz: scene.0.radar.waveform.centre_frequency_hz(),
        };
        let anew = exact(scene, seconds, [tx_m, rx_m], &frequencies_hz(), Polarization::Vv);
        for (f, s) in frequencies_hz().into_iter().zip(anew) {
            error += (scattering_of_paths(&frame.paths, &view, f)[0][0] - s).norm_sqr();
            power += s.norm_sqr();
        }
    }
    10.0 * f64::log10(error / power)
}

#[test]
fn a_car_at_rest_before_a_wide_array_is_as_exact_as_asked() {
    for accuracy_db in [-10.0, -15.0, -20.0, -25.0] {
        let scene = at_rest(accuracy_db);
        let frame = trace(&scene);
        let told = 20.0 * frame.error.total().unwrap().log10();
        let (got, places, paths) = (error_db(&scene, &frame), places(&frame), frame.paths.len());
        println!("asked {accuracy_db}, told {told:.1}, true {got:.1} dB, {places} places, {paths} paths");
        assert!(told <= accuracy_db && got <= told, "asked {accuracy_db}, told {told}, true {got}");
    }
}

/// A frame that takes its error over is blended from as many places as the measured one.
#[test]
fn a_frame_like_one_that_is_blended_over_the_array_is_blended_as_that_one() {
    let scene = at_rest(-20.0);
    let measured = trace(&scene);
    assert!(places(&measured) > 1, "one place does not do");
    let surroundings = FrameSurroundings { like: Some(&measured), ..FrameSurroundings::ALONE };
    let like = Tracer::new(&scene.0).unwrap().paths(&scene.0, &scene.1, &surroundings).unwrap();
    assert!(like.paths == measured.paths && like.trace.fineness == measured.trace.fineness);
}
