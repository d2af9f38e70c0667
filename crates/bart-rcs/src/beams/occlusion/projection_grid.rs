//! Facets sorted by their projection as seen by an antenna: a facet that may hide a polygon shares a cell of
//! a grid across the view with it.
//!
//! A box across the view bounds a facet as tightly as the view can resolve, unlike a box in space. Cell sizes
//! double from level to level; a facet is listed at the level whose cells are just larger than it, so in at
//! most four cells: small parts crowd in few places of the view, and panels that span hundreds of them are
//! listed once. Like the hierarchy the grid only proposes candidates.

use crate::beams::occlusion::projected_triangle::ProjectedTriangle;
use crate::beams::occlusion::projection::{ProjectedExtent, ViewCoordinates, across};
use crate::beams::occlusion::shadow::Shadow;
use crate::beams::occlusion::view::View;
use glam::{DVec2, Vec4};
use rayon::prelude::*;
use std::ops::ControlFlow;

/// Shadows of a view, listed by the cells that they reach.
pub(crate) struct ProjectionGrid {
    /// Boxes in units of the finest cells, in the order of the shadows.
    boxes: Vec<ProjectedExtent>,
    /// Triangles in the same units and order.
    triangles: Vec<ProjectedTriangle>,
    /// Levels of cells, the finest first.
    levels: Vec<GridLevel>,
    /// Start of each cell's entries, level by level and row by row, and the end of the last.
    starts: Vec<u32>,
    /// Entries by cell, nearest first.
    entries: Vec<Entry>,
}

/// Cells of one size.
#[derive(Debug, Clone, Copy)]
struct GridLevel {
    /// Number of this level's cells per finest cell.
    scale: f64,
    columns: usize,
    /// Index of the level's first cell among all levels.
    first: usize,
}

/// The part of a box used by the search, made small: single precision, rounded outwards.
#[derive(Debug, Clone, Copy)]
struct Entry {
    /// Bounds of its extent, arranged so that one instruction compares two boxes.
    bounds: Vec4,
    slot: u32,
    first_cell: [u16; 2],
    near_m: f32,
}

/// Columns and rows of cells, both ends included.
#[derive(Debug, Clone, Copy)]
struct Cells {
    first: [usize; 2],
    last: [usize; 2],
}

/// Number of cells per facet: small parts crowd in few places of the view, so that with more cells most are
/// empty and few are crowded.
const CELLS_PER_FACET: f64 = 8.0;
/// Minimum number of facets per thread.
const FEW: usize = 1024;
/// Maximum number of finest cells examined per facet; beyond it cells are made larger.
const LOOKS_PER_FACET: usize = 64;

