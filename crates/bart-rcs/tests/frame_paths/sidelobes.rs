//! Plates in their sidelobes, whose echo is as little as what one tile leaves out.

use crate::bodies::carts::parallelogram;
use crate::frames::{RADAR_M, anew, of_paths, pose, scene, trace};
use artifact::radar::Polarization;

const FREQUENCIES: u32 = 12;

/// A square plate at the height of the radar, one corner up, turned by some degrees.
#[test]
fn what_a_frame_tells_of_a_plate_in_its_sidelobes_is_no_less_than_it_errs_by() {
    let frequencies: Vec<f64> =
        (0..FREQUENCIES).map(|i| 77e9 + 0.625e9 * (f64::from(i) + 0.37) / f64::from(FREQUENCIES)).collect();
    let mut covered = 0;
    for (side_m, range_m) in [(0.02, 5.0), (0.02, 15.0), (0.05, 15.0), (0.1, 15.0)] {
        for yaw_deg in [-61.0_f64, -70.0, -82.0, -46.0] {
            let corner = [0.0, -0.5 * side_m, 0.0];
            let plate = parallelogram(corner, [0.0, side_m, 0.0], [0.0, 0.0, side_m]);
            let place = [0.0, range_m, RADAR_M[2] - 0.5 * side_m];
            let scene = scene(&[(plate, pose(place, [0.0; 3], yaw_deg.to_radians()))], &[], -20.0, 1);
            let (frame, seconds) = (trace(&scene), scene.0.radar.frame_middle_s());
            let exact = anew(&scene, seconds, &frequencies, Polarization::Vv);
            let (mut error, mut power) = (0.0, 0.0);
            for (f, s) in frequencies.iter().zip(exact) {
                error += (of_paths(&scene, &frame, seconds, *f)[0][0] - s).norm_sqr();
                power += s.norm_sqr();
            }
            let (got, told) = (10.0 * f64::log10(error / power), 20.0 * frame.error.total().unwrap().log10());
            println!("{side_m} m at {range_m} m, {yaw_deg}°: told {told:.1}, true {got:.1} dB");
            assert!(got <= -20.0, "told {told}, true {got}");
            covered += u32::from(got <= told);
        }
    }
    assert!(covered >= 15, "{covered} of 16");
}
