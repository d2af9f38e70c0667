//! Features of a signature for classification: level, extent, shape of the range profile, width, height, each
//! a number with its unit.

use crate::signatures::bands;
use crate::signatures::feature::{Features, NONE_DBSM, moments, span};
use crate::signatures::peaks;
use crate::signatures::profile::{Profile, VisibleCell};
use artifact::signature::Signature;
use artifact::units::db_from_power;
use std::ops::Range;

/// Cross sections above which cells are visible at any range of a crossing, dBsm.
const LEVELS_DBSM: [f64; 3] = [-12.0, 0.0, 10.0];
/// Zones behind the leading edge, m: bumper, bonnet and windscreen, roof, tail of a car, and a zone of long
/// vehicles only.
const ZONES_M: [f64; 9] = [-1.0, 0.75, 1.5, 2.5, 4.0, 6.0, 9.0, 13.0, 21.0];
/// All features of a signature, in a fixed order.
pub fn features(signature: &Signature) -> Features {
    let profile = Profile::of(signature);
    let mut all = levels(&profile);
    all.extend(extents(&profile));
    all.extend(form(&profile));
    all.extend(zones(&profile));
    all.extend(peaks::features(&profile));
    all.extend(bands::features(&profile));
    all.extend(width(&profile));
    all.extend(heights(&profile));
    all.extend(quality(&profile, signature));
    all.extend(view(signature));
    all
}

/// Names of the features.
pub fn names() -> Vec<&'static str> {
    features(&nothing()).into_iter().map(|(name, _)| name).collect()
}

fn levels(profile: &Profile) -> Features {
    let strongest = profile.visible.iter().map(|cell| cell.dbsm).fold(NONE_DBSM, f64::max);
    vec![("total_dbsm", dbsm(profile.total_m2)), ("strongest_cell_dbsm", strongest)]
}

fn dbsm(rcs_m2: f64) -> f64 {
    db_from_power(rcs_m2.max(1e-6)).max(NONE_DBSM)
}

/// Extent from the first to the last cell over each level, and the total length of such cells, m.
fn extents(profile: &Profile) -> Features {
    let names = [
        ("extent_m", "filled_m"),
        ("extent_-12_m", "filled_-12_m"),
        ("extent_0_m", "filled_0_m"),
        ("extent_10_m", "filled_10_m"),
    ];
    let levels = [f64::NEG_INFINITY].into_iter().chain(LEVELS_DBSM);
    let of = |((extent, filled), level): ((&'static str, &'static str), f64)| {
        let numbers: Vec<usize> =
            profile.visible.iter().filter(|c| c.dbsm >= level).map(|c| c.number).collect();
        let cells = numbers.first().zip(numbers.last()).map_or(0, |(first, last)| last + 1 - first);
        [(extent, cells as f64 * profile.cell_m), (filled, numbers.len() as f64 * profile.cell_m)]
    };
    names.into_iter().zip(levels).flat_map(of).collect()
}

/// Centre and spread of the profile, by power and by decibels over the threshold, and its entropy.
fn form(profile: &Profile) -> Features {
    let [middle, spread] = moments(profile.visible.iter().map(|c| (c.share, c.behind_m)));
    let by_db =
        profile.visible.iter().map(|c| (c.level_db - crate::signatures::profile::VISIBLE_DB, c.behind_m));
    let [middle_db, spread_db] = moments(by_db);
    let quantile = |share: f64| power_quantile_m(profile, share);
    let entropy = -profile.visible.iter().map(|c| c.share * c.share.max(1e-9).ln()).sum::<f64>();
    vec![
        ("middle_m", middle),
        ("spread_m", spread),
        ("middle_by_db_m", middle_db),
        ("spread_by_db_m", spread_db),
        ("entropy", entropy),
        ("power_10_percent_m", quantile(0.10)),
        ("power_25_percent_m", quantile(0.25)),
        ("power_50_percent_m", quantile(0.50)),
        ("power_75_percent_m", quantile(0.75)),
        ("power_90_percent_m", quantile(0.90)),
        ("power_97_percent_m", quantile(0.97)),
    ]
}

/// Distance behind the leading edge within which this share of the power lies, m; 0 without any.
fn power_quantile_m(profile: &Profile, share: f64) -> f64 {
    let mut sum = 0.0;
    let reached = profile.visible.iter().find(|cell| {
        sum += cell.share;
        sum >= share
    });
    reached.or(profile.visible.last()).map_or(0.0, |cell| cell.behind_m)
}

/// Cross section of each zone behind the leading edge, dBsm.
fn zones(profile: &Profile) -> Features {
    let names = [
        "zone_0_dbsm",
        "zone_1_dbsm",
        "zone_2_dbsm",
        "zone_3_dbsm",
        "zone_4_dbsm",
        "zone_5_dbsm",
        "zone_6_dbsm",
        "zone_7_dbsm",
    ];
    let of = |zone: Range<f64>| {
        dbsm(profile.visible.iter().filter(|c| zone.contains(&c.behind_m)).map(|c| c.rcs_m2).sum())
    };
    names.into_iter().zip(ZONES_M.windows(2).map(|ends| of(ends[0]..ends[1]))).collect()
}

