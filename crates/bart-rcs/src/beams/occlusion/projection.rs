//! Projection of facets across a view: their positions on a plane across it, and their depths.

use crate::beams::occlusion::shadow::{LitSide, seen_side};
use crate::beams::occlusion::view::View;
use crate::geometry::antenna::Antenna;
use crate::geometry::facet_geometry::FacetGeometry;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Facets of a view that show a side, projected onto one plane across it.
pub(crate) struct ProjectedView {
    pub(crate) coordinates: ViewCoordinates,
    /// Projected facets, by facet.
    pub(crate) facets: Vec<ProjectedFacet>,
}

/// A facet as seen in the view.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProjectedFacet {
    /// Index into the world's facets.
    pub(crate) facet: u32,
    pub(crate) seen: LitSide,
    pub(crate) extent: ProjectedExtent,
}

/// Coordinates across a view: tangents of the angles from its centre, or metres across a direction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ViewCoordinates {
    pub(crate) antenna: Antenna,
    pub(crate) forward: DVec3,
    pub(crate) right: DVec3,
    pub(crate) up: DVec3,
}

/// Projected position of a facet, and its depth in metres.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProjectedExtent {
    /// Corners in the winding seen by the antenna.
    pub(crate) corners: [DVec2; 3],
    /// Maximum error of the corners' coordinates.
    pub(crate) slack: f64,
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
    pub(crate) near_m: f64,
    pub(crate) far_m: f64,
}

/// Minimum ratio of the nearest to the farthest depth: with a facet beyond it, or one that extends behind the
/// antenna, facets have no position on one plane across the view, and the view has no grid.
const NEAREST_OF_FARTHEST: f64 = 1e-3;

impl ProjectedView {
    /// Projection of all facets of a direct view; `None` if the antenna stands among them.
    pub(crate) fn of_all(view: &View) -> Option<Self> {
        let seen = |(index, facet): (usize, &FacetGeometry)| {
            let (seen, _) = seen_side(facet, view.antenna, view.tolerance_m())?;
            Some((index as u32, seen))
        };
        let seen: Vec<(u32, LitSide)> = view.world.facets().par_iter().enumerate().filter_map(seen).collect();
        let corners = seen.par_iter().flat_map_iter(|&(facet, _)| view.world.facet(facet).corners_m);
        let around = corners.map(|c| [c, c]).reduce_with(|[a, b], [c, d]| [a.min(c), b.max(d)])?;
        let coordinates = ViewCoordinates::onto(around, view.antenna)?;
        let facet = |&(facet, seen): &(u32, LitSide)| coordinates.project(facet, seen, view);
        let facets: Vec<ProjectedFacet> = seen.par_iter().map(facet).collect();
        coordinates.holds(facets.iter().map(|facet| &facet.extent)).then_some(Self { coordinates, facets })
    }
}

impl ViewCoordinates {
    /// Coordinates for the view onto the space between two corners of a box.
    pub(crate) fn onto([low, high]: [DVec3; 2], antenna: Antenna) -> Option<Self> {
        let forward = -antenna.towards(0.5 * low + 0.5 * high).try_normalize()?;
        let right = forward.any_orthonormal_vector();
        Some(Self { antenna, forward, right, up: forward.cross(right) })
    }

    pub(crate) fn project(&self, facet: u32, seen: LitSide, view: &View) -> ProjectedFacet {
        let [a, b, c] = view.world.facet(facet).corners_m.map(|corner| self.place(corner));
        let corners = if seen == LitSide::Front { [a, b, c] } else { [a, c, b] };
        ProjectedFacet { facet, seen, extent: ProjectedExtent::around(corners, view) }
    }

    /// Whether facets with these extents have a position on one plane across the view.
    pub(crate) fn holds<'e>(&self, extents: impl Iterator<Item = &'e ProjectedExtent> + Clone) -> bool {
        let range =
            |(near_m, far_m): (f64, f64), b: &ProjectedExtent| (b.near_m.min(near_m), b.far_m.max(far_m));
        let (near_m, far_m) = extents.clone().fold((f64::INFINITY, 0.0), range);
        let is_apart = match self.antenna {
            Antenna::Point(_) => near_m > NEAREST_OF_FARTHEST * far_m,
            Antenna::Direction(_) => true,
        };
        is_apart && extents.into_iter().all(|b| b.low.is_finite() && b.high.is_finite())
    }

    fn place(&self, x: DVec3) -> (DVec2, f64) {
        match self.antenna {
            Antenna::Point(p) => {
                let way = x - p;
                let depth_m = way.dot(self.forward);
                (DVec2::new(way.dot(self.right), way.dot(self.up)) / depth_m, depth_m)
            }
            Antenna::Direction(_) => (DVec2::new(x.dot(self.right), x.dot(self.up)), x.dot(self.forward)),
        }
    }
}

impl ProjectedExtent {
    /// Extent of these corners, widened by rounding.
    fn around(corners: [(DVec2, f64); 3], view: &View) -> Self {
        let [(a, da), (b, db), (c, dc)] = corners;
        let (near_m, far_m) = (da.min(db).min(dc), da.max(db).max(dc));
        let slack_m = 4.0 * view.tolerance_m();
        let slack = match view.antenna {
            Antenna::Point(_) => slack_m / near_m.max(f64::MIN_POSITIVE),
            Antenna::Direction(_) => slack_m,
        };
        let (low, high) = (a.min(b).min(c) - slack, a.max(b).max(c) + slack);
        Self { corners: [a, b, c], slack, low, high, near_m: near_m - slack_m, far_m: far_m + slack_m }
    }

    /// Corners in units of cells from an origin.
    pub(crate) fn in_cells(&self, origin: DVec2, cell: f64) -> Self {
        let scaled = |x: DVec2| (x - origin) / cell;
        let corners = self.corners.map(scaled);
        Self { corners, slack: self.slack / cell, low: scaled(self.low), high: scaled(self.high), ..*self }
    }
}

/// Box across the view that contains these extents.
pub(crate) fn across<'e>(extents: impl Iterator<Item = &'e ProjectedExtent>) -> Option<(DVec2, DVec2)> {
    extents.map(|b| (b.low, b.high)).reduce(|(a, b), (c, d)| (a.min(c), b.max(d)))
}
