//! Parts of edges lit by a beam tree, and the parts lit from both ends.
//!
//! An edge is lit where a lit polygon of one of its facets reaches it: exactly the lit part of the facets,
//! with the same shadows, directly or via mirrors. Only edges whose facets are edge-on to the antenna to
//! within rounding have no polygon. Among edges on one line (rims of a double skin,
//! [`crate::mesh::wedges::coincident_rims`]) only the nearest to the antenna is lit, point by point.

use crate::beams::beam::{Beam, BeamTree};
use crate::beams::image_tree::goes_by_road;
use crate::bodies::world::World;
use crate::joins::join::tree_order;
use crate::joins::joint::{Reverse, Trees};
use crate::mesh::wedges::edge_band::EdgeBand;
use crate::mesh::wedges::world_edges::{EdgeGeometry, FacetSide, WorldEdges};
use artifact::paths::MAX_ORDER;
use artifact::settings::{Edges, NodeRule};
use glam::DVec3;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A part of an edge lit from one end along one path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LitEdge {
    pub(crate) edge: u32,
    /// Number of facets on the path, including the edge's own.
    pub(crate) order: u8,
    /// Patches of the preceding mirrors, nearest first.
    mirrors: MirrorPatches,
    /// Surfaces on the path other than perfect mirrors.
    surfaces: PathSurfaces,
    /// A beam that reaches the edge: its leg leads to the edge.
    pub(crate) beam: u32,
    /// Span along the edge, m.
    pub(crate) span_m: [f64; 2],
}

/// Patches of a path's mirrors; [`NO_MIRROR`] after the last. Light from one mirror comes in pieces wherever
/// a seam lies on it, and these count as one path.
type MirrorPatches = [u32; MAX_ORDER];
const NO_MIRROR: u32 = u32::MAX;

/// Number of surfaces on a path other than perfect mirrors, and a name for these. A path beside a pane and
/// one through it have the same mirrors, and are apart.
type PathSurfaces = [u32; 2];

/// A part of an edge lit from both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EdgeJoint {
    /// Band whose edges it counts among.
    pub(crate) band: EdgeBand,
    pub(crate) edge: u32,
    /// Beams whose legs lead to it.
    pub(crate) forward: u32,
    pub(crate) backward: u32,
    pub(crate) span_m: [f64; 2],
    pub(crate) reverse: Reverse,
}

/// Maximum order of beams needed for `bounces` under a rule: an edge is no mirror, and one end may reach it
/// via all other facets, whatever node is taken for facets.
pub(crate) fn tree_order_with(edges: Edges, bounces: u8, rule: NodeRule) -> u8 {
    let of_facets = tree_order(bounces, rule);
    if edges == Edges::FirstOrder { of_facets.max(bounces) } else { of_facets }
}

/// All paths of `order` reflections and one edge; each counts, since an edge is no mirror (docs/physics.md
/// §2).
pub(crate) fn edge_joints(world: &World, edges: &WorldEdges, trees: Trees<'_>, order: u8) -> Vec<EdgeJoint> {
    let forward = lit_edges(world, edges, trees.transmit(), order);
    match trees {
        Trees::Shared(_) => joints_of(edges, [&forward, &forward], order, Pairs::Unordered),
        Trees::Apart(..) | Trees::ByRoad(..) => {
            let backward = lit_edges(world, edges, trees.receive(), order);
            joints_of(edges, [&forward, &backward], order, Pairs::Ordered)
        }
    }
}

/// Parts of edges reached by a tree's beams up to `max_order`, sorted by edge, order, mirror and position.
/// Beams via the road are not followed to edges.
pub(crate) fn lit_edges(world: &World, edges: &WorldEdges, tree: &BeamTree, max_order: u8) -> Vec<LitEdge> {
    let (mut found, mut names) = (Vec::new(), SurfaceNames::default());
    let beams = (0..).zip(&tree.beams).take_while(|(_, beam)| beam.order <= max_order);
    for (index, beam) in beams.filter(|(_, beam)| !goes_by_road(world, tree, beam)) {
        for side in edges.sides_of(beam.facet) {
            let edge = &edges.edges[side.edge as usize];
            let reached = reached_m(world, tree, beam, side, edge);
            let surfaces = names.of_path(world, tree, beam);
            let lit = |span_m| LitEdge {
                edge: side.edge,
                order: beam.order,
                mirrors: mirrors_of(world, tree, beam),
                surfaces,
                beam: index,
                span_m,
            };
            found.extend(reached.map(lit));
        }
    }
    let line = |lit: &LitEdge| edges.edges[lit.edge as usize].line.first;
    let key = |lit: &LitEdge| (line(lit), lit.order, lit.mirrors, lit.edge, lit.surfaces);
    found.sort_by(|a, b| {
        key(a).cmp(&key(b)).then(a.span_m[0].total_cmp(&b.span_m[0])).then(a.beam.cmp(&b.beam))
    });
    let united = united(found, world.tolerance_m());
    let of_way = united.chunk_by(|a, b| (line(a), a.order, a.mirrors) == (line(b), b.order, b.mirrors));
    of_way.flat_map(|ways| nearest_of_line(edges, tree, ways)).collect()
}

