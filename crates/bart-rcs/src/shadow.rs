//! What one facet hides from an antenna: the part of its cone that lies behind its plane.
//!
//! A point y is hidden by facet O from antenna p when y lies inside the three planes through p and O's edges and behind
//! O's plane. Both are tests of y against planes made of original corners. In a reflected beam only the part of O beyond
//! the mirror counts: with d_A, d_O the distances from the planes of mirror and facet, f(y) = d_A(y)·d_O(p) − d_O(y)·d_A(p)
//! vanishes at p and where both planes meet, so it is positive where the ray to y meets O beyond the mirror.

use crate::antenna::Antenna;
use crate::clip::Corner;
use crate::plane::Plane;
use crate::world::FacetGeometry;
use artifact::settings::Sides;
use glam::DVec3;

/// The planes of a facet's shadow.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shadow {
    /// Index into the world's facets.
    pub(crate) facet: u32,
    /// The side that the antenna sees.
    pub(crate) seen: Seen,
    /// Through the antenna and each edge, in the winding as the antenna sees it; positive inside.
    pub(crate) edges: [Plane; 3],
    /// The facet's own plane, positive towards the antenna.
    pub(crate) front: Plane,
    /// Positive where the facet is met beyond the mirror; `None` where all of it is beyond.
    pub(crate) beyond_mirror: Option<Plane>,
    /// How much of the view the facet takes, for sorting only.
    pub(crate) apparent_size: f64,
}

/// The side of a facet that an antenna sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Seen {
    /// The winding is counter-clockwise.
    Front,
    /// It is clockwise.
    Back,
}

/// The mirror that a beam has just left.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mirror {
    /// Index into the world's facets.
    pub(crate) facet: u32,
    /// Its plane, positive on the lit side.
    pub(crate) front: Plane,
}

/// What of a target a facet may hide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Hides {
    /// Nothing: it lies behind, or is the one of two coincident facets that yields.
    Nothing,
    /// Whatever lies in its cone.
    AllInItsCone,
    /// What lies in its cone and behind its plane, which cuts the target.
    BehindItsPlane,
}

/// Where a polygon lies in a shadow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Cover {
    /// Outside.
    Apart,
    /// Some of it may be inside.
    Partial,
    /// Inside.
    Whole,
}

impl Shadow {
    /// The shadow of a facet; `None` where the antenna sees it edge-on, where it has no plane, or where none of it lies
    /// beyond the mirror.
    pub(crate) fn of(
        index: u32,
        facet: &FacetGeometry,
        antenna: Antenna,
        mirror: Option<(&Mirror, &FacetGeometry)>,
        tolerance_m: f64,
    ) -> Option<Self> {
        let (seen, front) = seen_side(facet, antenna, tolerance_m)?;
        let beyond_mirror = match mirror {
            Some((mirror, geometry)) => reach_beyond(mirror, geometry, facet, &front, antenna, tolerance_m)?,
            None => None,
        };
        let [a, b, c] = facet.corners_m;
        let [a, b, c] = if seen == Seen::Front { [a, b, c] } else { [a, c, b] };
        let edge = |from, to| Plane::through_edge(antenna, from, to);
        let edges = [edge(a, b)?, edge(b, c)?, edge(c, a)?];
        let apparent_size = apparent_size(facet, antenna);
        Some(Self { facet: index, seen, edges, front, beyond_mirror, apparent_size })
    }

    /// The facet as a polygon, counter-clockwise as the antenna sees it.
    pub(crate) fn polygon(&self, facet: &FacetGeometry) -> [Corner; 3] {
        let [a, b, c] = facet.corners_m;
        let points = if self.seen == Seen::Front { [a, b, c] } else { [a, c, b] };
        [0, 1, 2].map(|i| Corner { point_m: points[i], edge: self.edges[i] })
    }

    /// What this facet may hide of another.
    pub(crate) fn hides(&self, own: &FacetGeometry, target: &Self, other: &FacetGeometry, scale: &Scale) -> Hides {
        let tolerance_m = scale.tolerance_m;
        let (low, high) = extent(&self.front, &other.corners_m);
        if are_coincident(own, other, low.abs().max(high.abs()), tolerance_m) {
            let yields = self.tie_key(scale.sides) > target.tie_key(scale.sides);
            return if yields { Hides::Nothing } else { Hides::AllInItsCone };
        }
        match () {
            () if low >= -tolerance_m => Hides::Nothing,
            () if high <= tolerance_m => Hides::AllInItsCone,
            () => Hides::BehindItsPlane,
        }
    }

    /// Where a polygon of the target lies.
    pub(crate) fn cover(&self, hides: Hides, polygon: &[Corner], tolerance_m: f64) -> Cover {
        let mut cover = Cover::Whole;
        for plane in self.planes(hides) {
            let (mut any_inside, mut any_outside) = (false, false);
            for corner in polygon {
                let d = plane.distance_m(corner.point_m);
                any_inside |= d > tolerance_m;
                any_outside |= d < -tolerance_m;
            }
            if !any_inside {
                return Cover::Apart;
            }
            if any_outside {
                cover = Cover::Partial;
            }
        }
        cover
    }

