//! Ray caster of the references: obvhs finds candidates in single precision, hits are decided in double
//! precision.

use crate::aspect::PreparedAntenna;
use artifact::material::{Material, MeshMaterials, Transmission};
use artifact::scene::Mesh;
use artifact::settings::Sides;
use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, builder::build_bvh2};
use obvhs::ray::{Ray, RayHit};
use robust::{Coord3D, orient3d};
use std::time::Duration;

/// Reason that a reference computation cannot start.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReferenceError {
    /// A NaN or infinite coordinate, on which obvhs would panic.
    #[error("vertex {vertex} is not finite")]
    NotFinite {
        /// Index of the vertex.
        vertex: usize,
    },
    /// A triangle with a vertex index out of range.
    #[error("triangle {triangle} names vertex {vertex} of {vertices}")]
    IndexOutOfRange {
        /// Index of the triangle.
        triangle: usize,
        /// Vertex index used by it.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// An antenna within the body's circumscribed sphere: rays over the silhouette need a view from outside.
    #[error(
        "the antenna at {distance_m} m from the body's middle is inside its circumscribed sphere of {radius_m} m"
    )]
    AntennaInside {
        /// Distance from the antenna to the body's middle.
        distance_m: f64,
        /// Radius of the sphere.
        radius_m: f64,
    },
    /// A sheet with transmission, which the references do not model.
    #[error("material `{material}` is a sheet, and waves through sheets are for --method bart alone")]
    Transmission {
        /// Name of the material.
        material: String,
    },
    /// A permittivity with gain, or a layer without thickness.
    #[error(
        "material `{material}`: permittivities need a real part of 1 or more and no gain, layers a thickness"
    )]
    MaterialNotSound {
        /// Name of the material.
        material: String,
    },
    /// Sampling that would take too long.
    #[error(
        "{what}: one aspect would take {count:.1e} of them, at most {most:.0e} are allowed: ask for a lower density"
    )]
    TooMany {
        /// Name of what is counted.
        what: &'static str,
        /// Number of them that one aspect would take.
        count: f64,
        /// Largest number of them that one aspect may take.
        most: f64,
    },
    /// A density or frequency that is not positive and finite.
    #[error("{what} must be positive and finite, is {value}")]
    NotPositive {
        /// Name of the quantity.
        what: &'static str,
        /// Value of the quantity.
        value: f64,
    },
}

/// A triangle with its unit normal by winding.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Facet {
    pub(crate) corners_m: [DVec3; 3],
    pub(crate) normal: DVec3,
    /// Index of the triangle in the mesh.
    triangle: u32,
}

/// First facet hit by a ray.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hit {
    pub(crate) facet: u32,
    pub(crate) distance_m: f64,
}

/// A mesh for ray casting.
pub(crate) struct Body {
    pub(crate) facets: Vec<Facet>,
    pub(crate) centre_m: DVec3,
    pub(crate) radius_m: f64,
    bvh: Bvh2,
    touching_m: f64,
    makeup: MeshMaterials,
    slot_of_triangle: Vec<u16>,
}

/// Distance, as a share of the body's radius, within which facets count as touching: hit distances on
/// coincident facets differ by rounding, 1e-15 of it, while real gaps of vehicles are 1e-5 of it and more.
const TOUCHING: f64 = 1e-10;
/// Margin of boxes as a share of the radius. Single precision moves a box's side by 6e-8 and a ray of two
/// radii by 3e-7 of the radius (its start, its direction and obvhs's least direction component of 1.2e-7).
const BOX_MARGIN: f64 = 2e-6;

impl Body {
    pub(crate) fn of_mesh(mesh: &Mesh) -> Result<Self, ReferenceError> {
        check_materials(mesh)?;
        let facets = facets(mesh)?;
        let corners = || facets.iter().flat_map(|f| f.corners_m);
        let least = corners().fold(DVec3::INFINITY, DVec3::min);
        let most = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
        let centre_m = if facets.is_empty() { DVec3::ZERO } else { 0.5 * (least + most) };
        let radius_m = corners().fold(0.0, |r: f64, c| r.max(c.distance(centre_m)));
        let boxes: Vec<Aabb> = facets.iter().map(|f| inflated_box(f, centre_m, radius_m)).collect();
        let bvh = build_bvh2(&boxes, BvhBuildParams::fast_build(), &mut Duration::default());
        let touching_m = TOUCHING * radius_m;
        let (makeup, slot_of_triangle) = (mesh.makeup.clone(), mesh.material_of_triangle.clone());
        Ok(Self { facets, centre_m, radius_m, bvh, touching_m, makeup, slot_of_triangle })
    }

    /// Material of a facet; `None` for a perfect conductor.
    pub(crate) fn material(&self, facet: u32) -> Option<&Material> {
        let slot = *self.slot_of_triangle.get(self.facets[facet as usize].triangle as usize)?;
        Some(self.makeup.material(slot)).filter(|material| **material != Material::Conductor)
    }

    /// First facet hit beyond the touching zone by a ray from `origin_m` along unit `direction`, other than
    /// `left`; among coincident facets the one with the lowest index.
    pub(crate) fn nearest(&self, origin_m: DVec3, direction: DVec3, left: Option<u32>) -> Option<Hit> {
        // The single-precision ray starts where the line enters the circumscribed sphere, so that it stays
        // short.
        let skipped_m = ((self.centre_m - origin_m).dot(direction) - 1.01 * self.radius_m).max(0.0);
        let mut best: Option<Hit> = None;
        let ray = self.single_precision(origin_m + skipped_m * direction, direction, f32::INFINITY);
        self.bvh.ray_traverse(ray, &mut RayHit::none(), |_, slot| {
            let facet = self.bvh.primitive_indices[slot];
            if left == Some(facet) {
                return f32::INFINITY;
            }
            let Some(distance_m) = self.distance(origin_m, direction, facet) else { return f32::INFINITY };
            if distance_m <= self.touching_m && left.is_some() {
                return f32::INFINITY;
            }
            if best.is_none_or(|b| self.is_before(distance_m, facet, b)) {
                best = Some(Hit { facet, distance_m });
            }
            // Rounded up, so that boxes with facets at the same distance are still opened.
            (distance_m - skipped_m + BOX_MARGIN * self.radius_m) as f32
        });
        best
    }

