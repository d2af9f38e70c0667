//! Joins parts into one mesh: triangles without area dropped, size checked, open edges counted, nothing
//! welded.

use crate::mesh::error::{LocatedFault, MeshFault, MeshPlace};
use crate::mesh::format::MeshOptions;
use crate::mesh::part::{Part, check_count};
use artifact::material::MeshMaterials;
use artifact::scene::{Mesh, MeshStatistics};
use bodies::road_wheels;
use glam::DVec3;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::rc::Rc;

/// Sizes of models assumed to be in metres.
const SIZES_M: std::ops::RangeInclusive<f64> = 1e-3..=1e3;

pub(crate) fn assemble(name: String, parts: Vec<Part>, options: &MeshOptions) -> Result<Mesh, LocatedFault> {
    let refuse = |fault| MeshPlace::File.fault(fault);
    let triangles_read: usize = parts.iter().map(|part| part.triangles.len()).sum();
    check_count(triangles_read)?;
    let mut builder = MeshBuilder::default();
    let any_normals = parts.iter().any(|part| part.normals.is_some());
    for part in parts {
        let part = if any_normals && part.normals.is_none() { part.with_flat_normals() } else { part };
        builder.append(part, options.unit_scale.unwrap_or(1.0)).map_err(refuse)?;
    }
    let degenerate = builder.drop_degenerate();
    if builder.triangles.is_empty() {
        return Err(refuse(MeshFault::NoTriangles { degenerate }));
    }
    builder.drop_unused_vertices();
    let mut mesh = builder.into_mesh(name);
    check_size(&mesh, options).map_err(refuse)?;
    mesh.statistics =
        MeshStatistics { triangles_read: triangles_read as u64, degenerate, open_edges: open_edges(&mesh) };
    Ok(mesh)
}

#[derive(Default)]
struct MeshBuilder {
    vertices: Vec<DVec3>,
    normals: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    material_of_triangle: Vec<u16>,
    /// Whether each triangle belongs to a road wheel.
    are_of_wheels: Vec<bool>,
    materials: Vec<String>,
    /// Indices of materials in the list, by name.
    known: HashMap<Rc<str>, u16>,
}

impl MeshBuilder {
    fn append(&mut self, part: Part, scale: f64) -> Result<(), MeshFault> {
        let first = self.vertices.len() as u32;
        let material = self.material(part.material)?;
        self.vertices.extend(part.vertices.iter().map(|vertex| *vertex * scale));
        self.normals.extend(part.normals.unwrap_or_default());
        self.triangles.extend(part.triangles.iter().map(|corners| corners.map(|i| first + i)));
        self.material_of_triangle.resize(self.triangles.len(), material);
        self.are_of_wheels.resize(self.triangles.len(), part.is_of_wheel);
        Ok(())
    }

    fn material(&mut self, name: Rc<str>) -> Result<u16, MeshFault> {
        let next = u16::try_from(self.materials.len());
        match self.known.entry(name) {
            Entry::Occupied(known) => Ok(*known.get()),
            Entry::Vacant(new) => {
                self.materials.push(new.key().to_string());
                next.map(|index| *new.insert(index)).map_err(|_| MeshFault::TooManyMaterials)
            }
        }
    }

    fn drop_degenerate(&mut self) -> u64 {
        let keep: Vec<bool> =
            self.triangles.iter().map(|corners| has_area(self.corners_m(corners))).collect();
        let mut kept = keep.iter();
        self.triangles.retain(|_| *kept.next().unwrap_or(&true));
        let mut kept = keep.iter();
        self.material_of_triangle.retain(|_| *kept.next().unwrap_or(&true));
        let mut kept = keep.iter();
        self.are_of_wheels.retain(|_| *kept.next().unwrap_or(&true));
        keep.iter().filter(|keep| !**keep).count() as u64
    }

    fn corners_m(&self, corners: &[u32; 3]) -> [DVec3; 3] {
        corners.map(|i| self.vertices[i as usize])
    }

