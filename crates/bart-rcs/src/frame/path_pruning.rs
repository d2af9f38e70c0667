//! Paths too weak to matter: a table is no larger than the accuracy asked for needs.

use crate::bodies::world::World;
use crate::frame::band_power::power_over_frame;
use crate::frame::path_plan::Plan;
use crate::frame::path_sum::{PathView, apparent_m};
use artifact::paths::Path;

/// Paths kept, in their order, and the power of the others.
pub(crate) struct Kept {
    pub(crate) paths: Vec<Path>,
    /// Σ|a·R²/(L₁L₂)|² of the dropped paths in the radar's polarization: their power, as their phases are
    /// independent.
    pub(crate) dropped_power: f64,
    /// The strongest that was dropped of each target, its wheels among it, as power.
    pub(crate) strongest_dropped: Vec<f64>,
}

/// Share of the accuracy asked for that may be dropped, as an amplitude.
const SHARE: f64 = 0.3;

/// Drops the weakest paths of every target as long as their powers add up to less than (0.3·accuracy)² of
/// that target's: a weak target loses no more of itself than a strong one. Wheels are part of their vehicle.
pub(crate) fn pruned(paths: Vec<Path>, plan: &Plan<'_>, world: &World) -> Kept {
    let view = plan.view(plan.middle_s);
    let most = (SHARE * plan.asked()).powi(2);
    let powers: Vec<f64> = paths.iter().map(|path| power(path, plan, &view)).collect();
    let mut keep = vec![true; paths.len()];
    let mut dropped_power = 0.0;
    let mut strongest_dropped = Vec::new();
    for target in 0..plan.header.targets.len() as u32 {
        let is_own = |path: &Path| world.vehicle(path.target) == target;
        let own: Vec<Path> = paths.iter().filter(|path| is_own(path)).copied().collect();
        let budget = most * power_over_frame(&own, plan);
        let mut order: Vec<usize> = (0..paths.len()).filter(|&i| is_own(&paths[i])).collect();
        order.sort_by(|&a, &b| powers[a].total_cmp(&powers[b]).then(a.cmp(&b)));
        let (mut sum, mut strongest) = (0.0, 0.0);
        for i in order {
            sum += powers[i];
            if sum > budget {
                sum -= powers[i];
                break;
            }
            keep[i] = false;
            strongest = powers[i];
        }
        dropped_power += sum;
        strongest_dropped.push(strongest);
    }
    let paths = paths.into_iter().zip(keep).filter_map(|(path, keep)| keep.then_some(path)).collect();
    Kept { paths, dropped_power, strongest_dropped }
}

/// Paths of another moment of the frame, without those that are no stronger than what was dropped.
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
    plan.seen(&path.amplitude_m).norm_sqr() * (ranges / (l1 * l2)).powi(2)
}
