//! Error of each target's echo alone. Beside a strong target a weak one may err by more of its own echo than
//! the frame does of all: the accuracy asked for is the frame's.

use super::Reference;
use crate::frame::band_power::{MARGIN, mean, mean_difference, power_over_frame};
use crate::frame::integration_error::BodyEcho;
use crate::frame::path_plan::Plan;
use crate::frame::path_sum::element_over_band;
use crate::frame::path_table::PathTable;
use artifact::paths::Path;
use artifact::scene::TargetKind;
use artifact::settings::Wheels;

/// Errors of the targets' own echoes, in their order, as amplitudes relative to each one's own, with the
/// margin of the measurement: paths against bodies at the moment of the check, or what was dropped where that
/// is more, and the integrals of both. `None` of what has no echo, of point targets, which are exact, and of
/// vehicles whose wheels turn.
///
/// Ways that meet several bodies are nobody's own. What a blend misses at other moments than that of the
/// check counts for every target that is blended. The shares of tessellation, of beams given up, of the
/// reduction of paths and of the samples are told of the frame alone.
pub(crate) fn target_errors(plan: &Plan<'_>, table: &PathTable, reference: &Reference) -> Vec<Option<f64>> {
    let wheels_turn = plan.header.fidelity.wheels == Wheels::Turning;
    let of = |(index, body): (usize, &BodyEcho)| {
        let is_point = matches!(plan.header.targets[index].kind, TargetKind::Point { .. });
        let own: Vec<Path> = table.paths.iter().filter(|path| is_own(path, index as u32)).copied().collect();
        let power = power_over_frame(&own, plan).max(mean(&body.amplitude_m));
        let is_told = !is_point && !wheels_turn && power > 0.0;
        is_told.then(|| {
            let sum = element_over_band(&own, &plan.check_view(), plan.hearing(), &reference.frequencies_hz);
            let missed = mean_difference(&body.amplitude_m, &sum) + body.integration_power;
            let beside_check = missed + blends_power_m2(plan, table, index);
            let dropped = table.dropped_powers.get(index).copied().unwrap_or(0.0) + body.integration_power;
            MARGIN * (beside_check.max(dropped) / power).sqrt()
        })
    };
    reference.integration.bodies.iter().enumerate().map(of).collect()
}

/// Whether a path meets this target and no other.
fn is_own(path: &Path, target: u32) -> bool {
    path.target == target && path.facets[..usize::from(path.order)].iter().all(|facet| facet.body == target)
}

/// Power that blends miss beyond what they do at the moment of the check, of a target that is blended.
fn blends_power_m2(plan: &Plan<'_>, table: &PathTable, target: usize) -> f64 {
    let mut ways = table.fineness.ways.iter().chain(&table.fineness.ways_of_places).flatten();
    let is_blended = ways.any(|id| *id == plan.header.targets[target].id);
    if is_blended { table.given_up.blends_power_m2 } else { 0.0 }
}
