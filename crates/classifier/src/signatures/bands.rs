//! Heights and widths by sections of a vehicle's length.

use crate::signatures::feature::{Features, span};
use crate::signatures::profile::Profile;

/// Bands behind the leading edge, m: front, the section after it, middle, rear, and a section of long
/// vehicles only.
const BANDS_M: [f64; 6] = [-1.0, 1.5, 3.0, 5.0, 9.0, 21.0];

const NAMES: [[&str; 4]; 5] = [
    ["highest_of_front_m", "height_of_front_m", "lowest_of_front_m", "width_of_front_m"],
    [
        "highest_of_behind_front_m",
        "height_of_behind_front_m",
        "lowest_of_behind_front_m",
        "width_of_behind_front_m",
    ],
    ["highest_of_middle_m", "height_of_middle_m", "lowest_of_middle_m", "width_of_middle_m"],
    ["highest_of_rear_m", "height_of_rear_m", "lowest_of_rear_m", "width_of_rear_m"],
    ["highest_of_far_rear_m", "height_of_far_rear_m", "lowest_of_far_rear_m", "width_of_far_rear_m"],
];

/// Features of each band: highest, mean and lowest place over the road, and its extent across the line of
/// sight; −1 if nothing is located, for heights also if the array has no rows.
pub(crate) fn features(profile: &Profile) -> Features {
    let bands = NAMES.iter().zip(BANDS_M.windows(2));
    bands.flat_map(|(names, ends)| names.iter().copied().zip(of_band(profile, [ends[0], ends[1]]))).collect()
}

fn of_band(profile: &Profile, [from_m, to_m]: [f64; 2]) -> [f64; 4] {
    let cells = || profile.located().filter(|cell| (from_m..to_m).contains(&cell.behind_m));
    let count = cells().count();
    if count == 0 {
        return [-1.0; 4];
    }
    let across = span(cells().map(|cell| cell.cross_m));
    if !profile.has_rows {
        return [-1.0, -1.0, -1.0, across];
    }
    let heights = || cells().map(|cell| cell.height_m);
    let mean = heights().sum::<f64>() / count as f64;
    [heights().fold(f64::NEG_INFINITY, f64::max), mean, heights().fold(f64::INFINITY, f64::min), across]
}
