//! Bodies before an array so wide that its ends see other outlines on them than its middle: paths of a frame
//! against the same bodies traced and integrated anew for pairs of its elements.

use crate::bodies::car;
use crate::bodies::carts::{joined, mesh};
use crate::frames::{RADAR_M, exact, pose, scene, trace};
use artifact::material::{Material, Road};
use artifact::paths::PathsFrame;
use artifact::radar::Polarization;
use artifact::scene::{SceneFrame, SceneHeader};
use artifact::units::SPEED_OF_LIGHT_MPS;
use bart_rcs::{FrameContext, PathView, Tracer, scattering_of_paths};
use glam::DVec3;
use num_complex::Complex64;
use radar::aperture::Preset;
use radar::paper;
use std::f64::consts::{FRAC_PI_2, TAU};

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
    let [sent, heard] = [&array.tx_m, &array.rx_m];
    (0..12).map(|i| [sent[i % sent.len()], heard[(5 * i + 2) % heard.len()]]).collect()
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
    let scene = at_rest(-25.0);
    let measured = trace(&scene);
    assert!(places(&measured) > 1, "one place does not do");
    let context = FrameContext { like: Some(&measured), ..FrameContext::ALONE };
    let like = Tracer::new(&scene.0).unwrap().paths(&scene.0, &scene.1, &context).unwrap();
    assert!(like.paths == measured.paths && like.trace.fineness == measured.trace.fineness);
}

/// Two plates that lean, 0.4 m wide, before arrays of so many elements.
fn plates(preset: Preset, polarization: Polarization, accuracy_db: f64) -> Scene {
    let plate = |at: [f64; 3], lean: f64, turn: f64| {
        let corner = |across: f64, up: f64| {
            [at[0] + 0.2 * (turn * across + lean * up), at[1] + 0.2 * across, at[2] + 0.2 * up]
        };
        mesh(
            vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
            vec![[0, 1, 2], [0, 2, 3]],
        )
    };
    let both = joined(&[plate([0.0, -0.3, 0.6], 0.2, 0.07), plate([0.1, 0.25, 0.8], 0.26, -0.05)]);
    let (mut header, frame) = scene(&[(both, pose(ORIGIN_M, [0.0; 3], -1.5))], &[], accuracy_db, 1);
    header.radar = paper::radar(RADAR_M, paper::waveform(256, 32), preset.elements());
    header.radar.array.polarization = polarization;
    (header, frame)
}

/// S between two points over a conducting road, of bodies that hide nothing of each other: what is reflected
/// by the road comes from, or goes to, the end's image.
fn over_conductor(scene: &Scene, ends_m: [[f64; 3]; 2], frequencies: &[f64]) -> Vec<Complex64> {
    let polarization = scene.0.radar.array.polarization;
    let (received, sent) = polarization.indices();
    let range_m = |x: [f64; 3]| DVec3::from_array(x).distance(DVec3::from_array(ORIGIN_M));
    let below = |[x, y, z]: [f64; 3]| [x, y, -z];
    let mut sum = vec![Complex64::ZERO; frequencies.len()];
    for by_road in [[false, false], [false, true], [true, false], [true, true]] {
        let places: Vec<_> =
            ends_m.iter().zip(by_road).map(|(end, by)| if by { below(*end) } else { *end }).collect();
        let ways = exact(scene, 0.0, [places[0], places[1]], frequencies, polarization);
        // r of E is −1 in h, and that of H 1 in v.
        let turned = [(by_road[0], sent), (by_road[1], received)];
        let sign = if turned.iter().filter(|turned| **turned == (true, 1)).count() == 1 { -1.0 } else { 1.0 };
        for (total, (s, f)) in sum.iter_mut().zip(ways.iter().zip(frequencies)) {
            let factor = |at_m: [f64; 3], end_m: [f64; 3]| {
                let (of_way, of_end) = (range_m(at_m), range_m(end_m));
                Complex64::from_polar(of_end / of_way, -TAU * f / SPEED_OF_LIGHT_MPS * (of_way - of_end))
            };
            *total += sign * s * factor(places[0], ends_m[0]) * factor(places[1], ends_m[1]);
        }
    }
    sum
}

