//! A vehicle as binary glTF 2.0.

use crate::glb::{Buffer, container, extent, gltf_axes};
use crate::road_wheels::triangles_of_wheels;
use crate::vehicles::drawing::mesh_builder::Vehicle;
use artifact::scene::Mesh;
use serde_json::{Value, json};

/// A node and its mesh: the body, or a wheel.
struct Node {
    name: String,
    /// Triangles of the node, ascending.
    triangles: Vec<u32>,
}

/// Writes binary glTF: a node of the body and below it one of every road wheel, `Wheel_1` the left one in
/// front and so on to the rear; one mesh each in the vehicle's axes, one primitive per material, POSITION,
/// NORMAL and 32-bit indices, in glTF's axes (+Z forward, +X left, +Y up; (x, y, z) of the body is (z, x, y)
/// there). Equal vehicles give equal bytes, and the reader recognizes the wheels.
pub fn glb(vehicle: &Vehicle) -> Vec<u8> {
    let mesh = &vehicle.mesh;
    let mut buffer = Buffer::default();
    let nodes = nodes(vehicle);
    let meshes: Vec<Value> = nodes.iter().map(|node| mesh_of(&mut buffer, mesh, node)).collect();
    let materials: Vec<Value> = mesh.materials.iter().map(|name| material(name)).collect();
    let document = json!({
        "asset": { "version": "2.0", "generator": "wayside" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": described(&nodes),
        "meshes": meshes,
        "materials": materials,
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{ "byteLength": buffer.bytes.len() }],
    });
    container(document.to_string().into_bytes(), buffer.bytes)
}

/// The body's node, then the wheels'.
fn nodes(vehicle: &Vehicle) -> Vec<Node> {
    let Vehicle { mesh, is_of_wheel } = vehicle;
    let wheels = triangles_of_wheels(mesh, is_of_wheel);
    let mut is_of_body = vec![true; mesh.triangles.len()];
    wheels.iter().flatten().for_each(|triangle| is_of_body[*triangle as usize] = false);
    let triangles = (0..).zip(is_of_body).filter(|(_, is_of_body)| *is_of_body).map(|(t, _)| t).collect();
    let body = Node { name: mesh.name.clone(), triangles };
    let wheels =
        (1..).zip(wheels).map(|(number, triangles)| Node { name: format!("Wheel_{number}"), triangles });
    std::iter::once(body).chain(wheels).collect()
}

/// Nodes as JSON, the first above all others.
fn described(nodes: &[Node]) -> Vec<Value> {
    let mut all: Vec<Value> =
        nodes.iter().enumerate().map(|(number, node)| json!({ "mesh": number, "name": node.name })).collect();
    if nodes.len() > 1 {
        all[0]["children"] = (1..nodes.len()).collect();
    }
    all
}

fn mesh_of(buffer: &mut Buffer, mesh: &Mesh, node: &Node) -> Value {
    let primitives: Vec<Value> =
        (0..mesh.materials.len()).filter_map(|slot| primitive(buffer, mesh, node, slot)).collect();
    json!({ "name": node.name, "primitives": primitives })
}

/// Triangles of a node with one material; `None` if there are none, because accessors must not be empty.
fn primitive(buffer: &mut Buffer, mesh: &Mesh, node: &Node, slot: usize) -> Option<Value> {
    let is_of_slot = |t: &&u32| usize::from(mesh.material_of_triangle[**t as usize]) == slot;
    let corners: Vec<u32> =
        node.triangles.iter().filter(is_of_slot).flat_map(|t| mesh.triangles[*t as usize]).collect();
    if corners.is_empty() {
        return None;
    }
    let mut used = corners.clone();
    used.sort_unstable();
    used.dedup();
    let positions: Vec<[f32; 3]> =
        used.iter().map(|i| gltf_axes(mesh.vertices_m[*i as usize].map(|v| v as f32))).collect();
    let normals: Vec<[f32; 3]> = used.iter().map(|i| gltf_axes(mesh.normals[*i as usize])).collect();
    let position = buffer.vectors(&positions, Some(extent(&positions)));
    let normal = buffer.vectors(&normals, None);
    let indices = buffer.indices(corners.iter().map(|i| used.partition_point(|u| u < i) as u32));
    Some(json!({
        "attributes": { "POSITION": position, "NORMAL": normal },
        "indices": indices, "material": slot, "mode": 4,
    }))
}

/// A name and a display colour; only the name has a physical meaning.
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
