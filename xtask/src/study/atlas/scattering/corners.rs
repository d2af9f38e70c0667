//! Joints of beams in corners: each sequence once, and the effect of the choice of a node.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::Trial;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::bodies;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use artifact::scene::Mesh;
use artifact::settings::NodeRule;
use bart_rcs::RcsRequest;
use std::f64::consts::PI;
use wayside::host::failure::Failure;

const TRIAL: Trial = methods::BART.trial("right corners, one order alone", "body");

/// Levels of docs/physics.md D1, D2; joined at every node they would be 6 and 9.5 dB too high.
pub(in crate::study::atlas) fn right_angles(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let lambda_m = rcs_solvers::WAVELENGTH_M;
    let diagonal_deg = (0.5_f64).sqrt().atan().to_degrees();
    let dihedral = 0.15_f64.powi(2) * (8.0 * PI).sqrt() / lambda_m;
    let trihedral = |constant: f64| (constant * PI).sqrt() * 0.01 / lambda_m;
    let turned = (16.0 * PI).sqrt() * 0.15_f64.powi(2) / lambda_m * 25_f64.to_radians().sin();
    Ok(vec![
        order_alone("dihedral, azimuth 0", &bodies::dihedral(90.0), [0.0, 0.0], 2, dihedral)?,
        order_alone("dihedral, azimuth 20", &bodies::dihedral(90.0), [20.0, 0.0], 2, turned)?,
        order_alone(
            "square trihedral",
            &bodies::square_trihedral(0.1),
            [45.0, diagonal_deg],
            3,
            trihedral(12.0),
        )?,
        order_alone(
            "triangular trihedral",
            &bodies::triangular_trihedral(0.1),
            [45.0, diagonal_deg],
            3,
            trihedral(4.0 / 3.0),
        )?,
    ])
}

fn order_alone(
    name: &str,
    body: &Mesh,
    [azimuth_deg, elevation_deg]: [f64; 2],
    order: u8,
    level: f64,
) -> Result<CaseRow, Failure> {
    let result =
        rcs_solvers::trace_rcs(body, &rcs_solvers::request_with_bounces(azimuth_deg, elevation_deg, order))?;
    let found = result.by_order_m[usize::from(order) - 1][0].norm();
    Ok(TRIAL.answered(
        name,
        rcs_solvers::level_error(found, level),
        crate::study::atlas::verdict::printed(&result.error),
    ))
}

/// Angles other than 90°: the result depends on the node; neither is exact, and the spread is printed.
pub(in crate::study::atlas) fn other_angles(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("middle against exit node off 90°", "angle_deg, azimuth_deg");
    let row = |(angle_deg, azimuth_deg): (f64, f64)| {
        let body = bodies::dihedral(angle_deg);
        let middle = rcs_solvers::request_with_bounces(azimuth_deg, 0.0, 3);
        let exit = RcsRequest { nodes: NodeRule::Exit, ..middle.clone() };
        let (middle, exit) = (rcs_solvers::trace_rcs(&body, &middle)?, rcs_solvers::trace_rcs(&body, &exit)?);
        let error = rcs_solvers::relative_error(&exit.amplitude_m, &middle.amplitude_m);
        let statement = middle.model_error.nodes.map_or(ErrorStatement::Missing, ErrorStatement::Estimate);
        Ok(trial.answered(format!("{angle_deg}, {azimuth_deg}"), error, statement))
    };
    [(90.0, 0.0), (88.0, 0.0), (88.0, 7.0), (95.0, 0.0), (95.0, 7.0), (100.0, 10.0)]
        .into_iter()
        .map(row)
        .collect()
}
