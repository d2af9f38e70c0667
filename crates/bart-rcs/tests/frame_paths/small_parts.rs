//! Small parts that meshes lack: their mean level is γ times the area seen, whatever the mesh; they stay on
//! their body, and their share of the echo is told.

use crate::bodies::carts::{joined, mesh};
use crate::frames::{pose, scene, trace};
use artifact::paths::Path;
use artifact::radar::Polarization;
use artifact::scene::{Mesh, SceneFrame, SceneHeader};
use artifact::settings::SmallParts;
use bart_rcs::{RcsRequest, rcs};
use glam::DVec3;

/// γ (docs/decisions/small-parts.md).
const GAMMA: f64 = 5.093 / 4.67;

/// A rectangle in the plane x = 0 with its middle at `at_m`, in `cells` × `cells` squares of two triangles.
fn wall(at_m: [f64; 3], [width_m, height_m]: [f64; 2], cells: u32) -> Mesh {
    let step = |i: u32| f64::from(i) / f64::from(cells) - 0.5;
    let corner = |i: u32, j: u32| [at_m[0], at_m[1] + width_m * step(i), at_m[2] + height_m * step(j)];
    let number = |i: u32, j: u32| i * (cells + 1) + j;
    let grid = |last: u32| (0..last).flat_map(move |i| (0..last).map(move |j| (i, j)));
    let square = |(i, j): (u32, u32)| {
        let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| number(i, j));
        [[a, b, c], [a, c, d]]
    };
    mesh(grid(cells + 1).map(|(i, j)| corner(i, j)).collect(), grid(cells).flat_map(square).collect())
}

/// Mean |S|² of what is drawn, over azimuths about one and frequencies of 5 GHz.
fn drawn_m2(mesh: &Mesh, azimuth_deg: f64, polarization: Polarization) -> f64 {
    let frequency_hz = (0..40).map(|i| 76e9 + 0.125e9 * f64::from(i)).collect();
    let azimuth_rad = (0..20).map(|i| (azimuth_deg + 0.2 * f64::from(i)).to_radians()).collect();
    let without =
        RcsRequest { polarization, bounces: 1, ..RcsRequest::over(frequency_hz, vec![0.1], azimuth_rad) };
    let with = RcsRequest { small_parts: SmallParts::Statistical, ..without.clone() };
    let [without, with] = [without, with].map(|request| rcs(mesh, &request, &|_, _| {}).unwrap().amplitude_m);
    let powers = with.iter().zip(&without).map(|(with, without)| (with - without).norm_sqr());
    powers.sum::<f64>() / with.len() as f64
}

#[test]
fn the_mean_level_is_that_of_the_area_seen_whatever_the_mesh() {
    for (azimuth_deg, cells) in [(20.0, 1), (20.0, 9), (55.0, 3)] {
        let seen_m2 = 3.0 * 2.0 * f64::cos(0.1) * f64::to_radians(azimuth_deg + 2.0).cos();
        for polarization in [Polarization::Vv, Polarization::Hh] {
            let over = drawn_m2(&wall([0.0; 3], [3.0, 2.0], cells), azimuth_deg, polarization) / seen_m2;
            println!("{azimuth_deg}°, {cells} cells, {polarization:?}: γ asked {GAMMA:.2}, got {over:.2}");
            // Some hundred independent values: a tenth.
            assert!((over / GAMMA - 1.0).abs() < 0.3);
        }
        assert_eq!(drawn_m2(&wall([0.0; 3], [3.0, 2.0], cells), azimuth_deg, Polarization::Vh), 0.0);
    }
}

#[test]
fn what_is_hidden_has_no_small_parts() {
    let behind = wall([0.0; 3], [3.0, 2.0], 4);
    let alone_m2 = drawn_m2(&wall([1.0, 0.0, 0.0], [30.0, 20.0], 1), 0.0, Polarization::Vv);
    let both_m2 = drawn_m2(&joined(&[wall([1.0, 0.0, 0.0], [30.0, 20.0], 1), behind]), 0.0, Polarization::Vv);
    // The larger wall hides all of the other, whose triangles are the last.
    println!("a wall of 600 m²: {alone_m2:.1} m² drawn, with another behind it {both_m2:.1} m²");
    assert!((both_m2 / alone_m2 - 1.0).abs() < 1e-9);
}

fn moving(y_m: f64, small_parts: SmallParts, seed: u64) -> (SceneHeader, SceneFrame) {
    let body = (wall([0.0; 3], [2.0, 1.5], 3), pose([1.0, y_m, 1.0], [0.0, -8.0, 0.0], -1.4));
    let mut scene = scene(&[body], &[], -20.0, 1);
    scene.0.fidelity.small_parts = small_parts;
    scene.0.seed = seed;
    scene
}

fn drawn(scene: &(SceneHeader, SceneFrame)) -> Vec<Path> {
    let mut without = scene.clone();
    without.0.fidelity.small_parts = SmallParts::OfMesh;
    let (with, without) = (trace(scene), trace(&without));
    assert_eq!(with.paths[..without.paths.len()], without.paths[..]);
    with.paths[without.paths.len()..].to_vec()
}

#[test]
fn small_parts_move_with_their_body_from_frame_to_frame() {
    let [near, farther] = [30.0, 30.8].map(|y_m| drawn(&moving(y_m, SmallParts::Statistical, 1)));
    assert!(near.len() > 40 && near.len() == farther.len(), "{} and {}", near.len(), farther.len());
    for (a, b) in near.iter().zip(&farther) {
        let moved_m = DVec3::from_array(b.apparent_tx_m) - DVec3::from_array(a.apparent_tx_m);
        assert!((moved_m - 0.8 * DVec3::Y).length() < 1e-9 && a.apparent_tx_mps == [0.0, -8.0, 0.0]);
        let [a, b] = [a, b].map(|path| path.amplitude_m[0][0]);
        assert!((a.arg() - b.arg()).abs() < 1e-9 && (a.norm() / b.norm() - 1.0).abs() < 0.05);
    }
    let other = drawn(&moving(30.0, SmallParts::Statistical, 2));
    assert_ne!(other[0].amplitude_m, near[0].amplitude_m, "another seed draws others");
}

#[test]
fn the_share_of_small_parts_is_told_and_a_frame_that_takes_errors_over_has_them_too() {
    let scene = moving(30.0, SmallParts::Statistical, 1);
    let frame = trace(&scene);
    let power = |paths: &[Path]| paths.iter().map(|path| path.amplitude_m[0][0].norm_sqr()).sum::<f64>();
    let told = frame.model_error.small_parts.unwrap();
    let drawn_m2 = power(&drawn(&scene));
    println!("{drawn_m2:.2} m² drawn, {:.1} dB of the mesh's echo", 20.0 * told.log10());
    assert!((drawn_m2 / (GAMMA * 2.0 * 1.5) - 1.0).abs() < 0.4 && told > 0.0);
    assert_eq!(trace(&moving(30.0, SmallParts::OfMesh, 1)).model_error.small_parts, None);
    let context = bart_rcs::FrameContext { like: Some(&frame), ..bart_rcs::FrameContext::ALONE };
    let tracer = bart_rcs::Tracer::new(&scene.0).unwrap();
    let like = tracer.paths(&scene.0, &scene.1, &context).unwrap();
    assert_eq!((like.paths.len(), like.model_error), (frame.paths.len(), frame.model_error));
}