impl ProjectionGrid {
    /// Grid of all shadows of a view; `None` if the antenna stands among the facets.
    pub(crate) fn over(shadows: &[Shadow], view: &View) -> Option<Self> {
        let corners = shadows.iter().flat_map(|shadow| view.world.facet(shadow.facet).corners_m);
        let around = corners.map(|c| [c, c]).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])?;
        let coordinates = ViewCoordinates::onto(around, view.antenna)?;
        let extent = |shadow: &Shadow| coordinates.project(shadow.facet, shadow.seen, view).extent;
        let boxes: Vec<ProjectedExtent> = shadows.iter().map(extent).collect();
        if coordinates.holds(boxes.iter()) { Self::of(&boxes) } else { None }
    }

    /// Grid of shadows with these boxes, in their order.
    pub(crate) fn of(boxes: &[ProjectedExtent]) -> Option<Self> {
        let (low, high) = across(boxes.iter())?;
        let span = (high - low).max(DVec2::splat((high - low).max_element() * 1e-6));
        let mut cell = (span.x * span.y / (CELLS_PER_FACET * boxes.len() as f64)).sqrt();
        if !(cell.is_finite() && cell > 0.0) {
            return None;
        }
        loop {
            let scaled: Vec<ProjectedExtent> =
                boxes.par_iter().with_min_len(FEW).map(|b| b.in_cells(low, cell)).collect();
            let looks: usize = scaled.iter().map(|b| Cells::of(b, 1.0).count()).sum();
            let size = span / cell;
            if looks <= LOOKS_PER_FACET * boxes.len() && size.max_element() < f64::from(u16::MAX) {
                return Some(Self::filled(scaled, size));
            }
            cell *= 2.0;
        }
    }

    /// Calls `visit` with the slot of every shadow that may lie in front of the one in `slot`, until it
    /// breaks.
    pub(crate) fn visit_before(
        &self,
        slot: u32,
        mut visit: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let extent = &self.boxes[slot as usize];
        let triangle = &self.triangles[slot as usize];
        let most = extent.most();
        // Largest first: one of them may hide everything.
        for level in self.levels.iter().rev() {
            let cells = Cells::of(extent, level.scale);
            for (column, row) in cells.all() {
                for entry in self.before(level.cell(column, row), extent) {
                    // A pair meets in many cells; it counts in the first cell that both reach.
                    let first = |axis: usize| usize::from(entry.first_cell[axis]).max(cells.first[axis]);
                    if entry.bounds.cmple(most).all()
                        && column == first(0)
                        && row == first(1)
                        && !triangle.is_apart_from(&self.triangles[entry.slot as usize])
                    {
                        visit(entry.slot)?;
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Entries of a cell that start nearer than a box ends.
    fn before(&self, cell: usize, extent: &ProjectedExtent) -> impl Iterator<Item = &Entry> {
        let far_m = (extent.far_m as f32).next_up();
        let entries = &self.entries[self.starts[cell] as usize..self.starts[cell + 1] as usize];
        entries.iter().take_while(move |entry| entry.near_m <= far_m)
    }

    fn filled(boxes: Vec<ProjectedExtent>, size: DVec2) -> Self {
        let levels = levels(size);
        let count = levels.last().map_or(0, |last| last.first + last.cells_in(size));
        let own: Vec<(&GridLevel, Cells)> = boxes.iter().map(|b| b.listed(&levels)).collect();
        let mut starts = vec![0_u32; count + 1];
        let cells = |slot: usize| {
            own[slot].1.all().map({
                let level = own[slot].0;
                move |(column, row)| level.cell(column, row)
            })
        };
        (0..boxes.len()).flat_map(cells).for_each(|cell| starts[cell + 1] += 1);
        (0..count).for_each(|cell| starts[cell + 1] += starts[cell]);
        let mut by_depth: Vec<u32> = (0..boxes.len() as u32).collect();
        by_depth.sort_by(|&a, &b| boxes[a as usize].near_m.total_cmp(&boxes[b as usize].near_m));
        let nothing = Entry { bounds: Vec4::ZERO, slot: 0, first_cell: [0; 2], near_m: 0.0 };
        let mut entries = vec![nothing; starts[count] as usize];
        let mut next = starts.clone();
        for slot in by_depth {
            let entry = Entry::of(slot, &boxes[slot as usize], &own[slot as usize].1);
            for cell in cells(slot as usize) {
                entries[next[cell] as usize] = entry;
                next[cell] += 1;
            }
        }
        let triangle =
            |b: &ProjectedExtent| ProjectedTriangle::new(b.corners, size.max_element() + 1.0, b.slack);
        let triangles = boxes.par_iter().with_min_len(FEW).map(triangle).collect();
        Self { boxes, triangles, levels, starts, entries }
    }
}

/// Levels of cells from the finest to one that contains the view.
fn levels(size: DVec2) -> Vec<GridLevel> {
    let mut levels = Vec::new();
    let (mut scale, mut first) = (1.0, 0);
    loop {
        let level = GridLevel { scale, columns: (size.x * scale) as usize + 1, first };
        levels.push(level);
        if (size.max_element() * scale) < 1.0 {
            return levels;
        }
        first += level.cells_in(size);
        scale *= 0.5;
    }
}

impl GridLevel {
    fn cell(&self, column: usize, row: usize) -> usize {
        self.first + row * self.columns + column
    }

    fn cells_in(&self, size: DVec2) -> usize {
        self.columns * ((size.y * self.scale) as usize + 1)
    }
}

impl Cells {
    fn of(extent: &ProjectedExtent, scale: f64) -> Self {
        let at = |x: DVec2| (x * scale).to_array().map(|x| x as usize);
        Self { first: at(extent.low), last: at(extent.high) }
    }

    fn all(self) -> impl Iterator<Item = (usize, usize)> {
        let ([column, row], [last_column, last_row]) = (self.first, self.last);
        (row..=last_row).flat_map(move |row| (column..=last_column).map(move |column| (column, row)))
    }

    fn count(&self) -> usize {
        (self.last[0] - self.first[0] + 1).saturating_mul(self.last[1] - self.first[1] + 1)
    }
}

impl ProjectedExtent {
    /// Low x, low y, −high x, −high y, rounded outwards.
    fn bounds(&self) -> Vec4 {
        let ([low_x, low_y], [high_x, high_y]) = (self.low.to_array(), self.high.to_array());
        Vec4::from_array([low_x, low_y, -high_x, -high_y].map(|x| (x as f32).next_down()))
    }

    /// Upper limits on the bounds of a box that overlaps this one: high x, high y, −low x, −low y.
    fn most(&self) -> Vec4 {
        let bounds = self.bounds();
        -Vec4::new(bounds.z, bounds.w, bounds.x, bounds.y)
    }

    /// Level and cells in which a box is listed: the finest cells that are not smaller than it.
    fn listed<'l>(&self, levels: &'l [GridLevel]) -> (&'l GridLevel, Cells) {
        let longest = (self.high - self.low).max_element();
        let index = levels.partition_point(|level| longest * level.scale > 1.0).min(levels.len() - 1);
        (&levels[index], Cells::of(self, levels[index].scale))
    }
}

impl Entry {
    fn of(slot: u32, extent: &ProjectedExtent, cells: &Cells) -> Self {
        Self {
            bounds: extent.bounds(),
            slot,
            first_cell: cells.first.map(|n| n as u16),
            near_m: (extent.near_m as f32).next_down(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::world::World;
    use crate::geometry::antenna::Antenna;
    use artifact::scene::Mesh;
    use artifact::settings::Sides;
    use glam::DVec3;

    /// Triangles of any size around the origin, from the fractional parts of multiples of irrational numbers.
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
        for antenna in
            [Antenna::Point(DVec3::new(6.0, 2.0, 3.0)), Antenna::Direction(DVec3::new(0.36, 0.48, 0.8))]
        {
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
                    let hides = |x: &DVec3| {
                        shadow.edges.iter().chain([&-shadow.front]).all(|p| p.distance_m(*x) > 0.0)
                    };
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
        assert!(
            ProjectionGrid::over(&shadows, &view).is_none() && ProjectionGrid::over(&[], &view).is_none()
        );
    }
}
