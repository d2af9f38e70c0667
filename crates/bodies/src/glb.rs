//! The bytes of binary glTF 2.0, common to its writers.

use serde_json::{Value, json};

/// Component and target codes of glTF (glTF 2.0, §3.6.2.2 and §5.11).
const UNSIGNED_BYTE: u32 = 5121;
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// Bytes with their views and accessors.
#[derive(Default)]
pub(crate) struct Buffer {
    pub(crate) bytes: Vec<u8>,
    pub(crate) views: Vec<Value>,
    pub(crate) accessors: Vec<Value>,
}

impl Buffer {
    /// Adds a VEC3 accessor; positions require an extent.
    pub(crate) fn vectors(&mut self, values: &[[f32; 3]], extent: Option<[[f32; 3]; 2]>) -> usize {
        let bytes = values.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
        let view = self.view(bytes, ARRAY_BUFFER);
        let mut accessor =
            json!({ "bufferView": view, "componentType": FLOAT, "count": values.len(), "type": "VEC3" });
        if let Some([low, high]) = extent {
            accessor["min"] = json!(low);
            accessor["max"] = json!(high);
        }
        self.accessor(accessor)
    }

    pub(crate) fn indices(&mut self, indices: impl Iterator<Item = u32>) -> usize {
        let bytes: Vec<u8> = indices.flat_map(u32::to_le_bytes).collect();
        let count = bytes.len() / 4;
        let view = self.view(bytes, ELEMENT_ARRAY_BUFFER);
        self.accessor(
            json!({ "bufferView": view, "componentType": UNSIGNED_INT, "count": count, "type": "SCALAR" }),
        )
    }

    /// Adds colours in RGBA, a byte each.
    pub(crate) fn colours(&mut self, values: &[[u8; 4]]) -> usize {
        let view = self.view(values.concat(), ARRAY_BUFFER);
        let count = values.len();
        self.accessor(json!({
            "bufferView": view, "componentType": UNSIGNED_BYTE, "normalized": true,
            "count": count, "type": "VEC4"
        }))
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

/// Point of a body in the axes of glTF, where its (x, y, z) is (y, z, x).
pub(crate) fn gltf_axes([x, y, z]: [f32; 3]) -> [f32; 3] {
    [y, z, x]
}

/// Least and greatest corner.
pub(crate) fn extent(positions: &[[f32; 3]]) -> [[f32; 3]; 2] {
    let fold = |start: f32, pick: fn(f32, f32) -> f32| {
        [0, 1, 2].map(|k| positions.iter().map(|p| p[k]).fold(start, pick))
    };
    [fold(f32::INFINITY, f32::min), fold(f32::NEG_INFINITY, f32::max)]
}

/// A file of header and two chunks, each padded to four bytes (glTF 2.0, §4.4).
pub(crate) fn container(mut document: Vec<u8>, mut bytes: Vec<u8>) -> Vec<u8> {
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
