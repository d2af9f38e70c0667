//! Files of glTF that cost more than they say.

use serde_json::{Value, json};

/// A triangle whose 36 bytes lie in that file.
pub(crate) fn beside(uri: &str) -> Vec<u8> {
    text(&document(json!([{ "byteLength": 36, "uri": uri }]), 36, 3, 1))
}

fn text(document: &Value) -> Vec<u8> {
    serde_json::to_vec(document).unwrap()
}

/// Buffers, one view of so many bytes, as many accessors of so many floats on it, a primitive for each.
fn document(buffers: Value, bytes: usize, count: usize, accessors: usize) -> Value {
    let accessor = json!({ "bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3" });
    let primitives: Vec<Value> = (0..accessors).map(|i| json!({ "attributes": { "POSITION": i } })).collect();
    json!({
        "asset": { "version": "2.0" }, "buffers": buffers,
        "bufferViews": [{ "buffer": 0, "byteLength": bytes }],
        "accessors": vec![accessor; accessors], "meshes": [{ "primitives": primitives }],
        "nodes": [{ "mesh": 0 }],
    })
}

/// `large.bin` beside them has 64 MiB.
pub(crate) fn expensive() -> Vec<Vec<u8>> {
    let large = |bytes: usize| json!({ "byteLength": bytes, "uri": "large.bin" });
    let (bytes, mut quantized) =
        (64 << 20, document(json!([large(64 << 20)]), 64 << 20, (64 << 20) / 3, 200));
    quantized["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    for accessor in quantized["accessors"].as_array_mut().unwrap() {
        accessor["componentType"] = json!(5121);
    }
    let mut instances = document(json!([large(36)]), 36, 3, 1);
    instances["meshes"][0]["primitives"] =
        json!(vec![json!({ "attributes": { "POSITION": 0 }, "mode": 1 }); 10_000]);
    instances["nodes"] = json!(vec![json!({ "mesh": 0 }); 10_000]);
    let mut names = document(json!([large(36)]), 36, 3, 1);
    names["materials"] = json!([{ "name": "x".repeat(1 << 20) }]);
    names["meshes"][0]["primitives"][0]["material"] = json!(0);
    names["nodes"] = json!(vec![json!({ "mesh": 0 }); 100_000]);
    let chain: Vec<Value> = (1..=100_000).map(|i| json!({ "children": [i % 100_000] })).collect();
    let mut circle = document(json!([large(36)]), 36, 3, 1);
    circle["nodes"] = json!(chain);
    let deep = format!("{{\"asset\":{{\"version\":\"2.0\",\"extras\":{}", "[".repeat(1 << 20));
    vec![
        text(&document(json!(vec![large(bytes); 1000]), bytes, 3, 1)),
        text(&document(json!([large(1 << 40)]), 36, 3, 1)),
        text(&quantized),
        text(&instances),
        text(&names),
        text(&circle),
        deep.into_bytes(),
        format!("{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{}{{}}]}}", "{},".repeat(3_000_000))
            .into_bytes(),
        text(&document(json!([{ "byteLength": 36, "uri": "/etc/passwd" }]), 36, 3, 1)),
        text(&document(
            json!([{ "byteLength": 36, "uri": "h.gltf/../../../../../../../../dev/zero" }]),
            36,
            3,
            1,
        )),
        text(&document(json!([{ "byteLength": 36, "uri": "." }]), 36, 3, 1)),
        text(&document(json!([{ "byteLength": 36, "uri": "b%00.bin" }]), 36, 3, 1)),
        text(&document(
            json!([{ "byteLength": 36, "uri": format!("data:;base64,{}", "=".repeat(1 << 20)) }]),
            36,
            3,
            1,
        )),
        text(&document(json!([]), 36, 3, 1)),
        text(&json!({ "asset": { "version": "3.0" } })),
        text(&json!({ "asset": { "version": "2.0" }, "nodes": [{ "children": [0] }] })),
    ]
}

/// Binary files whose heads tell lengths that are not there.
pub(crate) fn chunks() -> Vec<Vec<u8>> {
    let json = br#"{"asset":{"version":"2.0"}} "#;
    let file = |total: u32, length: u32, kind: &[u8]| {
        [b"glTF", &2_u32.to_le_bytes()[..], &total.to_le_bytes(), &length.to_le_bytes(), kind, json].concat()
    };
    let size = json.len() as u32;
    [0, 1, 11, 12, 13, 19, 20, 20 + size, 21 + size, 1 << 30, u32::MAX]
        .into_iter()
        .flat_map(|total| {
            [0, 1, size, size + 1, u32::MAX - 3, u32::MAX].map(|length| file(total, length, b"JSON"))
        })
        .chain([file(20 + size, size, b"BIN\0"), file(20 + size, size, b"\xff\xff\xff\xff")])
        .collect()
}
