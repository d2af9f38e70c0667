//! A part of a mesh: checked triangles of one material with the vertices that they use.

use crate::mesh::error::{LocatedFault, MeshFault, MeshPlace};
use bodies::names_a_wheel;
use glam::DVec3;
use std::rc::Rc;

/// Largest number of triangles: 16 million take 2 GiB in the stages; the most detailed vehicle available has
/// 79 200.
const TRIANGLE_LIMIT: usize = 1 << 24;

/// Largest number of positions and normals: those of as many triangles that share none; a small file can
/// declare many accessors over the same bytes.
const VECTOR_LIMIT: usize = 6 * TRIANGLE_LIMIT;

/// Largest number of corners that a file may list before they are read.
pub(crate) const CORNER_LIMIT: u64 = 3 * TRIANGLE_LIMIT as u64;

/// Checks that so many positions and normals may be held.
pub(crate) fn check_vectors(vectors: usize) -> Result<(), MeshFault> {
    if vectors <= VECTOR_LIMIT { Ok(()) } else { Err(MeshFault::TooManyVectors { limit: VECTOR_LIMIT }) }
}

/// Checks that so many triangles may be read. Also called while parts are gathered: a small glTF can show one
/// mesh through many nodes.
pub(crate) fn check_count(triangles: usize) -> Result<(), LocatedFault> {
    if triangles <= TRIANGLE_LIMIT { Ok(()) } else { Err(too_many_triangles()) }
}

pub(crate) fn too_many_triangles() -> LocatedFault {
    MeshPlace::File.fault(MeshFault::TooManyTriangles { limit: TRIANGLE_LIMIT })
}

/// Triangles of one material in body axes and units of the file.
pub(crate) struct Part {
    pub vertices: Vec<DVec3>,
    /// Normals, one per vertex, of any length; `None` if the file stores none.
    pub normals: Option<Vec<DVec3>>,
    pub triangles: Vec<[u32; 3]>,
    /// Name of the material, shared by the parts that have it.
    pub material: Rc<str>,
    /// Whether a name indicates a road wheel.
    pub is_of_wheel: bool,
}

impl Part {
    /// Makes a part from the vertices that `triangles` use, in their order; everything finite, every index in
    /// range. A wheel is recognized only by the material's name at this point.
    pub(crate) fn new(
        place: MeshPlace,
        vertices: &[DVec3],
        normals: Option<&[DVec3]>,
        triangles: Vec<[u32; 3]>,
        material: Rc<str>,
    ) -> Result<Self, LocatedFault> {
        let used = used_vertices(&triangles);
        check_vertices(&used, vertices, normals).map_err(|fault| place.fault(fault))?;
        // Every index is in `used`: the search cannot fail.
        let renumber = |index: u32| used.binary_search(&index).unwrap_or(0) as u32;
        Ok(Self {
            vertices: used.iter().map(|&i| vertices[i as usize]).collect(),
            normals: normals.map(|normals| used.iter().map(|&i| normals[i as usize]).collect()),
            triangles: triangles.into_iter().map(|corners| corners.map(renumber)).collect(),
            is_of_wheel: names_a_wheel(&material),
            material,
        })
    }

    /// The same triangles with three vertices each and the facets' normals (glTF 2.0, 3.7.2.1: flat normals
    /// if none are given); a triangle without area gets none.
    pub(crate) fn with_flat_normals(self) -> Self {
        let corners: Vec<[DVec3; 3]> =
            self.triangles.iter().map(|corners| corners.map(|i| self.vertices[i as usize])).collect();
        let normals = corners.iter().flat_map(|[a, b, c]| [(b - a).cross(c - a); 3]).collect();
        Self {
            vertices: corners.iter().flatten().copied().collect(),
            normals: Some(normals),
            triangles: (0..corners.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
            material: self.material,
            is_of_wheel: self.is_of_wheel,
        }
    }
}

fn used_vertices(triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    used
}

fn check_vertices(used: &[u32], vertices: &[DVec3], normals: Option<&[DVec3]>) -> Result<(), MeshFault> {
    if let Some(&last) = used.last().filter(|&&last| last as usize >= vertices.len()) {
        return Err(MeshFault::VertexIndex { index: i64::from(last), vertices: vertices.len() });
    }
    for &i in used {
        let i = i as usize;
        if !vertices[i].is_finite() {
            return Err(MeshFault::Vertex(i));
        }
        if normals.is_some_and(|normals| !normals[i].is_finite()) {
            return Err(MeshFault::Normal(i));
        }
    }
    Ok(())
}
