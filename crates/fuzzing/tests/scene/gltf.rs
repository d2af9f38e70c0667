//! Fuzzed glTF, changed by its structure: values of its JSON, numbers of its arrays, lengths and kinds of its
//! chunks.

#[path = "../../../scene/tests/glb_file/mod.rs"]
pub(crate) mod glb_file;

use fuzzing::{FuzzRng, mutate_json, mutate_word32};
use glb_file::{GlbFile, floats};
use serde_json::{Value, json};

/// Sound files that reach every branch of the reader.
pub(crate) fn corpus() -> Vec<GlbFile> {
    let plain = GlbFile::tetrahedron();
    let nodes = json!([
        { "children": [1, 2], "translation": [1, 2, 3] },
        { "mesh": 0, "rotation": [0, 0.6, 0, 0.8], "scale": [1, -2, 1] },
        { "children": [3], "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 0, 0, 1] },
        { "mesh": 0 }]);
    let mut sparse = plain.clone();
    let indices = sparse.add_accessor(vec![1, 3], 2, 5121, "SCALAR");
    let values = sparse.add_accessor(floats(&[[4.0, 0.0, 0.0], [0.0, 0.0, 4.0]]), 2, 5126, "VEC3");
    let indices = json!({ "bufferView": indices, "componentType": 5121 });
    let replaced = json!({ "count": 2, "indices": indices, "values": { "bufferView": values } });
    let mut strip = plain.clone();
    let corners = strip.add_accessor(
        [0_u32, 1, 2, 3].iter().flat_map(|i| i.to_le_bytes()).collect(),
        4,
        5125,
        "SCALAR",
    );
    let strip = strip
        .set("/meshes/0/primitives/0/indices", json!(corners))
        .set("/meshes/0/primitives/0/mode", json!(5));
    let mut quantized = plain.clone();
    let positions =
        quantized.add_accessor(vec![0, 0, 0, 0, 9, 0, 0, 0, 0, 9, 0, 0, 0, 0, 9, 0], 4, 5120, "VEC3");
    let quantized = quantized
        .set("/meshes/0/primitives/0/attributes/POSITION", json!(positions))
        .set("/extensionsUsed", json!(["KHR_mesh_quantization"]));
    let fan =
        strip.clone().without("/meshes/0/primitives/0/indices").set("/meshes/0/primitives/0/mode", json!(6));
    vec![
        plain.clone().set("/nodes", nodes),
        plain,
        sparse.set("/accessors/0/sparse", replaced),
        strip,
        fan,
        quantized,
    ]
}

/// A binary file, changed.
pub(crate) fn binary(rng: &mut FuzzRng) -> Vec<u8> {
    let mut file = any(rng);
    for _ in 0..rng.below(4) {
        mutate_json(rng, &mut file.json, &WORDS, strange);
    }
    for _ in 0..rng.below(3) {
        mutate_word32(rng, &mut file.binary);
    }
    let mut bytes = file.bytes();
    if rng.one_in(4) {
        change_chunks(rng, &mut bytes);
    }
    bytes
}

/// The JSON of a file whose buffer lies beside it as `b.bin`, in its JSON, or nowhere; and that buffer.
pub(crate) fn beside(rng: &mut FuzzRng) -> (Vec<u8>, Vec<u8>) {
    const URIS: [&str; 10] = [
        "b.bin",
        "./b.bin",
        "b%2ebin",
        "../b.bin",
        "",
        "%",
        "/dev/null",
        "data:application/octet-stream;base64,AAAA",
        "http://example.invalid/b.bin",
        ".",
    ];
    let mut file = any(rng);
    let uri = if rng.one_in(3) { rng.choose(&URIS) } else { "b.bin" };
    file.json["buffers"][0]["uri"] = json!(uri);
    for _ in 0..=rng.below(3) {
        mutate_json(rng, &mut file.json, &WORDS, strange);
    }
    if rng.one_in(3) {
        mutate_word32(rng, &mut file.binary);
        file.binary.truncate(rng.below(2 * file.binary.len()));
    }
    (serde_json::to_vec(&file.json).unwrap(), file.binary)
}

fn any(rng: &mut FuzzRng) -> GlbFile {
    let files = corpus();
    files[rng.below(files.len())].clone()
}

const WORDS: [&str; 14] = [
    "uri",
    "byteOffset",
    "byteStride",
    "sparse",
    "mode",
    "indices",
    "children",
    "matrix",
    "scale",
    "rotation",
    "skin",
    "weights",
    "extensionsRequired",
    "normalized",
];

fn strange(rng: &mut FuzzRng) -> Value {
    let small = rng.below(12);
    match rng.below(12) {
        0..=3 => json!(small),
        4 => json!(5120 + small),
        5 => serde_json::from_str(&rng.number_text()).unwrap_or(Value::Null),
        6 => (0..rng.repeat_count().min(100)).fold(json!(small), |inner, _| json!([inner])),
        7 => json!([small, small, small]),
        8 => json!({ "POSITION": small, "NORMAL": small }),
        9 => json!("x".repeat(rng.repeat_count())),
        10 => json!([u32::MAX, -1, 1e300, null]),
        _ => json!(rng.choose(&[
            "VEC3",
            "SCALAR",
            "MAT4",
            "2.0",
            "KHR_draco_mesh_compression",
            "data:;base64,AAA="
        ])),
    }
}

/// Lengths, kinds, order and number of the chunks.
fn change_chunks(rng: &mut FuzzRng, bytes: &mut Vec<u8>) {
    let json_bytes = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
    let heads = [4, 8, 12, 16, 20 + json_bytes, 24 + json_bytes];
    let head = heads[rng.below(heads.len())];
    match rng.below(4) {
        0 => bytes.truncate(rng.below(bytes.len())),
        1 => bytes.extend_from_within(20 + json_bytes..),
        2 => bytes[12..].rotate_left(8 + json_bytes),
        _ => {
            let known = u32::from_le_bytes([bytes[head], bytes[head + 1], bytes[head + 2], bytes[head + 3]]);
            let near = known.wrapping_add(rng.below(9) as u32).wrapping_sub(4);
            let word = [near, u32::MAX, 0, rng.next_u64() as u32][rng.below(4)];
            bytes[head..head + 4].copy_from_slice(&word.to_le_bytes());
        }
    }
}
