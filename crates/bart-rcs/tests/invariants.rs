//! Invariants of beams on any mesh (docs/physics.md §2, G1, D4, D5): what is lit is what can be seen.

mod bodies;

use bart_rcs::{Antenna, BeamTree};
use bodies::referee::silhouette;
use bodies::{TRACERS, Triangles, car, cuboid, directions, settings, sphere};
use glam::DVec3;

/// G1's tolerance, relative.
const G1: f64 = 1e-9;

fn lit_section(tree: &BeamTree) -> f64 {
    tree.beams.iter().map(|beam| beam.section).sum()
}

fn bodies_to_look_at() -> [(&'static str, Triangles); 3] {
    [("sphere", sphere(0.7, 2)), ("cube", cuboid(DVec3::splat(-0.4), DVec3::splat(0.6)).refined(1)), ("car", car(12))]
}

#[test]
fn lit_area_across_the_direction_is_the_silhouettes() {
    for (body, triangles) in bodies_to_look_at() {
        for r in directions() {
            let expected = silhouette(&triangles.0, Antenna::Direction(r));
            for (tracer, trace) in TRACERS {
                let tree = trace(&triangles.world(), Antenna::Direction(r), &settings(1)).unwrap();
                let error = lit_section(&tree) / expected - 1.0;
                println!("{body} {r:.2} {tracer}: {error:e}, {} beams", tree.beams.len());
                assert!(error.abs() < G1, "{body} {r} {tracer}: {error:e}");
            }
        }
    }
}

#[test]
fn lit_solid_angle_is_the_silhouettes() {
    for (body, triangles) in bodies_to_look_at() {
        for (r, range_m) in directions().into_iter().zip([10.0, 25.0, 3.0, 60.0, 8.0, 4.0, 1e4]) {
            let antenna = Antenna::Point(r * range_m);
            let expected = silhouette(&triangles.0, antenna);
            for (tracer, trace) in TRACERS {
                let tree = trace(&triangles.world(), antenna, &settings(1)).unwrap();
                let error = lit_section(&tree) / expected - 1.0;
                println!("{body} {r:.2} {range_m} m {tracer}: {error:e}");
                assert!(error.abs() < G1, "{body} {r} {range_m} m {tracer}: {error:e}");
            }
        }
    }
}
