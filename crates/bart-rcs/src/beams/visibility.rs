//! Visibility from an antenna: every facet clipped to the view, less the parts hidden by other facets, as
//! convex polygons.
//!
//! For each facet the hierarchy proposes possible occluders. The facet's polygon is then cut by one occluder
//! after another, the largest first, and every piece keeps only those that may still reach it: a facet behind
//! a dense mesh costs the outline of its shadow, not the number of facets in front.

use crate::beams::occlusion::lit_parts::LitParts;
use crate::beams::occlusion::projection::{ProjectedExtent, ProjectedFacet, ProjectedView};
use crate::beams::occlusion::projection_grid::ProjectionGrid;
use crate::beams::occlusion::shadow::{HiddenPart, Shadow, ShadowCover};
use crate::beams::occlusion::solid_cells::visible;
use crate::beams::occlusion::view::View;
use crate::bodies::world::VisitBuffers;
use crate::geometry::antenna::Antenna;
use crate::geometry::border::Border;
use crate::geometry::clip::{Corner, Split, doubled_area, perimeter_m, split};
use crate::geometry::plane::Plane;
use glam::DVec3;
use rayon::prelude::*;
use std::ops::{ControlFlow, Range};

/// Algorithm to find the lit parts of a view. All give the same result up to how it is divided.
pub(crate) trait Visibility {
    /// Lit polygons of all directly visible facets, by facet.
    fn direct(view: &View) -> Vec<LitParts>;
    /// Lit polygons met by a reflected beam.
    fn reflected(view: &View, buffers: &mut Buffers) -> LitParts;
}

/// Visibility using the bodies' hierarchies.
pub(crate) struct BvhVisibility;

/// Buffers reused from view to view.
#[derive(Default)]
pub(crate) struct Buffers {
    walk: VisitBuffers,
    found: Vec<u32>,
    shadows: Vec<Shadow>,
    slot_of_facet: Vec<u32>,
    cutter: OccluderSubtraction,
}

/// Number of facets in view above which beams sort them into a grid of their own, or, if there can be none,
/// traverse the hierarchy again for each of them; below, testing all pairs is cheaper.
const MANY_IN_VIEW: usize = 24;
const NO_SLOT: u32 = u32::MAX;

impl Visibility for BvhVisibility {
    fn direct(view: &View) -> Vec<LitParts> {
        let seen = direct_of(view, |shadows| (0..shadows.len() as u32).collect());
        seen.into_iter().filter(|parts| !parts.parts.is_empty()).collect()
    }

    fn reflected(view: &View, buffers: &mut Buffers) -> LitParts {
        buffers.gather(view);
        let Buffers { walk, shadows, slot_of_facet, cutter, .. } = buffers;
        let grid = (shadows.len() > MANY_IN_VIEW).then(|| ProjectionGrid::over(shadows, view)).flatten();
        let table = ShadowTable { shadows, slot_of_facet, grid: grid.as_ref() };
        let mut parts = LitParts::default();
        for slot in 0..shadows.len() as u32 {
            see_facet(view, &table, slot, walk, cutter, &mut parts);
        }
        shadows.iter().for_each(|shadow| slot_of_facet[shadow.facet as usize] = NO_SLOT);
        parts
    }
}

/// Directly lit polygons of the visible facets selected by `choose` (as slots), in its order.
pub(crate) fn direct_of(view: &View, choose: impl FnOnce(&[Shadow]) -> Vec<u32>) -> Vec<LitParts> {
    let (shadows, grid) = in_sight(view);
    let mut slot_of_facet = vec![NO_SLOT; view.world.facets().len()];
    (0..).zip(&shadows).for_each(|(slot, shadow)| slot_of_facet[shadow.facet as usize] = slot);
    let table = ShadowTable { shadows: &shadows, slot_of_facet: &slot_of_facet, grid: grid.as_ref() };
    let lit = |(walk, cutter): &mut (VisitBuffers, OccluderSubtraction), slot: u32| {
        let mut parts = LitParts::default();
        see_facet(view, &table, slot, walk, cutter, &mut parts);
        parts
    };
    let slots = choose(&shadows).into_par_iter().with_min_len(64);
    slots.map_init(Default::default, lit).collect()
}

/// Shadows of all facets that may be directly visible, in their order.
fn in_sight(view: &View) -> (Vec<Shadow>, Option<ProjectionGrid>) {
    let Some(projected) = ProjectedView::of_all(view) else {
        let facets = (0..view.world.facets().len() as u32).into_par_iter();
        return (facets.filter_map(|facet| Shadow::of(facet, view)).collect(), None);
    };
    let shadow = |facet: &ProjectedFacet| Some((Shadow::of(facet.facet, view)?, facet.extent));
    let (shadows, extents): (Vec<Shadow>, Vec<ProjectedExtent>) =
        visible(&projected, view).par_iter().filter_map(shadow).unzip();
    let grid = ProjectionGrid::of(&extents);
    (shadows, grid)
}

