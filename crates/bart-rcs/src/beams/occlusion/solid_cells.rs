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

use crate::beams::occlusion::outline::{CellOutline, CellTest, MARGIN};
use crate::beams::occlusion::projection::{ProjectedExtent, ProjectedFacet, ProjectedView, across};
use crate::beams::occlusion::shadow::LitSide;
use crate::beams::occlusion::view::View;
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
/// which [`crate::beams::occlusion::depth_order`] decides what is lit.
const GAP: f64 = 1e6;
/// Marker for no facet.
const NONE: u32 = u32::MAX;

/// Facets of a projected view that may be visible, in its order.
pub(crate) fn visible(projected: &ProjectedView, view: &View) -> Vec<ProjectedFacet> {
    let Some((origin, cell, size)) = cells_for(&projected.facets) else { return projected.facets.clone() };
    let outline = |facet: &ProjectedFacet| CellOutline::of(facet, &projected.coordinates, view, origin, cell);
    let outlines: Vec<CellOutline> = projected.facets.par_iter().map(outline).collect();
    let cells =
        SolidCells::among(&outlines, &FacetNeighbours::of(projected, view), size, gap_m(projected, view));
    let seen = projected.facets.par_iter().zip(&outlines).filter(|(_, outline)| !cells.hide(outline));
    seen.map(|(facet, _)| *facet).collect()
}

/// Origin of the cells, their size, and their columns and rows; `None` if rounding is not far below a cell.
fn cells_for(facets: &[ProjectedFacet]) -> Option<(DVec2, f64, [usize; 2])> {
    let (low, high) = across(facets.iter().map(|facet| &facet.extent))?;
    let span = (high - low).max(DVec2::splat((high - low).max_element() * 1e-6));
    let mut cell = (span.x * span.y / (CELLS_PER_FACET * facets.len() as f64)).sqrt();
    let looks_at = |extent: &ProjectedExtent, cell: f64| {
        let size = ((extent.high - extent.low) / cell).ceil() + 1.0;
        (size.x * size.y) as usize
    };
    let looks = |cell: f64| facets.iter().map(|facet| looks_at(&facet.extent, cell)).sum::<usize>();
    // Coordinates lose some roundings of the largest, plus the slack of their extents.
    let slack = facets.iter().map(|facet| facet.extent.slack).fold(0.0, f64::max);
    let lost = slack + 16.0 * f64::EPSILON * (1.0 + low.abs().max(high.abs()).max_element());
    if !(cell.is_finite() && 4.0 * lost < MARGIN * cell) {
        return None;
    }
    while looks(cell) > LOOKS_PER_FACET * facets.len() {
        cell *= 2.0;
    }
    Some((low, cell, (span / cell + MARGIN).to_array().map(|x| x as usize + 1)))
}

fn gap_m(projected: &ProjectedView, view: &View) -> f64 {
    let far_m = projected.facets.iter().map(|facet| facet.extent.far_m.abs()).fold(0.0, f64::max);
    GAP * view.tolerance_m().max(f64::EPSILON * far_m)
}

impl SolidCells {
    fn among(
        outlines: &[CellOutline],
        surfaces: &FacetNeighbours,
        [columns, rows]: [usize; 2],
        gap_m: f64,
    ) -> Self {
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
            outline.columns(row, CellTest::Touched, self.columns).all(|column| {
                let depth_m =
                    self.depth_m.get(row * self.columns + column).map_or(f64::INFINITY, |d| d + self.gap_m);
                depth_m < outline.near_m() || depth_m < outline.depths_m(column, row)[0]
            })
        })
    }
}

/// Neighbours of hiding facets beyond their sides.
struct FacetNeighbours {
    /// Facets beyond each side of a facet, in the order of its corners, or [`NONE`]; `None` for a facet with
    /// transmission.
    beyond: Vec<Option<[u32; 3]>>,
}

impl FacetNeighbours {
    fn of(projected: &ProjectedView, view: &View) -> Self {
        let facets = &projected.facets;
        let mut slot_of = vec![NONE; view.world.facets().len()];
        let hiding = (0..).zip(facets).filter(|(_, facet)| !view.world.is_transparent(facet.facet));
        hiding.for_each(|(slot, facet)| slot_of[facet.facet as usize] = slot);
        let beyond_side = |facet: &ProjectedFacet, side: usize| {
            let (other, winding) = view.world.across(facet.facet, side)?;
            let slot = Some(slot_of[other as usize]).filter(|slot| *slot != NONE)?;
            // Both oriented counter-clockwise, they traverse the side in opposite senses.
            let is_turned = facets[slot as usize].seen != facet.seen;
            (is_turned == (winding == Winding::Opposite)).then_some(slot)
        };
        let beyond = |facet: &ProjectedFacet| {
            // Seen from the back the sides run in reverse, in reverse order.
            let order = if facet.seen == LitSide::Front { [0, 1, 2] } else { [2, 1, 0] };
            let hides = slot_of[facet.facet as usize] != NONE;
            hides.then(|| order.map(|side| beyond_side(facet, side).unwrap_or(NONE)))
        };
        Self { beyond: facets.par_iter().map(beyond).collect() }
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
                for column in outline.columns(row, CellTest::Centre, columns) {
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
