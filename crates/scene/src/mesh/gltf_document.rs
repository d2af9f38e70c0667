//! Document of glTF 2.0. The `gltf` crate opens the container and types the JSON; every reference in the JSON
//! is checked here, because the crate's own validation and readers panic on damaged files.

use crate::mesh::error::{LocatedFault, MeshFault, MeshPlace};
use crate::mesh::gltf_accessor::Accessors;
use crate::mesh::gltf_buffers::{self, read_buffers};
use crate::mesh::gltf_json::check_values;
use crate::mesh::gltf_nodes::{Instance, instances};
use crate::mesh::part::{Part, check_count};
use glam::{DMat3, DVec3};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;
use gltf::json::{Root, deserialize};
use std::collections::BTreeMap;
use std::path::Path;
use std::rc::Rc;

/// Extensions that do not change the geometry.
const HARMLESS: [&str; 6] = [
    "KHR_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "KHR_lights_punctual",
    "KHR_xmp",
    "KHR_mesh_quantization",
];
const COMPRESSION: [&str; 3] =
    ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"];

/// Extensions that a file need not require although they determine the places of bodies.
const SHAPING: [&str; 2] = ["EXT_mesh_gpu_instancing", "KHR_node_visibility"];

pub(crate) fn read_glb(bytes: &[u8], path: &Path) -> Result<Vec<Part>, LocatedFault> {
    let (json, binary) =
        gltf_buffers::split_container(bytes).map_err(|fault| MeshPlace::File.fault(fault))?;
    read_document(&json, binary, path)
}

pub(crate) fn read_gltf(bytes: &[u8], path: &Path) -> Result<Vec<Part>, LocatedFault> {
    read_document(bytes, None, path)
}

fn read_document(json: &[u8], binary: Option<Vec<u8>>, path: &Path) -> Result<Vec<Part>, LocatedFault> {
    check_values(json).map_err(|fault| MeshPlace::File.fault(fault))?;
    let root: Root =
        deserialize::from_slice(json).map_err(|error| MeshPlace::File.fault(MeshFault::Json(error)))?;
    check_version(&root)
        .and_then(|()| check_extensions(&root))
        .map_err(|fault| MeshPlace::File.fault(fault))?;
    let buffers = read_buffers(&root, binary, path)?;
    let mut accessors = Accessors::new(&root, &buffers);
    let mut collector = PartCollector::default();
    for instance in instances(&root)? {
        read_mesh_instance(&root, &mut accessors, &instance, &mut collector)?;
    }
    Ok(collector.parts)
}

/// Parts gathered so far.
#[derive(Default)]
struct PartCollector {
    parts: Vec<Part>,
    triangles: usize,
    primitives: usize,
    /// Names of materials by their index.
    materials: BTreeMap<usize, Rc<str>>,
}

/// Largest number of primitives: four times that of the most detailed game scenes.
const PRIMITIVE_LIMIT: usize = 1 << 22;

fn check_version(root: &Root) -> Result<(), MeshFault> {
    let version = &root.asset.version;
    let found = || version.clone();
    if version.split('.').next() == Some("2") { Ok(()) } else { Err(MeshFault::Version { found: found() }) }
}

fn check_extensions(root: &Root) -> Result<(), MeshFault> {
    for name in &root.extensions_required {
        if COMPRESSION.contains(&name.as_str()) {
            return Err(MeshFault::Compressed(name.clone()));
        }
        if !HARMLESS.iter().any(|harmless| name.starts_with(harmless)) {
            return Err(MeshFault::Extension(name.clone()));
        }
    }
    let shaping = root.extensions_used.iter().find(|name| SHAPING.contains(&name.as_str()));
    shaping.map_or(Ok(()), |name| Err(MeshFault::Extension(name.clone())))
}

fn read_mesh_instance(
    root: &Root,
    accessors: &mut Accessors<'_>,
    instance: &Instance,
    collector: &mut PartCollector,
) -> Result<(), LocatedFault> {
    let mesh = &root.meshes[instance.mesh];
    if mesh.weights.iter().flatten().any(|weight| *weight != 0.0) {
        let place = MeshPlace::Primitive { mesh: instance.mesh, primitive: 0 };
        return Err(place.fault(MeshFault::Deformed("morph weights")));
    }
    for (primitive, content) in mesh.primitives.iter().enumerate() {
        let place = MeshPlace::Primitive { mesh: instance.mesh, primitive };
        collector.primitives += 1;
        if collector.primitives > PRIMITIVE_LIMIT {
            return Err(MeshPlace::File.fault(MeshFault::TooManyPrimitives { limit: PRIMITIVE_LIMIT }));
        }
        let material = collector.material(root, content).map_err(|fault| place.fault(fault))?;
        let Some(mut part) = read_primitive(accessors, instance, place, content, material)? else { continue };
        part.is_of_wheel |= instance.is_of_wheel;
        collector.triangles += part.triangles.len();
        check_count(collector.triangles)?;
        collector.parts.push(part);
    }
    Ok(())
}

