//! Peaks of a range profile: number, strength, distance behind the leading edge, and spacing.

use crate::signatures::feature::{Features, NONE_DBSM, moments};
use crate::signatures::profile::{Profile, VisibleCell};

/// Least height of a peak over the lowest of the cells around it, dB.
const PROMINENCE_DB: f64 = 6.0;
/// Number of cells on each side of a peak: two main lobes.
const AROUND: usize = 4;
/// Distance behind the front beyond which a peak counts as far for every class, m; windows, axles and loads
/// are farther back.
const FAR_M: f64 = 2.8;

pub(crate) fn features(profile: &Profile) -> Features {
    let along: Vec<&VisibleCell> =
        profile.visible.iter().filter(|cell| is_peak(&profile.levels_db, cell.number)).collect();
    let mut all = ranked(&along);
    all.extend(near_and_far(&along));
    all.extend(spacing(&along));
    all
}

fn is_peak(levels_db: &[f64], at: usize) -> bool {
    let around = &levels_db[at.saturating_sub(AROUND)..(at + AROUND + 1).min(levels_db.len())];
    let lowest = around.iter().copied().fold(f64::INFINITY, f64::min);
    let before = at.checked_sub(1).map_or(f64::NEG_INFINITY, |i| levels_db[i]);
    let after = levels_db.get(at + 1).copied().unwrap_or(f64::NEG_INFINITY);
    levels_db[at] >= before && levels_db[at] > after && levels_db[at] - lowest >= PROMINENCE_DB
}

/// Number of peaks, place of the strongest, and levels of the next ones.
fn ranked(along: &[&VisibleCell]) -> Features {
    let mut peaks = along.to_vec();
    peaks.sort_by(|a, b| b.dbsm.total_cmp(&a.dbsm));
    let strong = peaks.iter().filter(|cell| cell.dbsm >= -5.0).count();
    let first = peaks.first();
    let below = |rank: usize, none: f64| first.zip(peaks.get(rank)).map_or(none, |(a, b)| a.dbsm - b.dbsm);
    let dbsm = |rank: usize| peaks.get(rank).map_or(NONE_DBSM, |cell| cell.dbsm);
    vec![
        ("peaks", peaks.len() as f64),
        ("peaks_over_-5_dbsm", strong as f64),
        ("strongest_at_m", first.map_or(0.0, |cell| cell.behind_m)),
        ("second_below_db", below(1, 40.0)),
        ("second_behind_m", first.zip(peaks.get(1)).map_or(0.0, |(a, b)| b.behind_m - a.behind_m)),
        ("third_below_db", below(2, 50.0)),
        ("fourth_dbsm", dbsm(3)),
        ("sixth_dbsm", dbsm(5)),
    ]
}

/// Peaks at the front and behind it.
fn near_and_far(along: &[&VisibleCell]) -> Features {
    let far = || along.iter().filter(|cell| cell.behind_m > FAR_M);
    let near = along.iter().filter(|cell| cell.behind_m <= FAR_M);
    let over = |dbsm: f64| far().filter(|cell| cell.dbsm > dbsm).count() as f64;
    vec![
        ("far_peaks", far().count() as f64),
        ("far_peaks_over_-10_dbsm", over(-10.0)),
        ("far_peaks_over_0_dbsm", over(0.0)),
        ("strongest_far_dbsm", far().map(|cell| cell.dbsm).fold(NONE_DBSM, f64::max)),
        ("strongest_near_dbsm", near.map(|cell| cell.dbsm).fold(NONE_DBSM, f64::max)),
    ]
}

/// Spacing between successive peaks, m, which is regular for panes; −1 below two peaks.
fn spacing(along: &[&VisibleCell]) -> Features {
    let gaps: Vec<f64> = along.windows(2).map(|pair| pair[1].behind_m - pair[0].behind_m).collect();
    let [mean, spread] =
        if gaps.is_empty() { [-1.0; 2] } else { moments(gaps.iter().map(|gap| (1.0, *gap))) };
    vec![
        ("peak_spacing_m", mean),
        ("peak_spacing_spread_m", if gaps.len() > 1 { spread } else { -1.0 }),
        ("peak_spacing_greatest_m", gaps.iter().copied().fold(-1.0, f64::max)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signatures::profile::Profile;
    use artifact::signature::{Signature, SignatureCell};

    fn value(features: &Features, name: &str) -> f64 {
        features.iter().find(|(known, _)| *known == name).unwrap().1
    }

    #[test]
    fn three_scatterers_are_three_peaks_with_their_distances() {
        let mut signature = Signature {
            cell_m: 0.25,
            range_extent_m: [40.0, 46.0],
            first_range_m: 39.0,
            ..Signature::default()
        };
        signature.cells = vec![SignatureCell::default(); 32];
        for (cell, level_db) in [(4, 30.0), (12, 20.0), (24, 40.0)] {
            signature.cells[cell].level_db = level_db;
        }
        let all = features(&Profile::of(&signature));
        for (name, expected) in [
            ("peaks", 3.0),
            ("strongest_at_m", 5.0),
            ("second_below_db", 10.0),
            ("second_behind_m", -5.0),
            ("fourth_dbsm", NONE_DBSM),
            ("far_peaks", 1.0),
            ("strongest_near_dbsm", 30.0),
            ("peak_spacing_m", 2.5),
            ("peak_spacing_spread_m", 0.5),
            ("peak_spacing_greatest_m", 3.0),
        ] {
            assert!((value(&all, name) - expected).abs() < 1e-9, "{name}: {}", value(&all, name));
        }
    }
}
