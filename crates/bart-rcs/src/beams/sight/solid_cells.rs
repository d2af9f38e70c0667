//! Cells of a view that facets fill without a gap, so that nothing behind them is visible there: most of a
//! body's interior is rejected before clipping.
//!
//! Take facets as seen by the antenna, all oriented counter-clockwise, and any set of them that continues
//! beyond every side that may cross a cell: the facet across the side is in the set and runs along it in the
//! opposite sense. Then the sides' sum has no part in the cell, and the number of facets over a point is
//! constant over the cell. One facet that certainly contains the cell's centre makes it at least one: no ray
//! through the cell misses them all. Neighbours share corners to the last bit, so there is no seam. A set is
//! flood-filled from a facet at the centre; if it meets an open side, the next facet behind is tried.
//!
//! Whatever lies behind the set's farthest depth in every cell that it touches is dark. It hides nothing
//! either, since what is behind it is behind the set. The foremost set of a cell is itself never rejected
//! there, so everything rejected is hidden by remaining facets. Like the hierarchy it defines no outline: the
//! remaining facets are clipped as usual.

use crate::beams::sight::outline::{CellOutline, MARGIN, Reach};
use crate::beams::sight::prospect::{Extent, Prospect, Sight, across};
use crate::beams::sight::shadow::LitSide;
use crate::beams::sight::view::View;
use crate::mesh::mesh_edges::Winding;
use glam::DVec2;
use rayon::prelude::*;
use std::ops::Range;

/// Depth in each cell beyond which nothing is visible.
pub(crate) struct SolidCells {
    columns: usize,
    /// Depths row by row; infinite where the cell is not known to be filled.
    depth_m: Vec<f64>,
    gap_m: f64,
}

/// Number of cells per facet: for five vehicles of 14,000 to 79,000 triangles first orders were fastest with
/// a quarter to one: larger cells are filled less often, smaller ones are too many.
const CELLS_PER_FACET: f64 = 0.5;
/// Maximum number of cells examined per facet; beyond it cells are made larger.
const LOOKS_PER_FACET: usize = 64;
/// Number of facets at a cell's centre that are tried.
const LAYERS: usize = 8;
/// Maximum number of facets that fill a cell together.
const MOST_IN_A_CELL: usize = 64;
/// Number of bands of rows that are filled in parallel.
const BANDS: usize = 16;
/// Resolution of depths, in units of rounding: facets within rounding of each other are one surface, for
/// which [`crate::beams::sight::depth_order`] decides what is lit.
const GAP: f64 = 1e6;
/// Marker for no facet.
const NONE: u32 = u32::MAX;

/// Sights of a prospect that may be visible, in its order.
pub(crate) fn visible(prospect: &Prospect, view: &View) -> Vec<Sight> {
    let Some((origin, cell, size)) = cells_for(&prospect.sights) else { return prospect.sights.clone() };
    let outline = |sight: &Sight| CellOutline::of(sight, &prospect.outlook, view, origin, cell);
    let outlines: Vec<CellOutline> = prospect.sights.par_iter().map(outline).collect();
    let cells = SolidCells::among(&outlines, &Surfaces::of(prospect, view), size, gap_m(prospect, view));
    let seen = prospect.sights.par_iter().zip(&outlines).filter(|(_, outline)| !cells.hide(outline));
    seen.map(|(sight, _)| *sight).collect()
}

/// Origin of the cells, their size, and their columns and rows; `None` if rounding is not far below a cell.
fn cells_for(sights: &[Sight]) -> Option<(DVec2, f64, [usize; 2])> {
    let (low, high) = across(sights.iter().map(|sight| &sight.extent))?;
    let span = (high - low).max(DVec2::splat((high - low).max_element() * 1e-6));
    let mut cell = (span.x * span.y / (CELLS_PER_FACET * sights.len() as f64)).sqrt();
    let looks_at = |extent: &Extent, cell: f64| {
        let size = ((extent.high - extent.low) / cell).ceil() + 1.0;
        (size.x * size.y) as usize
    };
    let looks = |cell: f64| sights.iter().map(|sight| looks_at(&sight.extent, cell)).sum::<usize>();
    // Coordinates lose some roundings of the largest, plus the slack of their extents.
    let slack = sights.iter().map(|sight| sight.extent.slack).fold(0.0, f64::max);
    let lost = slack + 16.0 * f64::EPSILON * (1.0 + low.abs().max(high.abs()).max_element());
    if !(cell.is_finite() && 4.0 * lost < MARGIN * cell) {
        return None;
    }
    while looks(cell) > LOOKS_PER_FACET * sights.len() {
        cell *= 2.0;
    }
    Some((low, cell, (span / cell + MARGIN).to_array().map(|x| x as usize + 1)))
}

fn gap_m(prospect: &Prospect, view: &View) -> f64 {
    let far_m = prospect.sights.iter().map(|sight| sight.extent.far_m.abs()).fold(0.0, f64::max);
    GAP * view.tolerance_m().max(f64::EPSILON * far_m)
}

