//! Meshes of a scene in their own axes, each with its hierarchy and facet data; rotating wheels are separate
//! meshes.

use crate::geometry::bvh::Hierarchy;
use crate::mesh::mesh_edges::{MeshEdges, exact_places};
use crate::mesh::neighbours::Neighbours;
use crate::mesh::patch::Patches;
use crate::mesh::wedges::body_edges::{BodyEdges, body_edges};
use crate::mesh::wedges::edge_band::{EdgeBand, PerBand};
use crate::run_control::error::BartError;
use crate::run_control::memory::MemoryLimit;
use crate::surface::skin::Skin;
use crate::surface::skin_triangles::SkinTriangles;
use artifact::material::{Material, MeshMaterials};
use artifact::scene::{Mesh, RoadWheel, SceneHeader, Target, TargetKind};
use artifact::settings::Wheels;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Meshes of a scene, each with its hierarchy, shared by all frames and poses.
#[derive(Clone)]
pub(crate) struct Models {
    /// Meshes of the scene, followed by those of rotating wheels.
    meshes: Vec<Arc<BodyMesh>>,
    /// Rotating wheels of each of the scene's meshes: index of the mesh and position of the hub.
    wheels: Vec<Vec<(u32, DVec3)>>,
    pub(crate) memory_limit: MemoryLimit,
}

impl Models {
    /// Builds all meshes of the header with the requested skin.
    pub(crate) fn build(header: &SceneHeader) -> Result<Self, BartError> {
        Self::build_with(header, skin(header))
    }

    /// Builds all meshes with a skin subdivided for this relative amplitude error.
    pub(crate) fn build_coarser(header: &SceneHeader, error: f64) -> Result<Self, BartError> {
        Self::build_with(header, skin(header).coarser(error))
    }

    /// Builds all meshes with a skin subdivided for an error `times` smaller.
    pub(crate) fn build_finer(header: &SceneHeader, times: f64) -> Result<Self, BartError> {
        Self::build_with(header, skin(header).finer(times))
    }

    /// Builds one of the meshes with a skin subdivided for this relative amplitude error.
    pub(crate) fn coarser_of(header: &SceneHeader, mesh: &Mesh, error: f64) -> Result<BodyMesh, BartError> {
        body_alone(header, mesh, skin(header).coarser(error))
    }

    /// Builds one of the meshes with a skin subdivided for an error `times` smaller.
    pub(crate) fn finer_of(header: &SceneHeader, mesh: &Mesh, times: f64) -> Result<BodyMesh, BartError> {
        body_alone(header, mesh, skin(header).finer(times))
    }

    fn build_with(header: &SceneHeader, skin: Skin) -> Result<Self, BartError> {
        let turning = |mesh: &Mesh| turns(header, mesh);
        let build = |mesh: &Mesh| body_alone(header, mesh, skin).map(Arc::new);
        let meshes = header.meshes.par_iter().map(build).collect::<Vec<_>>();
        let mut meshes = meshes.into_iter().collect::<Result<Vec<_>, _>>()?;
        let mut wheels = vec![];
        for mesh in header.meshes.iter() {
            let own = mesh.wheels.iter().filter(|_| turning(mesh));
            let first = meshes.len() as u32;
            wheels.push((first..).zip(own.clone().map(|wheel| DVec3::from_array(wheel.hub_m))).collect());
            for wheel in own {
                meshes.push(Arc::new(BodyMesh::of_wheel(mesh, wheel, skin)?));
            }
        }
        Ok(Self { meshes, wheels, memory_limit: MemoryLimit::NONE })
    }

    /// Rotating wheels of a target: index of the mesh and position of the hub.
    pub(crate) fn wheels_of(&self, target: &Target) -> impl Iterator<Item = (u32, DVec3)> {
        let of_mesh = match target.kind {
            TargetKind::Mesh { mesh, .. } => self.wheels.get(mesh as usize),
            TargetKind::Point { .. } => None,
        };
        of_mesh.into_iter().flatten().copied()
    }

