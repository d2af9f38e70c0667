//! Estimation of corner normals for a mesh that stores none: edges are classified as creases or not, and
//! elsewhere the skin's normal is estimated.
//!
//! A tessellated round turns by a similar angle from edge to edge; a crease turns once. A facet beside a
//! round that is much wider than the round's own facets, or that continues flat, is a flat joined to a round:
//! it keeps its normal, and the round adopts it.

use crate::mesh::mesh_edges::{MeshEdges, TriangleSide, Winding, sides_of};
use glam::DVec3;

/// Maximum angle by which a smooth skin turns at an edge: a round of eight sides turns 45°, an icosahedron
/// 41.8°.
const TURN_MAX: f64 = 50.0 * std::f64::consts::PI / 180.0;
/// Minimum ratio of a round's next turn to its last.
const GOES_ON: f64 = 0.25;
/// Ratio of widths from which a facet is no step of its neighbour's round.
const WIDER: f64 = 3.0;
/// Minimum cosine between the directions across two edges for one to be evidence of the skin's shape across
/// the other.
const SAME_WAY: f64 = 0.4;

/// Facets with their planes.
pub(crate) struct Facets<'a> {
    /// Corners by triangle; those omitted from `edges` are not read.
    pub(crate) corners_m: &'a [[DVec3; 3]],
    /// Unit normals by winding; zero if a triangle is omitted.
    pub(crate) normals: &'a [DVec3],
    pub(crate) places: &'a [Option<[u32; 3]>],
    pub(crate) edges: &'a MeshEdges,
}

/// Turn from one facet to the next.
#[derive(Debug, Clone, Copy)]
struct FacetTurn {
    angle: f64,
    /// Kind of the turn; flat if below the effect of single-precision corners on a flat edge.
    kind: TurnKind,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TurnKind {
    Flat,
    Smooth,
    Crease,
}

/// Unit normals at the corners of every triangle, on the side of its own winding.
pub(crate) fn estimate_normals(facets: &Facets<'_>) -> Vec<[DVec3; 3]> {
    let turns = turns(facets);
    let fans = Fans::of(facets.places);
    let corner = |triangle: usize, k: usize| corner_normal(facets, &turns, &fans, triangle, k);
    use rayon::prelude::*;
    (0..facets.normals.len()).into_par_iter().map(|t| [0, 1, 2].map(|k| corner(t, k))).collect()
}

/// Triangles around each place.
struct Fans {
    starts: Vec<usize>,
    corners: Vec<(u32, u8)>,
}

impl Fans {
    fn of(places: &[Option<[u32; 3]>]) -> Self {
        let count = places.iter().flatten().flatten().max().map_or(0, |most| *most as usize + 1);
        let mut starts = vec![0; count + 1];
        places.iter().flatten().flatten().for_each(|place| starts[*place as usize + 1] += 1);
        (0..count).for_each(|i| starts[i + 1] += starts[i]);
        let mut next = starts.clone();
        let mut corners = vec![(0, 0); *starts.last().unwrap_or(&0)];
        for (triangle, corner_places) in (0..).zip(places) {
            for (k, &place) in (0..).zip(corner_places.iter().flatten()) {
                corners[next[place as usize]] = (triangle, k);
                next[place as usize] += 1;
            }
        }
        Self { starts, corners }
    }

    fn around(&self, place: u32) -> &[(u32, u8)] {
        &self.corners[self.starts[place as usize]..self.starts[place as usize + 1]]
    }
}

impl Facets<'_> {
    /// Other facet at a side shared by two, and +1, or −1 if its winding is opposite.
    fn across(&self, side: TriangleSide) -> Option<(TriangleSide, f64)> {
        let edge = *self.edges.of_side(side).first()?;
        let (other, winding) = self.edges.edge(edge as usize).across(side, self.places)?;
        Some((other, if winding == Winding::Alike { 1.0 } else { -1.0 }))
    }

    fn normal(&self, side: TriangleSide) -> DVec3 {
        self.normals[side.triangle as usize]
    }

    /// Vector from the side's start to its end.
    fn along_m(&self, side: TriangleSide) -> DVec3 {
        let corners = &self.corners_m[side.triangle as usize];
        corners[(usize::from(side.side) + 1) % 3] - corners[usize::from(side.side)]
    }

    /// Whether no side of its facet is longer.
    fn is_longest(&self, side: TriangleSide) -> bool {
        let length2 = |s: TriangleSide| self.along_m(s).length_squared();
        other_sides(side).into_iter().all(|other| length2(other) <= length2(side))
    }

    /// Unit vector in the facet's plane, pointing out of the facet.
    fn outwards(&self, side: TriangleSide) -> DVec3 {
        self.along_m(side).cross(self.normal(side)).try_normalize().unwrap_or(DVec3::ZERO)
    }

