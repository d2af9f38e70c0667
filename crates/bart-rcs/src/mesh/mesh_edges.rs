//! Edges of a mesh and the triangles that meet there: the single topology of a mesh, from the positions of
//! its corners alone.
//!
//! It is defined for any mesh: open, doubled, with either winding, with many facets at one edge. Patches,
//! creases and diffracting edges are defined elsewhere.

use crate::mesh::welding::Welding;
use glam::DVec3;
use std::ops::Range;

/// A side of a triangle: it runs from corner `side` to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct TriangleSide {
    pub(crate) triangle: u32,
    pub(crate) side: u8,
}

/// A side, or a part of one between corners of its neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct SidePart {
    /// Place indices of the two ends, ascending.
    pub(crate) ends: [u32; 2],
    pub(crate) of: TriangleSide,
}

/// Two places and the triangles that contain both.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeshEdge<'a> {
    /// Place indices of the two ends, ascending.
    pub(crate) ends: [u32; 2],
    /// Sides at the edge, ascending by triangle; each once, except for triangles without height.
    pub(crate) sides: &'a [TriangleSide],
}

/// Relative winding of two triangles at an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Winding {
    /// The triangles traverse the edge in opposite senses: their normals are on one side of the surface.
    Alike,
    Opposite,
}

/// All edges of a mesh in the order of their ends, and the edges of each triangle.
#[derive(Debug, Default)]
pub(crate) struct MeshEdges {
    ends: Vec<[u32; 2]>,
    /// Start of each edge's sides in `sides`, and the end of the last.
    starts: Vec<u32>,
    sides: Vec<TriangleSide>,
    /// Edges of every side of every triangle, `edges_of_sides[starts_of_sides[3·triangle + side]..]`.
    edges_of_sides: Vec<u32>,
    starts_of_sides: Vec<u32>,
}

impl MeshEdges {
    /// Edges of triangles whose corners are `places`; `None` omits a triangle. Sides without length are no
    /// edges.
    pub(crate) fn of(places: &[Option<[u32; 3]>]) -> Self {
        Self::of_parts(parts(places), places.len())
    }

    /// Edges of possibly cut sides, for this number of triangles.
    pub(crate) fn of_parts(mut parts: Vec<SidePart>, triangles: usize) -> Self {
        parts.sort_unstable();
        let mut edges = Self { starts: vec![0], ..Self::default() };
        let mut of_sides: Vec<(TriangleSide, u32)> = Vec::with_capacity(parts.len());
        for group in parts.chunk_by(|a, b| a.ends == b.ends) {
            let edge = edges.ends.len() as u32;
            of_sides.extend(group.iter().map(|part| (part.of, edge)));
            edges.ends.push(group[0].ends);
            edges.sides.extend(group.iter().map(|part| part.of));
            edges.starts.push(edges.sides.len() as u32);
        }
        of_sides.sort_unstable();
        edges.starts_of_sides = starts_by(of_sides.iter().map(|(side, _)| slot(*side)), 3 * triangles);
        edges.edges_of_sides = of_sides.into_iter().map(|(_, edge)| edge).collect();
        edges
    }

