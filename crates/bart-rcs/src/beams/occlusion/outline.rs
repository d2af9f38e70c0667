//! Outline of a facet on the cells of a view: the cells that it touches, the centres that it contains, the
//! cells crossed by its sides, and its depth there.
//!
//! Every answer errs on the safe side by [`MARGIN`].

use crate::beams::occlusion::projection::{ProjectedExtent, ProjectedFacet, ViewCoordinates};
use crate::beams::occlusion::view::View;
use crate::geometry::antenna::Antenna;
use glam::DVec2;
use std::ops::{Range, RangeInclusive};

/// Margin of every answer, in cells: smaller distances are not distinguished, and rounding must be well below
/// it.
pub(crate) const MARGIN: f64 = 1e-6;

/// A facet in units of cells.
pub(crate) struct CellOutline {
    low: DVec2,
    high: DVec2,
    corners: [DVec2; 3],
    /// Half-planes inside the sides, from each corner to the next.
    sides: [HalfPlane; 3],
    near_m: f64,
    far_m: f64,
    /// Depth over the plane of the facet, if it is larger than a cell.
    depth: Option<DepthPlane>,
}

/// Half-plane normal · x ≥ offset; the normal is unit, or zero if the facet is too thin to decide.
#[derive(Clone, Copy)]
struct HalfPlane {
    normal: DVec2,
    offset: f64,
}

/// Criterion by which cells of a row count as reached.
#[derive(Clone, Copy)]
pub(crate) enum CellTest {
    /// Cells whose square may be partly inside.
    Touched,
    /// Cells whose centre may be inside.
    Centre,
}

impl CellOutline {
    /// Outline of a facet in cells of this size from an origin.
    pub(crate) fn of(
        facet: &ProjectedFacet,
        coordinates: &ViewCoordinates,
        view: &View,
        origin: DVec2,
        cell: f64,
    ) -> Self {
        let ProjectedExtent { corners, low, high, near_m, far_m, .. } = facet.extent.in_cells(origin, cell);
        let [a, b, c] = corners;
        let sides = [HalfPlane::along(a, b, c), HalfPlane::along(b, c, a), HalfPlane::along(c, a, b)];
        let is_large = (high - low).max_element() > 1.0;
        let depth = if is_large { DepthPlane::of(facet, coordinates, view, origin, cell) } else { None };
        Self { low, high, corners, sides, near_m, far_m, depth }
    }

    pub(crate) fn near_m(&self) -> f64 {
        self.near_m
    }

    /// Minimum and maximum depth in a cell, m.
    pub(crate) fn depths_m(&self, column: usize, row: usize) -> [f64; 2] {
        let in_cell = self.depth.and_then(|depth| depth.range_m(column as f64, row as f64));
        in_cell.map_or([self.near_m, self.far_m], |[near, far]| [near.max(self.near_m), far.min(self.far_m)])
    }

    /// Rows that the outline may reach.
    pub(crate) fn rows(&self) -> RangeInclusive<usize> {
        (self.low.y - MARGIN).max(0.0) as usize..=(self.high.y + MARGIN).max(0.0) as usize
    }

    /// Cells among the `count` of a row that the outline reaches, possibly including others.
    pub(crate) fn columns(&self, row: usize, reach: CellTest, count: usize) -> Range<usize> {
        let (half, least) = match reach {
            CellTest::Touched => (0.5, -MARGIN),
            CellTest::Centre => (0.0, MARGIN),
        };
        let (mut low, mut high) = (self.low.x - MARGIN - 0.5 - half, self.high.x + MARGIN - 0.5 + half);
        for HalfPlane { normal, offset } in self.sides {
            // normal.x·(column + ½) ≥ bound; the rounding for steep sides is less than the margin along the
            // normal.
            let bound =
                offset + least - normal.y * (row as f64 + 0.5) - half * (normal.x.abs() + normal.y.abs());
            if normal.x > 0.0 {
                low = low.max(bound / normal.x - 0.5);
            } else if normal.x < 0.0 {
                high = high.min(bound / normal.x - 0.5);
            } else if bound > 0.0 {
                return 0..0;
            }
        }
        let (first, end) = (low.ceil().max(0.0), (high.floor() + 1.0).clamp(0.0, count as f64));
        if first < end { first as usize..end as usize } else { 0..0 }
    }