/// Parts of the edges of one line, without those hidden by a nearer edge that is lit in the same way, or lit
/// over fewer surfaces as well.
fn nearest_of_line(edges: &WorldEdges, tree: &BeamTree, lit: &[LitEdge]) -> Vec<LitEdge> {
    if lit.iter().all(|other| (other.edge, other.surfaces) == (lit[0].edge, lit[0].surfaces)) {
        return lit.to_vec();
    }
    let seen = |one: &LitEdge| {
        let before = lit.iter().filter(|other| is_before(edges, tree, other, one));
        let hidden = before.map(|other| edges.on_line_m(other.edge, other.span_m)).collect();
        let left = without(edges.on_line_m(one.edge, one.span_m), hidden);
        left.into_iter().map(|span_m| LitEdge { span_m: edges.on_edge_m(one.edge, span_m), ..*one }).collect()
    };
    lit.iter().flat_map(|one| -> Vec<LitEdge> { seen(one) }).collect()
}

/// Whether an edge is nearer to the antenna than another one on its line, at the middle of their common lit
/// part, or is the same one and comes first by its surfaces.
fn is_before(edges: &WorldEdges, tree: &BeamTree, one: &LitEdge, other: &LitEdge) -> bool {
    let [a, b] = [one, other].map(|lit| edges.on_line_m(lit.edge, lit.span_m));
    let overlap_m = [a[0].max(b[0]), a[1].min(b[1])];
    if one.edge == other.edge || overlap_m[0] >= overlap_m[1] {
        return overlap_m[0] < overlap_m[1] && one.surfaces < other.surfaces;
    }
    let place = |lit: &LitEdge| {
        let middle_m = edges.on_edge_m(lit.edge, [0.5 * (overlap_m[0] + overlap_m[1]); 2])[0];
        edges.edges[lit.edge as usize].point_m(middle_m)
    };
    let (x, y) = (place(one), place(other));
    let travel = tree.beams[one.beam as usize].image.travel_direction_at(0.5 * (x + y));
    let ahead_m = (y - x).dot(travel);
    ahead_m > 0.0 || (ahead_m == 0.0 && one.edge < other.edge)
}

/// A span with some parts removed.
fn without(span_m: [f64; 2], mut parts_m: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    parts_m.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut left, mut from_m) = (Vec::new(), span_m[0]);
    for [start_m, end_m] in parts_m {
        if start_m > from_m {
            left.push([from_m, start_m.min(span_m[1])]);
        }
        from_m = from_m.max(end_m);
    }
    if from_m < span_m[1] {
        left.push([from_m, span_m[1]]);
    }
    left.retain(|part| part[0] < part[1]);
    left
}

fn mirrors_of(world: &World, tree: &BeamTree, beam: &Beam) -> MirrorPatches {
    let before = tree.mirror_chain(beam).skip(1).map(|mirror| world.patch(mirror.facet));
    let mut mirrors = [NO_MIRROR; MAX_ORDER];
    mirrors.iter_mut().zip(before).for_each(|(place, patch)| *place = patch);
    mirrors
}

/// Names of the surfaces on paths, in the order of their discovery.
#[derive(Default)]
struct SurfaceNames(BTreeMap<Vec<SurfaceKey>, u32>);

/// Patch of a surface, and its material by its place in memory; 0 for a conductor.
type SurfaceKey = (u32, usize);

