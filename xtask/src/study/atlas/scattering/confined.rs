//! Cavities, ducts and facing walls: the field returns after many bounces.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::printed;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::bodies::{self, Face};
use crate::study::closed_forms;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use artifact::scene::Mesh;
use artifact::settings::Sides;
use num_complex::Complex64;
use po_sbr::{Bracket, sbr};
use std::f64::consts::PI;
use wayside::host::failure::Failure;

/// Orders of the path record; the reference goes on to eight.
const ORDERS: [u8; 5] = [1, 2, 3, 4, 5];

/// Comparison with rays that bounce eight times, 30 per wavelength.
pub(in crate::study::atlas) fn open_box(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    of_orders("box without a front", &bodies::cube(0.06, &Face::ALL[1..]), [25.0, 15.0], 8)
}

/// A square tube ten times as long as wide, 20° off its axis: comparison with rays that bounce 24 times.
pub(in crate::study::atlas) fn duct(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let (side_m, length_m) = (0.03, 0.3);
    let half_m = 0.5 * side_m;
    let wall = |corner: [f64; 3], across: [f64; 3]| [corner, across, [length_m, 0.0, 0.0]];
    let body = bodies::parallelograms(&[
        wall([0.0, -half_m, -half_m], [0.0, side_m, 0.0]),
        wall([0.0, -half_m, half_m], [0.0, side_m, 0.0]),
        wall([0.0, -half_m, -half_m], [0.0, 0.0, side_m]),
        wall([0.0, half_m, -half_m], [0.0, 0.0, side_m]),
        [[0.0, -half_m, -half_m], [0.0, side_m, 0.0], [0.0, 0.0, side_m]],
    ]);
    of_orders("duct ten times as long as wide, shut at its end", &body, [20.0, 0.0], 24)
}

/// Two upright tubes side by side, with waves between their round walls.
pub(in crate::study::atlas) fn round_walls(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let (radius_m, height_m, gap_m) = (0.03, 0.03, 0.02);
    let beside = |y_m: f64| bodies::shifted(bodies::tube(radius_m, height_m, 120, 0.0), [0.0, y_m, 0.0]);
    let apart_m = radius_m + 0.5 * gap_m;
    let body = bodies::joined(beside(apart_m), &beside(-apart_m));
    of_orders("two round walls that face each other", &body, [0.0, 0.0], 8)
}

/// Two hollow walls about one axis, with gaps of 60° between them, seen from above.
pub(in crate::study::atlas) fn hollow_walls(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let (radius_m, height_m) = (0.03, 0.03);
    let mut tube = bodies::tube(radius_m, height_m, 120, 0.0);
    let middle_deg = |t: &[u32; 3]| {
        let sum =
            t.iter().map(|i| tube.vertices_m[*i as usize]).fold([0.0; 2], |s, v| [s[0] + v[0], s[1] + v[1]]);
        f64::atan2(sum[1], sum[0]).to_degrees().abs()
    };
    let kept = tube.triangles.iter().filter(|t| (30.0..150.0).contains(&middle_deg(t))).copied().collect();
    tube.triangles = kept;
    of_orders("two hollow walls that face each other", &tube, [20.0, 40.0], 10)
}

/// Traced orders against rays that bounce as long as anything is left.
fn of_orders(
    case: &'static str,
    body: &Mesh,
    [azimuth_deg, elevation_deg]: [f64; 2],
    of_rays: u8,
) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial(case, "bounces");
    let all = by_rays(body, [azimuth_deg, elevation_deg], of_rays)?;
    let row = |bounces: u8| {
        let result = rcs_solvers::trace_rcs(
            body,
            &rcs_solvers::request_with_bounces(azimuth_deg, elevation_deg, bounces),
        )?;
        let model = result.model_error;
        let statement = match (model.bounces, model.nodes) {
            (Some(left_out), nodes) => ErrorStatement::Estimate(left_out.hypot(nodes.unwrap_or(0.0))),
            (None, _) => {
                ErrorStatement::Remark("model_error_db.bounces is null: one order tells nothing of the next")
            }
        };
        Ok(trial.answered(bounces, rcs_solvers::relative_error(&result.amplitude_m, &[all]), statement))
    };
    ORDERS.into_iter().map(row).collect()
}

fn by_rays(body: &Mesh, [azimuth_deg, elevation_deg]: [f64; 2], bounces: u8) -> Result<Complex64, Failure> {
    let shooting =
        sbr::RaySettings { per_wavelength: 30.0, bounces, sides: Sides::Two, bracket: Bracket::Symmetrised };
    let request = rcs_solvers::first_order_request(azimuth_deg, elevation_deg);
    Ok(rcs_solvers::sbr_amplitudes(body, &request, &shooting)?.iter().sum())
}

/// A closed box seen from outside: whatever orders are traced inside it, its S is that of its front (P1).
pub(in crate::study::atlas) fn closed_box(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("closed box from outside: nothing gets in", "bounces");
    let (side_m, azimuth_rad) = (0.06, 1_f64.to_radians());
    let body = bodies::shifted(bodies::cube(side_m, &Face::ALL), [-0.5 * side_m, 0.0, -0.5 * side_m]);
    let front = closed_forms::plate_far(side_m, azimuth_rad);
    // The middle of the only other lit side is half a side behind and beside the front's.
    let middle_m = 0.5 * side_m * (azimuth_rad.sin() - azimuth_rad.cos());
    let beside = closed_forms::plate_far(side_m, 0.5 * PI - azimuth_rad);
    let exact = front + beside * Complex64::cis(2.0 * rcs_solvers::K * middle_m);
    let row = |bounces: u8| {
        let result = rcs_solvers::trace_rcs(&body, &rcs_solvers::request_with_bounces(1.0, 0.0, bounces))?;
        let error = rcs_solvers::relative_error(&result.amplitude_m, &[exact]);
        Ok(trial.answered(bounces, error, printed(&result.error)))
    };
    [1, 3, 5].into_iter().map(row).collect()
}
