//! A vehicle as binary glTF 2.0.

use artifact::scene::Mesh;
use serde_json::{Value, json};

/// Binary glTF: one node, one mesh, one primitive per material, POSITION, NORMAL and 32-bit indices, in glTF's axes
/// (+Z forward, +X left, +Y up; (x, y, z) of the body is (z, x, y) there). Equal meshes give equal bytes.
///
/// Needs what [`mesh`](super::mesh) gives: vertices ordered by material and not shared between materials, a normal each.
pub fn glb(mesh: &Mesh) -> Vec<u8> {
    let mut buffer = Buffer::default();
    let primitives: Vec<Value> = (0..mesh.materials.len()).map(|slot| buffer.primitive(mesh, slot)).collect();
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

/// glTF's component and target codes (glTF 2.0, §3.6.2.2 and §5.11).
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    fn primitive(&mut self, mesh: &Mesh, slot: usize) -> Value {
        let of_slot = mesh.triangles.iter().zip(&mesh.material_of_triangle).filter(|(_, m)| **m as usize == slot);
        let corners: Vec<u32> = of_slot.flat_map(|(t, _)| *t).collect();
        let first = corners.iter().copied().min().unwrap_or(0);
        let end = corners.iter().copied().max().map_or(0, |last| last + 1);
        let used = first as usize..end as usize;
        let positions: Vec<[f32; 3]> =
            mesh.vertices_m[used.clone()].iter().map(|p| gltf_axes(p.map(|v| v as f32))).collect();
        let normals: Vec<[f32; 3]> = mesh.normals[used].iter().map(|n| gltf_axes(*n)).collect();
        let position = self.vectors(&positions, Some(extent(&positions)));
        let normal = self.vectors(&normals, None);
        let indices = self.indices(corners.iter().map(|i| i - first));
        json!({ "attributes": { "POSITION": position, "NORMAL": normal }, "indices": indices, "material": slot, "mode": 4 })
    }

    fn vectors(&mut self, values: &[[f32; 3]], extent: Option<[[f32; 3]; 2]>) -> usize {
        let bytes = values.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
        let view = self.view(bytes, ARRAY_BUFFER);
        let mut accessor = json!({ "bufferView": view, "componentType": FLOAT, "count": values.len(), "type": "VEC3" });
        if let Some([low, high]) = extent {
            accessor["min"] = json!(low);
            accessor["max"] = json!(high);
        }
        self.accessor(accessor)
    }

    fn indices(&mut self, indices: impl Iterator<Item = u32>) -> usize {
        let bytes: Vec<u8> = indices.flat_map(u32::to_le_bytes).collect();
        let count = bytes.len() / 4;
        let view = self.view(bytes, ELEMENT_ARRAY_BUFFER);
        self.accessor(json!({ "bufferView": view, "componentType": UNSIGNED_INT, "count": count, "type": "SCALAR" }))
    }

    fn view(&mut self, bytes: Vec<u8>, target: u32) -> usize {
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len(), "target": target
        }));
        self.bytes.extend(bytes);
        self.views.len() - 1
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}

/// (x, y, z) in glTF is (y, z, x) of the body.
fn gltf_axes([x, y, z]: [f32; 3]) -> [f32; 3] {
    [y, z, x]
}

fn extent(positions: &[[f32; 3]]) -> [[f32; 3]; 2] {
    let fold =
        |start: f32, pick: fn(f32, f32) -> f32| [0, 1, 2].map(|k| positions.iter().map(|p| p[k]).fold(start, pick));
    [fold(f32::INFINITY, f32::min), fold(f32::NEG_INFINITY, f32::max)]
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

/// Header and two chunks, each padded to four bytes (glTF 2.0, §4.4).
fn container(mut document: Vec<u8>, mut bytes: Vec<u8>) -> Vec<u8> {
    document.resize(document.len().next_multiple_of(4), b' ');
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let total = 12 + 8 + document.len() + 8 + bytes.len();
    let mut file = Vec::with_capacity(total);
    file.extend(b"glTF");
    for word in [2, total as u32, document.len() as u32] {
        file.extend(word.to_le_bytes());
    }
    file.extend(b"JSON");
    file.extend(&document);
    file.extend((bytes.len() as u32).to_le_bytes());
    file.extend(b"BIN\0");
    file.extend(&bytes);
    file
}
