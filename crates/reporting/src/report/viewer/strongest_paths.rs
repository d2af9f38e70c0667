//! Paths of a frame in the view: the strongest, with their places and powers.

use crate::report::viewer::packed::Packed;
use crate::report::viewer::path_geometry::{PathCourse, PathFolding};
use artifact::paths::{Path, PathsFrame};
use artifact::radar::Radar;
use glam::DVec3;
use radar::path_echo::echo_value;
use radar::path_kinematics::legs;
use serde::Serialize;

/// Paths of a frame, the strongest first.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct StrongestPaths {
    /// Number of all paths of the frame.
    all: usize,
    /// Sum of the powers of all paths, W.
    all_power_w: f64,
    /// Sum of the powers of the paths that are not shown, W.
    left_out_power_w: f64,
    /// Sum of the powers of all paths by body, W.
    power_of_bodies_w: Vec<f64>,
    /// Number of shown paths whose course leads through the centres of their facets.
    through_middles: usize,
    /// Number of places of each path.
    corners: Packed,
    /// Places of all paths, concatenated: x, y, z relative to the radar, m.
    places_m: Packed,
    orders: Packed,
    /// Index of each path's body.
    targets: Packed,
    /// Received power of each single path, dBW.
    levels_dbw: Packed,
    ranges_m: Packed,
    velocities_mps: Packed,
}

/// Precision of places and ranges, m, and of velocities, m/s.
const STEP: f64 = 0.01;
/// Precision of levels, dB.
const STEP_DB: f64 = 0.05;
/// Level of a path without power, dBW.
const NO_POWER_DBW: f64 = -400.0;

impl StrongestPaths {
    /// Selects the strongest `most` paths that a radar receives from `bodies` bodies.
    pub(super) fn of(
        radar: &Radar,
        frame: &PathsFrame,
        folding: &PathFolding,
        bodies: usize,
        most: usize,
    ) -> Self {
        let powers: Vec<f64> = frame.paths.iter().map(|path| echo_value(radar, path).norm_sqr()).collect();
        let mut power_of_bodies_w = vec![0.0; bodies];
        for (path, power) in frame.paths.iter().zip(&powers) {
            if let Some(sum) = power_of_bodies_w.get_mut(path.target as usize) {
                *sum += power;
            }
        }
        let mut order: Vec<usize> = (0..powers.len()).collect();
        order.sort_by(|a, b| powers[*b].total_cmp(&powers[*a]).then(a.cmp(b)));
        let left_out_power_w = order.iter().skip(most).map(|i| powers[*i]).sum();
        order.truncate(most);
        let shown: Vec<&Path> = order.iter().map(|i| &frame.paths[*i]).collect();
        let ways: Vec<PathCourse> = shown.iter().map(|path| folding.way(path)).collect();
        let level = |i: &usize| (10.0 * powers[*i].log10()).max(NO_POWER_DBW);
        let [ranges, velocities] = ranges_and_velocities(radar, &shown);
        Self {
            all: powers.len(),
            all_power_w: powers.iter().sum(),
            left_out_power_w,
            power_of_bodies_w,
            through_middles: ways.iter().filter(|way| way.missed_by_m.is_none()).count(),
            corners: Packed::bytes(&ways.iter().map(|way| way.places_m.len() as u8).collect::<Vec<_>>()),
            places_m: Packed::places(&all_places_m(&ways), radar.position_m, STEP),
            orders: Packed::bytes(&shown.iter().map(|path| path.order).collect::<Vec<_>>()),
            targets: Packed::numbers(&shown.iter().map(|path| path.target).collect::<Vec<_>>()),
            levels_dbw: Packed::steps(&order.iter().map(level).collect::<Vec<_>>(), STEP_DB),
            ranges_m: Packed::steps(&ranges, STEP),
            velocities_mps: Packed::steps(&velocities, STEP),
        }
    }
}

fn all_places_m(ways: &[PathCourse]) -> Vec<[f64; 3]> {
    ways.iter().flat_map(|way| &way.places_m).map(DVec3::to_array).collect()
}

fn ranges_and_velocities(radar: &Radar, paths: &[&Path]) -> [Vec<f64>; 2] {
    let legs = || paths.iter().map(|path| legs(radar, path));
    [
        legs().map(|[there, back]| 0.5 * (there.length_m + back.length_m)).collect(),
        legs().map(|[there, back]| 0.5 * (there.rate_mps + back.rate_mps)).collect(),
    ]
}
