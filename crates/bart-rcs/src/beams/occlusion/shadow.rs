//! Shadow of a facet: the part of its cone, as seen by the antenna, that lies behind it.
//!
//! A point y is hidden by facet O from antenna p if y lies inside the three planes through p and O's edges,
//! and behind O. If O and the target intersect, one more plane through p separates them
//! ([`crate::beams::occlusion::depth_order`]). In a reflected beam only the part of O beyond the mirror
//! counts, which is cut off by a plane through p and the intersection of O with the mirror's plane. So
//! everything is a test of y against planes through p constructed from original corners, and what one facet's
//! shadow loses at such a plane, its neighbour's gains, bit for bit.

use crate::beams::occlusion::depth_order::{DepthOrder, are_coincident, depth_order};
use crate::beams::occlusion::material_order::material_order;
use crate::beams::occlusion::view::{Mirror, View};
use crate::bodies::world::World;
use crate::geometry::antenna::Antenna;
use crate::geometry::border::Border;
use crate::geometry::clip::Corner;
use crate::geometry::facet_geometry::FacetGeometry;
use crate::geometry::plane::Plane;
use artifact::settings::Sides;

/// Planes of a facet's shadow.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shadow {
    /// Index into the world's facets.
    pub(crate) facet: u32,
    /// Side seen by the antenna.
    pub(crate) seen: LitSide,
    /// Planes through the antenna and each edge, in the winding seen by the antenna; positive inside.
    pub(crate) edges: [Plane; 3],
    /// The facet's own plane, positive towards the antenna.
    pub(crate) front: Plane,
    /// Plane that is positive where the facet lies beyond the mirror; `None` if all of it does.
    pub(crate) beyond_mirror: Option<Plane>,
    /// Apparent size of the facet in the view, for sorting only.
    pub(crate) apparent_size: f64,
}

/// Side of a facet that an antenna sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum LitSide {
    /// Side of counter-clockwise winding.
    Front,
    /// Side of clockwise winding.
    Back,
}

/// Part of a target that a facet may hide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum HiddenPart {
    /// Nothing: the facet lies behind the target, or is the one of two coincident facets that yields.
    Nothing,
    /// Everything in the facet's cone.
    AllInItsCone,
    /// Everything in the facet's cone on the positive side of a plane through the antenna: the facets
    /// intersect.
    InItsConeAnd(Plane),
}

/// Position of a polygon relative to a shadow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ShadowCover {
    /// Outside the shadow.
    Apart,
    /// Possibly partly inside.
    Partial,
    /// Inside the shadow.
    Whole,
}

impl Shadow {
    /// Shadow of a facet; `None` if the antenna sees it edge-on, if it has no plane, or if none of it lies
    /// beyond the mirror.
    pub(crate) fn of(index: u32, view: &View) -> Option<Self> {
        let facet = view.world.facet(index);
        let (seen, front) = seen_side(facet, view.antenna, view.tolerance_m())?;
        let beyond_mirror = match &view.mirror {
            Some(mirror) => reach_beyond(mirror, facet, &front, view)?,
            None => None,
        };
        let [a, b, c] = facet.corners_m;
        let [a, b, c] = if seen == LitSide::Front { [a, b, c] } else { [a, c, b] };
        let edge = |from, to| Plane::through_edge(view.antenna, from, to);
        let edges = [edge(a, b)?, edge(b, c)?, edge(c, a)?];
        let apparent_size = apparent_size(facet, view.antenna);
        Some(Self { facet: index, seen, edges, front, beyond_mirror, apparent_size })
    }

    /// The facet as a polygon, counter-clockwise as seen by the antenna.
    pub(crate) fn polygon(&self, world: &World) -> [Corner; 3] {
        let [a, b, c] = world.facet(self.facet).corners_m;
        let points = if self.seen == LitSide::Front { [a, b, c] } else { [a, c, b] };
        // Edge i of the facet starts at corner i; seen from the back the edges run in reverse, in reverse
        // order.
        let order = if self.seen == LitSide::Front { [0, 1, 2] } else { [2, 1, 0] };
        let border = |edge| if world.is_inside_patch(self.facet, edge) { Border::Inner } else { Border::Own };
        [0, 1, 2].map(|i| Corner { point_m: points[i], edge: self.edges[i], border: border(order[i]).into() })
    }

    /// Part of another facet that this one may hide; a sheet with transmission hides nothing.
    pub(crate) fn hides(&self, target: &Self, view: &View) -> HiddenPart {
        if view.world.is_transparent(self.facet) {
            HiddenPart::Nothing
        } else {
            self.stands_before(target, view)
        }
    }

