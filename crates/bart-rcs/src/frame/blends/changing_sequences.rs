//! Sequences of bodies whose paths differ at other moments, or from other positions of the array, from those
//! of the middle.

use crate::beams::body_sequences::BodySequences;
use crate::frame::band_power::{MARGIN, frequencies_hz, mean_difference, power_over_frame};
use crate::frame::path_plan::Plan;
use crate::frame::path_sum::{PathView, element_over_band};
use artifact::paths::Path;
use num_complex::Complex64;
use std::collections::{BTreeMap, BTreeSet};

/// Share of the requested accuracy that may be missed by all sequences together that keep the middle's paths.
const KEPT_SHARE: f64 = 0.5;
/// Minimum share of the measured error: if the error of the middle's paths at the probed nodes, or of a grid
/// halfway between its nodes, is smaller as an amplitude, the cause is another one (the other axis, cells),
/// and no finer grid is tried.
const LEAST_SHARE: f64 = 0.5;
/// Number of frequencies at which the fields of nodes are compared.
pub(super) const FIELD_FREQUENCIES: usize = 12;

/// Sequences whose paths at the frame's middle miss most of the field at two `others`: all but those that
/// together miss half of the requested accuracy there, as an amplitude. None if what they miss does not
/// explain the error `measured`.
pub(super) fn changing_sequences(
    plan: &Plan<'_>,
    middle: &[Path],
    measured: f64,
    others: [(PathView, &[Path]); 2],
) -> BodySequences {
    let power = power_over_frame(middle, plan);
    let mut left = (KEPT_SHARE * plan.allowed_error() / MARGIN).powi(2) * power;
    let missed_of = missed_by_way(plan, middle, others);
    let mut ways: Vec<(Vec<u32>, f64)> = missed_of.into_iter().collect();
    ways.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    let mut change = BodySequences::default();
    let missed: f64 = ways.iter().map(|(_, missed)| missed).sum();
    if missed < least_missed(measured, power) {
        return change;
    }
    for (way, missed) in ways {
        left -= missed;
        if left < 0.0 && missed > 0.0 {
            change.add(&way);
        }
    }
    change
}

/// Mean power missed by the middle's paths of each sequence at two others.
fn missed_by_way(
    plan: &Plan<'_>,
    middle: &[Path],
    others: [(PathView, &[Path]); 2],
) -> BTreeMap<Vec<u32>, f64> {
    let of_middle = by_sequence(middle);
    let mut missed: BTreeMap<Vec<u32>, f64> = BTreeMap::new();
    for (view, paths) in others {
        let of_other = by_sequence(paths);
        let ways: BTreeSet<&Vec<u32>> = of_middle.keys().chain(of_other.keys()).collect();
        for way in ways {
            let [was, is] = [&of_middle, &of_other].map(|of| field(of.get(way), plan, &view));
            *missed.entry(way.clone()).or_default() += 0.5 * mean_difference(&was, &is);
        }
    }
    missed
}

/// Power that must be missed along an axis to explain a measured error.
pub(super) fn least_missed(measured: f64, power: f64) -> f64 {
    (LEAST_SHARE * measured / MARGIN).powi(2) * power
}

/// Bodies of a path in the order of travel; empty for a point target.
pub(super) fn bodies(path: &Path) -> Vec<u32> {
    path.sequence().iter().map(|facet| facet.body).collect()
}

/// Groups paths by sequence of bodies; a sequence and its reverse are one.
fn by_sequence(paths: &[Path]) -> BTreeMap<Vec<u32>, Vec<Path>> {
    let mut ways: BTreeMap<Vec<u32>, Vec<Path>> = BTreeMap::new();
    for path in paths.iter().filter(|path| path.order > 0) {
        let there = bodies(path);
        let back = there.iter().rev().copied().collect();
        ways.entry(there.min(back)).or_default().push(*path);
    }
    ways
}

/// S of paths over the band in the radar's polarization.
pub(super) fn field(paths: Option<&Vec<Path>>, plan: &Plan<'_>, view: &PathView) -> Vec<Complex64> {
    let frequencies = frequencies_hz(plan.band.centre_hz, plan.band.bandwidth_hz, FIELD_FREQUENCIES);
    element_over_band(paths.map_or(&[], Vec::as_slice), view, plan.reception(), &frequencies)
}

/// Sequences as ids of their bodies.
pub(super) fn named(ways: &BodySequences, plan: &Plan<'_>) -> Vec<Vec<String>> {
    let id = |body: &u32| {
        plan.header.targets.get(*body as usize).map_or(String::new(), |target| target.id.clone())
    };
    ways.iter().map(|way| way.iter().map(id).collect()).collect()
}

/// Sequences among these whose bodies are all in a frame.
pub(super) fn present_sequences(names: &[Vec<String>], plan: &Plan<'_>) -> BodySequences {
    let index =
        |id: &String| plan.header.targets.iter().position(|target| target.id == *id).map(|i| i as u32);
    let mut ways = BodySequences::default();
    for way in names.iter().filter_map(|way| way.iter().map(index).collect::<Option<Vec<u32>>>()) {
        ways.add(&way);
    }
    ways
}

#[cfg(test)]
mod tests {
    use crate::frame::blends::axis::{FINEST, LOOKED_AT};
    use std::f64::consts::TAU;

    /// An amplitude that rotates at a constant rate misses |1 − e^{iφ}|² = 2 − 2·cos φ of its power: over the
    /// frame, at both of its ends, and at the probed places, from almost constant to four cycles per frame.
    #[test]
    fn what_turns_at_any_pace_is_seen_to_change_where_it_is_looked_at() {
        let missed = |cycles: f64, offset: f64| 2.0 - 2.0 * (TAU * cycles * offset).cos();
        let mut least_db = [f64::INFINITY; 2];
        for pace in 1..=400 {
            let cycles = f64::from(pace) / 100.0;
            let over_frame =
                (0..1000).map(|i| missed(cycles, (f64::from(i) + 0.5) / 1000.0 - 0.5)).sum::<f64>() / 1000.0;
            let looked_at = LOOKED_AT.map(|place| f64::from(place) / f64::from(FINEST) - 0.5);
            for (least, offsets) in least_db.iter_mut().zip([looked_at, [-0.5, 0.5]]) {
                let seen = offsets.map(|offset| missed(cycles, offset)).iter().sum::<f64>() / 2.0;
                *least = least.min(10.0 * (seen / over_frame).max(1e-9).log10());
            }
        }
        let [looked_at, ends] = least_db;
        println!(
            "least missed of what is missed over the frame: {looked_at:.1} dB, at its ends {ends:.1} dB"
        );
        assert!(looked_at > -6.0 && ends < -40.0);
    }
}
