//! Assembly of the final mesh from parts: scaled to its dimensions, with smooth normals split at creases, in
//! single precision.

use crate::road_wheels::road_wheels;
use crate::vehicles::drawing::surface::{Material, Surface, Triangle};
use artifact::scene::{Mesh, MeshStatistics};
use glam::{DVec3, Vec3};
use std::collections::BTreeMap;

/// Cosine of the least angle between faces that makes an edge. The finest roundings have steps of at most
/// 30°.
const CREASE_COSINE: f64 = 0.766; // cos 40°

/// Least area of a facet; smaller ones are points rounded to single precision.
const SMALLEST_AREA_M2: f64 = 1e-8;

/// A vehicle, with a mark for its road wheels.
#[derive(Debug, Clone, PartialEq)]
pub struct Vehicle {
    /// Mesh in body axes.
    pub mesh: Mesh,
    /// Whether each triangle belongs to a road wheel, i.e. its tyre or the parts in it; `mesh.wheels` has
    /// those whose rotation is visible.
    pub is_of_wheel: Vec<bool>,
}

/// A vehicle as a list of parts; parts may intersect, and each has its own normals.
#[derive(Debug, Default)]
pub(crate) struct Assembly {
    parts: Vec<Surface>,
    /// Kind of each part.
    of: Vec<PartKind>,
}

/// Whether a part belongs to a road wheel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PartKind {
    Body,
    Wheel,
}

impl Assembly {
    /// Adds one more part.
    pub(crate) fn add(&mut self, part: Surface) {
        self.push(part, PartKind::Body);
    }

    /// Adds a part of the left side and its mirror image.
    pub(crate) fn add_pair(&mut self, part: Surface) {
        self.push(part.clone(), PartKind::Body);
        self.push(part.mirrored(), PartKind::Body);
    }

    /// Adds a part of a road wheel.
    pub(crate) fn add_of_wheel(&mut self, part: Surface) {
        self.push(part, PartKind::Wheel);
    }

    /// Adds a part of a road wheel on the left, and its mirror image on the right.
    pub(crate) fn add_pair_of_wheels(&mut self, part: Surface) {
        self.push(part.clone(), PartKind::Wheel);
        self.push(part.mirrored(), PartKind::Wheel);
    }

    /// Adds the parts of another assembly, each transformed by `change`.
    pub(crate) fn add_all(&mut self, other: Assembly, change: impl Fn(Surface) -> Surface) {
        self.parts.extend(other.parts.into_iter().map(change));
        self.of.extend(other.of);
    }

    fn push(&mut self, part: Surface, of: PartKind) {
        self.parts.push(part);
        self.of.push(of);
    }

    /// Parts added so far.
    #[cfg(test)]
    pub(crate) fn parts(&self) -> &[Surface] {
        &self.parts
    }

    /// Makes the vehicle, with a bounding box of exactly `size_m` (length, width, height) and the origin in
    /// the middle of that box on the ground.
    pub(crate) fn finish(self, name: &str, size_m: [f64; 3]) -> Vehicle {
        let parts = fitted(self.parts, DVec3::from_array(size_m));
        let mut output = Output::default();
        for (part, of) in parts.iter().zip(self.of) {
            output.add(part, of);
        }
        output.into_vehicle(name)
    }
}

/// Lowest and highest corner over all parts.
pub(crate) fn bounds_m(parts: &[Surface]) -> (DVec3, DVec3) {
    let used = parts.iter().flat_map(|p| p.triangles.iter().flat_map(|t| p.corners_m(t)));
    used.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
}

fn fitted(parts: Vec<Surface>, size_m: DVec3) -> Vec<Surface> {
    let (low, high) = bounds_m(&parts);
    let scale = size_m / (high - low);
    let ground = DVec3::new(0.5 * (low.x + high.x), 0.5 * (low.y + high.y), low.z);
    parts.into_iter().map(|part| part.map(|p| (p - ground) * scale)).collect()
}

/// One vertex: material, position and normal, by their bits, so that equal ones are shared.
type Key = (Material, [u32; 3], [u32; 3]);

#[derive(Default)]
struct Output {
    /// Triangles, with their kinds of part.
    by_material: BTreeMap<Material, Vec<([Key; 3], PartKind)>>,
}