    /// Number of edges.
    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }

    /// Edge with this index.
    pub(crate) fn edge(&self, edge: usize) -> MeshEdge<'_> {
        MeshEdge { ends: self.ends[edge], sides: &self.sides[range(&self.starts, edge)] }
    }

    /// All edges.
    pub(crate) fn iter(&self) -> impl Iterator<Item = MeshEdge<'_>> {
        (0..self.len()).map(|edge| self.edge(edge))
    }

    /// Edges of which a side consists: one, several if it is cut, none if it has no length or its triangle is
    /// omitted.
    pub(crate) fn of_side(&self, side: TriangleSide) -> &[u32] {
        &self.edges_of_sides[range(&self.starts_of_sides, slot(side))]
    }

    /// Other triangles along a side.
    pub(crate) fn neighbours(&self, side: TriangleSide) -> impl Iterator<Item = u32> {
        let sides = self.of_side(side).iter().flat_map(|edge| self.edge(*edge as usize).sides);
        sides.map(|other| other.triangle).filter(move |other| *other != side.triangle)
    }

    /// Seed of `seeds` with which each triangle is connected via edges, through triangles that `belongs(seed,
    /// other)` admits and that no earlier seed has taken; [`MeshEdges::NO_SEED`] for triangles reached by
    /// none.
    pub(crate) fn connected_components(
        &self,
        seeds: impl Iterator<Item = u32>,
        belongs: impl Fn(u32, u32) -> bool,
    ) -> Vec<u32> {
        let mut seed_of = vec![Self::NO_SEED; self.starts_of_sides.len() / 3];
        let mut left = Vec::new();
        for seed in seeds {
            if seed_of[seed as usize] != Self::NO_SEED {
                continue;
            }
            seed_of[seed as usize] = seed;
            left.push(seed);
            while let Some(triangle) = left.pop() {
                for other in sides_of(triangle).into_iter().flat_map(|side| self.neighbours(side)) {
                    if seed_of[other as usize] == Self::NO_SEED && belongs(seed, other) {
                        seed_of[other as usize] = seed;
                        left.push(other);
                    }
                }
            }
        }
        seed_of
    }

    /// No triangle.
    pub(crate) const NO_SEED: u32 = u32::MAX;
}

impl MeshEdge<'_> {
    /// Other triangle of two at an edge, and their relative winding; `places` are the corners of all
    /// triangles.
    pub(crate) fn across(
        &self,
        side: TriangleSide,
        places: &[Option<[u32; 3]>],
    ) -> Option<(TriangleSide, Winding)> {
        let &[a, b] = self.sides else { return None };
        let start = |s: TriangleSide| places[s.triangle as usize].map(|places| places[usize::from(s.side)]);
        let winding = if start(a) == start(b) { Winding::Opposite } else { Winding::Alike };
        Some((if a == side { b } else { a }, winding))
    }
}

/// Places of corners, where bit-identical corners are one place.
pub(crate) fn exact_places(triangles_m: &[[DVec3; 3]]) -> Vec<Option<[u32; 3]>> {
    let places = Welding::Exact.places(triangles_m.as_flattened());
    places.as_chunks::<3>().0.iter().map(|corners| Some(*corners)).collect()
}

/// All three sides of a triangle.
pub(crate) fn sides_of(triangle: u32) -> [TriangleSide; 3] {
    [0, 1, 2].map(|side| TriangleSide { triangle, side })
}

/// Whole sides of non-zero length.
pub(crate) fn parts(places: &[Option<[u32; 3]>]) -> Vec<SidePart> {
    let of = |(triangle, corners): (u32, &Option<[u32; 3]>)| {
        let corners = *corners;
        let part = move |corners: [u32; 3]| {
            sides_of(triangle).map(|of| SidePart { ends: between(&corners, of.side), of }).into_iter()
        };
        corners.into_iter().flat_map(part)
    };
    (0..).zip(places).flat_map(of).filter(|part| part.ends[0] != part.ends[1]).collect()
}

/// Ends of a side, ascending.
fn between(corners: &[u32; 3], side: u8) -> [u32; 2] {
    let (a, b) = (corners[usize::from(side)], corners[(usize::from(side) + 1) % 3]);
    [a.min(b), a.max(b)]
}

fn slot(side: TriangleSide) -> usize {
    3 * side.triangle as usize + usize::from(side.side)
}

fn range(starts: &[u32], index: usize) -> Range<usize> {
    starts[index] as usize..starts[index + 1] as usize
}

/// Start of each slot in a list sorted by slot, and the end.
fn starts_by(slots: impl Iterator<Item = usize>, count: usize) -> Vec<u32> {
    let mut starts = vec![0; count + 1];
    slots.for_each(|slot| starts[slot + 1] += 1);
    (0..count).for_each(|i| starts[i + 1] += starts[i]);
    starts
}