impl SolidCells {
    fn among(outlines: &[CellOutline], surfaces: &Surfaces, [columns, rows]: [usize; 2], gap_m: f64) -> Self {
        let height = rows.div_ceil(BANDS);
        let bands = (0..rows.div_ceil(height)).into_par_iter();
        let filled = bands.map(|band| {
            let rows = band * height..((band + 1) * height).min(rows);
            surfaces.depths_m(outlines, columns, rows)
        });
        Self { columns, depth_m: filled.collect::<Vec<_>>().concat(), gap_m }
    }

    /// Whether a facet lies behind the filling facets in all cells that it touches.
    fn hide(&self, outline: &CellOutline) -> bool {
        outline.rows().all(|row| {
            outline.columns(row, Reach::Touched, self.columns).all(|column| {
                let depth_m =
                    self.depth_m.get(row * self.columns + column).map_or(f64::INFINITY, |d| d + self.gap_m);
                depth_m < outline.near_m() || depth_m < outline.depths_m(column, row)[0]
            })
        })
    }
}

/// Neighbours of hiding facets beyond their sides.
struct Surfaces {
    /// Sights beyond each side of a sight, in the order of its corners, or [`NONE`]; `None` for a facet with
    /// transmission.
    beyond: Vec<Option<[u32; 3]>>,
}

impl Surfaces {
    fn of(prospect: &Prospect, view: &View) -> Self {
        let sights = &prospect.sights;
        let mut slot_of = vec![NONE; view.world.facets().len()];
        let hiding = (0..).zip(sights).filter(|(_, sight)| !view.world.is_passed(sight.facet));
        hiding.for_each(|(slot, sight)| slot_of[sight.facet as usize] = slot);
        let beyond_side = |sight: &Sight, side: usize| {
            let (other, winding) = view.world.across(sight.facet, side)?;
            let slot = Some(slot_of[other as usize]).filter(|slot| *slot != NONE)?;
            // Both oriented counter-clockwise, they traverse the side in opposite senses.
            let is_turned = sights[slot as usize].seen != sight.seen;
            (is_turned == (winding == Winding::Opposite)).then_some(slot)
        };
        let beyond = |sight: &Sight| {
            // Seen from the back the sides run in reverse, in reverse order.
            let order = if sight.seen == LitSide::Front { [0, 1, 2] } else { [2, 1, 0] };
            let hides = slot_of[sight.facet as usize] != NONE;
            hides.then(|| order.map(|side| beyond_side(sight, side).unwrap_or(NONE)))
        };
        Self { beyond: sights.par_iter().map(beyond).collect() }
    }

    /// Depths of [`SolidCells`] in a range of rows.
    fn depths_m(&self, outlines: &[CellOutline], columns: usize, rows: Range<usize>) -> Vec<f64> {
        let layers = self.layers(outlines, columns, &rows);
        let mut set = Vec::new();
        let mut depth_m = |(index, layers): (usize, &[(f64, u32); LAYERS])| {
            let cell = (index % columns, rows.start + index / columns);
            let seeds = layers.iter().map(|(_, seed)| *seed).take_while(|seed| *seed != NONE);
            seeds
                .into_iter()
                .find_map(|seed| self.filled_from(seed, cell, outlines, &mut set))
                .unwrap_or(f64::INFINITY)
        };
        layers.iter().enumerate().map(&mut depth_m).collect()
    }

    /// Facets at the centre of each cell, nearest first.
    fn layers(
        &self,
        outlines: &[CellOutline],
        columns: usize,
        rows: &Range<usize>,
    ) -> Vec<[(f64, u32); LAYERS]> {
        let mut layers = vec![[(f64::INFINITY, NONE); LAYERS]; columns * rows.len()];
        let hiding = (0..).zip(outlines).zip(&self.beyond).filter(|(_, beyond)| beyond.is_some());
        for ((slot, outline), _) in hiding {
            let (first, last) = outline.rows().into_inner();
            for row in first.max(rows.start)..(last + 1).min(rows.end) {
                for column in outline.columns(row, Reach::Centre, columns) {
                    let mut here = (outline.depths_m(column, row)[1], slot);
                    for layer in &mut layers[(row - rows.start) * columns + column] {
                        if here.0 < layer.0 {
                            std::mem::swap(&mut here, layer);
                        }
                    }
                }
            }
        }
        layers
    }

    /// Farthest depth of the facets that fill a cell, starting from one at its centre; `None` if they meet an
    /// open side in it.
    fn filled_from(
        &self,
        seed: u32,
        (column, row): (usize, usize),
        outlines: &[CellOutline],
        set: &mut Vec<u32>,
    ) -> Option<f64> {
        if !outlines[seed as usize].holds_centre(column, row) {
            return None;
        }
        set.clear();
        set.push(seed);
        let (mut done, mut far_m) = (0, f64::NEG_INFINITY);
        while let Some(&slot) = set.get(done) {
            let outline = &outlines[slot as usize];
            far_m = far_m.max(outline.depths_m(column, row)[1]);
            let beyond = self.beyond[slot as usize]?;
            let passing = (0..3).filter(|side| outline.passes(*side, column, row));
            for other in passing.map(|side| beyond[side]) {
                if other == NONE || set.len() > MOST_IN_A_CELL {
                    return None;
                }
                if !set.contains(&other) {
                    set.push(other);
                }
            }
            done += 1;
        }
        Some(far_m)
    }
}