impl Output {
    fn add(&mut self, part: &Surface, of: PartKind) {
        let part = &rounded(part);
        let around = triangles_around(part);
        let unit = |t: &Triangle| part.area_vector_m2(t).try_normalize().unwrap_or(DVec3::ZERO);
        let face_normals: Vec<DVec3> = part.triangles.iter().map(unit).collect();
        for (f, t) in part.triangles.iter().enumerate() {
            let corner = |i: u32| {
                let normal = corner_normal(part, &around[i as usize], &face_normals, f, i);
                (t.material, bits(part.points_m[i as usize]), bits(normal))
            };
            let triangle = (t.corners.map(corner), of);
            self.by_material.entry(t.material).or_default().push(triangle);
        }
    }

    fn into_vehicle(self, name: &str) -> Vehicle {
        let mut mesh = Mesh { name: name.to_owned(), ..Mesh::default() };
        let mut is_of_wheel = vec![];
        for (slot, (material, triangles)) in self.by_material.iter().enumerate() {
            mesh.materials.push(material.name().to_owned());
            let mut index_of = BTreeMap::new();
            for (corners, of) in triangles {
                is_of_wheel.push(*of == PartKind::Wheel);
                let triangle = corners.map(|key| {
                    *index_of.entry(key).or_insert_with(|| {
                        mesh.vertices_m.push(key.1.map(|b| f64::from(f32::from_bits(b))));
                        mesh.normals.push(key.2.map(f32::from_bits));
                        mesh.vertices_m.len() as u32 - 1
                    })
                });
                mesh.triangles.push(triangle);
                mesh.material_of_triangle.push(slot as u16);
            }
        }
        mesh.wheels = road_wheels(&mesh, &is_of_wheel);
        let triangles_read = mesh.triangles.len() as u64;
        mesh.statistics = MeshStatistics { triangles_read, degenerate: 0, open_edges: open_edges(&mesh) };
        Vehicle { mesh, is_of_wheel }
    }
}

/// The part with single-precision coordinates and without triangles that rounding degenerated.
fn rounded(part: &Surface) -> Surface {
    let part = part.clone().map(|p| p.as_vec3().as_dvec3()).welded();
    let has_area = |t: &Triangle| 0.5 * part.area_vector_m2(t).length() > SMALLEST_AREA_M2;
    let triangles = part.triangles.iter().copied().filter(has_area).collect();
    Surface { points_m: part.points_m, triangles }
}

fn triangles_around(part: &Surface) -> Vec<Vec<usize>> {
    let mut around = vec![Vec::new(); part.points_m.len()];
    for (f, t) in part.triangles.iter().enumerate() {
        for i in t.corners {
            around[i as usize].push(f);
        }
    }
    around
}

/// Mean of the normals of the faces around a point, except those separated from face `f` by a crease,
/// weighted by their angles there.
fn corner_normal(part: &Surface, around: &[usize], face_normals: &[DVec3], f: usize, point: u32) -> DVec3 {
    let smooth = around.iter().filter(|g| face_normals[**g].dot(face_normals[f]) > CREASE_COSINE);
    let weighted = smooth.map(|g| face_normals[*g] * angle_at(part, &part.triangles[*g], point));
    let sum = weighted.fold(DVec3::ZERO, |sum, n| sum + n);
    sum.try_normalize().unwrap_or(face_normals[f])
}

fn angle_at(part: &Surface, t: &Triangle, point: u32) -> f64 {
    let k = t.corners.iter().position(|i| *i == point).unwrap_or(0);
    let corners = part.corners_m(t);
    let (a, b) = (corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]);
    a.angle_between(b)
}

/// Bits of the single-precision vector, −0 as 0, so that equal vectors have equal bits.
fn bits(v: DVec3) -> [u32; 3] {
    let v: Vec3 = v.as_vec3();
    v.to_array().map(|c| (c + 0.0).to_bits())
}

/// Number of edges, by position, with only one triangle.
fn open_edges(mesh: &Mesh) -> u64 {
    let mut count: BTreeMap<[[u64; 3]; 2], u32> = BTreeMap::new();
    let at = |i: u32| mesh.vertices_m[i as usize].map(f64::to_bits);
    for [a, b, c] in &mesh.triangles {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let mut edge = [at(*p), at(*q)];
            edge.sort_unstable();
            *count.entry(edge).or_default() += 1;
        }
    }
    count.values().filter(|n| **n == 1).count() as u64
}
