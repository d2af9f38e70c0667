//! Facets sorted by where an antenna sees them: what may hide a polygon shares a cell of a grid across the view with it.
//!
//! A box across the view is as tight around a facet as the view can tell, a box in space is not: for the shadow on each
//! facet of a van of 55,000 the hierarchy proposes 86 others, the grid 40. Like the hierarchy it decides nothing.

use crate::beams::shadow::Shadow;
use crate::beams::view::View;
use crate::geometry::antenna::Antenna;
use glam::{DVec2, DVec3};
use std::ops::{ControlFlow, Range};

/// Shadows of a direct view by the cells that they reach.
pub(crate) struct ProjectionGrid {
    /// Boxes in units of the cells, in the order of the shadows.
    boxes: Vec<Extent>,
    columns: usize,
    /// Where each cell's entries begin, row by row, and where the last one's end.
    starts: Vec<u32>,
    /// By cell, the nearest first.
    entries: Vec<Entry>,
}

/// Where a facet appears: in units of the cells, and its depth in metres.
#[derive(Debug, Clone, Copy)]
struct Extent {
    low: DVec2,
    high: DVec2,
    near_m: f64,
    far_m: f64,
}

/// As much of a box as the search looks at, small: single precision, rounded outwards.
#[derive(Debug, Clone, Copy)]
struct Entry {
    slot: u32,
    first_cell: [u16; 2],
    low: [f32; 2],
    high: [f32; 2],
    near_m: f32,
}

/// A facet whose depths differ by more than this factor from another's, or that reaches behind the antenna, has no place on
/// one plane across the view: such a view has no grid.
const NEAREST_OF_FARTHEST: f64 = 1e-3;
/// Details crowd in few places of the view: with more cells than facets there, most cells are empty and few are crowded.
const CELLS_PER_FACET: f64 = 8.0;
/// Entries per facet that a grid may hold at most; else its cells are made larger.
const ENTRIES_PER_FACET: usize = 16;

impl ProjectionGrid {
    /// Of all shadows of a direct view; `None` where the antenna stands among the facets.
    pub(crate) fn over(shadows: &[Shadow], view: &View) -> Option<Self> {
        let boxes = projected(shadows, view)?;
        let across = boxes.iter().map(|b| (b.low, b.high)).reduce(|(a, b), (c, d)| (a.min(c), b.max(d)));
        let (low, high) = across?;
        let span = (high - low).max(DVec2::splat((high - low).max_element() * 1e-6));
        let mut cell = (span.x * span.y / (CELLS_PER_FACET * shadows.len() as f64)).sqrt();
        if !(cell.is_finite() && cell > 0.0) {
            return None;
        }
        loop {
            let scaled: Vec<Extent> = boxes.iter().map(|b| b.in_cells(low, cell)).collect();
            let [columns, rows] = ((span / cell).floor() + 1.0).to_array().map(|n| n as usize);
            let entries: usize = scaled.iter().map(Extent::cell_count).sum();
            if entries <= ENTRIES_PER_FACET * shadows.len() && columns.max(rows) <= usize::from(u16::MAX) {
                return Some(Self::filled(scaled, columns, rows));
            }
            cell *= 2.0;
        }
    }