    /// These models with a limit on the memory of a frame's bodies and beams.
    pub(crate) fn within(self, limit: MemoryLimit) -> Self {
        Self { memory_limit: limit, ..self }
    }

    /// The model of a target; `None` for a point.
    pub(crate) fn of(&self, target: &Target) -> Result<Option<Arc<BodyMesh>>, BartError> {
        let TargetKind::Mesh { mesh, .. } = target.kind else { return Ok(None) };
        let missing =
            || BartError::MeshOutOfRange { target: target.id.clone(), mesh, meshes: self.meshes.len() };
        self.meshes.get(mesh as usize).cloned().ok_or_else(missing).map(Some)
    }
}

/// Whether wheels of a mesh rotate.
fn turns(header: &SceneHeader, mesh: &Mesh) -> bool {
    header.fidelity.wheels == Wheels::Turning && !mesh.wheels.is_empty()
}

/// A mesh of a scene without its rotating wheels.
fn body_alone(header: &SceneHeader, mesh: &Mesh, skin: Skin) -> Result<BodyMesh, BartError> {
    match turns(header, mesh) {
        true => BodyMesh::without_wheels(mesh, skin),
        false => BodyMesh::build(mesh, skin),
    }
}

/// Skin requested by a scene.
fn skin(header: &SceneHeader) -> Skin {
    let (fidelity, wavelength_m) = (&header.fidelity, header.radar.waveform.wavelength_m());
    Skin::of(fidelity.surface, fidelity.accuracy, wavelength_m, fidelity.bounces)
}

/// A mesh in its body frame.
pub(crate) struct BodyMesh {
    pub(crate) skin: SkinTriangles,
    pub(crate) patches: Patches,
    pub(crate) neighbours: Neighbours,
    pub(crate) hierarchy: Hierarchy,
    edges: PerBand<BodyEdges>,
    /// Materials by slot, `None` for a perfect conductor; empty if all are perfect conductors.
    pub(crate) materials: Vec<Option<Arc<Material>>>,
    /// Material slots of the mesh's own triangles.
    slot_of_triangle: Vec<u16>,
    /// Rolling radius; `None` if it is not a wheel.
    pub(crate) rolls_on_m: Option<f64>,
}

impl BodyMesh {
    /// The mesh without rotating wheels; triangles keep their numbers.
    fn without_wheels(mesh: &Mesh, skin: Skin) -> Result<Self, BartError> {
        let turning: BTreeSet<u32> = mesh.wheels.iter().flat_map(|wheel| &wheel.triangles).copied().collect();
        let rest: Vec<u32> = (0..mesh.triangles.len() as u32).filter(|i| !turning.contains(i)).collect();
        Self::of_part(mesh, &rest, DVec3::ZERO, skin)
    }

    /// A wheel about its hub; triangles keep the mesh's numbers.
    fn of_wheel(mesh: &Mesh, wheel: &RoadWheel, skin: Skin) -> Result<Self, BartError> {
        let part = Self::of_part(mesh, &wheel.triangles, DVec3::from_array(wheel.hub_m), skin)?;
        Ok(Self { rolls_on_m: Some(wheel.radius_m), ..part })
    }

    /// A subset of a mesh's triangles, relative to another origin.
    fn of_part(mesh: &Mesh, triangles: &[u32], origin_m: DVec3, skin: Skin) -> Result<Self, BartError> {
        let none = || BartError::WheelNotSound { mesh: mesh.name.clone(), triangles: mesh.triangles.len() };
        let corners = |i: &u32| mesh.triangles.get(*i as usize).copied().ok_or_else(none);
        let from_origin = |v: &[f64; 3]| (DVec3::from_array(*v) - origin_m).to_array();
        let part = Mesh {
            triangles: triangles.iter().map(corners).collect::<Result<_, _>>()?,
            vertices_m: mesh.vertices_m.iter().map(from_origin).collect(),
            ..mesh.clone()
        };
        let mut built = Self::build(&part, skin)?;
        for triangle in &mut built.skin.triangle_of {
            *triangle = triangles[*triangle as usize];
        }
        Ok(built)
    }