    /// The planes that bound what is hidden, positive inside.
    pub(crate) fn planes(&self, hides: Hides) -> impl Iterator<Item = Plane> {
        let behind = (hides == Hides::BehindItsPlane).then_some(-self.front);
        self.edges.into_iter().chain(self.beyond_mirror).chain(behind)
    }

    /// Of coincident facets the least is lit: the one whose front is seen where only fronts scatter, then the first.
    fn tie_key(&self, sides: Sides) -> (Option<Seen>, u32) {
        ((sides == Sides::One).then_some(self.seen), self.facet)
    }
}

/// What decides between facets of one world.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scale {
    /// Distances below this are rounding.
    pub(crate) tolerance_m: f64,
    /// Which sides scatter.
    pub(crate) sides: Sides,
}

/// The plane that bounds what an antenna sees through a convex hole in `front`: through the antenna and the hole's edge.
///
/// With d_E, d_A the distances from the edge's plane and the hole's, d_E(y)·d_A(p) − d_A(y)·d_E(p) vanishes at the antenna
/// p and along the edge.
pub(crate) fn window_plane(edge: &Plane, front: &Plane, antenna: Antenna) -> Option<Plane> {
    // From an image the hole is seen from behind: d_A(p) < 0, and the sign is set so that the edge's inside stays inside.
    let (e, a) = (side(edge, antenna), side(front, antenna));
    let sign = a.signum();
    let normal = sign * (a * edge.normal - e * front.normal);
    let length = normal.length();
    let offset_m = sign * (a * edge.offset_m - e * front.offset_m);
    (length > 0.0 && length.is_finite()).then(|| Plane { normal: normal / length, offset_m: offset_m / length })
}

/// Distance of the antenna from a plane, m, or the cosine of its direction.
pub(crate) fn side(plane: &Plane, antenna: Antenna) -> f64 {
    match antenna {
        Antenna::Point(p) => plane.distance_m(p),
        Antenna::Direction(r) => plane.normal.dot(r),
    }
}

/// Whether two facets are one surface to rounding: all corners of either lie in the plane of the other. Symmetric; the
/// farthest corner of `b` from the plane of `a` is known.
fn are_coincident(a: &FacetGeometry, b: &FacetGeometry, b_from_a_m: f64, tolerance_m: f64) -> bool {
    b_from_a_m <= tolerance_m || {
        let (low, high) = extent(&b.plane, &a.corners_m);
        low.abs().max(high.abs()) <= tolerance_m
    }
}

/// The side that is seen and the plane towards the antenna; `None` where it is seen edge-on.
fn seen_side(facet: &FacetGeometry, antenna: Antenna, tolerance_m: f64) -> Option<(Seen, Plane)> {
    // Directions are rounded to ε; a facet this close to edge-on has no area across the wave.
    let least = if matches!(antenna, Antenna::Point(_)) { tolerance_m } else { 16.0 * f64::EPSILON };
    let height = side(&facet.plane, antenna);
    match () {
        () if !facet.has_plane() => None,
        () if height > least => Some((Seen::Front, facet.plane)),
        () if height < -least => Some((Seen::Back, -facet.plane)),
        () => None,
    }
}

/// `None` where nothing of the facet is beyond the mirror, `Some(None)` where everything is.
#[expect(
    clippy::option_option,
    reason = "the outer says whether there is a shadow, the inner whether the mirror cuts it"
)]
fn reach_beyond(
    mirror: &Mirror,
    geometry: &FacetGeometry,
    facet: &FacetGeometry,
    front: &Plane,
    antenna: Antenna,
    tolerance_m: f64,
) -> Option<Option<Plane>> {
    let (low, high) = extent(&mirror.front, &facet.corners_m);
    if high <= tolerance_m || are_coincident(geometry, facet, low.abs().max(high.abs()), tolerance_m) {
        return None;
    }
    if low >= -tolerance_m {
        return Some(None);
    }
    // f of the module's head: d_O(p) > 0 as `front` points to the antenna.
    let (o, a) = (side(front, antenna), side(&mirror.front, antenna));
    let normal = o * mirror.front.normal - a * front.normal;
    let length = normal.length();
    let offset_m = o * mirror.front.offset_m - a * front.offset_m;
    Some((length > 0.0).then(|| Plane { normal: normal / length, offset_m: offset_m / length }))
}

/// Least and greatest distance of the corners from a plane.
fn extent(plane: &Plane, corners_m: &[DVec3; 3]) -> (f64, f64) {
    let [a, b, c] = corners_m.map(|corner| plane.distance_m(corner));
    (a.min(b).min(c), a.max(b).max(c))
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