impl Buffers {
    /// Shadows of all facets that reach into the view, in facet order.
    fn gather(&mut self, view: &View) {
        self.slot_of_facet.resize(view.world.facets().len(), NO_SLOT);
        self.found.clear();
        let planes =
            view.window.iter().map(|(plane, _)| *plane).chain(view.mirror.map(|mirror| mirror.front));
        // Most proposals of the hierarchy are outside, and a shadow costs more than this test.
        let found = |facet| {
            if view.reaches(view.world.facet(facet)) {
                self.found.push(facet);
            }
            ControlFlow::Continue(())
        };
        let _ = view.world.visit_inside(planes, view.opening(), DVec3::ZERO, &mut self.walk, found);
        if !self.found.iter().any(|&facet| view.is_followed(facet)) {
            self.found.clear();
        }
        self.found.sort_unstable();
        self.shadows.clear();
        self.shadows.extend(self.found.iter().filter_map(|&facet| Shadow::of(facet, view)));
        for (slot, shadow) in (0..).zip(&self.shadows) {
            self.slot_of_facet[shadow.facet as usize] = slot;
        }
    }
}

/// Shadows of the facets in view.
struct ShadowTable<'a> {
    shadows: &'a [Shadow],
    slot_of_facet: &'a [u32],
    /// Grid of a direct view with all facets in front of the antenna.
    grid: Option<&'a ProjectionGrid>,
}

/// Appends the visible part of the facet in `slot`.
fn see_facet(
    view: &View,
    table: &ShadowTable,
    slot: u32,
    walk: &mut VisitBuffers,
    cutter: &mut OccluderSubtraction,
    parts: &mut LitParts,
) {
    let target = &table.shadows[slot as usize];
    let Some(polygon) = view.clip(target, &mut cutter.corners, &mut cutter.distances_m) else { return };
    cutter.occluders.clear();
    let mut search = OccluderSearch {
        view,
        table,
        slot,
        target,
        polygon: &cutter.corners[polygon.clone()],
        occluders: &mut cutter.occluders,
    };
    if search.find_occluders(walk).is_continue() {
        cutter.cut(polygon, table.shadows, view.tolerance_m(), |polygon| parts.push(target, view, polygon));
    }
}

/// Search for the occluders of a polygon.
struct OccluderSearch<'a> {
    view: &'a View<'a>,
    table: &'a ShadowTable<'a>,
    slot: u32,
    target: &'a Shadow,
    polygon: &'a [Corner],
    occluders: &'a mut Vec<Occluder>,
}

/// An occluder of one target.
#[derive(Debug, Clone, Copy)]
struct Occluder {
    /// Index into the table of shadows.
    slot: u32,
    hides: HiddenPart,
    apparent_size: f64,
}

impl OccluderSearch<'_> {
    /// Collects possible occluders of the polygon, largest first; breaks if one facet hides all of it.
    fn find_occluders(&mut self, walk: &mut VisitBuffers) -> ControlFlow<()> {
        if let Some(grid) = self.table.grid {
            grid.visit_before(self.slot, |slot| self.suspect(slot))?;
        } else if self.view.mirror.is_some() && self.table.shadows.len() <= MANY_IN_VIEW {
            (0..self.table.shadows.len() as u32).try_for_each(|slot| self.suspect(slot))?;
        } else {
            self.walk(walk)?;
        }
        self.occluders
            .sort_unstable_by(|a, b| b.apparent_size.total_cmp(&a.apparent_size).then(a.slot.cmp(&b.slot)));
        ControlFlow::Continue(())
    }

    /// Tests all facets that may lie between the antenna and the polygon, roughly from the antenna on.
    fn walk(&mut self, walk: &mut VisitBuffers) -> ControlFlow<()> {
        let front = self.target.front;
        // Nearer to the facet's plane than the antenna.
        let nearer = match self.view.antenna {
            Antenna::Point(p) => Some(Plane { normal: -front.normal, offset_m: -front.normal.dot(p) }),
            Antenna::Direction(_) => None,
        };
        let planes = self.polygon.iter().map(|corner| corner.edge).chain([front]).chain(nearer);
        let towards = self.view.antenna.towards(self.polygon[0].point_m);
        self.view.world.visit_inside(planes, None, towards, walk, |facet| {
            match self.table.slot_of_facet[facet as usize] {
                NO_SLOT => ControlFlow::Continue(()),
                slot => self.suspect(slot),
            }
        })
    }

    /// Adds a facet to the occluders if it may hide some of the polygon; breaks if it hides all of it.
    fn suspect(&mut self, slot: u32) -> ControlFlow<()> {
        if slot == self.slot {
            return ControlFlow::Continue(());
        }
        let (shadow, tolerance_m) = (&self.table.shadows[slot as usize], self.view.tolerance_m());
        let of_cone = shadow.cover(HiddenPart::AllInItsCone, self.polygon, tolerance_m);
        if of_cone == ShadowCover::Apart || self.is_beside(shadow.facet) {
            return ControlFlow::Continue(());
        }
        let hides = shadow.hides(self.target, self.view);
        let cover = match hides {
            HiddenPart::Nothing => ShadowCover::Apart,
            HiddenPart::AllInItsCone => of_cone,
            HiddenPart::InItsConeAnd(plane) => of_cone.and(&plane, self.polygon, tolerance_m),
        };
        match cover {
            ShadowCover::Apart => {}
            ShadowCover::Partial => {
                self.occluders.push(Occluder { slot, hides, apparent_size: shadow.apparent_size })
            }
            ShadowCover::Whole => return ControlFlow::Break(()),
        }
        ControlFlow::Continue(())
    }

    /// Whether a facet lies completely outside one of the planes through the antenna and the polygon's edges.
    fn is_beside(&self, facet: u32) -> bool {
        let (corners_m, tolerance_m) = (&self.view.world.facet(facet).corners_m, self.view.tolerance_m());
        self.polygon.iter().any(|corner| corner.edge.extent_m(corners_m).1 <= tolerance_m)
    }
}

