//! Removal of negligible paths: a table is no larger than the requested accuracy requires.

use crate::bodies::world::World;
use crate::frame::band_power::{frequencies_hz, mean, power_over_frame};
use crate::frame::path_plan::Plan;
use crate::frame::path_sum::{PathView, apparent_m, element_over_band};
use artifact::paths::Path;
use num_complex::Complex64;

/// Kept paths, in their order, and the power of the others.
pub(crate) struct PrunedPaths {
    pub(crate) paths: Vec<Path>,
    /// Power of the dropped paths of each target in the radar's polarization: the larger of
    /// Σ|a·R²/(L₁L₂)|², as if their phases were independent, and of their sum over the band.
    pub(crate) dropped_powers: Vec<f64>,
    /// Power of the strongest dropped path of each target, including its wheels.
    pub(crate) strongest_dropped: Vec<f64>,
}

/// Share of the requested accuracy that may be dropped, as an amplitude.
const DROPPED_SHARE: f64 = 0.3;
/// Number of frequencies at which the sum of dropped paths is tested.
const FREQUENCIES: usize = 12;
/// Ratio of the power of their sum to that with independent phases that is tolerated: over twelve
/// frequencies, four of them independent, the mean power of such a sum exceeds this in one of twenty cases
/// (χ² with 8 degrees of freedom).
const BY_CHANCE: f64 = 1.94;
/// Number of runs in which paths are dropped, after each of which their sum is tested.
const RUNS: usize = 64;

/// Drops the weakest paths of every target as long as their power is less than (0.3·accuracy)² of that
/// target's: a weak target loses no larger share than a strong one. Wheels are part of their vehicle.
///
/// Both their summed power and the power of their sum count: cells of a smooth face, such as a kerb's or a
/// rail's, are weak individually but in phase with their neighbours.
pub(crate) fn pruned(paths: Vec<Path>, plan: &Plan<'_>, world: &World) -> PrunedPaths {
    let view = plan.view(plan.middle_s);
    let most = (DROPPED_SHARE * plan.allowed_error()).powi(2);
    let powers: Vec<f64> = paths.iter().map(|path| power(path, plan, &view)).collect();
    let mut keep = vec![true; paths.len()];
    let (mut dropped_powers, mut strongest_dropped) = (Vec::new(), Vec::new());
    for target in 0..plan.header.targets.len() as u32 {
        let mut order: Vec<usize> =
            (0..paths.len()).filter(|&i| world.vehicle(paths[i].target) == target).collect();
        let own: Vec<Path> = order.iter().map(|&i| paths[i]).collect();
        let budget = most * power_over_frame(&own, plan);
        order.sort_by(|&a, &b| powers[a].total_cmp(&powers[b]).then(a.cmp(&b)));
        let mut alone = 0.0;
        let weak = order.iter().take_while(|&&i| {
            alone += powers[i];
            alone <= budget
        });
        let weak: Vec<usize> = weak.copied().collect();
        let (count, together) = negligible_together(&weak, &paths, plan, BY_CHANCE * budget);
        let dropped = &weak[..count];
        dropped.iter().for_each(|&i| keep[i] = false);
        dropped_powers.push(together.max(dropped.iter().map(|&i| powers[i]).sum()));
        strongest_dropped.push(dropped.last().map_or(0.0, |&i| powers[i]));
    }
    let paths = paths.into_iter().zip(keep).filter_map(|(path, keep)| keep.then_some(path)).collect();
    PrunedPaths { paths, dropped_powers, strongest_dropped }
}

/// Largest number of the first of these paths whose sum over the band and the array stays within a power, and
/// the power of that sum.
///
/// Sums of fewer may have more: cells of a face whose echo comes only from its borders cancel only together.
fn negligible_together(weak: &[usize], paths: &[Path], plan: &Plan<'_>, budget: f64) -> (usize, f64) {
    let frequencies = frequencies_hz(plan.band.centre_hz, plan.band.bandwidth_hz, FREQUENCIES);
    let pairs = plan.pairs_of_array_m();
    let views: Vec<PathView> = pairs.iter().map(|ends_m| plan.view_from(*ends_m, plan.middle_s)).collect();
    let (mut seen, mut most) = (0, (0, 0.0));
    let mut sums = vec![vec![Complex64::ZERO; FREQUENCIES]; views.len()];
    for run in weak.chunks(weak.len().div_ceil(RUNS).max(1)) {
        let of_run: Vec<Path> = run.iter().map(|&i| paths[i]).collect();
        for (sum, view) in sums.iter_mut().zip(&views) {
            let added = element_over_band(&of_run, view, plan.reception(), &frequencies);
            sum.iter_mut().zip(added).for_each(|(sum, added)| *sum += added);
        }
        seen += run.len();
        let together = sums.iter().map(|sum| mean(sum)).sum::<f64>() / views.len() as f64;
        if together <= budget {
            most = (seen, together);
        }
    }
    most
}

/// Paths at another moment of the frame, without those no stronger than the dropped ones.
pub(crate) fn pruned_alike(
    paths: Vec<Path>,
    plan: &Plan<'_>,
    world: &World,
    strongest_dropped: &[f64],
) -> Vec<Path> {
    let view = plan.view(plan.middle_s);
    let limit =
        |path: &Path| strongest_dropped.get(world.vehicle(path.target) as usize).copied().unwrap_or(0.0);
    paths.into_iter().filter(|path| power(path, plan, &view) > limit(path)).collect()
}

fn power(path: &Path, plan: &Plan<'_>, view: &PathView) -> f64 {
    let [from_tx_m, from_rx_m] = apparent_m(path, view.seconds);
    let (l1, l2) = (from_tx_m.distance(view.transmitter_m), from_rx_m.distance(view.receiver_m));
    let ranges = view.origin_m.distance(view.transmitter_m) * view.origin_m.distance(view.receiver_m);
    plan.polarization_element(&path.amplitude_m).norm_sqr()
        * (plan.gains.of_path(path) * ranges / (l1 * l2)).powi(2)
}
