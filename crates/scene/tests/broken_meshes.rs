//! Broken mesh files: each is refused with its place and the rule it breaks; no damage whatever makes the
//! reader panic.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

mod glb_file;

use glb_file::{GlbFile, floats};
use scene::MeshOptions;
use scene::mesh::{Format, MeshPlace, mesh_from_bytes};
use serde_json::{Value, json};
use std::path::Path;

const METRES: MeshOptions = MeshOptions { unit_scale: None };

/// Name, bytes, where it is refused and in which words.
type Case = (&'static str, Vec<u8>, &'static str, &'static str);

/// A `.glb` with one value of its JSON changed.
fn changed(pointer: &str, value: Value) -> Vec<u8> {
    GlbFile::tetrahedron().set(pointer, value).bytes()
}

fn without(pointer: &str) -> Vec<u8> {
    GlbFile::tetrahedron().without(pointer).bytes()
}

/// A `.glb` whose vertex 1 stands elsewhere.
fn moved(vertex: [f32; 3]) -> Vec<u8> {
    let mut file = GlbFile::tetrahedron();
    file.binary[12..24].copy_from_slice(&floats(&[vertex]));
    file.bytes()
}

fn sparse(indices: [u8; 2], values_view: u64) -> Vec<u8> {
    let mut file = GlbFile::tetrahedron();
    let index_view = file.add_accessor(indices.to_vec(), 2, 5121, "SCALAR");
    file.set(
        "/accessors/0/sparse",
        json!({ "count": 2, "indices": { "bufferView": index_view, "componentType": 5121 },
                "values": { "bufferView": values_view } }),
    )
    .bytes()
}

fn with_bytes(change: impl Fn(&mut Vec<u8>)) -> Vec<u8> {
    let mut bytes = GlbFile::tetrahedron().bytes();
    change(&mut bytes);
    bytes
}

/// One triangle as binary STL, its first corner's x as given.
fn binary_stl(x: f32) -> Vec<u8> {
    let corners = floats(&[[0.0, 0.0, 1.0], [x, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    [&[0; 80][..], &1_u32.to_le_bytes(), &corners, &[0; 2]].concat()
}

fn cases() -> Vec<Case> {
    [container_cases(), accessor_cases(), primitive_and_node_cases(), stl_and_obj_cases()].concat()
}

#[rustfmt::skip]
fn container_cases() -> Vec<Case> {
    vec![
        // The container and the JSON.
        ("empty.glb", vec![], ": ", "is cut off: 0 bytes where at least 12 belong"),
        ("text.glb", b"solid nothing of glTF".to_vec(), ": ", "is not binary glTF 2.0"),
        ("cut.glb", with_bytes(|b| b.truncate(300)), ": ", "is cut off: 300 bytes where at least"),
        ("short.glb", with_bytes(|b| b[8..12].copy_from_slice(&3_u32.to_le_bytes())), ": ", "is cut off"),
        ("version.glb", with_bytes(|b| b[4] = 1), ": ", "is not binary glTF 2.0: unsupported version"),
        ("chunk.glb", with_bytes(|b| b[15] = 0x7f), ": ", "is not binary glTF 2.0: JSON chunk length exceeds"),
        ("brace.glb", with_bytes(|b| b[20] = b'['), ": ", "is not glTF"),
        ("brace.gltf", b"{".to_vec(), ": ", "is not glTF: EOF while parsing"),
        ("asset.glb", changed("/asset/version", json!("1.0")), ": ", "is glTF 1.0; version 2 is read"),
        ("draco.glb", changed("/extensionsRequired", json!(["KHR_draco_mesh_compression"])), ": ", "is compressed by `KHR_draco_mesh_compression`"),
        ("meshopt.glb", changed("/extensionsRequired", json!(["EXT_meshopt_compression"])), ": ", "is compressed by `EXT_meshopt_compression`"),
        ("instances.glb", changed("/extensionsUsed", json!(["EXT_mesh_gpu_instancing"])), ": ", "needs the extension `EXT_mesh_gpu_instancing`"),
        ("hidden.glb", changed("/extensionsUsed", json!(["KHR_node_visibility"])), ": ", "needs the extension `KHR_node_visibility`"),
        ("unknown.glb", changed("/extensionsRequired", json!(["ACME_cubes"])), ": ", "needs the extension `ACME_cubes`"),
        // Buffers and views.
        ("nobuffer.gltf", serde_json::to_vec(&GlbFile::tetrahedron().json).unwrap(), ": buffers[0]: ", "has no data"),
        ("longbuffer.glb", changed("/buffers/0/byteLength", json!(1_u64 << 40)), ": buffers[0]: ", "ends at byte 1099511627776 of 120"),
        ("uri.glb", changed("/buffers/0/uri", json!("http://example.invalid/b.bin")), ": buffers[0]: ", "`uri` is neither"),
        ("base64.glb", changed("/buffers/0/uri", json!("data:application/octet-stream;base64,?")), ": buffers[0]: ", "`uri` is neither"),
        ("noview.glb", changed("/accessors/0/bufferView", json!(9)), ": accessors[0]: ", "refers to buffer view 9 of 3"),
        ("viewbuffer.glb", changed("/bufferViews/0/buffer", json!(2)), ": bufferViews[0]: ", "refers to buffer 2 of 1"),
        ("viewend.glb", changed("/bufferViews/1/byteLength", json!(1000)), ": bufferViews[1]: ", "ends at byte 1048 of 120"),
        ("viewstart.glb", changed("/bufferViews/1/byteOffset", json!(u64::MAX)), ": bufferViews[1]: ", "ends at byte 18446744073709551615 of 120"),
        ("stride.glb", changed("/bufferViews/0/byteStride", json!(4)), ": accessors[0]: ", "byte stride 4 is less than the 12 bytes"),
    ]
}

#[rustfmt::skip]
fn accessor_cases() -> Vec<Case> {
    vec![
        ("count.glb", changed("/accessors/0/count", json!(5)), ": accessors[0]: ", "ends at byte 60 of 48"),
        ("overflow.glb", changed("/accessors/0/count", json!(u64::MAX)), ": accessors[0]: ", "ends at byte 18446744073709551615 of 48"),
        ("none.glb", changed("/accessors/0/count", json!(0)), ": accessors[0]: ", "holds nothing"),
        ("offset.glb", changed("/accessors/1/byteOffset", json!(8)), ": accessors[1]: ", "ends at byte 56 of 48"),
        ("type.glb", changed("/accessors/0/type", json!("VEC2")), ": accessors[0]: ", "must hold vectors of three 32-bit floats"),
        ("component.glb", changed("/accessors/0/componentType", json!(5123)), ": accessors[0]: ", "must hold vectors of three 32-bit floats"),
        ("oddcomponent.glb", changed("/accessors/0/componentType", json!(1)), ": accessors[0]: ", "must hold vectors"),
        ("floatindex.glb", changed("/accessors/2/componentType", json!(5126)), ": accessors[2]: ", "must hold scalars of 8, 16 or 32 unsigned bits"),
        ("viewless.glb", without("/accessors/0/bufferView"), ": accessors[0]: ", "has neither a buffer view nor"),
        ("sparsehigh.glb", sparse([1, 4], 0), ": accessors[0]: ", "sparse indices must rise and stay below 4; found 4"),
        ("sparsefall.glb", sparse([2, 1], 0), ": accessors[0]: ", "sparse indices must rise and stay below 4; found 1"),
        ("sparseview.glb", sparse([1, 2], 7), ": accessors[0]: ", "refers to buffer view 7 of 4"),
    ]
}

#[rustfmt::skip]
fn primitive_and_node_cases() -> Vec<Case> {
    let twice = json!([{ "children": [1, 1] }, { "mesh": 0 }]);
    let cycle = json!([{ "children": [1] }, { "children": [0], "mesh": 0 }]);
    let far_node = json!([{ "mesh": 0, "translation": [1e39, 0, 0] }]);
    let flat_matrix = json!([1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    vec![
        ("noaccessor.glb", changed("/meshes/0/primitives/0/attributes/POSITION", json!(7)), ": meshes[0].primitives[0]: ", "refers to accessor 7 of 3"),
        ("noindices.glb", changed("/meshes/0/primitives/0/indices", json!(7)), ": meshes[0].primitives[0]: ", "refers to accessor 7 of 3"),
        ("nopositions.glb", without("/meshes/0/primitives/0/attributes/POSITION"), ": meshes[0].primitives[0]: ", "has no attribute POSITION"),
        ("normals.glb", changed("/accessors/1/count", json!(3)), ": meshes[0].primitives[0]: ", "has 3 normals for 4 vertices"),
        ("nomaterial.glb", changed("/meshes/0/primitives/0/material", json!(1)), ": meshes[0].primitives[0]: ", "refers to material 1 of 1"),
        ("mode.glb", changed("/meshes/0/primitives/0/mode", json!(9)), ": meshes[0].primitives[0]: ", "has an unknown mode"),
        ("corners.glb", changed("/accessors/2/count", json!(11)), ": meshes[0].primitives[0]: ", "11 corners are no whole triangles"),
        ("index.glb", with_bytes(|b| { let end = b.len(); b[end - 2] = 4 }), ": meshes[0].primitives[0]: ", "vertex index 4 is out of range: there are 4 vertices"),
        ("nan.glb", moved([f32::NAN, 0.0, 0.0]), ": meshes[0].primitives[0]: ", "vertex 1 is not finite"),
        ("infinite.glb", moved([1.0, f32::INFINITY, 0.0]), ": meshes[0].primitives[0]: ", "vertex 1 is not finite"),
        ("morph.glb", changed("/meshes/0/weights", json!([0.5])), ": meshes[0].primitives[0]: ", "has morph weights"),
        ("points.glb", changed("/meshes/0/primitives/0/mode", json!(0)), ": ", "has no triangle with area (0 without)"),
        // Nodes.
        ("nomesh.glb", changed("/nodes/0/mesh", json!(3)), ": nodes[0]: ", "refers to mesh 3 of 1"),
        ("nochild.glb", changed("/nodes/0/children", json!([5])), ": ", "refers to node 5 of 1"),
        ("noscene.glb", changed("/scene", json!(2)), ": ", "refers to scene 2 of 1"),
        ("twice.glb", changed("/nodes", twice), ": nodes[1]: ", "is reached twice"),
        ("cycle.glb", changed("/nodes", cycle), ": nodes[0]: ", "is reached twice"),
        ("farnode.glb", changed("/nodes", far_node), ": ", "is not glTF: number out of range at line 1 column "),
        ("matrix.glb", changed("/nodes/0/matrix", flat_matrix), ": nodes[0]: ", "its transform is not finite and affine"),
        ("rotation.glb", changed("/nodes/0/rotation", json!([0, 0, 0, 0])), ": nodes[0]: ", "its transform is not finite and affine"),
        ("skin.glb", changed("/nodes/0/skin", json!(0)), ": nodes[0]: ", "has a skin"),
        // Size and area.
        ("kilometres.glb", changed("/nodes/0/scale", json!([1000, 1000, 1000])), ": ", "is 3000 m large, not 0.001 to 1000 m"),
        ("micrometres.glb", changed("/nodes/0/scale", json!([1e-6, 1e-6, 1e-6])), ": ", "m large, not 0.001 to 1000 m"),
        ("line.glb", changed("/nodes/0/scale", json!([0, 0, 1])), ": ", "has no triangle with area (4 without)"),
        ("nothing.glb", changed("/nodes", json!([{}])), ": ", "has no triangle with area (0 without)"),
    ]
}

#[rustfmt::skip]
fn stl_and_obj_cases() -> Vec<Case> {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let obj = |rest: &str| format!("{square}{rest}").into_bytes();
    vec![
        // STL.
        ("empty.stl", vec![], ": ", "is cut off: 0 bytes where at least 84 belong"),
        ("cut.stl", binary_stl(0.5)[..130].to_vec(), ": ", "is cut off: 130 bytes where at least 134 belong"),
        ("long.stl", [binary_stl(0.5), vec![0; 120]].concat(), ": ", "is longer than its header says: 1 facets take 134 bytes, it has 254, which hold 3"),
        ("nan.stl", binary_stl(f32::NAN), ": facet 1: ", "vertex 0 is not finite"),
        ("word.stl", b"solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n".to_vec(), ":4: ", "expected a number, found `zero`"),
        ("half.stl", b"solid s\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0.0".to_vec(), ": ", "is cut off: it ends without `endsolid`"),
        ("line.stl", b"solid s\nfacte normal 0 0 1\n".to_vec(), ":2: ", "expected a line of STL"),
        ("two.stl", b"solid s\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n".to_vec(), ":5: ", "a facet of 2 vertices is no triangle"),
        ("six.stl", text_stl(6), ":9: ", "a facet of 6 vertices is no triangle"),
        ("nine.stl", text_stl(9), ":12: ", "a facet of 9 vertices is no triangle"),
        ("bare.stl", text_stl(0), ":3: ", "a facet of 0 vertices is no triangle"),
        ("nothing.stl", b"solid s\nendsolid s\n".to_vec(), ": ", "has no triangle with area"),
        ("latin.stl", b"solid \xe9\n".to_vec(), ": ", "is not UTF-8 text"),
        // OBJ.
        ("empty.obj", vec![], ": ", "has no triangle with area"),
        ("number.obj", b"v 0 0\n".to_vec(), ":1: ", "expected a number, found ``"),
        ("index.obj", obj("f 1 2 5\n"), ":5: ", "vertex index 5 is out of range: there are 4 vertices"),
        ("zero.obj", obj("f 1 2 0\n"), ":5: ", "vertex index 0 is out of range"),
        ("negative.obj", obj("f -1 -2 -5\n"), ":5: ", "vertex index -5 is out of range"),
        ("normal.obj", obj("f 1//1 2//1 3//1\n"), ":5: ", "vertex index 1 is out of range: there are 0 vertices"),
        ("two.obj", obj("f 1 2\n"), ":5: ", "2 corners are no whole triangles"),
        ("polygon.obj", obj(&format!("f{}\n", " 1 2 3".repeat(1366))), ":5: ", "is a polygon of 4098 corners; at most 4096"),
        ("word.obj", obj("f 1 two 3\n"), ":5: ", "expected an index, found `two`"),
        ("curve.obj", obj("cstype bezier\n"), ":5: ", "expected a polygonal OBJ statement"),
        ("nan.obj", obj("v nan 0 0\nf 1 2 5\n"), ":5: ", "vertex 5 is not finite"),
        ("infinite.obj", obj("v 1 2 3\nv 1e999 0 \\\n0\n\nf 1 2 6\n"), ":6: ", "vertex 6 is not finite"),
        ("nan normal.obj", obj("vn 0 0 1\nvn 0 nan 1\nf 1//1 2//2 3//1\n"), ":6: ", "normal 2 is not finite"),
        ("flat.obj", obj("v 2 0 0\nf 1 2 5\n"), ": ", "has no triangle with area (1 without)"),
        ("model.fbx", vec![], ": ", "is not a .glb, .gltf, .stl, .obj or .xoma file by its name"),
    ]
}

/// STL as text, of a facet with so many vertices.
fn text_stl(vertices: usize) -> Vec<u8> {
    let vertices: String = (0..vertices).map(|i| format!("vertex {i} {} 0\n", i * i)).collect();
    format!("solid s\nfacet\n{vertices}endfacet\nendsolid s\n").into_bytes()
}

#[test]
fn every_broken_mesh_is_refused_at_its_place_with_its_rule() {
    let folder = tempfile::tempdir().unwrap();
    let mut failures = vec![];
    for (name, bytes, place, words) in cases() {
        let file = folder.path().join(name);
        std::fs::write(&file, bytes).unwrap();
        let Err(error) = scene::read_mesh(&file, &METRES) else {
            failures.push(format!("{name}: accepted"));
            continue;
        };
        let text = error.to_string();
        if !text.starts_with(&format!("{}{place}", file.display()))
            || !text.contains(words)
            || error.is_system()
        {
            failures.push(format!("{name}: wanted {place}{words}\n  got {text}"));
        }
    }
    assert!(failures.is_empty(), "{} of {}:\n{}", failures.len(), cases().len(), failures.join("\n"));
}

#[test]
fn a_refusal_repeats_no_megabytes_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let word = json!("x".repeat(2 << 20));
    let lines = json!("x\n".repeat(1 << 20));
    for (pointer, value, rule) in [
        ("/extensionsRequired", json!([word]), "`, which is not supported"),
        ("/extensionsRequired", json!([lines]), "`, which is not supported"),
        ("/asset/version", word.clone(), "; version 2 is read"),
        ("/buffers/0/uri", word, ""),
    ] {
        let file = folder.path().join("long.glb");
        std::fs::write(&file, changed(pointer, value)).unwrap();
        let said = scene::read_mesh(&file, &METRES).unwrap_err().to_string();
        assert!(said.len() < 4096 && said.starts_with(&format!("{}: ", file.display())), "{}", said.len());
        assert!(said.contains("left out …") && said.ends_with(rule), "{pointer}: {said}");
    }
}

#[test]
fn a_missing_mesh_or_buffer_file_is_the_systems_fault() {
    let folder = tempfile::tempdir().unwrap();
    assert!(scene::read_mesh(&folder.path().join("absent.glb"), &METRES).unwrap_err().is_system());
    let file = folder.path().join("model.gltf");
    let document = GlbFile::tetrahedron().set("/buffers/0/uri", json!("absent.bin"));
    std::fs::write(&file, serde_json::to_vec(&document.json).unwrap()).unwrap();
    let error = scene::read_mesh(&file, &METRES).unwrap_err();
    assert!(error.is_system() && error.to_string().contains("buffers[0]: buffer file"), "{error}");
}

#[test]
fn a_small_file_that_shows_one_mesh_many_times_is_refused_before_it_fills_the_memory() {
    // 32 767 triangles over and over the same four corners, in 1000 nodes: twice the limit from 230 kB.
    let mut file = GlbFile::tetrahedron();
    let corners: Vec<u8> = (0..98_301_u32).flat_map(|i| ((i % 4) as u16).to_le_bytes()).collect();
    let indices = file.add_accessor(corners, 98_301, 5123, "SCALAR");
    let nodes: Vec<Value> = (0..1000).map(|_| json!({ "mesh": 0 })).collect();
    let file = file
        .set("/meshes/0/primitives/0/indices", json!(indices))
        .set("/scenes/0/nodes", json!((0..1000).collect::<Vec<_>>()))
        .set("/nodes", json!(nodes));
    let error = mesh_from_bytes(&file.bytes(), Format::Glb, Path::new("many.glb"), &METRES).unwrap_err();
    assert!(error.to_string().contains("has more than 16777216 triangles"), "{error}");
}

#[test]
fn a_unit_scale_lifts_the_limits_on_size() {
    let kilometres = changed("/nodes/0/scale", json!([1000, 1000, 1000]));
    let read = |unit_scale| {
        mesh_from_bytes(&kilometres, Format::Glb, Path::new("k.glb"), &MeshOptions { unit_scale })
    };
    assert!(read(None).is_err());
    assert!(read(Some(1.0)).is_ok());
    let length_m = |mesh: &artifact::scene::Mesh| mesh.vertices_m.iter().map(|v| v[0]).fold(0.0, f64::max);
    assert_eq!(length_m(&read(Some(0.5)).unwrap()), 1500.0);
}

/// Deterministic noise (SplitMix64, Steele et al. 2014): the same files on every machine.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

/// Turns one or two bits, as often in the first 20 bytes and in the last 128, the binary chunk, as anywhere;
/// cuts off one file in eight.
fn damaged_bytes(noise: &mut Noise, whole: &[u8]) -> Vec<u8> {
    let mut bytes = whole.to_vec();
    for _ in 0..=noise.below(2) {
        let end = bytes.len();
        let at =
            [noise.below(end), noise.below(end.min(20)), end - 1 - noise.below(end.min(128))][noise.below(3)];
        bytes[at] ^= 1 << noise.below(8);
    }
    if noise.below(8) == 0 {
        bytes.truncate(noise.below(bytes.len()));
    }
    bytes
}

/// Replaces, removes or doubles one or two values anywhere in the JSON.
fn damaged_json(noise: &mut Noise, file: &GlbFile) -> Vec<u8> {
    let mut file = file.clone();
    for _ in 0..=noise.below(2) {
        damage_value(noise, &mut file.json);
    }
    file.bytes()
}

fn damage_value(noise: &mut Noise, value: &mut Value) {
    let stop_here = noise.below(16) == 0;
    match value {
        Value::Array(array) if !stop_here && !array.is_empty() => {
            let at = noise.below(array.len());
            match noise.below(8) {
                0 => drop(array.remove(at)),
                1 => array.push(array[at].clone()),
                _ => damage_value(noise, &mut array[at]),
            }
        }
        Value::Object(object) if !stop_here && !object.is_empty() => {
            let key = object.keys().nth(noise.below(object.len())).unwrap().clone();
            match noise.below(8) {
                0 => drop(object.remove(&key)),
                _ => damage_value(noise, &mut object[&key]),
            }
        }
        _ => *value = strange_value(noise),
    }
}

fn strange_value(noise: &mut Noise) -> Value {
    let small = noise.below(12);
    [
        json!(small),
        json!(small),
        json!(small),
        json!(-1),
        json!(u32::MAX),
        json!(u64::MAX),
        json!(1_u64 << 53),
        json!(0.5),
        json!(1e300),
        json!(5120 + small),
        json!(null),
        json!(true),
        json!("VEC3"),
        json!("data:;base64,AAAA"),
        json!([]),
        json!([0, 0, 0, 1]),
        json!({}),
        json!({ "POSITION": small }),
    ][noise.below(18)]
    .clone()
}

/// Files that reach every branch of the reader: sparse values, strips, nested nodes, quantized positions,
/// indices of 8 and 32 bits, none.
fn sound_files() -> Vec<GlbFile> {
    let plain = GlbFile::tetrahedron();
    let nested = plain.clone().set(
        "/nodes",
        json!([
        { "children": [1, 2], "translation": [1, 2, 3] },
        { "mesh": 0, "rotation": [0, 0.6, 0, 0.8], "scale": [1, -2, 1] },
        { "children": [3], "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 0, 0, 1] },
        { "mesh": 0 }]),
    );
    let mut sparse = plain.clone();
    let indices = sparse.add_accessor(vec![1, 3], 2, 5121, "SCALAR");
    let values = sparse.add_accessor(floats(&[[4.0, 0.0, 0.0], [0.0, 0.0, 4.0]]), 2, 5126, "VEC3");
    let corner = sparse.add_accessor(vec![3, 0], 1, 5123, "SCALAR");
    let replaced = |count: u64, values: usize| {
        json!({ "count": count,
        "indices": { "bufferView": indices, "componentType": 5121 }, "values": { "bufferView": values } })
    };
    let sparse = sparse
        .set("/accessors/0/sparse", replaced(2, values))
        .set("/accessors/2/sparse", replaced(1, corner));
    let mut strip = plain.clone();
    let corners = [0_u32, 1, 2, 3].iter().flat_map(|i| i.to_le_bytes()).collect();
    let corners = strip.add_accessor(corners, 4, 5125, "SCALAR");
    let strip = strip
        .set("/meshes/0/primitives/0/indices", json!(corners))
        .set("/meshes/0/primitives/0/mode", json!(5));
    let fan =
        strip.clone().without("/meshes/0/primitives/0/indices").set("/meshes/0/primitives/0/mode", json!(6));
    let mut quantized = plain.clone();
    let positions =
        quantized.add_accessor(vec![0, 0, 0, 0, 9, 0, 0, 0, 0, 9, 0, 0, 0, 0, 9, 0], 4, 5120, "VEC3");
    let view = format!("/bufferViews/{positions}/byteStride");
    let quantized = quantized
        .set("/meshes/0/primitives/0/attributes/POSITION", json!(positions))
        .set(&view, json!(4))
        .set("/extensionsUsed", json!(["KHR_mesh_quantization"]));
    vec![plain, nested, sparse, strip, fan, quantized]
}

#[test]
fn a_hundred_thousand_damaged_files_are_read_or_refused_without_panic() {
    let files = sound_files();
    let mut noise = Noise(1);
    // Read, and refused at: the file, buffers, views, accessors, nodes, primitives.
    let mut outcomes = [0; 7];
    for i in 0..100_000 {
        let file = &files[i % files.len()];
        let bytes = if i % 2 == 0 {
            damaged_bytes(&mut noise, &file.bytes())
        } else {
            damaged_json(&mut noise, file)
        };
        match std::panic::catch_unwind(|| {
            mesh_from_bytes(&bytes, Format::Glb, Path::new("damaged.glb"), &METRES)
        }) {
            Ok(Ok(mesh)) => {
                assert_sound(&mesh);
                outcomes[0] += 1;
            }
            Ok(Err(error)) => outcomes[outcome(error.place)] += 1,
            Err(_) => panic!("file {i} made the reader panic: {bytes:?}"),
        }
    }
    // The damage reaches every part of the reader.
    assert!(outcomes.iter().all(|count| *count > 300), "{outcomes:?}");
}

fn outcome(place: MeshPlace) -> usize {
    match place {
        MeshPlace::File | MeshPlace::Line(_) | MeshPlace::Facet(_) => 1,
        MeshPlace::Buffer(_) => 2,
        MeshPlace::View(_) => 3,
        MeshPlace::Accessor(_) => 4,
        MeshPlace::Node(_) => 5,
        MeshPlace::Primitive { .. } => 6,
    }
}

#[test]
fn damaged_stl_and_obj_files_are_read_or_refused_without_panic() {
    let text_stl = b"solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n";
    let obj = b"# square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nusemtl paint\nf 1//1 2//1 3//1 4//1\nf -4 -3 -2 \\\n-1\n";
    let sound =
        [(Format::Stl, binary_stl(0.5)), (Format::Stl, text_stl.to_vec()), (Format::Obj, obj.to_vec())];
    let mut noise = Noise(2);
    for i in 0..30_000 {
        let (format, whole) = &sound[i % sound.len()];
        let bytes = damaged_bytes(&mut noise, whole);
        if let Ok(mesh) = mesh_from_bytes(&bytes, *format, Path::new("damaged"), &METRES) {
            assert_sound(&mesh);
        }
    }
}

fn assert_sound(mesh: &artifact::scene::Mesh) {
    let vertices = mesh.vertices_m.len();
    assert!(mesh.vertices_m.as_flattened().iter().all(|x| x.is_finite()));
    assert!(mesh.normals.is_empty() || mesh.normals.len() == vertices);
    let unit = |n: &[f32; 3]| (n.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 8.0 * f32::EPSILON;
    assert!(mesh.normals.iter().all(unit), "{:?}", mesh.normals);
    assert!(mesh.triangles.as_flattened().iter().all(|&i| (i as usize) < vertices));
    assert_eq!(mesh.triangles.len(), mesh.material_of_triangle.len());
    assert!(mesh.material_of_triangle.iter().all(|&i| usize::from(i) < mesh.materials.len()));
    assert!(!mesh.triangles.is_empty());
}

#[test]
fn many_accessors_over_the_same_bytes_are_refused_before_they_fill_the_memory() {
    // 6 MiB of bytes as 2²¹ positions, by 100 accessors: 5 GiB once they are read.
    let mut file = GlbFile::tetrahedron();
    let positions = file.add_accessor(vec![7; 6 << 20], 2 << 20, 5121, "VEC3");
    let accessor = file.json["accessors"][positions].clone();
    for _ in 0..100 {
        file.json["accessors"].as_array_mut().unwrap().push(accessor.clone());
    }
    let primitive = |i: usize| json!({ "attributes": { "POSITION": positions + i }, "indices": 2 });
    let file = file
        .set("/meshes/0/primitives", json!((0..100).map(primitive).collect::<Vec<_>>()))
        .set("/extensionsUsed", json!(["KHR_mesh_quantization"]));
    let error = mesh_from_bytes(&file.bytes(), Format::Glb, Path::new("many.glb"), &METRES).unwrap_err();
    assert!(error.to_string().contains("has more than 100663296 positions and normals"), "{error}");
}

#[test]
fn lines_that_go_on_and_materials_by_the_thousand_take_time_as_they_are_many_and_not_their_square() {
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let start = std::time::Instant::now();
    let going_on = format!("{corners}f 1 2 {}3\n", "\\\n".repeat(1 << 20));
    assert!(mesh_from_bytes(going_on.as_bytes(), Format::Obj, Path::new("long.obj"), &METRES).is_ok());
    let materials: String = (0..60_000).map(|i| format!("usemtl m{i}\nf 1 2 3\n")).collect();
    let materials = format!("{corners}{}", materials.repeat(3));
    let mesh = mesh_from_bytes(materials.as_bytes(), Format::Obj, Path::new("many.obj"), &METRES).unwrap();
    assert_eq!((mesh.materials.len(), mesh.triangles.len()), (60_000, 180_000));
    assert!(start.elapsed().as_secs() < 30, "{:?}", start.elapsed());
}

#[cfg(unix)]
#[test]
fn what_is_no_plain_file_is_refused_before_it_is_opened_buffers_too() {
    let folder = tempfile::tempdir().unwrap();
    let fifo = folder.path().join("b.glb");
    assert!(std::process::Command::new("mkfifo").arg(&fifo).status().unwrap().success());
    let error = scene::read_mesh(&fifo, &METRES).unwrap_err();
    assert!(
        error.is_system() && error.to_string().contains("b.glb: cannot be read: it is a FIFO"),
        "{error}"
    );
    let file = folder.path().join("m.gltf");
    let document = GlbFile::tetrahedron().set("/buffers/0/uri", json!("b.glb"));
    std::fs::write(&file, serde_json::to_vec(&document.json).unwrap()).unwrap();
    let error = scene::read_mesh(&file, &METRES).unwrap_err();
    assert!(error.is_system() && error.to_string().contains("cannot be read: it is a FIFO"), "{error}");
}