/// Reads a primitive; `None` for points and lines, which have no area.
fn read_primitive(
    accessors: &mut Accessors<'_>,
    instance: &Instance,
    place: MeshPlace,
    primitive: &Primitive,
    material: Rc<str>,
) -> Result<Option<Part>, LocatedFault> {
    let Checked::Valid(mode) = primitive.mode else { return Err(place.fault(MeshFault::Mode)) };
    if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        return Ok(None);
    }
    let attribute = |name| primitive.attributes.get(&Checked::Valid(name)).map(|accessor| accessor.value());
    let positions = attribute(Semantic::Positions).ok_or_else(|| place.fault(MeshFault::NoPositions))?;
    let positions = accessors.vectors(place, positions)?;
    let normals =
        attribute(Semantic::Normals).map(|normals| accessors.vectors(place, normals)).transpose()?;
    if let Some(normals) = normals.as_ref().filter(|normals| normals.len() != positions.len()) {
        return Err(place.fault(MeshFault::NormalCount { normals: normals.len(), vertices: positions.len() }));
    }
    let corners = match primitive.indices {
        Some(indices) => accessors.indices(place, indices.value())?,
        None => (0..positions.len() as u32).collect(),
    };
    let triangles = triangles(mode, &corners).map_err(|fault| place.fault(fault))?;
    let part = Part::new(place, &positions, normals.as_deref().map(Vec::as_slice), triangles, material)?;
    Ok(Some(in_body_axes(part, instance)))
}

/// Triangles of a list, strip or fan of corners (glTF 2.0, 3.7.2.1).
fn triangles(mode: Mode, corners: &[u32]) -> Result<Vec<[u32; 3]>, MeshFault> {
    match mode {
        Mode::TriangleStrip => Ok(corners
            .windows(3)
            .enumerate()
            .map(|(i, w)| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[0], w[2], w[1]] })
            .collect()),
        Mode::TriangleFan => Ok(corners
            .iter()
            .skip(1)
            .zip(corners.iter().skip(2))
            .map(|(b, c)| [*b, *c, corners[0]])
            .collect()),
        _ if corners.len().is_multiple_of(3) => {
            Ok(corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect())
        }
        _ => Err(MeshFault::Corners(corners.len())),
    }
}

impl PartCollector {
    /// Name of a primitive's material, shared by all that have it; empty without one.
    fn material(&mut self, root: &Root, primitive: &Primitive) -> Result<Rc<str>, MeshFault> {
        let Some(index) = primitive.material.map(|material| material.value()) else {
            return Ok(Rc::default());
        };
        let count = root.materials.len();
        let material =
            root.materials.get(index).ok_or(MeshFault::NoSuch { what: "material", index, count })?;
        let name = || material.name.as_deref().unwrap_or_default().into();
        Ok(self.materials.entry(index).or_insert_with(name).clone())
    }
}

/// The part in body axes: glTF has +Z forward and +Y up, a body +x forward and +z up: (x, y, z)_body = (z, x,
/// y)_glTF. A mirroring transform reverses the winding, so that normals stay outward (glTF 2.0, 3.7.4).
fn in_body_axes(mut part: Part, instance: &Instance) -> Part {
    let body = |v: DVec3| DVec3::new(v.z, v.x, v.y);
    let linear = DMat3::from_mat4(instance.scene_from_mesh);
    let mirrors = linear.determinant() < 0.0;
    let normals = normals_matrix(linear);
    for vertex in &mut part.vertices {
        *vertex = body(instance.scene_from_mesh.transform_point3(*vertex));
    }
    for normal in part.normals.iter_mut().flatten() {
        *normal = body(normals * *normal);
    }
    if mirrors {
        part.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    }
    part
}

/// The inverse transpose up to a positive factor: the cofactors, which also exist for a singular transform.
fn normals_matrix(linear: DMat3) -> DMat3 {
    let [a, b, c] = [linear.x_axis, linear.y_axis, linear.z_axis];
    let cofactors = DMat3::from_cols(b.cross(c), c.cross(a), a.cross(b));
    if linear.determinant() < 0.0 { -cofactors } else { cofactors }
}
