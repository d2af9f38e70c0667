//! Bodies before an array so wide that its ends see other outlines on them than its middle: paths of a frame
//! against the same bodies traced and integrated anew for pairs of its elements.
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

mod bodies;

use artifact::Accuracy;
use artifact::paths::PathsFrame;
use artifact::radar::Polarization;
use artifact::scene::{Mesh, SceneFrame, SceneHeader};
use artifact::settings::Surface;
use bart_rcs::{FrameSurroundings, PathView, RcsRequest, Standpoint, Tracer, rcs, scattering_of_paths};
use bodies::car;
use bodies::scenes::scene;
use glam::{DMat3, DVec3};
use num_complex::Complex64;
use radar::aperture::Preset;
use radar::paper;

type Scene = (SceneHeader, SceneFrame);

/// Origin that R is counted to.
const ORIGIN_M: DVec3 = DVec3::new(3.0, 25.0, 0.0);
const YAW_RAD: f64 = -1.4;
const FREQUENCIES: u32 = 8;

/// A car at rest before 192 channels, two bounces.
fn at_rest(accuracy_db: f64) -> Scene {
    let mesh = car(8).mesh();
    let (mut header, frame) = scene(&mesh, &[(ORIGIN_M.to_array(), YAW_RAD, [0.0; 3])]);
    let elements = Preset::TwelveBySixteen.elements();
    header.radar = paper::radar([0.0, 0.0, 6.0], paper::waveform(256, 32), elements);
    header.fidelity.accuracy = Accuracy::from_db(accuracy_db);
    header.fidelity.bounces = 2;
    (header, frame)
}

fn traced((header, frame): &Scene, like: Option<&PathsFrame>) -> PathsFrame {
    let surroundings = FrameSurroundings { like, ..FrameSurroundings::ALONE };
    Tracer::new(header).unwrap().paths(header, frame, &surroundings).unwrap()
}

/// The car about [`ORIGIN_M`].
fn placed(mesh: &Mesh) -> Mesh {
    let turned = |v: &[f64; 3]| (DMat3::from_rotation_z(YAW_RAD) * DVec3::from_array(*v)).to_array();
    Mesh { vertices_m: mesh.vertices_m.iter().map(turned).collect(), ..mesh.clone() }
}

fn frequencies_hz() -> Vec<f64> {
    (0..FREQUENCIES).map(|i| 77e9 + 0.625e9 * (f64::from(i) + 0.37) / f64::from(FREQUENCIES)).collect()
}

fn standpoint(place_m: DVec3) -> Standpoint {
    let way = place_m - ORIGIN_M;
    Standpoint {
        azimuth_rad: way.y.atan2(way.x),
        elevation_rad: (way.z / way.length()).asin(),
        range_m: way.length(),
    }
}

/// S from one element to another, traced and integrated anew, far finer than any frame here.
fn anew(scene: &Scene, [tx_m, rx_m]: [DVec3; 2]) -> Vec<Complex64> {
    let (from, fidelity) = (standpoint(tx_m), &scene.0.fidelity);
    let request = RcsRequest {
        frequency_hz: frequencies_hz(),
        azimuth_rad: vec![from.azimuth_rad],
        elevation_rad: vec![from.elevation_rad],
        range_m: from.range_m,
        receiver: Some(standpoint(rx_m)),
        polarization: Polarization::Vv,
        bounces: fidelity.bounces,
        nodes: fidelity.nodes,
        sides: fidelity.sides,
        edges: fidelity.edges,
        surface: Surface::Flat,
        accuracy: Accuracy::from_db(-50.0),
    };
    rcs(&placed(&scene.0.meshes[0]), &request, &|_, _| ()).unwrap().amplitude_m
}

fn of_paths(scene: &Scene, frame: &PathsFrame, [tx_m, rx_m]: [DVec3; 2]) -> Vec<Complex64> {
    let view = PathView {
        transmitter_m: tx_m,
        receiver_m: rx_m,
        origin_m: ORIGIN_M,
        seconds: scene.0.radar.frame_middle_s(),
        centre_frequency_hz: scene.0.radar.waveform.centre_frequency_hz(),
    };
    frequencies_hz().iter().map(|f| scattering_of_paths(&frame.paths, &view, *f)[0][0]).collect()
}

/// Pairs of elements spread over the array.
fn pairs_m(scene: &Scene) -> Vec<[DVec3; 2]> {
    let array = &scene.0.radar.array;
    let pair = |tx: usize, rx: usize| [array.tx_m[tx], array.rx_m[rx]].map(DVec3::from_array);
    (0..12).map(|tx| pair(tx, (5 * tx + 2) % 16)).collect()
}

/// Error ‖S of the paths − S‖/‖S‖ over pairs and frequencies, dB.
fn error_db(scene: &Scene, frame: &PathsFrame) -> f64 {
    let (mut error, mut power) = (0.0, 0.0);
    for pair in pairs_m(scene) {
        for (got, s) in of_paths(scene, frame, pair).iter().zip(anew(scene, pair)) {
            error += (got - s).norm_sqr();
            power += s.norm_sqr();
        }
    }
    10.0 * f64::log10(error / power)
}

fn places(frame: &PathsFrame) -> u32 {
    frame.trace.fineness.as_ref().unwrap().places
}

#[test]
fn a_car_at_rest_before_a_wide_array_is_as_exact_as_asked() {
    for accuracy_db in [-10.0, -15.0, -20.0, -25.0] {
        let scene = at_rest(accuracy_db);
        let frame = traced(&scene, None);
        let told = 20.0 * frame.error.total().unwrap().log10();
        let (got, places) = (error_db(&scene, &frame), places(&frame));
        println!(
            "asked {accuracy_db}, told {told:.1}, true {got:.1} dB, {} places, {} paths",
            places,
            frame.paths.len()
        );
        assert!(told <= accuracy_db && got <= told, "asked {accuracy_db}, told {told}, true {got}");
    }
}

/// A frame that takes its error over is blended from as many places as the measured one.
#[test]
fn a_frame_like_one_that_is_blended_over_the_array_is_blended_as_that_one() {
    let scene = at_rest(-20.0);
    let measured = traced(&scene, None);
    assert!(places(&measured) > 1, "one place does not do");
    let like = traced(&scene, Some(&measured));
    assert!(like.paths == measured.paths && like.trace.fineness == measured.trace.fineness);
}
