//! Diffracting edges of a body: open edges and wedges of its surface, but not seams, diagonals, concave
//! corners or bends of a tessellated curve (docs/decisions/edges.md).

use crate::mesh::curve_bend::{may_be_a_step, may_be_of_one_curve};
use crate::mesh::mesh_edges::{MeshEdge, TriangleSide};
use crate::mesh::surface_topology::{FanFacet, Topology};
use crate::mesh::t_junction::CornerTolerance;
use crate::mesh::wedges::wedge::Wedge;
use crate::mesh::welding::rounding_m;
use glam::DVec3;
use std::f64::consts::PI;

/// Diffracting edges and the flat patches that they bound, body frame.
#[derive(Debug, Clone, Default)]
pub(crate) struct BodyEdges {
    pub(crate) edges: Vec<BodyEdge>,
    pub(crate) patches: Vec<Patch>,
}

/// A straight edge.
#[derive(Debug, Clone)]
pub(crate) struct BodyEdge {
    pub(crate) ends_m: [DVec3; 2],
    pub(crate) wedge: Wedge,
    /// Patches of face 1 and face 2.
    pub(crate) patches: [u32; 2],
    /// All facets that end here.
    pub(crate) sides: Vec<EdgeSide>,
}

/// A side of a triangle at an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct EdgeSide {
    pub(crate) triangle: u32,
    /// Corner at which the side starts; it ends at the next.
    pub(crate) side: u8,
    pub(crate) patch: u32,
}

/// Connected coplanar triangles.
#[derive(Debug, Clone, Default)]
pub(crate) struct Patch {
    /// Ends of currents on the patch, unordered: its outline except where a smooth skin continues.
    pub(crate) ends: Vec<PatchEnd>,
}

/// A line that ends a patch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PatchEnd {
    pub(crate) ends_m: [DVec3; 2],
    /// Index in [`BodyEdges::edges`]; `None` for a wall standing on the patch.
    pub(crate) edge: Option<u32>,
}

/// Bend below which facets are one surface: its fringe is below 1 % of an open edge's.
const LEAST_BEND_RAD: f64 = 1.0 * PI / 180.0;
/// Bend above which there is an edge whatever the file's normals: a box with averaged normals stays a box, a
/// hexagon may be round.
const SHADED_BEND_RAD: f64 = 65.0 * PI / 180.0;

/// Edges of a mesh; `corner_normals` are those stored for the corners of its triangles, empty if there are
/// none. Seams and planes are closed within `negligible_m`, a distance negligible for any wave.
pub(crate) fn body_edges(
    triangles_m: &[[DVec3; 3]],
    corner_normals: &[[DVec3; 3]],
    negligible_m: f64,
) -> BodyEdges {
    let near = CornerTolerance { rounding_m: rounding_m(triangles_m.as_flattened()), negligible_m };
    let topology = Topology::of(triangles_m, near);
    let bends: Vec<DiffractingLine> =
        topology.lines().filter_map(|line| DiffractingLine::of(&topology, &line)).collect();
    let by_patch = by_patch(&bends, topology.patches());
    let is_edge = |bend: &&DiffractingLine| !is_curve(bend, &bends, &by_patch, corner_normals);
    let pieces: Vec<BodyEdge> = bends.iter().filter(is_edge).map(|bend| bend.edge.clone()).collect();
    let edges = merged(pieces, 0.5 * near.of_plane_m());
    BodyEdges { patches: ends_of_patches(&topology, &edges), edges }
}

/// A line around which free space spans more than half a turn.
struct DiffractingLine {
    edge: BodyEdge,
    /// Facets of face 1 and face 2.
    blades: [FanFacet; 2],
    /// Exterior angle beyond a half turn, (N − 1)π.
    turn_rad: f64,
}

impl EdgeSide {
    fn of(topology: &Topology<'_>, &TriangleSide { triangle, side }: &TriangleSide) -> Self {
        Self { triangle, side, patch: topology.patch_of(triangle) }
    }
}