    /// Width of the facet across the side: its height.
    fn width_m(&self, side: TriangleSide) -> f64 {
        let corners = &self.corners_m[side.triangle as usize];
        let third = corners[(usize::from(side.side) + 2) % 3];
        -(third - corners[usize::from(side.side)]).dot(self.outwards(side))
    }
}

fn other_sides(side: TriangleSide) -> [TriangleSide; 2] {
    [1, 2].map(|i| TriangleSide { side: (side.side + i) % 3, ..side })
}

/// Turns by triangle and side.
fn turns(facets: &Facets<'_>) -> Vec<[FacetTurn; 3]> {
    let sides = |triangle: usize| sides_of(triangle as u32);
    let largest = facets.corners_m.iter().flatten().fold(0.0, |m, c| c.abs().max_element().max(m));
    let rounding_m = largest * f64::from(f32::EPSILON);
    let angle = |side: TriangleSide| {
        let Some((other, sign)) = facets.across(side) else {
            return FacetTurn { angle: 0.0, kind: TurnKind::Crease };
        };
        let angle = facets.normal(side).angle_between(sign * facets.normal(other));
        let noise = 4.0 * rounding_m / facets.width_m(side).min(facets.width_m(other));
        FacetTurn { angle, kind: if angle <= noise { TurnKind::Flat } else { TurnKind::Crease } }
    };
    let plain: Vec<[FacetTurn; 3]> = (0..facets.normals.len()).map(|t| sides(t).map(angle)).collect();
    let judged = |side: TriangleSide| {
        let turn = plain[side.triangle as usize][usize::from(side.side)];
        let Some((other, _)) = facets.across(side) else { return turn };
        let smooth = turn.kind == TurnKind::Crease
            && turn.angle <= TURN_MAX
            && [side, other]
                .iter()
                .any(|s| continues_turn(facets, &plain, *s).is_some_and(|on| on >= GOES_ON * turn.angle));
        if smooth { FacetTurn { kind: TurnKind::Smooth, ..turn } } else { turn }
    };
    (0..facets.normals.len()).map(|t| sides(t).map(judged)).collect()
}

/// Angle by which the skin continues to turn in the same direction where it leaves a facet entered at `side`,
/// rad; `None` if no edge shows it.
///
/// A diagonal is crossed once: where it does not bend, and, since quads of a doubly curved skin are not flat,
/// where it is the longest side of both its facets; there it may be the exit as well.
fn continues_turn(facets: &Facets<'_>, turns: &[[FacetTurn; 3]], side: TriangleSide) -> Option<f64> {
    let (behind, sign) = facets.across(side)?;
    // Across the side the normal has turned along this direction.
    let way = -facets.outwards(side);
    let bend = (facets.normal(side) - sign * facets.normal(behind)).dot(way);
    let turn_at = |s: TriangleSide| turns[s.triangle as usize][usize::from(s.side)];
    let exits = other_sides(side).into_iter().flat_map(|exit| match facets.across(exit) {
        Some((next, _)) if turn_at(exit).kind == TurnKind::Flat => other_sides(next).to_vec(),
        Some((next, _)) if facets.is_longest(exit) && facets.is_longest(next) => {
            let [a, b] = other_sides(next);
            vec![exit, a, b]
        }
        _ => vec![exit],
    });
    let on = exits.filter_map(|exit| {
        let (next, sign_next) = facets.across(exit)?;
        if facets.outwards(exit).dot(way) < SAME_WAY {
            return None;
        }
        let next_normal =
            sign_next * facets.normal(next) * facets.normal(exit).dot(facets.normal(side)).signum();
        let further = (next_normal - facets.normal(side)).dot(way) * bend.signum();
        Some(if turn_at(exit).angle <= TURN_MAX { further } else { 0.0 })
    });
    on.fold(None, |most: Option<f64>, x| Some(most.map_or(x, |m| m.max(x))))
}

/// Extent, from a side, of a facet and its flat continuation beyond its other sides.
fn patch_width_m(facets: &Facets<'_>, turns: &[[FacetTurn; 3]], side: TriangleSide) -> f64 {
    let (out, from) =
        (facets.outwards(side), facets.corners_m[side.triangle as usize][usize::from(side.side)]);
    let beyond = other_sides(side).into_iter().filter_map(|exit| {
        let is_flat = turns[exit.triangle as usize][usize::from(exit.side)].kind == TurnKind::Flat;
        facets.across(exit).filter(|_| is_flat).map(|(next, _)| next.triangle)
    });
    let corners = beyond.chain([side.triangle]).flat_map(|t| facets.corners_m[t as usize]);
    corners.map(|corner| (from - corner).dot(out)).fold(0.0, f64::max)
}

