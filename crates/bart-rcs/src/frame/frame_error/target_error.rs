//! Error of each target's echo alone. Beside a strong target a weak one may have a larger relative error than
//! the frame: the requested accuracy is the frame's.

use super::FrameReference;
use crate::frame::band_power::{MARGIN, mean, mean_difference, power_over_frame};
use crate::frame::integration_error::BodyEcho;
use crate::frame::path_plan::Plan;
use crate::frame::path_sum::{PathView, element_over_band};
use crate::frame::path_table::PathTable;
use artifact::paths::Path;
use artifact::scene::TargetKind;
use artifact::settings::Wheels;
use num_complex::Complex64;

/// Errors of the targets' own echoes, in their order, as amplitudes relative to each echo, with the margin of
/// the measurement: the difference between paths and bodies at the moment of the check, between as many pairs
/// of elements as the frame's own, or the dropped part if that is larger, and the integrals of both. `None`
/// for targets without echo, for point targets, which are exact, and for vehicles with rotating wheels.
///
/// Paths over several bodies belong to no target. The error of a blend at other moments than that of the
/// check counts for every blended target. The shares of tessellation, of dropped beams, of the reduction of
/// paths and of the samples are reported for the frame alone.
pub(crate) fn target_errors(
    plan: &Plan<'_>,
    table: &PathTable,
    reference: &FrameReference,
) -> Vec<Option<f64>> {
    let wheels_turn = plan.header.fidelity.wheels == Wheels::Turning;
    let of = |(index, body): (usize, &BodyEcho)| {
        let is_point = matches!(plan.header.targets[index].kind, TargetKind::Point { .. });
        let own: Vec<Path> = table.paths.iter().filter(|path| is_own(path, index as u32)).copied().collect();
        let power = power_of_target(plan, &own, body);
        let is_told = !is_point && !wheels_turn && power > 0.0;
        is_told.then(|| {
            let missed = |view: &PathView, of_body: &[Complex64]| {
                let sum = element_over_band(&own, view, plan.reception(), &reference.frequencies_hz);
                mean_difference(of_body, &sum)
            };
            let first = missed(&plan.check_view(), &body.amplitude_m);
            let second = reference.second.as_ref().map(|pair| missed(&pair.view, &pair.bodies_m[index]));
            let compared = second.map_or(first, |second| 0.5 * (first + second));
            let beside_check = compared + body.integration_power + blends_power_m2(plan, table, index);
            let dropped = table.dropped_powers.get(index).copied().unwrap_or(0.0) + body.integration_power;
            MARGIN * (beside_check.max(dropped) / power).sqrt()
        })
    };
    reference.integration.bodies.iter().enumerate().map(of).collect()
}

/// Mean power of a target's own paths over the frame; in the cross polarization, and where they cancel, of
/// the target at the moment of the check if that is more.
fn power_of_target(plan: &Plan<'_>, own: &[Path], body: &BodyEcho) -> f64 {
    let power = power_over_frame(own, plan);
    if plan.is_cross_polarized() || power == 0.0 { power.max(mean(&body.amplitude_m)) } else { power }
}

/// Whether a path meets this target only.
fn is_own(path: &Path, target: u32) -> bool {
    path.target == target && path.facets[..usize::from(path.order)].iter().all(|facet| facet.body == target)
}

/// Power missed by blends beyond that at the moment of the check, for a blended target.
fn blends_power_m2(plan: &Plan<'_>, table: &PathTable, target: usize) -> f64 {
    let mut ways = table.fineness.ways.iter().chain(&table.fineness.ways_of_places).flatten();
    let is_blended = ways.any(|id| *id == plan.header.targets[target].id);
    if is_blended { table.omitted_powers.blends_power_m2 } else { 0.0 }
}