    fn drop_unused_vertices(&mut self) {
        const UNUSED: u32 = u32::MAX;
        let mut new_index = vec![UNUSED; self.vertices.len()];
        self.triangles.iter().flatten().for_each(|&i| new_index[i as usize] = 0);
        let used: Vec<usize> = (0..new_index.len()).filter(|&i| new_index[i] != UNUSED).collect();
        used.iter().zip(0..).for_each(|(&old, new)| new_index[old] = new);
        self.vertices = used.iter().map(|&i| self.vertices[i]).collect();
        if !self.normals.is_empty() {
            self.normals = used.iter().map(|&i| self.normals[i]).collect();
        }
        self.triangles.iter_mut().flatten().for_each(|i| *i = new_index[*i as usize]);
    }

    /// Replaces stored normals of length zero by the area-weighted sum of the facets' normals.
    fn fill_empty_normals(&mut self) {
        let empty: Vec<bool> = self.normals.iter().map(|normal| normal.try_normalize().is_none()).collect();
        for corners in &self.triangles {
            let [a, b, c] = self.corners_m(corners);
            let area = (b - a).cross(c - a);
            for &i in corners.iter().filter(|&&i| empty.get(i as usize) == Some(&true)) {
                self.normals[i as usize] += area;
            }
        }
    }

    fn into_mesh(mut self, name: String) -> Mesh {
        self.fill_empty_normals();
        // Facets that cancel exactly leave no direction, so up is chosen.
        let unit = |normal: &DVec3| normal.try_normalize().unwrap_or(DVec3::Z).as_vec3().into();
        let mut mesh = Mesh {
            name,
            vertices_m: self.vertices.iter().map(|vertex| (*vertex).into()).collect(),
            normals: self.normals.iter().map(unit).collect(),
            triangles: self.triangles,
            material_of_triangle: self.material_of_triangle,
            materials: self.materials,
            makeup: MeshMaterials::default(),
            wheels: vec![],
            statistics: MeshStatistics::default(),
        };
        mesh.wheels = road_wheels(&mesh, &self.are_of_wheels);
        mesh
    }
}

/// Whether a triangle's area exceeds the rounding error of zero. Each coordinate carries an error of up to
/// ε/2·|x| from its transform and ε·|x| from the difference, so the doubled area of collinear corners stays
/// below 2·√3·(3/2)·ε·|x|·edge < 8·ε·|x|·edge.
fn has_area([a, b, c]: [DVec3; 3]) -> bool {
    let farthest = a.abs().max(b.abs()).max(c.abs()).max_element();
    let longest = (b - a).length().max((c - a).length()).max((c - b).length());
    (b - a).cross(c - a).length() > 8.0 * f64::EPSILON * farthest * longest
}

fn check_size(mesh: &Mesh, options: &MeshOptions) -> Result<(), MeshFault> {
    let [low, high] = mesh.bounds_m().map(DVec3::from);
    let size_m = (high - low).max_element();
    let (least_m, most_m) = match options.unit_scale {
        None => (*SIZES_M.start(), *SIZES_M.end()),
        // Any size at a requested scale, as long as its squares are finite.
        Some(_) => (1e-100, 1e100),
    };
    if (least_m..=most_m).contains(&size_m) {
        Ok(())
    } else {
        Err(MeshFault::Size { size_m, least_m, most_m })
    }
}

/// Number of edges with only one triangle; corners are equal if their positions are.
fn open_edges(mesh: &Mesh) -> u64 {
    let place = first_at_each_position(&mesh.vertices_m);
    let edge = |a: u32, b: u32| {
        let (a, b) = (place[a as usize], place[b as usize]);
        (a.min(b), a.max(b))
    };
    let mut edges: Vec<(u32, u32)> =
        mesh.triangles.iter().flat_map(|&[a, b, c]| [edge(a, b), edge(b, c), edge(c, a)]).collect();
    edges.sort_unstable();
    edges.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).count() as u64
}

/// First vertex, in the order of positions, at the same place, for each vertex.
fn first_at_each_position(vertices_m: &[[f64; 3]]) -> Vec<u32> {
    // Adding zero makes the bits of −0 equal to those of +0.
    let key = |i: u32| vertices_m[i as usize].map(|x| (x + 0.0).to_bits());
    let mut order: Vec<u32> = (0..vertices_m.len() as u32).collect();
    order.sort_unstable_by_key(|&i| (key(i), i));
    let mut place = vec![0; vertices_m.len()];
    for same in order.chunk_by(|&a, &b| key(a) == key(b)) {
        same.iter().for_each(|&i| place[i as usize] = same[0]);
    }
    place
}