impl DiffractingLine {
    fn of(topology: &Topology<'_>, line: &MeshEdge<'_>) -> Option<Self> {
        if topology.is_inside_a_patch(line) {
            return None;
        }
        let fan = topology.fan(line)?;
        let (gap_rad, blades) = fan.widest_gap();
        if gap_rad < PI + LEAST_BEND_RAD {
            return None;
        }
        let (along, inward) = (fan.along, blades.map(|blade| blade.inward));
        // The exterior angle turns around `along` from face 1 to face 2.
        let normal = [along.cross(inward[0]), inward[1].cross(along)];
        let edge = BodyEdge {
            ends_m: topology.ends_m(line),
            wedge: Wedge { along, inward, normal, exterior: gap_rad / PI },
            patches: blades.map(|blade| topology.patch_of(blade.side.triangle)),
            sides: line.sides.iter().map(|side| EdgeSide::of(topology, side)).collect(),
        };
        Some(Self { edge, blades, turn_rad: gap_rad - PI })
    }

    /// Whether another bend is between the same two patches, and so a piece of the same edge.
    fn is_of_the_edge(&self, other: &Self) -> bool {
        self.edge.patches == other.edge.patches
            || self.edge.patches == [other.edge.patches[1], other.edge.patches[0]]
    }

    /// Outward normal of one of its patches, as implied by this bend.
    fn outward_of(&self, patch: u32) -> DVec3 {
        self.edge.wedge.normal[usize::from(self.edge.patches[0] != patch)]
    }
}

fn by_patch(bends: &[DiffractingLine], patches: usize) -> Vec<Vec<u32>> {
    let mut by_patch = vec![Vec::new(); patches];
    for (index, bend) in (0..).zip(bends) {
        bend.edge.patches.iter().for_each(|patch| by_patch[*patch as usize].push(index));
    }
    by_patch
}

/// Whether a bend is a piece of a tessellated curve: from the normals stored in the file, else from its
/// neighbours.
fn is_curve(
    bend: &DiffractingLine,
    bends: &[DiffractingLine],
    by_patch: &[Vec<u32>],
    corner_normals: &[[DVec3; 3]],
) -> bool {
    if bend.turn_rad > SHADED_BEND_RAD {
        return false;
    }
    match shading(bend, corner_normals) {
        Shading::Smooth => true,
        Shading::Creased => false,
        Shading::Flat => may_be_a_step(bend.turn_rad) && continues_curve(bend, bends, by_patch),
    }
}

/// Evidence from the normals stored in a file at a bend.
enum Shading {
    /// Both facets have the same normals at their common line: a curve.
    Smooth,
    /// The normals differ, although a facet has varying normals elsewhere: an edge in a curved skin.
    Creased,
    /// The file has no normals, or only the facets' own, which say nothing about the surface.
    Flat,
}

fn shading(bend: &DiffractingLine, corner_normals: &[[DVec3; 3]]) -> Shading {
    let [Some(a), Some(b)] = bend.blades.map(|blade| corner_normals.get(blade.side.triangle as usize)) else {
        return Shading::Flat;
    };
    let ends = |normals: &[DVec3; 3], blade: &FanFacet| {
        let from = usize::from(blade.side.side);
        [normals[from], normals[(from + 1) % 3]]
    };
    let ([a_from, a_to], [b_from, b_to]) = (ends(a, &bend.blades[0]), ends(b, &bend.blades[1]));
    let turn = |u: DVec3, v: DVec3| u.angle_between(v);
    // Consistently wound neighbours traverse their common side in opposite senses; the winding is not relied
    // on.
    let least = turn(a_from, b_from).max(turn(a_to, b_to)).min(turn(a_from, b_to).max(turn(a_to, b_from)));
    let is_flat = |normals: &[DVec3; 3]| (1..3).all(|i| turn(normals[0], normals[i]) < LEAST_BEND_RAD);
    match () {
        () if !least.is_finite() => Shading::Flat,
        () if least < 0.25 * bend.turn_rad => Shading::Smooth,
        () if is_flat(a) && is_flat(b) => Shading::Flat,
        () => Shading::Creased,
    }
}

/// Whether one of the two patches has another edge with a bend in the same sense and of similar size.
fn continues_curve(bend: &DiffractingLine, bends: &[DiffractingLine], by_patch: &[Vec<u32>]) -> bool {
    bend.edge.patches.iter().any(|&patch| {
        let outward = bend.outward_of(patch);
        by_patch[patch as usize].iter().map(|index| &bends[*index as usize]).any(|other| {
            !other.is_of_the_edge(bend)
                && may_be_of_one_curve(bend.turn_rad, other.turn_rad)
                && other.outward_of(patch).dot(outward) > 0.0
        })
    })
}