impl SurfaceNames {
    fn of_path<'a>(&mut self, world: &World, tree: &'a BeamTree, beam: &'a Beam) -> PathSurfaces {
        if world.is_conductor() {
            return [0; 2];
        }
        let key = |facet: &u32| {
            let material = world.lossy_material(*facet);
            (world.patch(*facet), material.map_or(0, |material| Arc::as_ptr(material) as usize))
        };
        // Sheets before the edge, then each mirror with the sheets before it.
        let of_leg =
            |(leg, beam): (usize, &'a Beam)| (leg > 0).then_some(&beam.facet).into_iter().chain(&beam.sheets);
        let path: Vec<SurfaceKey> = tree.mirror_chain(beam).enumerate().flat_map(of_leg).map(key).collect();
        let count = path.iter().filter(|(_, material)| *material != 0).count() as u32;
        let next = self.0.len() as u32;
        [count, *self.0.entry(path).or_insert(next)]
    }
}

/// Spans of an edge covered by sides of a beam's polygon.
fn reached_m<'a>(
    world: &World,
    tree: &'a BeamTree,
    beam: &Beam,
    side: &FacetSide,
    edge: &'a EdgeGeometry,
) -> impl Iterator<Item = [f64; 2]> + 'a {
    let corners_m = world.facet(beam.facet).corners_m;
    let (from, to) = (corners_m[usize::from(side.side)], corners_m[(usize::from(side.side) + 1) % 3]);
    let along = (to - from).try_normalize().unwrap_or(DVec3::ZERO);
    // Corners of polygons are cut along the facet's sides: they stay on the line to a rounding or two.
    let tolerance_m = 4.0 * world.tolerance_m();
    let is_on_side = move |x: &DVec3| (*x - from).cross(along).length() <= tolerance_m;
    let polygon = tree.polygon(beam);
    let next = polygon.iter().cycle().skip(1);
    let place = |x: DVec3| (x - edge.from_m).dot(edge.wedge.along).clamp(0.0, edge.length_m);
    polygon.iter().zip(next).filter(move |(a, b)| is_on_side(a) && is_on_side(b)).filter_map(move |(a, b)| {
        let (a, b) = (place(*a), place(*b));
        (a != b).then(|| [a.min(b), a.max(b)])
    })
}

/// Merges touching parts.
fn united(found: Vec<LitEdge>, tolerance_m: f64) -> Vec<LitEdge> {
    let mut united: Vec<LitEdge> = Vec::with_capacity(found.len());
    for lit in found {
        match united.last_mut() {
            Some(last)
                if (last.edge, last.order, last.mirrors, last.surfaces)
                    == (lit.edge, lit.order, lit.mirrors, lit.surfaces)
                    && lit.span_m[0] <= last.span_m[1] + 16.0 * tolerance_m =>
            {
                last.span_m[1] = last.span_m[1].max(lit.span_m[1]);
            }
            _ => united.push(lit),
        }
    }
    united
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Pairs {
    /// One tree: a pair also represents its reverse.
    Unordered,
    Ordered,
}

/// Overlaps on every line of the parts lit from both ends with `order` + 1 facets between them; of two edges
/// on one line they are assigned to the first.
fn joints_of(
    edges: &WorldEdges,
    [forward, backward]: [&[LitEdge]; 2],
    order: u8,
    pairs: Pairs,
) -> Vec<EdgeJoint> {
    let line = |lit: &LitEdge| edges.edges[lit.edge as usize].line.first;
    let mut joints = Vec::new();
    let mut start = 0;
    for of_line in forward.chunk_by(|a, b| line(a) == line(b)) {
        let here = line(&of_line[0]);
        start += backward[start..].partition_point(|lit| line(lit) < here);
        let others = &backward[start..start + backward[start..].partition_point(|lit| line(lit) == here)];
        for (i, f) in of_line.iter().enumerate() {
            for (j, b) in others.iter().enumerate().filter(|(_, b)| f.order + b.order == order + 1) {
                let reverse = match pairs {
                    Pairs::Unordered if j < i => continue,
                    Pairs::Unordered if j > i => Reverse::Included,
                    Pairs::Unordered | Pairs::Ordered => Reverse::Apart,
                };
                let (edge, span_m) = edges.overlap_m([(f.edge, f.span_m), (b.edge, b.span_m)]);
                if span_m[0] < span_m[1] {
                    let (band, forward, backward) = (edges.band, f.beam, b.beam);
                    joints.push(EdgeJoint { band, edge, forward, backward, span_m, reverse });
                }
            }
        }
    }
    joints
}
