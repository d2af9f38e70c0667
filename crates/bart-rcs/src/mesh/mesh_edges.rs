//! Edges of a mesh by place, with the triangles at each.

/// A side of a triangle: edge `side` runs from corner `side` to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    pub(crate) triangle: u32,
    pub(crate) side: u8,
}

/// Two places and the triangles that have both.
#[derive(Debug, Clone)]
pub(crate) struct MeshEdge {
    /// Ascending.
    pub(crate) ends: [u32; 2],
    /// Ascending by triangle.
    pub(crate) sides: Vec<Side>,
}

/// All edges of a mesh, and those of each triangle.
pub(crate) struct MeshEdges {
    pub(crate) edges: Vec<MeshEdge>,
    /// Of side 0, 1, 2; `None` for a side without length and for triangles left out.
    pub(crate) of_triangle: Vec<[Option<u32>; 3]>,
}

impl MeshEdges {
    /// `places` are a triangle's corners; `None` leaves it out.
    pub(crate) fn of(places: &[Option<[u32; 3]>]) -> Self {
        let mut all: Vec<([u32; 2], Side)> = Vec::with_capacity(3 * places.len());
        for (triangle, corners) in (0..).zip(places) {
            let Some(corners) = corners else { continue };
            let sides = (0..3_u8).map(|side| (between(corners, side), Side { triangle, side }));
            all.extend(sides.filter(|(ends, _)| ends[0] != ends[1]));
        }
        all.sort_unstable();
        let mut of_triangle = vec![[None; 3]; places.len()];
        let mut edges = Vec::new();
        for group in all.chunk_by(|a, b| a.0 == b.0) {
            for (_, side) in group {
                of_triangle[side.triangle as usize][usize::from(side.side)] = Some(edges.len() as u32);
            }
            edges.push(MeshEdge { ends: group[0].0, sides: group.iter().map(|(_, side)| *side).collect() });
        }
        Self { edges, of_triangle }
    }
}

/// Ends of a side, ascending.
fn between(corners: &[u32; 3], side: u8) -> [u32; 2] {
    let (a, b) = (corners[usize::from(side)], corners[(usize::from(side) + 1) % 3]);
    [a.min(b), a.max(b)]
}
