//! Corners that are one point of the surface.

use glam::DVec3;
use std::collections::HashMap;

/// For every point the index of the first point within `tolerance_m` of it that represents its neighbourhood.
///
/// Meshes name a corner once per facet, and single precision or a converter has moved the names apart by a few ε. Points
/// of one chain of neighbours go to the nearest of its representatives in their order, so that the answer does not depend
/// on more than the order of the points.
pub(crate) fn weld(points_m: &[DVec3], tolerance_m: f64) -> Vec<u32> {
    let cell = |x: DVec3| (x / tolerance_m).floor().to_array().map(|c| c as i64);
    let mut found: HashMap<[i64; 3], u32> = HashMap::with_capacity(points_m.len() / 4);
    let mut representative = Vec::with_capacity(points_m.len());
    for (index, &point) in (0..).zip(points_m) {
        let near = representative_near(&found, points_m, point, cell(point), tolerance_m);
        representative.push(near.unwrap_or(index));
        if near.is_none() {
            found.insert(cell(point), index);
        }
    }
    representative
}

/// A cell is as wide as the tolerance and holds at most one representative.
fn representative_near(
    found: &HashMap<[i64; 3], u32>,
    points_m: &[DVec3],
    point_m: DVec3,
    [x, y, z]: [i64; 3],
    tolerance_m: f64,
) -> Option<u32> {
    if let Some(&own) = found.get(&[x, y, z]) {
        return Some(own);
    }
    let around = (0..27).map(|n| [n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1]);
    around
        .filter_map(|[i, j, k]| found.get(&[x.saturating_add(i), y.saturating_add(j), z.saturating_add(k)]).copied())
        .find(|&other| points_m[other as usize].distance_squared(point_m) <= tolerance_m * tolerance_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_nearer_than_the_tolerance_is_one_point_wherever_the_cells_lie() {
        for shift in 0..20 {
            let at = DVec3::splat(0.1 * f64::from(shift));
            let points = [at, at + DVec3::new(0.5, 0.5, 0.5), at + DVec3::X * 3.0, at + DVec3::new(3.3, 0.0, -0.6)];
            assert_eq!(weld(&points, 1.0), [0, 0, 2, 2], "{shift}");
            assert_eq!(weld(&points, 1e-3), [0, 1, 2, 3], "{shift}");
        }
    }
}
