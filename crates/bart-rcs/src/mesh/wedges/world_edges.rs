//! Edges of all bodies at one instant.

use crate::mesh::wedges::body_edges::{BodyEdge, BodyEdges, EdgeSide, Patch, PatchEnd};
use crate::mesh::wedges::coincident_rims::lines;
use crate::mesh::wedges::edge_band::EdgeBand;
use crate::mesh::wedges::face_end::FaceEnds;
use crate::mesh::wedges::wedge::Wedge;
use glam::{DMat3, DVec2, DVec3};

/// Edges in world metres, and the facets that end at them.
pub(crate) struct WorldEdges {
    /// Band in which they are valid.
    pub(crate) band: EdgeBand,
    pub(crate) edges: Vec<EdgeGeometry>,
    patches: Vec<Patch>,
    /// Start and end of each facet's list of sides.
    first_side: Vec<u32>,
    /// Sides (facet, side, edge), by facet.
    sides: Vec<FacetSide>,
}

/// A straight edge.
#[derive(Debug, Clone)]
pub(crate) struct EdgeGeometry {
    pub(crate) from_m: DVec3,
    pub(crate) length_m: f64,
    pub(crate) wedge: Wedge,
    /// Line of the edge, shared with others on double skins; most lines have a single edge.
    pub(crate) line: EdgeLine,
    /// Patches of face 1 and face 2.
    patches: [u32; 2],
}

/// Position of an edge on a line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EdgeLine {
    /// First edge of the line.
    pub(crate) first: u32,
    /// Start of the edge, measured along the line's first edge from its start, m.
    pub(crate) from_m: f64,
}

/// A side of a facet that is an edge or a part of one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct FacetSide {
    facet: u32,
    /// Corner at which the side starts; it ends at the next.
    pub(crate) side: u8,
    pub(crate) edge: u32,
}

impl EdgeGeometry {
    /// Point at `at_m` from the edge's start.
    pub(crate) fn point_m(&self, at_m: f64) -> DVec3 {
        self.from_m + at_m * self.wedge.along
    }
}

/// Placement of a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BodyPlacement {
    pub(crate) world_from_body: DMat3,
    pub(crate) position_m: DVec3,
}

impl WorldEdges {
    /// Empty list of edges.
    pub(crate) fn for_facets(facets: usize, band: EdgeBand) -> Self {
        let first_side = vec![0; facets + 1];
        Self { band, edges: Vec::new(), patches: Vec::new(), first_side, sides: Vec::new() }
    }

    /// Appends the edges of a body; its facets follow those of the preceding bodies.
    ///
    /// The wedge beside a side narrower than `thin_m` is the open edge of its other face
    /// ([`seen_from_afar`]), and open edges closer than that share a line ([`lines`]).
    pub(crate) fn add(&mut self, body: &BodyEdges, place: &BodyPlacement, first_facet: u32, thin_m: f64) {
        let BodyPlacement { world_from_body, position_m } = *place;
        let seen: Vec<BodyEdge> =
            body.edges.iter().map(|edge| seen_from_afar(edge, &body.patches, thin_m)).collect();
        let (first_edge, first_patch) = (self.edges.len() as u32, self.patches.len() as u32);
        let place = |x: DVec3| position_m + world_from_body * x;
        let on_line = |edge: &BodyEdge, first: u32| {
            let line = &seen[first as usize];
            let from_m = (edge.ends_m[0] - line.ends_m[0]).dot(line.wedge.along);
            EdgeLine { first: first_edge + first, from_m }
        };
        let posed = |(edge, first): (&BodyEdge, u32)| EdgeGeometry {
            from_m: place(edge.ends_m[0]),
            length_m: edge.ends_m[0].distance(edge.ends_m[1]),
            wedge: edge.wedge.turned(world_from_body),
            line: on_line(edge, first),
            patches: edge.patches.map(|patch| first_patch + patch),
        };
        self.edges.extend(seen.iter().zip(lines(&seen, thin_m)).map(posed));
        let posed_end = |end: &PatchEnd| PatchEnd {
            ends_m: end.ends_m.map(place),
            edge: end.edge.map(|edge| first_edge + edge),
        };
        let placed = |patch: &Patch| Patch { ends: patch.ends.iter().map(posed_end).collect() };
        self.patches.extend(body.patches.iter().map(placed));
        for (edge, of_body) in (first_edge..).zip(&seen) {
            let side = |s: &EdgeSide| FacetSide { facet: first_facet + s.triangle, side: s.side, edge };
            self.sides.extend(of_body.sides.iter().map(side));
        }
        self.sides.sort_unstable();
        for (facet, first) in self.first_side.iter_mut().enumerate() {
            *first = self.sides.partition_point(|side| (side.facet as usize) < facet) as u32;
        }
    }

