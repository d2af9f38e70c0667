//! A vehicle as binary glTF 2.0.

use crate::glb::{Buffer, container, extent, gltf_axes};
use artifact::scene::Mesh;
use serde_json::{Value, json};

/// Binary glTF: one node, one mesh, one primitive per material, POSITION, NORMAL and 32-bit indices, in
/// glTF's axes (+Z forward, +X left, +Y up; (x, y, z) of the body is (z, x, y) there). Equal meshes give
/// equal bytes.
///
/// Needs what [`mesh`](crate::vehicles::catalogue::mesh) gives: vertices ordered by material and not
/// shared between materials, a normal each.
pub fn glb(mesh: &Mesh) -> Vec<u8> {
    let mut buffer = Buffer::default();
    let primitives: Vec<Value> =
        (0..mesh.materials.len()).map(|slot| primitive(&mut buffer, mesh, slot)).collect();
    let materials: Vec<Value> = mesh.materials.iter().map(|name| material(name)).collect();
    let document = json!({
        "asset": { "version": "2.0", "generator": "wayside" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "name": mesh.name }],
        "meshes": [{ "name": mesh.name, "primitives": primitives }],
        "materials": materials,
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{ "byteLength": buffer.bytes.len() }],
    });
    container(document.to_string().into_bytes(), buffer.bytes)
}

fn primitive(buffer: &mut Buffer, mesh: &Mesh, slot: usize) -> Value {
    let of_slot = mesh.triangles.iter().zip(&mesh.material_of_triangle).filter(|(_, m)| **m as usize == slot);
    let corners: Vec<u32> = of_slot.flat_map(|(t, _)| *t).collect();
    let first = corners.iter().copied().min().unwrap_or(0);
    let end = corners.iter().copied().max().map_or(0, |last| last + 1);
    let used = first as usize..end as usize;
    let positions: Vec<[f32; 3]> =
        mesh.vertices_m[used.clone()].iter().map(|p| gltf_axes(p.map(|v| v as f32))).collect();
    let normals: Vec<[f32; 3]> = mesh.normals[used].iter().map(|n| gltf_axes(*n)).collect();
    let position = buffer.vectors(&positions, Some(extent(&positions)));
    let normal = buffer.vectors(&normals, None);
    let indices = buffer.indices(corners.iter().map(|i| i - first));
    json!({ "attributes": { "POSITION": position, "NORMAL": normal }, "indices": indices, "material": slot, "mode": 4 })
}

/// A name and a colour to look at; nothing physical is read from either but the name.
fn material(name: &str) -> Value {
    let (colour, metallic, roughness) = match name {
        "paint" => ([0.55, 0.08, 0.07], 0.3, 0.35),
        "glass" => ([0.05, 0.08, 0.10], 0.0, 0.05),
        "rubber" => ([0.02, 0.02, 0.02], 0.0, 0.9),
        "steel" => ([0.20, 0.21, 0.22], 0.8, 0.5),
        "aluminium" => ([0.62, 0.63, 0.65], 0.9, 0.35),
        "chrome" => ([0.80, 0.80, 0.82], 1.0, 0.1),
        "plastic" => ([0.05, 0.05, 0.055], 0.0, 0.6),
        "lamp" => ([0.90, 0.90, 0.80], 0.0, 0.1),
        "tail_lamp" => ([0.60, 0.02, 0.02], 0.0, 0.2),
        "plate" => ([0.85, 0.85, 0.75], 0.0, 0.5),
        "fabric" => ([0.07, 0.10, 0.22], 0.0, 0.9),
        _ => ([0.12, 0.07, 0.04], 0.0, 0.7),
    };
    let [r, g, b] = colour;
    json!({ "name": name, "pbrMetallicRoughness": {
        "baseColorFactor": [r, g, b, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness } })
}