/// Subtracts occluders from a polygon.
#[derive(Default)]
struct OccluderSubtraction {
    /// Polygons, with those of the open pieces first.
    corners: Vec<Corner>,
    distances_m: Vec<f64>,
    occluders: Vec<Occluder>,
    /// Lists of indices into `occluders`, with those of the open pieces first.
    lists: Vec<u32>,
    open: Vec<OpenPolygon>,
}

/// A polygon and the occluders that may still reach it.
#[derive(Debug, Clone)]
struct OpenPolygon {
    polygon: Range<usize>,
    list: Range<usize>,
}

impl OccluderSubtraction {
    /// Calls `lit` with every unhidden piece of `corners[polygon]`; all occluders reach the polygon.
    fn cut(
        &mut self,
        polygon: Range<usize>,
        shadows: &[Shadow],
        tolerance_m: f64,
        mut lit: impl FnMut(&[Corner]),
    ) {
        self.lists.clear();
        self.lists.extend(0..self.occluders.len() as u32);
        self.open.clear();
        if !self.subtract_first_of(0, polygon.clone(), shadows, tolerance_m) {
            return lit(&self.corners[polygon]);
        }
        while let Some(piece) = self.open.pop() {
            // Anything appended after this piece belonged to finished pieces.
            self.corners.truncate(piece.polygon.end);
            self.lists.truncate(piece.list.end);
            if self.list_what_reaches(&piece, shadows, tolerance_m).is_continue()
                && !self.subtract_first_of(piece.list.end, piece.polygon.clone(), shadows, tolerance_m)
            {
                lit(&self.corners[piece.polygon]);
            }
        }
    }

    /// Appends those of the piece's occluders that still reach it to the lists; breaks if one hides all of
    /// it.
    fn list_what_reaches(
        &mut self,
        piece: &OpenPolygon,
        shadows: &[Shadow],
        tolerance_m: f64,
    ) -> ControlFlow<()> {
        let polygon = &self.corners[piece.polygon.clone()];
        for i in piece.list.clone() {
            let index = self.lists[i];
            let occluder = &self.occluders[index as usize];
            match shadows[occluder.slot as usize].cover(occluder.hides, polygon, tolerance_m) {
                ShadowCover::Apart => {}
                ShadowCover::Partial => self.lists.push(index),
                ShadowCover::Whole => return ControlFlow::Break(()),
            }
        }
        ControlFlow::Continue(())
    }

    /// Opens the parts of the polygon outside the first occluder of the last list that really overlaps it;
    /// returns `false` if none does.
    fn subtract_first_of(
        &mut self,
        list_start: usize,
        polygon: Range<usize>,
        shadows: &[Shadow],
        tolerance_m: f64,
    ) -> bool {
        let list_end = self.lists.len();
        for i in list_start..list_end {
            let occluder = self.occluders[self.lists[i] as usize];
            let planes = shadows[occluder.slot as usize].planes(occluder.hides);
            let (open, corners) = (self.open.len(), self.corners.len());
            if self.open_outside_parts(planes, polygon.clone(), i + 1..list_end, tolerance_m) {
                return true;
            }
            self.open.truncate(open);
            self.corners.truncate(corners);
        }
        false
    }

    /// Cuts the polygon by an occluder's planes in turn; returns `false` if only rounding is hidden.
    fn open_outside_parts(
        &mut self,
        planes: impl Iterator<Item = Plane>,
        mut polygon: Range<usize>,
        list: Range<usize>,
        tolerance_m: f64,
    ) -> bool {
        for plane in planes {
            match split(
                &mut self.corners,
                polygon.clone(),
                &plane,
                Border::Shadow,
                tolerance_m,
                &mut self.distances_m,
            ) {
                Split::Inside => {}
                Split::Outside => return false,
                Split::Cut { inside, outside } => {
                    self.open.push(OpenPolygon { polygon: outside, list: list.clone() });
                    polygon = inside;
                }
            }
        }
        let hidden = &self.corners[polygon];
        doubled_area(hidden.iter().map(|c| c.point_m)).length() > 2.0 * tolerance_m * perimeter_m(hidden)
    }
}