/// Width across the line of sight, m.
fn width(profile: &Profile) -> Features {
    let weighted =
        || profile.located().map(|c| (c.level_db - crate::signatures::profile::LOCATED_DB, c.cross_m));
    let [_, spread] = moments(weighted());
    let [_, spread_by_power] = moments(profile.visible.iter().map(|c| (c.share, c.cross_m)));
    vec![
        ("width_m", span(profile.located().map(|c| c.cross_m))),
        ("cross_spread_m", spread),
        ("cross_spread_by_power_m", spread_by_power),
        ("cross_slope", slope(profile)),
    ]
}

/// Magnitude of the slope of the cells' places across over the distance behind the leading edge.
fn slope(profile: &Profile) -> f64 {
    let weight = |c: &VisibleCell| c.level_db - crate::signatures::profile::LOCATED_DB;
    let total: f64 = profile.located().map(weight).sum();
    if total <= 0.0 {
        return 0.0;
    }
    let mean =
        |value: fn(&VisibleCell) -> f64| profile.located().map(|c| weight(c) * value(c)).sum::<f64>() / total;
    let (behind, cross) = (mean(|c| c.behind_m), mean(|c| c.cross_m));
    let together: f64 =
        profile.located().map(|c| weight(c) * (c.behind_m - behind) * (c.cross_m - cross)).sum();
    let along: f64 = profile.located().map(|c| weight(c) * (c.behind_m - behind).powi(2)).sum();
    // The width of a cell is added, so that a single cell has no slope.
    (together / (along + 0.05 * total)).abs()
}

/// Heights over the road, m; zero if the array has no rows.
fn heights(profile: &Profile) -> Features {
    let has_rows = profile.has_rows;
    let names = [
        "height_m",
        "height_spread_m",
        "height_greatest_m",
        "height_upper_m",
        "height_of_strongest_m",
        "height_by_power_m",
        "height_of_front_m",
        "height_behind_m",
    ];
    let values = if has_rows { measured_heights(profile) } else { [0.0; 8] };
    let mut all: Features = vec![("has_rows", f64::from(u8::from(has_rows)))];
    all.extend(names.into_iter().zip(values));
    all
}

fn measured_heights(profile: &Profile) -> [f64; 8] {
    let [mean, spread] =
        moments(profile.located().map(|c| (c.level_db - crate::signatures::profile::LOCATED_DB, c.height_m)));
    let mut sorted: Vec<f64> = profile.located().map(|c| c.height_m).collect();
    sorted.sort_by(f64::total_cmp);
    let quantile =
        |share: f64| sorted.get((share * (sorted.len().max(1) - 1) as f64) as usize).copied().unwrap_or(mean);
    let strongest = profile.visible.iter().reduce(|a, b| if b.dbsm > a.dbsm { b } else { a });
    let part = |keep: fn(f64) -> bool| {
        let heights = profile.located().filter(|c| keep(c.behind_m)).map(|c| (1.0, c.height_m));
        if heights.clone().next().is_some() { moments(heights)[0] } else { mean }
    };
    let of_strongest = strongest.map_or(0.0, |c| c.height_m);
    let by_power = profile.mean(|c| c.height_m);
    [
        mean,
        spread,
        quantile(1.0),
        quantile(0.75),
        of_strongest,
        by_power,
        part(|m| m < 1.5),
        part(|m| m > 2.5),
    ]
}

/// Quality of the object's echo: single or several scatterers in a cell, rotating parts, and ghosts.
fn quality(profile: &Profile, signature: &Signature) -> Features {
    let located = profile.located().count().max(1) as f64;
    let mean = |value: fn(&VisibleCell) -> f64| profile.located().map(value).sum::<f64>() / located;
    vec![
        ("coherence", profile.mean(|c| c.coherence)),
        ("coherence_of_cells", mean(|c| c.coherence)),
        ("velocity_spread_mps", profile.mean(|c| c.velocity_spread_mps)),
        ("velocity_spread_of_cells_mps", mean(|c| c.velocity_spread_mps)),
        ("ghost_share", signature.ghost_share.unwrap_or(0.0)),
    ]
}

/// View of the object: its aspect and its visibility.
fn view(signature: &Signature) -> Features {
    vec![
        ("range_m", signature.range_m),
        ("azimuth_rad", signature.azimuth_rad.abs()),
        ("noise_dbsm", signature.noise_dbsm),
        ("points", f64::from(signature.points)),
        ("beam", signature.beams[0].unwrap_or(1.0)),
        ("radar_height_m", signature.radar_height_m),
    ]
}

fn nothing() -> Signature {
    Signature {
        range_m: 0.0,
        radial_velocity_mps: 0.0,
        azimuth_rad: 0.0,
        radar_height_m: 0.0,
        beams: [None; 2],
        cell_m: 1.0,
        velocity_cell_mps: 1.0,
        noise_dbsm: 0.0,
        points: 0,
        range_extent_m: [0.0; 2],
        ghost_share: None,
        first_range_m: 0.0,
        cells: vec![],
    }
}
