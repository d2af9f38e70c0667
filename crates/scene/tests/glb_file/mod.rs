//! A small `.glb` made here, to be damaged and varied.

use serde_json::{Value, json};

/// JSON and binary chunk of a `.glb`.
#[derive(Clone)]
pub(crate) struct GlbFile {
    pub(crate) json: Value,
    pub(crate) binary: Vec<u8>,
}

impl GlbFile {
    /// A tetrahedron with corners at the origin and 1, 2, 3 m along x, y, z of glTF; indices of 16 bits,
    /// normals, a material, and a node that does nothing. Accessors: 0 positions, 1 normals, 2 indices.
    pub(crate) fn tetrahedron() -> Self {
        let mut file = Self { json: json!({ "asset": { "version": "2.0" } }), binary: vec![] };
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
        let normals = [[-0.6, 0.0, -0.8], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let faces = [[0_u16, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        file.json["bufferViews"] = json!([]);
        file.json["accessors"] = json!([]);
        file.add_accessor(floats(&positions), 4, 5126, "VEC3");
        file.add_accessor(floats(&normals), 4, 5126, "VEC3");
        file.add_accessor(
            faces.as_flattened().iter().flat_map(|i| i.to_le_bytes()).collect(),
            12,
            5123,
            "SCALAR",
        );
        file.json["materials"] = json!([{ "name": "paint" }]);
        file.json["meshes"] = json!([{ "primitives": [
            { "attributes": { "POSITION": 0, "NORMAL": 1 }, "indices": 2, "material": 0, "mode": 4 }] }]);
        file.json["nodes"] = json!([{ "mesh": 0 }]);
        file.json["scenes"] = json!([{ "nodes": [0] }]);
        file.json["scene"] = json!(0);
        file
    }

    /// Appends a view and an accessor on it; returns the accessor's index.
    pub(crate) fn add_accessor(&mut self, bytes: Vec<u8>, count: u64, component: u64, kind: &str) -> usize {
        let view = json!({ "buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len() });
        self.binary.extend(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        self.json["buffers"] = json!([{ "byteLength": self.binary.len() }]);
        let views = self.json["bufferViews"].as_array_mut().unwrap();
        views.push(view);
        let view = views.len() - 1;
        let accessors = self.json["accessors"].as_array_mut().unwrap();
        accessors
            .push(json!({ "bufferView": view, "componentType": component, "count": count, "type": kind }));
        accessors.len() - 1
    }

    /// The value at a JSON pointer, made where it is not.
    pub(crate) fn set(mut self, pointer: &str, value: Value) -> Self {
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        let parent = self.json.pointer_mut(parent).unwrap();
        match parent.as_array_mut() {
            Some(array) => array[key.parse::<usize>().unwrap()] = value,
            None => parent[key] = value,
        }
        self
    }

    /// Removes what stands at a JSON pointer.
    pub(crate) fn without(mut self, pointer: &str) -> Self {
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        self.json.pointer_mut(parent).unwrap().as_object_mut().unwrap().remove(key);
        self
    }

    /// The container (glTF 2.0, 4.4).
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let mut json = serde_json::to_vec(&self.json).unwrap();
        json.resize(json.len().next_multiple_of(4), b' ');
        let length = 12 + 8 + json.len() + 8 + self.binary.len();
        let chunk =
            |bytes: &[u8], kind: &[u8; 4]| [&(bytes.len() as u32).to_le_bytes()[..], kind, bytes].concat();
        let header = [&b"glTF"[..], &2_u32.to_le_bytes(), &(length as u32).to_le_bytes()].concat();
        [header, chunk(&json, b"JSON"), chunk(&self.binary, b"BIN\0")].concat()
    }
}

/// Vectors as 32-bit floats.
pub(crate) fn floats(vectors: &[[f32; 3]]) -> Vec<u8> {
    vectors.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect()
}
