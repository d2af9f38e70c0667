//! Parts of edges that a beam tree lights, and where both ends meet on an edge.
//!
//! An edge is lit where a lit polygon of one of its facets reaches it: exactly what is lit of the facets, by
//! the same shadows, straight or through mirrors. Only edges in the plane of vision itself (their facets
//! edge-on to the antenna to rounding) have no polygon.

use crate::beams::beam::{Beam, BeamTree};
use crate::beams::image_tree::goes_by_road;
use crate::bodies::world::World;
use crate::joins::join::tree_order;
use crate::joins::joint::{Reverse, Trees};
use crate::mesh::wedges::world_edges::{EdgeGeometry, FacetSide, WorldEdges};
use artifact::paths::MAX_ORDER;
use artifact::settings::{Edges, NodeRule};
use glam::DVec3;

/// A part of an edge that one end lights along one way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LitEdge {
    pub(crate) edge: u32,
    /// Facets on the way, the edge's own included.
    pub(crate) order: u8,
    /// Patches of the mirrors before it, the nearest first.
    mirrors: Mirrors,
    /// A beam that reaches the edge: its leg is the way there.
    pub(crate) beam: u32,
    /// Span along the edge, m.
    pub(crate) span_m: [f64; 2],
}

/// Patches of the mirrors of a way; [`NO_MIRROR`] behind the last. Light of one mirror comes in pieces
/// wherever a seam lies on it, and its ways are one.
type Mirrors = [u32; MAX_ORDER];
const NO_MIRROR: u32 = u32::MAX;

/// A part of an edge that both ends light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EdgeJoint {
    pub(crate) edge: u32,
    /// Beams whose legs lead to it.
    pub(crate) forward: u32,
    pub(crate) backward: u32,
    pub(crate) span_m: [f64; 2],
    pub(crate) reverse: Reverse,
}

/// Highest order of beams that `bounces` need by a rule: an edge is no mirror, and one end may come to it
/// over all the others, whatever node is taken of facets.
pub(crate) fn tree_order_with(edges: Edges, bounces: u8, rule: NodeRule) -> u8 {
    let of_facets = tree_order(bounces, rule);
    if edges == Edges::FirstOrder { of_facets.max(bounces) } else { of_facets }
}

/// Every way of `order` reflections and one edge; each counts, as an edge is no mirror (docs/physics.md §2).
pub(crate) fn edge_joints(world: &World, edges: &WorldEdges, trees: Trees<'_>, order: u8) -> Vec<EdgeJoint> {
    let forward = lit_edges(world, edges, trees.transmit(), order);
    match trees {
        Trees::Shared(_) => joints_of(&forward, &forward, order, Pairs::Unordered),
        Trees::Apart(..) | Trees::ByRoad(..) => {
            joints_of(&forward, &lit_edges(world, edges, trees.receive(), order), order, Pairs::Ordered)
        }
    }
}

/// Parts of edges that a tree's beams up to `max_order` reach; by edge, order, mirror and place. What comes
/// by the road is not followed to edges.
pub(crate) fn lit_edges(world: &World, edges: &WorldEdges, tree: &BeamTree, max_order: u8) -> Vec<LitEdge> {
    let mut found = Vec::new();
    let beams = (0..).zip(&tree.beams).take_while(|(_, beam)| beam.order <= max_order);
    for (index, beam) in beams.filter(|(_, beam)| !goes_by_road(world, tree, beam)) {
        for side in edges.sides_of(beam.facet) {
            let edge = &edges.edges[side.edge as usize];
            let reached = reached_m(world, tree, beam, side, edge);
            let lit = |span_m| LitEdge {
                edge: side.edge,
                order: beam.order,
                mirrors: mirrors_of(world, tree, beam),
                beam: index,
                span_m,
            };
            found.extend(reached.map(lit));
        }
    }
    let key = |lit: &LitEdge| (lit.edge, lit.order, lit.mirrors);
    found.sort_by(|a, b| {
        key(a).cmp(&key(b)).then(a.span_m[0].total_cmp(&b.span_m[0])).then(a.beam.cmp(&b.beam))
    });
    united(found, world.tolerance_m())
}

fn mirrors_of(world: &World, tree: &BeamTree, beam: &Beam) -> Mirrors {
    let before = tree.way_back(beam).skip(1).map(|mirror| world.patch(mirror.facet));
    let mut mirrors = [NO_MIRROR; MAX_ORDER];
    mirrors.iter_mut().zip(before).for_each(|(place, patch)| *place = patch);
    mirrors
}

/// Spans of an edge that sides of a beam's polygon cover.
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
    // Corners of polygons are cut along the facet's sides: they keep the line to a rounding or two.
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

/// Parts that touch become one.
fn united(found: Vec<LitEdge>, tolerance_m: f64) -> Vec<LitEdge> {
    let mut united: Vec<LitEdge> = Vec::with_capacity(found.len());
    for lit in found {
        match united.last_mut() {
            Some(last)
                if (last.edge, last.order, last.mirrors) == (lit.edge, lit.order, lit.mirrors)
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
    /// One tree: a pair stands for its reverse.
    Unordered,
    Ordered,
}

/// Overlaps on every edge of what both ends light with `order` + 1 facets between them.
fn joints_of(forward: &[LitEdge], backward: &[LitEdge], order: u8, pairs: Pairs) -> Vec<EdgeJoint> {
    let mut joints = Vec::new();
    let mut start = 0;
    for of_edge in forward.chunk_by(|a, b| a.edge == b.edge) {
        let edge = of_edge[0].edge;
        start += backward[start..].partition_point(|lit| lit.edge < edge);
        let others = &backward[start..start + backward[start..].partition_point(|lit| lit.edge == edge)];
        for (i, f) in of_edge.iter().enumerate() {
            for (j, b) in others.iter().enumerate() {
                let reverse = match pairs {
                    Pairs::Unordered if j < i => continue,
                    Pairs::Unordered if j > i => Reverse::Included,
                    Pairs::Unordered | Pairs::Ordered => Reverse::Apart,
                };
                let span_m = [f.span_m[0].max(b.span_m[0]), f.span_m[1].min(b.span_m[1])];
                if f.order + b.order == order + 1 && span_m[0] < span_m[1] {
                    joints.push(EdgeJoint { edge, forward: f.beam, backward: b.beam, span_m, reverse });
                }
            }
        }
    }
    joints
}
