//! Far-field tables of a frame: what they tell of their errors, against tables as fine as one part in a
//! thousand.

use crate::frames::{pose, scene};
use artifact::Accuracy;
use artifact::rcs::{RcsFrame, RcsTable};
use artifact::scene::{Mesh, RoadWheel, SceneFrame, SceneHeader, TargetKind, Wheel};
use artifact::settings::{Edges, Surface, Wheels};
use bart_rcs::{NoProgress, RcsRequest, Tracer, rcs};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A tube of radius 0.3 m and height 0.5 m, open at both ends, in strips of 15°.
fn tube() -> Mesh {
    const STRIPS: u32 = 24;
    let corner = |i: u32, z: f64| {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(STRIPS)).sin_cos();
        [0.3 * cos, 0.3 * sin, z]
    };
    let vertices_m = (0..STRIPS).flat_map(|i| [corner(i, 0.0), corner(i, 0.5)]).collect();
    let strip = |i: u32| {
        let [a, b] = [2 * i, 2 * ((i + 1) % STRIPS)];
        [[a, b, b + 1], [a, b + 1, a + 1]]
    };
    Mesh { vertices_m, triangles: (0..STRIPS).flat_map(strip).collect(), ..Mesh::default() }
}

fn tables((header, frame): &(SceneHeader, SceneFrame)) -> RcsFrame {
    Tracer::new(header).unwrap().tables(header, frame, &NoProgress).unwrap()
}

/// Error of a table at its first aspect over frequency, by one of the body's own as fine as −60 dB.
fn error_of(table: &RcsTable, header: &SceneHeader) -> f64 {
    let (edges, surface) = (header.fidelity.edges, header.fidelity.surface);
    let request = RcsRequest {
        bounces: header.fidelity.bounces,
        nodes: header.fidelity.nodes,
        sides: header.fidelity.sides,
        edges,
        surface,
        accuracy: Accuracy::from_db(-60.0),
        ..RcsRequest::over(
            table.frequency_hz.clone(),
            vec![table.elevation_rad[0]],
            vec![table.azimuth_rad[0]],
        )
    };
    let exact = rcs(&header.meshes[0], &request, &|_, _| ()).unwrap().amplitude_m;
    let columns = table.elevation_rad.len() * table.azimuth_rad.len();
    let got = table.amplitude_m.iter().step_by(columns);
    let error: f64 = got.zip(&exact).map(|(got, exact)| (got - exact).norm_sqr()).sum();
    (error / exact.iter().map(|exact| exact.norm_sqr()).sum::<f64>()).sqrt()
}

/// What goes round on a body is in no table: a scene that has it is refused, where the wheels were left out.
#[test]
fn tables_of_what_turns_on_a_body_are_refused_by_name() {
    let mut body = tube();
    body.wheels = vec![RoadWheel { hub_m: [0.0; 3], radius_m: 0.3, triangles: (0..4).collect() }];
    let start = pose([4.0, 30.0, 0.3], [3.0, 0.0, 0.0], 0.0);
    let mut scene = scene(&[(body, start)], &[(1.0, start)], -20.0, 1);
    let refused = |scene: &(SceneHeader, SceneFrame)| {
        let tables = Tracer::new(&scene.0).unwrap().tables(&scene.0, &scene.1, &NoProgress);
        tables.err().map_or_else(String::new, |error| error.to_string())
    };
    assert_eq!(refused(&scene), "", "wheels that stand still are part of the body");
    scene.0.fidelity.wheels = Wheels::Turning;
    assert!(refused(&scene).contains("wheels = \"turning\""), "{}", refused(&scene));
    scene.0.fidelity.wheels = Wheels::Still;
    let wheel = Some(Wheel { radius_m: 0.3, angle_rad: 0.0 });
    scene.0.targets[1].kind = TargetKind::Point { rcs_m2: 1.0, wheel };
    assert!(refused(&scene).contains("a point on a wheel"), "{}", refused(&scene));
}

/// A tube at rest, seen square: its tables err by nothing but integrals, facets in place of a skin and what
/// was dropped.
#[test]
fn tables_of_bent_skins_and_of_edges_tell_what_they_err_by() {
    for (surface, edges, bounces) in [
        (Surface::Smooth, Edges::Ignored, 1),
        (Surface::Smooth, Edges::Ignored, 2),
        (Surface::Flat, Edges::FirstOrder, 1),
        (Surface::Smooth, Edges::FirstOrder, 1),
    ] {
        for (yaw_rad, accuracy_db) in [(0.3, -10.0), (-FRAC_PI_2, -15.0), (1.1, -20.0)] {
            let mut scene =
                scene(&[(tube(), pose([4.0, 30.0, 5.75], [0.0; 3], yaw_rad))], &[], accuracy_db, bounces);
            (scene.0.fidelity.surface, scene.0.fidelity.edges) = (surface, edges);
            let found = tables(&scene);
            let (told, error) = (found.error.total().unwrap(), error_of(&found.tables[0], &scene.0));
            let [told_db, error_db] = [told, error].map(|e| 20.0 * e.log10());
            println!(
                "{surface:?}, {edges:?}, {bounces} bounces, asked {accuracy_db}, told {told_db:.1}, true {error_db:.1} dB"
            );
            assert!(error <= told, "{:?}", found.error);
        }
    }
}
