//! The edges of all bodies at one instant.

use crate::body_edges::{BodyEdge, BodyEdges, Patch};
use crate::fringe::Wedge;
use glam::{DMat3, DVec3};

/// Edges in world metres, and which facets end at them.
pub(crate) struct WorldEdges {
    pub(crate) edges: Vec<EdgeGeometry>,
    patches: Vec<Patch>,
    /// By facet: where its list of sides begins and ends.
    first_side: Vec<u32>,
    /// (facet, side, edge), by facet.
    sides: Vec<FacetSide>,
}

/// A straight edge.
#[derive(Debug, Clone)]
pub(crate) struct EdgeGeometry {
    pub(crate) from_m: DVec3,
    pub(crate) length_m: f64,
    pub(crate) wedge: Wedge,
    /// Of face 1 and face 2.
    patches: [u32; 2],
}

/// A side of a facet that is (a part of) an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct FacetSide {
    facet: u32,
    /// From this corner to the next.
    pub(crate) side: u8,
    pub(crate) edge: u32,
}

impl EdgeGeometry {
    /// The point at `at_m` from the edge's beginning.
    pub(crate) fn point_m(&self, at_m: f64) -> DVec3 {
        self.from_m + at_m * self.wedge.along
    }
}

impl WorldEdges {
    /// No edges yet.
    pub(crate) fn for_facets(facets: usize) -> Self {
        Self { edges: Vec::new(), patches: Vec::new(), first_side: vec![0; facets + 1], sides: Vec::new() }
    }

    /// Appends a body's; its facets come after those of the bodies before.
    pub(crate) fn add(&mut self, body: &BodyEdges, world_from_body: DMat3, position_m: DVec3, first_facet: u32) {
        let (first_edge, first_patch) = (self.edges.len() as u32, self.patches.len() as u32);
        let place = |x: DVec3| position_m + world_from_body * x;
        let posed = |edge: &BodyEdge| EdgeGeometry {
            from_m: place(edge.ends_m[0]),
            length_m: edge.ends_m[0].distance(edge.ends_m[1]),
            wedge: edge.wedge.turned(world_from_body),
            patches: edge.patches.map(|patch| first_patch + patch),
        };
        self.edges.extend(body.edges.iter().map(posed));
        let placed = |patch: &Patch| Patch { ends_m: patch.ends_m.iter().map(|end| end.map(place)).collect() };
        self.patches.extend(body.patches.iter().map(placed));
        for (edge, of_body) in (first_edge..).zip(&body.edges) {
            let side = |&(triangle, side): &(u32, u8)| FacetSide { facet: first_facet + triangle, side, edge };
            self.sides.extend(of_body.sides.iter().map(side));
        }
        self.sides.sort_unstable();
        for (facet, first) in self.first_side.iter_mut().enumerate() {
            *first = self.sides.partition_point(|side| (side.facet as usize) < facet) as u32;
        }
    }

    /// Where currents end on face 0 or 1 of an edge.
    pub(crate) fn ends_of_face(&self, edge: &EdgeGeometry, face: usize) -> &[[DVec3; 2]] {
        &self.patches[edge.patches[face] as usize].ends_m
    }

    /// The sides of a facet that are edges.
    pub(crate) fn sides_of(&self, facet: u32) -> &[FacetSide] {
        let [from, to] = [facet, facet + 1].map(|f| self.first_side[f as usize] as usize);
        &self.sides[from..to]
    }
}