    /// Whether the centre of a cell is certainly inside.
    pub(crate) fn holds_centre(&self, column: usize, row: usize) -> bool {
        let centre = centre(column, row);
        self.sides.iter().all(|side| side.normal.dot(centre) - side.offset > MARGIN)
    }

    /// Whether the side from corner `side` to the next may pass through a cell.
    pub(crate) fn passes(&self, side: usize, column: usize, row: usize) -> bool {
        let centre = centre(column, row);
        let HalfPlane { normal, offset } = self.sides[side];
        let (from, to) = (self.corners[side], self.corners[(side + 1) % 3]);
        (normal.dot(centre) - offset).abs() <= 0.5 * (normal.x.abs() + normal.y.abs()) + MARGIN
            && (from.min(to) - MARGIN).cmple(centre + 0.5).all()
            && (from.max(to) + MARGIN).cmpge(centre - 0.5).all()
    }
}

fn centre(column: usize, row: usize) -> DVec2 {
    DVec2::new(column as f64 + 0.5, row as f64 + 0.5)
}

impl HalfPlane {
    fn along(from: DVec2, to: DVec2, opposite: DVec2) -> Self {
        let edge = to - from;
        let normal = DVec2::new(-edge.y, edge.x).normalize_or_zero();
        let height = normal.dot(opposite - from);
        let inwards = if height.abs() > MARGIN { normal * height.signum() } else { DVec2::ZERO };
        Self { normal: inwards, offset: inwards.dot(from) }
    }
}

/// Depth over a facet's plane, a quotient of linear functions of column and row: n·(a − p)/n·d from a point p
/// along d, n·(a − x)/n·r̂ for a direction r̂ and x across it.
#[derive(Clone, Copy)]
struct DepthPlane {
    /// Numerator at the origin, and its increase per column and row.
    numerator_m: [f64; 3],
    denominator: [f64; 3],
}

/// Minimum ratio of area to squared length for a facet's plane to be used: facets longer than a thousand of
/// their heights, or this near to edge-on, are excluded. For the others rounding is less than a millionth of
/// the gap of [`crate::beams::occlusion::solid_cells::SolidCells`].
const LEAST_AREA_OF_SQUARE: f64 = 5e-4;
const LEAST_COSINE: f64 = 1e-2;

impl DepthPlane {
    fn of(
        facet: &ProjectedFacet,
        coordinates: &ViewCoordinates,
        view: &View,
        origin: DVec2,
        cell: f64,
    ) -> Option<Self> {
        let facet = view.world.facet(facet.facet);
        let [a, b, c] = facet.corners_m;
        let longest_m2 = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
        if facet.area_m2 < LEAST_AREA_OF_SQUARE * longest_m2 {
            return None;
        }
        let n = facet.plane.normal;
        let [forward, right, up] =
            [coordinates.forward, coordinates.right, coordinates.up].map(|axis| n.dot(axis));
        let across = [right * origin.x + up * origin.y, right * cell, up * cell];
        Some(match coordinates.antenna {
            Antenna::Point(p) => Self {
                numerator_m: [n.dot(a - p), 0.0, 0.0],
                denominator: [forward + across[0], across[1], across[2]],
            },
            Antenna::Direction(_) => Self {
                numerator_m: [n.dot(a) - across[0], -across[1], -across[2]],
                denominator: [forward, 0.0, 0.0],
            },
        })
    }

    /// Minimum and maximum depth over a cell; both functions are monotonic along lines, so the extremes are
    /// at its corners.
    fn range_m(&self, column: f64, row: f64) -> Option<[f64; 2]> {
        let at = |[start, by_column, by_row]: [f64; 3], [x, y]: [f64; 2]| start + by_column * x + by_row * y;
        let steps = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        let corners = steps.map(|[x, y]| [column + x, row + y]);
        let denominators = corners.map(|corner| at(self.denominator, corner));
        let sign = denominators[0].signum();
        let is_sound = denominators.iter().all(|d| sign * d > LEAST_COSINE);
        let depths_m = [0, 1, 2, 3].map(|i| at(self.numerator_m, corners[i]) / denominators[i]);
        let range = |[low, high]: [f64; 2], d: &f64| [low.min(*d), high.max(*d)];
        is_sound.then(|| depths_m.iter().fold([f64::INFINITY, f64::NEG_INFINITY], range))
    }
}