/// The turn of a wave on its way from one element to another is all that a flat plate has of the cross
/// polarization; over a road it was told of elements at one place, which see none of it.
#[test]
fn elements_off_the_middle_have_the_error_that_is_told_over_a_road_too() {
    for (preset, polarization, accuracy_db) in [
        (Preset::TwelveBySixteen, Polarization::Vh, -30.0),
        (Preset::ThreeByFour, Polarization::Vh, -30.0),
        (Preset::TwelveBySixteen, Polarization::Hh, -30.0),
    ] {
        for road in [None, Some(Road { material: Material::Conductor, rms_height_m: 0.0 })] {
            let mut scene = plates(preset, polarization, accuracy_db);
            scene.0.road = road.clone();
            let frame = trace(&scene);
            let array = &scene.0.radar.array;
            let (p, q) = polarization.indices();
            let (mut error, mut power) = (0.0, 0.0);
            for tx_m in array.tx_m.iter().step_by(array.tx_m.len().div_ceil(3)) {
                for rx_m in array.rx_m.iter().step_by(array.rx_m.len().div_ceil(4)) {
                    let anew = match road {
                        None => exact(&scene, 0.0, [*tx_m, *rx_m], &frequencies_hz(), polarization),
                        Some(_) => over_conductor(&scene, [*tx_m, *rx_m], &frequencies_hz()),
                    };
                    let view = PathView {
                        transmitter_m: DVec3::from_array(*tx_m),
                        receiver_m: DVec3::from_array(*rx_m),
                        origin_m: DVec3::from_array(ORIGIN_M),
                        seconds: 0.0,
                        centre_frequency_hz: scene.0.radar.waveform.centre_frequency_hz(),
                    };
                    for (f, s) in frequencies_hz().into_iter().zip(anew) {
                        error += (scattering_of_paths(&frame.paths, &view, f)[p][q] - s).norm_sqr();
                        power += s.norm_sqr();
                    }
                }
            }
            let (told, got) = (20.0 * frame.error.total().unwrap().log10(), 10.0 * f64::log10(error / power));
            println!(
                "{preset:?}, {polarization:?}, road {}: asked {accuracy_db}, told {told:.1}, true {got:.1} dB \
                 of {:.1} dBsm",
                road.is_some(),
                10.0 * f64::log10(power / 96.0)
            );
            assert!(got <= told + 0.5, "told {told}, true {got}");
        }
    }
}

/// A plate seen square has no cross polarization at the middle of the array, and the elements beside it have
/// one that grows with their distance from each other: errors are told of the field over the array.
#[test]
fn errors_of_an_echo_that_vanishes_at_the_middle_are_told_of_the_field_over_the_array() {
    let polarization = Polarization::Vh;
    for preset in [Preset::ThreeByFour, Preset::TwelveBySixteen] {
        let mut scene = plates(preset, polarization, -20.0);
        // Square to the radar, and symmetrical about the upright plane through the array's middle.
        let corner = |across: f64, up: f64| [-0.216 * up, across, 0.6 + up];
        let corners = vec![corner(-0.2, -0.2), corner(0.2, -0.2), corner(0.2, 0.2), corner(-0.2, 0.2)];
        scene.0.meshes = vec![mesh(corners, vec![[0, 1, 2], [0, 2, 3]])].into();
        let start = pose([0.0, 25.0, 0.0], [0.0; 3], -FRAC_PI_2);
        scene.0.targets[0].start = start;
        scene.1.poses = vec![start];
        let frame = trace(&scene);
        let (mut error, mut power) = (0.0, 0.0);
        for [tx_m, rx_m] in pairs_m(&scene) {
            let anew = exact(&scene, 0.0, [tx_m, rx_m], &frequencies_hz(), polarization);
            let view = PathView {
                transmitter_m: DVec3::from_array(tx_m),
                receiver_m: DVec3::from_array(rx_m),
                origin_m: DVec3::from_array(start.position_m),
                seconds: 0.0,
                centre_frequency_hz: scene.0.radar.waveform.centre_frequency_hz(),
            };
            let (p, q) = polarization.indices();
            for (f, s) in frequencies_hz().into_iter().zip(anew) {
                error += (scattering_of_paths(&frame.paths, &view, f)[p][q] - s).norm_sqr();
                power += s.norm_sqr();
            }
        }
        let (told, got) = (20.0 * frame.error.total().unwrap().log10(), 10.0 * f64::log10(error / power));
        println!("{preset:?}: told {told:.1}, true {got:.1} dB, {:?}", frame.error);
        assert!(told < 6.0 && got <= told + 0.5, "{preset:?}: told {told}, true {got}");
    }
}
