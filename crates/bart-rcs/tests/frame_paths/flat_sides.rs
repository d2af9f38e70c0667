//! Bodies of large flat sides, off their speculars: little is left of what their parts scatter, and that
//! comes from their corners.

use crate::bodies::cuboid;
use crate::frames::{pose, scene, trace};
use crate::true_error;
use artifact::scene::Mesh;
use glam::DVec3;

/// A closed box of 9 m × 2.5 m × 3 m.
fn lorry() -> Mesh {
    cuboid(DVec3::new(-4.5, -1.25, 0.0), DVec3::new(4.5, 1.25, 3.0)).mesh()
}

/// Cut into cells alone these took up to 400,000 paths, and reached −19 to +2 dB.
#[test]
fn a_box_off_its_speculars_meets_the_accuracy_with_few_paths() {
    const CASES: [([f64; 2], f64, f64, f64); 6] = [
        ([3.0, 20.0], 0.0, -8.0, -20.0),
        ([-1.9, 29.7], 1.54, -14.0, -20.0),
        ([8.0, 25.0], -0.98, 0.0, -25.0),
        ([9.0, 46.0], -1.08, 0.0, -30.0),
        ([-3.4, 14.0], 0.84, -2.8, -15.0),
        ([1.0, 60.0], 0.3, 12.0, -30.0),
    ];
    for ([x_m, y_m], yaw_rad, vy_mps, asked_db) in CASES {
        let start = pose([x_m, y_m, 0.0], [0.0, vy_mps, 0.0], yaw_rad);
        let scene = scene(&[(lorry(), start)], &[], asked_db, 1);
        let frame = trace(&scene);
        let [told, got] =
            [frame.error.total().unwrap(), true_error(&scene, &frame)].map(|e| 20.0 * e.log10());
        let paths = frame.paths.len();
        println!("({x_m}, {y_m}) m: {paths} paths, asked {asked_db}, told {told:.1}, true {got:.1} dB");
        assert!(told <= asked_db, "({x_m}, {y_m}) m: asked {asked_db}, told {told}");
        assert!(got <= told + 3.0, "({x_m}, {y_m}) m: told {told}, true {got}");
        assert!(paths < 5000, "({x_m}, {y_m}) m: {paths} paths");
    }
}