/// Direction perpendicular to no edge of a manufactured body, along which edges are oriented.
const FORWARDS: DVec3 = DVec3::new(0.534_713, 0.613_291, 0.581_377);

/// Merges collinear pieces between the same patches into one edge.
fn merged(mut pieces: Vec<BodyEdge>, tolerance_m: f64) -> Vec<BodyEdge> {
    pieces.iter_mut().for_each(turn_forwards);
    let from_m = |edge: &BodyEdge| edge.ends_m[0].dot(FORWARDS);
    pieces.sort_by(|a, b| a.patches.cmp(&b.patches).then(from_m(a).total_cmp(&from_m(b))));
    let mut edges: Vec<BodyEdge> = Vec::with_capacity(pieces.len());
    let mut first_of_patches = 0;
    for piece in pieces {
        if edges.last().is_some_and(|last| last.patches != piece.patches) {
            first_of_patches = edges.len();
        }
        match edges[first_of_patches..].iter_mut().find(|edge| continues(edge, &piece, tolerance_m)) {
            Some(edge) => {
                edge.ends_m[1] = piece.ends_m[1];
                edge.sides.extend(piece.sides);
            }
            None => edges.push(piece),
        }
    }
    edges
}

/// Orients an edge forwards: both senses describe the same edge.
fn turn_forwards(edge: &mut BodyEdge) {
    let Wedge { along, inward: [x1, x2], normal: [n1, n2], exterior } = edge.wedge;
    if along.dot(FORWARDS) < 0.0 {
        edge.wedge = Wedge { along: -along, inward: [x2, x1], normal: [n2, n1], exterior };
        edge.patches.reverse();
    }
    if (edge.ends_m[1] - edge.ends_m[0]).dot(FORWARDS) < 0.0 {
        edge.ends_m.reverse();
    }
}

fn continues(edge: &BodyEdge, piece: &BodyEdge, tolerance_m: f64) -> bool {
    let whole = piece.ends_m[1] - edge.ends_m[0];
    let across = |x: DVec3| {
        let arm = x - edge.ends_m[0];
        (arm - whole * (arm.dot(whole) / whole.length_squared())).length()
    };
    edge.ends_m[1].distance(piece.ends_m[0]) <= 2.0 * tolerance_m
        && edge.wedge.along.dot(piece.wedge.along) > 0.0
        && across(piece.ends_m[0]) <= 2.0 * tolerance_m
}