    /// Ends of the currents on face 0 or 1 of an edge.
    pub(crate) fn ends_of_face(&self, edge: &EdgeGeometry, face: usize) -> &[PatchEnd] {
        &self.patches[edge.patches[face] as usize].ends
    }

    /// A span of an edge, measured on its line.
    pub(crate) fn on_line_m(&self, edge: u32, span_m: [f64; 2]) -> [f64; 2] {
        span_m.map(|at_m| at_m + self.edges[edge as usize].line.from_m)
    }

    /// Span of an edge that corresponds to a span of its line, clipped to its ends.
    pub(crate) fn on_edge_m(&self, edge: u32, span_m: [f64; 2]) -> [f64; 2] {
        let EdgeGeometry { line, length_m, .. } = &self.edges[edge as usize];
        span_m.map(|at_m| (at_m - line.from_m).clamp(0.0, *length_m))
    }

    /// Overlap of spans of two edges on one line, measured on the first edge.
    pub(crate) fn overlap_m(&self, [one, other]: [(u32, [f64; 2]); 2]) -> (u32, [f64; 2]) {
        let common = |a: [f64; 2], b: [f64; 2]| [a[0].max(b[0]), a[1].min(b[1])];
        if one.0 == other.0 {
            return (one.0, common(one.1, other.1));
        }
        let edge = one.0.min(other.0);
        let [a, b] = [one, other].map(|(edge, span_m)| self.on_line_m(edge, span_m));
        (edge, self.on_edge_m(edge, common(a, b)))
    }

    /// Sides of a facet that are edges.
    pub(crate) fn sides_of(&self, facet: u32) -> &[FacetSide] {
        let [from, to] = [facet, facet + 1].map(|f| self.first_side[f as usize] as usize);
        &self.sides[from..to]
    }
}

/// Edge of a sheet of some thickness: at a side so narrow that the wave does not resolve its two edges,
/// k·width < 1, a wedge is the open edge of its wide face.
///
/// The currents of two wedges a fraction of a wavelength apart are not the sum of those of each alone, and
/// all further terms of the series are as large; a half-plane is the limit of zero width. It is lit where its
/// wide face is.
fn seen_from_afar(edge: &BodyEdge, patches: &[Patch], thin_m: f64) -> BodyEdge {
    let Wedge { along, inward, normal, .. } = edge.wedge;
    let width_m = |face: usize| {
        let ends = &patches[edge.patches[face] as usize].ends;
        let seen = FaceEnds::seen_from(edge.ends_m[0], along, inward[face], ends);
        let middle_m = 0.5 * edge.ends_m[0].distance(edge.ends_m[1]);
        seen.nearest(middle_m, DVec2::X).map_or(f64::INFINITY, |met| met.way_m)
    };
    let wide = match [0, 1].map(|face| width_m(face) < thin_m) {
        _ if edge.patches[0] == edge.patches[1] => return edge.clone(),
        [true, false] => 1,
        [false, true] => 0,
        _ => return edge.clone(),
    };
    let (x, n) = (inward[wide], if wide == 0 { normal[0] } else { -normal[1] });
    BodyEdge {
        ends_m: edge.ends_m,
        wedge: Wedge { along, inward: [x; 2], normal: [n, -n], exterior: 2.0 },
        patches: [edge.patches[wide]; 2],
        sides: edge.sides.iter().filter(|side| side.patch == edge.patches[wide]).copied().collect(),
    }
}