    pub(crate) fn build(mesh: &Mesh, skin: Skin) -> Result<Self, BartError> {
        check_materials(mesh)?;
        // obvhs panics on infinite and accepts NaN coordinates; single precision ends at 3.4e38.
        let not_finite = |v: &[f64; 3]| v.iter().any(|x| !(*x as f32).is_finite());
        if let Some(vertex) = mesh.vertices_m.iter().position(not_finite) {
            return Err(BartError::VertexNotFinite { mesh: mesh.name.clone(), vertex });
        }
        let corners = |(index, triangle): (usize, &[u32; 3])| corners_of(mesh, index, triangle);
        let corners_m = mesh.triangles.iter().enumerate().map(corners).collect::<Result<Vec<_>, _>>()?;
        let skin = skin.triangles(mesh, corners_m);
        let hierarchy = || Hierarchy::over(skin.triangles_m.iter().copied());
        let (hierarchy, (patches, neighbours)) = rayon::join(hierarchy, || topology(&skin.triangles_m));
        Ok(Self {
            hierarchy,
            patches,
            neighbours,
            edges: PerBand::new(),
            materials: lossy_materials(&mesh.makeup),
            slot_of_triangle: mesh.material_of_triangle.clone(),
            rolls_on_m: None,
            skin,
        })
    }

    pub(crate) fn bytes(&self) -> usize {
        self.hierarchy.bytes() + self.neighbours.bytes() + self.skin.bytes()
    }

    pub(crate) fn material(&self, facet: u32) -> Option<&Arc<Material>> {
        let triangle = *self.skin.triangle_of.get(facet as usize)?;
        let slot = self.slot_of_triangle.get(triangle as usize)?;
        self.materials.get(usize::from(*slot))?.as_ref()
    }

    /// Whether some material of the mesh reflects by layers, with a phase that depends on frequency.
    pub(crate) fn has_layers(&self) -> bool {
        self.materials.iter().flatten().any(|material| matches!(**material, Material::Layers { .. }))
    }

    /// Diffracting edges in a band; `negligible_m`, a distance negligible for any of its waves, decides which
    /// seams are closed.
    pub(crate) fn edges(&self, band: EdgeBand, negligible_m: f64) -> &BodyEdges {
        let find = || body_edges(&self.skin.triangles_m, &self.skin.corner_normals, negligible_m);
        self.edges.get(band, &find)
    }
}

fn topology(triangles_m: &[[DVec3; 3]]) -> (Patches, Neighbours) {
    let places = exact_places(triangles_m);
    let edges = MeshEdges::of(&places);
    rayon::join(|| Patches::of(triangles_m, &edges), || Neighbours::of(&edges, &places))
}

fn check_materials(mesh: &Mesh) -> Result<(), BartError> {
    let wrong = |slot: usize| {
        let material = mesh.materials.get(slot).cloned().unwrap_or_default();
        Err(BartError::MaterialNotSound { mesh: mesh.name.clone(), material })
    };
    mesh.makeup.materials.iter().position(|material| !material.is_sound()).map_or(Ok(()), wrong)
}

fn lossy_materials(makeup: &MeshMaterials) -> Vec<Option<Arc<Material>>> {
    if makeup.is_perfect_conductor() {
        return Vec::new();
    }
    let lossy = |m: &Material| (*m != Material::Conductor).then(|| Arc::new(m.clone()));
    makeup.materials.iter().map(lossy).collect()
}

fn corners_of(mesh: &Mesh, index: usize, triangle: &[u32; 3]) -> Result<[DVec3; 3], BartError> {
    let mut corners_m = [DVec3::ZERO; 3];
    for (corner, &vertex) in corners_m.iter_mut().zip(triangle) {
        let vertices = mesh.vertices_m.len();
        let out_of_range =
            || BartError::VertexOutOfRange { mesh: mesh.name.clone(), triangle: index, vertex, vertices };
        *corner = DVec3::from_array(*mesh.vertices_m.get(vertex as usize).ok_or_else(out_of_range)?);
    }
    Ok(corners_m)
}