/// Ends of the currents of each patch: its edges and the walls standing on it, but not bends of a smooth
/// skin.
fn ends_of_patches(topology: &Topology<'_>, edges: &[BodyEdge]) -> Vec<Patch> {
    let mut patches = vec![Patch::default(); topology.patches()];
    for (index, edge) in (0..).zip(edges) {
        let [first, second] = edge.patches;
        let end = PatchEnd { ends_m: edge.ends_m, edge: Some(index) };
        patches[first as usize].ends.push(end);
        if second != first {
            patches[second as usize].ends.push(end);
        }
    }
    for line in topology.lines().filter(|line| topology.fan(line).is_some_and(|fan| fan.blades.len() > 2)) {
        let mut here: Vec<u32> = line.sides.iter().map(|side| topology.patch_of(side.triangle)).collect();
        here.sort_unstable();
        here.dedup();
        let end = PatchEnd { ends_m: topology.ends_m(&line), edge: None };
        here.into_iter().for_each(|patch| patches[patch as usize].ends.push(end));
    }
    patches
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad(corners: [[f64; 3]; 4]) -> [[DVec3; 3]; 2] {
        let [a, b, c, d] = corners.map(DVec3::from_array);
        [[a, b, c], [a, c, d]]
    }

    fn length_of(edges: &BodyEdges) -> f64 {
        edges.edges.iter().map(|e| e.ends_m[0].distance(e.ends_m[1])).sum()
    }

    fn cube() -> Vec<[DVec3; 3]> {
        let at = |i: u32| [f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2 & 1)];
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        faces.iter().flat_map(|face| quad(face.map(at))).collect()
    }

    #[test]
    fn a_plate_has_its_outline_and_a_cube_twelve_right_angles() {
        let plate = quad([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        let edges = body_edges(&plate, &[], 0.0);
        assert_eq!(edges.edges.len(), 4);
        assert!((length_of(&edges) - 6.0).abs() < 1e-12);
        assert!(
            edges.edges.iter().all(|e| e.wedge.exterior == 2.0 && e.wedge.normal[0] == -e.wedge.normal[1])
        );
        let edges = body_edges(&cube(), &[], 0.0);
        assert_eq!(edges.edges.len(), 12);
        let centre = DVec3::splat(0.5);
        for edge in &edges.edges {
            assert!((edge.wedge.exterior - 1.5).abs() < 1e-12);
            let out = edge.ends_m[0] - centre;
            assert!(edge.wedge.normal.iter().all(|n| n.dot(out) > 0.4), "normals look out of the body");
            for face in 0..2 {
                let [x, n] = [edge.wedge.inward[face], edge.wedge.normal[face]];
                let t = if face == 0 { edge.wedge.along } else { -edge.wedge.along };
                assert!((x.cross(n) - t).length() < 1e-12);
            }
        }
    }

    #[test]
    fn the_winding_and_doubled_facets_change_no_edge() {
        let mut triangles = cube();
        triangles.iter_mut().step_by(3).for_each(|t| t.swap(1, 2));
        triangles.extend(cube());
        let edges = body_edges(&triangles, &[], 0.0);
        assert_eq!(edges.edges.len(), 12);
        assert!(edges.edges.iter().all(|e| (e.wedge.exterior - 1.5).abs() < 1e-12));
    }

    #[test]
    fn an_inner_corner_is_no_edge_and_its_rims_are() {
        let floor = quad([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        let wall = quad([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]]);
        let both: Vec<_> = floor.into_iter().chain(wall).collect();
        let edges = body_edges(&both, &[], 0.0);
        let folded = edges.edges.iter().filter(|e| e.wedge.exterior < 1.9).count();
        // The fold is a wedge from behind, six rims are open.
        assert_eq!((folded, edges.edges.len()), (1, 7));
    }

    fn prism(sides: u32) -> Vec<[DVec3; 3]> {
        let corner = |i: u32, z: f64| {
            let (sin, cos) = (2.0 * PI * f64::from(i) / f64::from(sides)).sin_cos();
            [cos, sin, z]
        };
        (0..sides)
            .flat_map(|i| quad([corner(i, 0.0), corner(i + 1, 0.0), corner(i + 1, 1.0), corner(i, 1.0)]))
            .collect()
    }

    #[test]
    fn a_tessellated_cylinder_has_its_rims_alone() {
        let edges = body_edges(&prism(32), &[], 0.0);
        assert_eq!(edges.edges.len(), 64);
        assert!(edges.edges.iter().all(|e| e.wedge.exterior == 2.0));
        // Six sides are a prism: its long edges count.
        assert_eq!(body_edges(&prism(6), &[], 0.0).edges.len(), 18);
    }

    #[test]
    fn stored_normals_decide_where_there_are_some() {
        let triangles = prism(12);
        let flat: Vec<[DVec3; 3]> =
            triangles.iter().map(|t| [(t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero(); 3]).collect();
        // A hexagon with round normals is a coarse cylinder, without them it is a prism.
        let hexagon = prism(6);
        let round = |t: &[DVec3; 3]| t.map(|c| DVec3::new(c.x, c.y, 0.0).normalize_or_zero());
        let normals: Vec<_> = hexagon.iter().map(round).collect();
        assert_eq!(
            (body_edges(&hexagon, &[], 0.0).edges.len(), body_edges(&hexagon, &normals, 0.0).edges.len()),
            (18, 12)
        );
        assert_eq!(body_edges(&triangles, &flat, 0.0).edges.len(), 24, "flat shading tells nothing");
    }

    #[test]
    fn one_crease_between_flat_panels_is_an_edge() {
        let left = quad([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 1.0, -0.2], [-1.0, 0.0, -0.2]]);
        let right = quad([[0.0, 0.0, 0.0], [1.0, 0.0, -0.2], [1.0, 1.0, -0.2], [0.0, 1.0, 0.0]]);
        let both: Vec<_> = left.into_iter().chain(right).collect();
        let edges = body_edges(&both, &[], 0.0);
        assert_eq!(edges.edges.iter().filter(|e| e.wedge.exterior < 1.9).count(), 1);
    }
}
