//! Welding of a mesh's points: files repeat a vertex for every facet, material, normal and seam, and single
//! precision or a converter may have moved the copies apart by a few ε.

use glam::DVec3;
use std::collections::HashMap;

/// Condition under which two points are one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Welding {
    /// Bit-identical coordinates: facets then cover an area without any seam, which a beam cut at their
    /// common side relies on.
    Exact,
    /// Distance below this, m.
    Within(f64),
}

impl Welding {
    /// Welding within the separation caused by a file's single precision.
    pub(crate) fn of_rounded(points_m: &[DVec3]) -> Self {
        Self::Within(rounding_m(points_m))
    }

    /// First point at the place of each point.
    ///
    /// Points of one chain of neighbours are assigned to the first of them that is near enough and starts a
    /// place itself, so that the result depends only on the order of the points.
    pub(crate) fn places(self, points_m: &[DVec3]) -> Vec<u32> {
        match self {
            Self::Exact => same_bits(points_m),
            Self::Within(tolerance_m) => nearer_than(points_m, tolerance_m),
        }
    }
}

/// Distance below which points may be one, m: four ε of single precision, in which meshes are stored,
/// relative to their extent (10 µm for a bus, λ/400 at 77 GHz; a closed curve traversed once by a program
/// misses its start by a quarter of it), plus double-precision rounding.
pub(crate) fn rounding_m(points_m: &[DVec3]) -> f64 {
    let low = points_m.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points_m.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let extent_m = (high - low).max_element().max(0.0);
    let largest_m = low.abs().max(high.abs()).max_element();
    let sum_m = 4.0 * f64::from(f32::EPSILON) * extent_m + 256.0 * f64::EPSILON * largest_m;
    if sum_m.is_finite() && sum_m > 0.0 { sum_m } else { 1.0 }
}

fn same_bits(points_m: &[DVec3]) -> Vec<u32> {
    let mut firsts: HashMap<[u64; 3], u32> = HashMap::with_capacity(points_m.len() / 4);
    // Treats both zeros as one.
    let bits = |x_m: &DVec3| x_m.to_array().map(|c| (c + 0.0).to_bits());
    (0..).zip(points_m).map(|(index, point)| *firsts.entry(bits(point)).or_insert(index)).collect()
}

fn nearer_than(points_m: &[DVec3], tolerance_m: f64) -> Vec<u32> {
    let mut firsts =
        PlaceIndex { cell_m: CELL * tolerance_m, last: HashMap::new(), before: vec![NONE; points_m.len()] };
    let place = |(index, point): (u32, &DVec3)| {
        let found = firsts.near(*point, points_m, tolerance_m);
        found.unwrap_or_else(|| firsts.add(*point, index))
    };
    (0..).zip(points_m).map(place).collect()
}

/// Width of a cell in tolerances: most points lie so far inside their cell that no other one is searched.
const CELL: f64 = 16.0;
const NONE: u32 = u32::MAX;

/// First points of places, by cell; only looked up, never iterated.
struct PlaceIndex {
    cell_m: f64,
    last: HashMap<[i64; 3], u32>,
    /// Previous first point in the cell of each first point.
    before: Vec<u32>,
}

impl PlaceIndex {
    fn add(&mut self, point_m: DVec3, index: u32) -> u32 {
        self.before[index as usize] = self.last.insert(self.cell(point_m), index).unwrap_or(NONE);
        index
    }

    fn near(&self, point_m: DVec3, points_m: &[DVec3], tolerance_m: f64) -> Option<u32> {
        let [low, high] = [-tolerance_m, tolerance_m].map(|step_m| self.cell(point_m + step_m));
        let is_near = |first: &u32| points_m[*first as usize].distance(point_m) <= tolerance_m;
        cells_between(low, high).flat_map(|cell| self.of_cell(cell)).filter(is_near).min()
    }

    fn of_cell(&self, cell: [i64; 3]) -> impl Iterator<Item = u32> {
        let next = |first: &u32| Some(self.before[*first as usize]).filter(|before| *before != NONE);
        std::iter::successors(self.last.get(&cell).copied(), next)
    }

    fn cell(&self, x_m: DVec3) -> [i64; 3] {
        (x_m / self.cell_m).floor().to_array().map(|c| c as i64)
    }
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
        assert_eq!(Welding::of_rounded(&vertices).places(&vertices), [0, 1, 0, 0, 1, 5, 6]);
    }

    #[test]
    fn the_same_bits_are_one_place_and_the_next_number_is_another() {
        let x = |x: f64| DVec3::new(x, 0.0, -x);
        let vertices = [x(0.0), x(1.0), x(-0.0), x(1.0_f64.next_up()), x(1.0)];
        assert_eq!(Welding::Exact.places(&vertices), [0, 1, 0, 3, 1]);
    }

    #[test]
    fn what_is_nearer_than_the_tolerance_is_one_point_wherever_the_cells_lie() {
        for shift in 0..40 {
            let at = DVec3::splat(0.45 * f64::from(shift));
            let points =
                [at, at + DVec3::new(0.5, 0.5, 0.5), at + DVec3::X * 3.0, at + DVec3::new(3.3, 0.0, -0.6)];
            assert_eq!(Welding::Within(1.0).places(&points), [0, 0, 2, 2], "{shift}");
            assert_eq!(Welding::Within(1e-3).places(&points), [0, 1, 2, 3], "{shift}");
        }
    }
}