    /// Calls `visit` with the slot of every shadow that may lie before the one in `slot`, until it breaks.
    pub(crate) fn visit_before(&self, slot: u32, mut visit: impl FnMut(u32) -> ControlFlow<()>) -> ControlFlow<()> {
        let extent = &self.boxes[slot as usize];
        let target = Entry::of(slot, extent);
        let far_m = (extent.far_m as f32).next_up();
        for (column, row) in extent.cells() {
            for entry in &self.entries[self.cell(column, row)] {
                if entry.near_m > far_m {
                    break;
                }
                // A pair meets in many cells; it counts in the first that both reach.
                let first = |axis: usize| usize::from(entry.first_cell[axis].max(target.first_cell[axis]));
                if entry.overlaps(&target) && column == first(0) && row == first(1) {
                    visit(entry.slot)?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    fn filled(boxes: Vec<Extent>, columns: usize, rows: usize) -> Self {
        let mut starts = vec![0_u32; columns * rows + 1];
        let cells = |b: Extent| b.cells().map(move |(column, row)| row * columns + column);
        boxes.iter().copied().flat_map(cells).for_each(|cell| starts[cell + 1] += 1);
        (0..columns * rows).for_each(|cell| starts[cell + 1] += starts[cell]);
        let mut by_depth: Vec<u32> = (0..boxes.len() as u32).collect();
        by_depth.sort_by(|&a, &b| boxes[a as usize].near_m.total_cmp(&boxes[b as usize].near_m));
        let nothing = Entry { slot: 0, first_cell: [0; 2], low: [0.0; 2], high: [0.0; 2], near_m: 0.0 };
        let mut entries = vec![nothing; starts[columns * rows] as usize];
        let mut next = starts.clone();
        for slot in by_depth {
            let extent = boxes[slot as usize];
            for cell in cells(extent) {
                entries[next[cell] as usize] = Entry::of(slot, &extent);
                next[cell] += 1;
            }
        }
        Self { boxes, columns, starts, entries }
    }

    fn cell(&self, column: usize, row: usize) -> Range<usize> {
        let cell = row * self.columns + column;
        self.starts[cell] as usize..self.starts[cell + 1] as usize
    }
}

impl Extent {
    fn in_cells(&self, origin: DVec2, cell: f64) -> Self {
        Self { low: (self.low - origin) / cell, high: (self.high - origin) / cell, ..*self }
    }

    fn first_cell(&self) -> [usize; 2] {
        self.low.to_array().map(|x| x as usize)
    }

    fn cells(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let ([column, row], [last_column, last_row]) = (self.first_cell(), self.high.to_array().map(|x| x as usize));
        (row..=last_row).flat_map(move |row| (column..=last_column).map(move |column| (column, row)))
    }

    fn cell_count(&self) -> usize {
        let ([column, row], [last_column, last_row]) = (self.first_cell(), self.high.to_array().map(|x| x as usize));
        (last_column - column + 1).saturating_mul(last_row - row + 1)
    }
}

impl Entry {
    fn of(slot: u32, extent: &Extent) -> Self {
        Self {
            slot,
            first_cell: extent.first_cell().map(|n| n as u16),
            low: extent.low.to_array().map(|x| (x as f32).next_down()),
            high: extent.high.to_array().map(|x| (x as f32).next_up()),
            near_m: (extent.near_m as f32).next_down(),
        }
    }

    fn overlaps(&self, other: &Self) -> bool {
        self.low[0] <= other.high[0]
            && other.low[0] <= self.high[0]
            && self.low[1] <= other.high[1]
            && other.low[1] <= self.high[1]
    }
}

/// Tangents of the angles to the middle of the view, or metres across a direction.
fn projected(shadows: &[Shadow], view: &View) -> Option<Vec<Extent>> {
    let corners = |shadow: &Shadow| view.world.facet(shadow.facet).corners_m;
    let all = shadows
        .iter()
        .flat_map(corners)
        .fold(None, |range: Option<[DVec3; 2]>, c| Some(range.map_or([c, c], |[low, high]| [low.min(c), high.max(c)])));
    let [low, high] = all?;
    let forward = -view.antenna.towards(0.5 * low + 0.5 * high).try_normalize()?;
    let right = forward.any_orthonormal_vector();
    let up = forward.cross(right);
    let place = |x: DVec3| match view.antenna {
        Antenna::Point(p) => {
            let way = x - p;
            let depth_m = way.dot(forward);
            (DVec2::new(way.dot(right), way.dot(up)) / depth_m, depth_m)
        }
        Antenna::Direction(_) => (DVec2::new(x.dot(right), x.dot(up)), x.dot(forward)),
    };
    let boxes: Vec<Extent> = shadows.iter().map(|shadow| Extent::around(corners(shadow).map(place), view)).collect();
    let (near_m, far_m) = boxes.iter().fold((f64::INFINITY, 0.0), |(n, f), b| (b.near_m.min(n), b.far_m.max(f)));
    let is_apart = match view.antenna {
        Antenna::Point(_) => near_m > NEAREST_OF_FARTHEST * far_m,
        Antenna::Direction(_) => true,
    };
    (is_apart && boxes.iter().all(|b| b.low.is_finite() && b.high.is_finite())).then_some(boxes)
}

impl Extent {
    /// Widened by what is rounding.
    fn around(corners: [(DVec2, f64); 3], view: &View) -> Self {
        let [(a, da), (b, db), (c, dc)] = corners;
        let (near_m, far_m) = (da.min(db).min(dc), da.max(db).max(dc));
        let slack_m = 4.0 * view.tolerance_m();
        let slack = match view.antenna {
            Antenna::Point(_) => DVec2::splat(slack_m / near_m.max(f64::MIN_POSITIVE)),
            Antenna::Direction(_) => DVec2::splat(slack_m),
        };
        let (low, high) = (a.min(b).min(c) - slack, a.max(b).max(c) + slack);
        Self { low, high, near_m: near_m - slack_m, far_m: far_m + slack_m }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::world::World;
    use artifact::scene::Mesh;
    use artifact::settings::Sides;

    /// Triangles of any size about the origin, from the fractions of multiples of irrational numbers.
    fn strewn(count: usize) -> World {
        let at = |i: usize, step: f64| ((i as f64 + 1.0) * step).fract() - 0.5;
        let corner = |i: usize| {
            let size = 10.0_f64.powf(2.0 * at(i / 3, 0.259_921) - 1.0);
            let middle = [0.618_034, 0.414_214, 0.732_051].map(|step| 2.0 * at(i / 3, step));
            [0, 1, 2].map(|k| middle[k] + size * at(i, [0.236_068, 0.645_751, 0.316_625][k]))
        };
        let triangles = (0..count as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        let vertices_m = (0..3 * count).map(corner).collect();
        World::of_mesh(&Mesh { vertices_m, triangles, ..Mesh::default() }).unwrap()
    }

    #[test]
    fn every_facet_that_shares_a_ray_with_a_farther_one_is_proposed_once() {
        let world = strewn(300);
        for antenna in [Antenna::Point(DVec3::new(6.0, 2.0, 3.0)), Antenna::Direction(DVec3::new(0.36, 0.48, 0.8))] {
            let view = View::direct(&world, Sides::Two, antenna);
            let shadows: Vec<Shadow> = (0..300).filter_map(|facet| Shadow::of(facet, &view)).collect();
            let grid = ProjectionGrid::over(&shadows, &view).unwrap();
            let mut met = 0;
            for (slot, target) in (0..).zip(&shadows) {
                let mut proposed = Vec::new();
                let _ = grid.visit_before(slot, |other| {
                    proposed.push(other);
                    ControlFlow::Continue(())
                });
                let [a, b, c] = world.facet(target.facet).corners_m;
                let points = [(a + b + c) / 3.0, 0.5 * (a + b), 0.9 * c + 0.1 * a];
                for (other, shadow) in (0..).zip(&shadows).filter(|(other, _)| *other != slot) {
                    let hides = |x: &DVec3| shadow.edges.iter().chain([&-shadow.front]).all(|p| p.distance_m(*x) > 0.0);
                    let times = proposed.iter().filter(|&&p| p == other).count();
                    assert!(times <= 1, "facet {other} twice for {slot}");
                    assert!(times == 1 || !points.iter().any(hides), "facet {other} is missing for {slot}");
                    met += times;
                }
            }
            println!("{met} pairs proposed of {}", shadows.len() * (shadows.len() - 1));
            assert!(met < shadows.len() * shadows.len() / 2, "the grid leaves out most");
        }
    }

    #[test]
    fn an_antenna_among_the_facets_has_no_grid() {
        let world = strewn(50);
        let view = View::direct(&world, Sides::Two, Antenna::Point(DVec3::splat(0.1)));
        let shadows: Vec<Shadow> = (0..50).filter_map(|facet| Shadow::of(facet, &view)).collect();
        assert!(ProjectionGrid::over(&shadows, &view).is_none() && ProjectionGrid::over(&[], &view).is_none());
    }
}
