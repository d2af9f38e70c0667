//! Which vertices of a mesh are one place: files repeat a vertex for every material, normal and seam.

use glam::DVec3;
use std::collections::HashMap;

/// For each vertex the first one that is at its place.
///
/// Places closer than 2⁻²⁰ of the mesh's extent are one: a coordinate in single precision is rounded by 2⁻²⁵ of the
/// largest, and a closed curve that a program walks once around misses its start by a few of these.
pub(crate) fn welded(vertices_m: &[DVec3]) -> Vec<u32> {
    const TOLERANCE: f64 = 1.0 / (1 << 20) as f64;
    let low = vertices_m.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = vertices_m.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let tolerance_m = (TOLERANCE * (high - low).max_element()).max(f64::MIN_POSITIVE);
    // Cells so large that most vertices lie in the middle of one; looked up only, never walked through.
    let cell_m = 16.0 * tolerance_m;
    let cell = |x: DVec3| ((x - low) / cell_m).floor().to_array().map(|c| c as i64);
    let mut firsts: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let mut first_of = Vec::with_capacity(vertices_m.len());
    for (index, &vertex) in (0..).zip(vertices_m) {
        let cells = cells_between(cell(vertex - tolerance_m), cell(vertex + tolerance_m));
        let near = |&first: &u32| vertices_m[first as usize].distance(vertex) <= tolerance_m;
        let found = cells.filter_map(|c| firsts.get(&c)?.iter().copied().find(near)).min();
        if found.is_none() {
            firsts.entry(cell(vertex)).or_default().push(index);
        }
        first_of.push(found.unwrap_or(index));
    }
    first_of
}

fn cells_between(low: [i64; 3], high: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    let [x, y, z] = [0, 1, 2].map(|axis| low[axis]..=high[axis]);
    x.flat_map(move |i| {
        let z = z.clone();
        y.clone().flat_map(move |j| z.clone().map(move |k| [i, j, k]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_closer_than_rounding_are_one_and_others_are_not() {
        let x = |x: f64| DVec3::new(x, 0.0, 0.0);
        let vertices = [x(0.0), x(5.0), x(0.0), x(-2.4e-16), x(5.0 - 1e-6), x(2.0), x(2.0001)];
        assert_eq!(welded(&vertices), [0, 1, 0, 0, 1, 5, 6]);
    }
}
