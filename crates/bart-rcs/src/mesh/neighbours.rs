//! Neighbours of triangles: those with which a surface continues beyond each side.

use crate::mesh::mesh_edges::{MeshEdges, Winding};

/// Neighbour of every side of every triangle.
#[derive(Debug, Default)]
pub(crate) struct Neighbours {
    across: Vec<[u32; 3]>,
    /// Bit i of each triangle: the neighbour across side i has the opposite winding.
    opposite: Vec<u8>,
}

const NONE: u32 = u32::MAX;

impl Neighbours {
    /// Neighbours at edges of exactly two triangles; `places` are the corners of all.
    pub(crate) fn of(edges: &MeshEdges, places: &[Option<[u32; 3]>]) -> Self {
        let mut neighbours = Self { across: vec![[NONE; 3]; places.len()], opposite: vec![0; places.len()] };
        for edge in edges.iter() {
            for &side in edge.sides {
                let Some((other, winding)) = edge.across(side, places) else { continue };
                let (triangle, place) = (side.triangle as usize, usize::from(side.side));
                neighbours.across[triangle][place] = other.triangle;
                neighbours.opposite[triangle] |= u8::from(winding == Winding::Opposite) << place;
            }
        }
        neighbours
    }

    /// Triangle across a side and its winding; `None` if there is none or several.
    pub(crate) fn across(&self, triangle: u32, side: usize) -> Option<(u32, Winding)> {
        let other = self.across[triangle as usize][side];
        let is_opposite = self.opposite[triangle as usize] >> side & 1 == 1;
        (other != NONE).then_some((other, if is_opposite { Winding::Opposite } else { Winding::Alike }))
    }

    /// Approximate memory, bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.across.len() * (size_of::<[u32; 3]>() + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_an_edge_of_two_triangles_has_a_neighbour_and_both_say_how_they_are_wound() {
        // Two at 1–2 with equal winding, one of them at 2–3 with a reversed one; three meet at 3–4.
        let triangles = [[0, 1, 2], [2, 1, 3], [2, 3, 4], [3, 4, 5], [4, 3, 6]];
        let places = triangles.map(Some);
        let neighbours = Neighbours::of(&MeshEdges::of(&places), &places);
        assert_eq!(neighbours.across(0, 1), Some((1, Winding::Alike)));
        assert_eq!(neighbours.across(1, 0), Some((0, Winding::Alike)));
        assert_eq!(neighbours.across(2, 0), Some((1, Winding::Alike)));
        let turned = [[0, 1, 2], [1, 2, 3]].map(Some);
        let both = Neighbours::of(&MeshEdges::of(&turned), &turned);
        assert_eq!(
            [both.across(0, 1), both.across(1, 0)],
            [Some((1, Winding::Opposite)), Some((0, Winding::Opposite))]
        );
        assert_eq!([neighbours.across(0, 0), neighbours.across(2, 1), neighbours.across(3, 0)], [None; 3]);
    }
}