    fn is_before(&self, distance_m: f64, facet: u32, than: Hit) -> bool {
        let ahead_m = than.distance_m - distance_m;
        ahead_m > self.touching_m || (ahead_m.abs() <= self.touching_m && facet < than.facet)
    }

    /// Whether the straight line from a point of `facet` to the antenna is unobstructed. A facet that touches
    /// the point hides it only if its index is lower, so that exactly one of coincident facets is lit.
    pub(crate) fn is_clear(&self, point_m: DVec3, facet: u32, post: &PreparedAntenna) -> bool {
        let leg = post.leg_from(point_m);
        let ray = self.single_precision(point_m, leg.towards, f32::INFINITY);
        self.bvh.ray_traverse_miss(ray, |_, slot| {
            let other = self.bvh.primitive_indices[slot];
            let hides = other != facet
                && self.distance(point_m, leg.towards, other).is_some_and(|distance_m| {
                    if distance_m > self.touching_m { distance_m < leg.length_m } else { other < facet }
                });
            if hides { 0.0 } else { f32::INFINITY }
        })
    }

    /// Whether `facet` scatters a wave travelling along `travel`, given the sides that scatter.
    pub(crate) fn scatters(&self, facet: u32, travel: DVec3, sides: Sides) -> bool {
        let cosine = self.facets[facet as usize].normal.dot(travel);
        match sides {
            Sides::Two => cosine != 0.0,
            Sides::One => cosine < 0.0,
        }
    }

    fn single_precision(&self, origin_m: DVec3, direction: DVec3, longest_m: f32) -> Ray {
        let start = (origin_m - self.centre_m).as_vec3();
        Ray::new(Vec3A::from(start), Vec3A::from(direction.as_vec3()), 0.0, longest_m)
    }

    /// Distance along the line to its intersection with a facet, from just behind the origin on.
    fn distance(&self, origin_m: DVec3, direction: DVec3, facet: u32) -> Option<f64> {
        let Facet { corners_m: [a, b, c], normal, .. } = self.facets[facet as usize];
        let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| side(origin_m, direction, from, to));
        let inside = sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0);
        if !inside {
            return None;
        }
        let distance_m = (a - origin_m).dot(normal) / direction.dot(normal);
        (distance_m >= -self.touching_m).then_some(distance_m)
    }
}

/// Side of the line from–to on which a ray passes: the sign is exact, so that no ray slips between the facets
/// at an edge or around a corner (rounded signs let rays aimed at corners pass).
fn side(origin_m: DVec3, direction: DVec3, from: DVec3, to: DVec3) -> f64 {
    let coordinates = |p: DVec3| Coord3D { x: p.x, y: p.y, z: p.z };
    let [origin, through, from, to] = [origin_m, origin_m + direction, from, to].map(coordinates);
    orient3d(origin, through, from, to)
}

fn check_materials(mesh: &Mesh) -> Result<(), ReferenceError> {
    let name = |slot: usize| mesh.materials.get(slot).cloned().unwrap_or_default();
    for (slot, material) in mesh.makeup.materials.iter().enumerate() {
        if !material.is_sound() {
            return Err(ReferenceError::MaterialNotSound { material: name(slot) });
        }
        if material.is_sheet() && mesh.makeup.transmission == Transmission::Followed {
            return Err(ReferenceError::Transmission { material: name(slot) });
        }
    }
    Ok(())
}

/// Facets of positive area, in the mesh's order.
fn facets(mesh: &Mesh) -> Result<Vec<Facet>, ReferenceError> {
    if let Some(vertex) = mesh.vertices_m.iter().position(|v| !v.iter().all(|c| c.is_finite())) {
        return Err(ReferenceError::NotFinite { vertex });
    }
    let mut facets = Vec::with_capacity(mesh.triangles.len());
    for (triangle, indices) in mesh.triangles.iter().enumerate() {
        let mut corners_m = [DVec3::ZERO; 3];
        for (corner, &vertex) in corners_m.iter_mut().zip(indices) {
            let vertices = mesh.vertices_m.len();
            let place = mesh.vertices_m.get(vertex as usize);
            *corner = place.copied().map(DVec3::from_array).ok_or(ReferenceError::IndexOutOfRange {
                triangle,
                vertex,
                vertices,
            })?;
        }
        let [a, b, c] = corners_m;
        facets.extend((b - a).cross(c - a).try_normalize().map(|normal| Facet {
            corners_m,
            normal,
            triangle: triangle as u32,
        }));
    }
    Ok(facets)
}

fn inflated_box(facet: &Facet, centre_m: DVec3, radius_m: f64) -> Aabb {
    let margin = DVec3::splat(BOX_MARGIN * radius_m);
    let [a, b, c] = facet.corners_m.map(|corner| corner - centre_m);
    let least = a.min(b).min(c) - margin;
    let most = a.max(b).max(c) + margin;
    Aabb::new(Vec3A::from(least.as_vec3()), Vec3A::from(most.as_vec3()))
}