    /// Part of another facet that this one is in front of.
    pub(crate) fn stands_before(&self, target: &Self, view: &View) -> HiddenPart {
        let [own, other] = [self, target].map(|shadow| (&shadow.front, view.world.facet(shadow.facet)));
        match depth_order(own, other, view.antenna, view.tolerance_m()) {
            DepthOrder::FirstInFront => HiddenPart::AllInItsCone,
            DepthOrder::SecondInFront => HiddenPart::Nothing,
            DepthOrder::PartedBy(plane) => HiddenPart::InItsConeAnd(plane),
            DepthOrder::Coincident if self.is_before(target, view) => HiddenPart::AllInItsCone,
            DepthOrder::Coincident => HiddenPart::Nothing,
        }
    }

    /// Position of a polygon of the target relative to the hidden part.
    pub(crate) fn cover(&self, hides: HiddenPart, polygon: &[Corner], tolerance_m: f64) -> ShadowCover {
        let mut cover = ShadowCover::Whole;
        for plane in &self.edges {
            cover = cover.and(plane, polygon, tolerance_m);
            if cover == ShadowCover::Apart {
                return cover;
            }
        }
        if let Some(plane) = &self.beyond_mirror {
            cover = cover.and(plane, polygon, tolerance_m);
        }
        if let HiddenPart::InItsConeAnd(plane) = &hides {
            cover = cover.and(plane, polygon, tolerance_m);
        }
        cover
    }

    /// Planes that bound the hidden part, positive inside.
    pub(crate) fn planes(&self, hides: HiddenPart) -> impl Iterator<Item = Plane> {
        let behind = if let HiddenPart::InItsConeAnd(plane) = hides { Some(plane) } else { None };
        self.edges.into_iter().chain(self.beyond_mirror).chain(behind)
    }

    /// Whether this one of two coincident facets is lit: the one whose front is seen if only fronts scatter,
    /// then the better reflector ([`material_order`]), of one material the larger, and among facets of equal
    /// size to rounding the first.
    fn is_before(&self, other: &Self, view: &View) -> bool {
        let seen = |shadow: &Self| (view.sides == Sides::One).then_some(shadow.seen);
        let area_m2 = |shadow: &Self| view.world.facet(shadow.facet).area_m2 as f32;
        let larger = || area_m2(other).total_cmp(&area_m2(self));
        let reflecting = || material_order(view.world, self.facet, other.facet);
        let order = seen(self).cmp(&seen(other)).then_with(reflecting).then_with(larger);
        order.then(self.facet.cmp(&other.facet)).is_lt()
    }
}

impl ShadowCover {
    /// Cover that remains on the positive side of one more plane.
    #[inline]
    pub(crate) fn and(self, plane: &Plane, polygon: &[Corner], tolerance_m: f64) -> Self {
        let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
        for corner in polygon {
            let d = plane.distance_m(corner.point_m);
            least = if d < least { d } else { least };
            greatest = if d > greatest { d } else { greatest };
        }
        match () {
            () if self == Self::Apart || greatest <= tolerance_m => Self::Apart,
            () if least < -tolerance_m => Self::Partial,
            () => self,
        }
    }
}

/// Visible side and the plane facing the antenna; `None` if the facet is seen edge-on.
pub(crate) fn seen_side(
    facet: &FacetGeometry,
    antenna: Antenna,
    tolerance_m: f64,
) -> Option<(LitSide, Plane)> {
    // Directions are rounded to ε; a facet this close to edge-on has no area across the wave.
    let least = if matches!(antenna, Antenna::Point(_)) { tolerance_m } else { 16.0 * f64::EPSILON };
    let height = facet.plane.side_of(antenna);
    match () {
        () if !facet.has_plane() => None,
        () if height > least => Some((LitSide::Front, facet.plane)),
        () if height < -least => Some((LitSide::Back, -facet.plane)),
        () => None,
    }
}

/// Plane that cuts a facet off at the mirror: `None` if none of it is beyond the mirror, `Some(None)` if all
/// of it is.
#[expect(
    clippy::option_option,
    reason = "the outer says whether there is a shadow, the inner whether the mirror cuts it"
)]
fn reach_beyond(mirror: &Mirror, facet: &FacetGeometry, front: &Plane, view: &View) -> Option<Option<Plane>> {
    let tolerance_m = view.tolerance_m();
    let (low, high) = mirror.front.extent_m(&facet.corners_m);
    match () {
        () if high <= tolerance_m || are_coincident(mirror.facet, facet, tolerance_m) => None,
        () if low >= -tolerance_m => Some(None),
        () => Plane::through_meeting(view.antenna, &mirror.front, front).map(Some),
    }
}

fn apparent_size(facet: &FacetGeometry, antenna: Antenna) -> f64 {
    let [a, b, c] = facet.corners_m;
    let towards = antenna.towards((a + b + c) / 3.0);
    let across = facet.area_m2 * facet.plane.normal.dot(towards).abs();
    match antenna {
        Antenna::Point(_) => across / (towards.length_squared() * towards.length()).max(f64::MIN_POSITIVE),
        Antenna::Direction(_) => across,
    }
}