/// Whether the facet of `side` is a flat with a round behind that side.
fn is_flat_towards(facets: &Facets<'_>, turns: &[[FacetTurn; 3]], side: TriangleSide) -> bool {
    let turn = turns[side.triangle as usize][usize::from(side.side)];
    let Some((other, _)) = facets.across(side) else { return false };
    if turn.kind != TurnKind::Smooth {
        return false;
    }
    let wide = patch_width_m(facets, turns, side) > WIDER * patch_width_m(facets, turns, other);
    let ends = |s: TriangleSide| continues_turn(facets, turns, s).is_some_and(|on| on < GOES_ON * turn.angle);
    wide || (ends(side) && !ends(other))
}

/// Mean normal of the facets around a place that no crease separates from this one; flats joined to a round
/// take precedence.
fn corner_normal(
    facets: &Facets<'_>,
    turns: &[[FacetTurn; 3]],
    fans: &Fans,
    triangle: usize,
    k: usize,
) -> DVec3 {
    let own = facets.normals[triangle];
    let Some(places) = facets.places[triangle] else { return own };
    let group = smooth_group(facets, turns, fans.around(places[k]), triangle as u32);
    let at_corner =
        |(t, k, _): &(u32, u8, f64)| [*k, (*k + 2) % 3].map(|side| TriangleSide { triangle: *t, side });
    let is_flat =
        |member: &(u32, u8, f64)| at_corner(member).iter().any(|s| is_flat_towards(facets, turns, *s));
    let flats: Vec<bool> = group.iter().map(is_flat).collect();
    let any_flat = flats.iter().any(|flat| *flat);
    let voting = group.iter().zip(&flats).filter(|(_, flat)| **flat || !any_flat);
    let turn = |s: TriangleSide| turns[s.triangle as usize][usize::from(s.side)];
    let has_quads = group.iter().flat_map(at_corner).any(|s| turn(s).kind == TurnKind::Flat);
    let vote = if has_quads { by_angle } else { by_sphere };
    let sum = voting.fold(DVec3::ZERO, |sum, ((t, k, sign), _)| sum + *sign * vote(facets, *t, *k));
    let normal = sum.try_normalize().unwrap_or(own);
    // An apex has no normal: a skin's differs from a facet's by no more than the turns around it.
    let smooth = group.iter().flat_map(at_corner).map(turn).filter(|turn| turn.kind == TurnKind::Smooth);
    let most = 2.0 * smooth.fold(0.0, |most, turn| turn.angle.max(most));
    if normal.angle_between(own) <= most { normal } else { own }
}

/// Triangles of a fan connected to `start` by edges at the fan's place that are not creases: corner, and the
/// sign that aligns their winding with that of `start`; ascending.
fn smooth_group(
    facets: &Facets<'_>,
    turns: &[[FacetTurn; 3]],
    fan: &[(u32, u8)],
    start: u32,
) -> Vec<(u32, u8, f64)> {
    let corner_of = |triangle: u32| fan.iter().find(|(t, _)| *t == triangle).map(|(_, k)| *k);
    let mut group: Vec<(u32, u8, f64)> = corner_of(start).map(|k| (start, k, 1.0)).into_iter().collect();
    let mut next = 0;
    while let Some(&(triangle, k, sign)) = group.get(next) {
        next += 1;
        for side in [k, (k + 2) % 3] {
            let side = TriangleSide { triangle, side };
            if turns[triangle as usize][usize::from(side.side)].kind == TurnKind::Crease {
                continue;
            }
            let Some((other, turned)) = facets.across(side) else { continue };
            let Some(corner) = corner_of(other.triangle) else { continue };
            if !group.iter().any(|(t, ..)| *t == other.triangle) {
                group.push((other.triangle, corner, sign * turned));
            }
        }
    }
    group.sort_by_key(|member| member.0);
    group
}

/// Normal of the facet times its angle at a corner (G. Thürmer, C. Wüthrich, J. Graphics Tools 3 (1998) 43):
/// a quad counts the same for either diagonal, so that normals of cylinders and cones are exact.
fn by_angle(facets: &Facets<'_>, triangle: u32, k: u8) -> DVec3 {
    let [u, v] = leaving(facets, triangle, k);
    facets.normals[triangle as usize] * u.angle_between(v)
}

/// Normal u × v/(|u|²|v|²) from the edges that leave a corner (N. Max, J. Graphics Tools 4 (1999) 1): if all
/// vertices lie on a sphere their sum is its normal, for any triangles.
fn by_sphere(facets: &Facets<'_>, triangle: u32, k: u8) -> DVec3 {
    let [u, v] = leaving(facets, triangle, k);
    let squares = u.length_squared() * v.length_squared();
    if squares > 0.0 { u.cross(v) / squares } else { DVec3::ZERO }
}

fn leaving(facets: &Facets<'_>, triangle: u32, k: u8) -> [DVec3; 2] {
    let (corners, k) = (&facets.corners_m[triangle as usize], usize::from(k));
    [corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]]
}
