//! Sound mesh files: what is read is what they say, in body axes.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

mod glb_file;
#[path = "meshes/wheels.rs"]
mod wheels;

use artifact::scene::Mesh;
use glb_file::{GlbFile, floats};
use scene::mesh::{Format, mesh_from_bytes};
use scene::{MeshOptions, centred, read_mesh, vehicles};
use serde_json::json;
use std::collections::BTreeSet;
use std::path::Path;

const METRES: MeshOptions = MeshOptions { unit_scale: None };

fn read(file: &GlbFile) -> Mesh {
    mesh_from_bytes(&file.bytes(), Format::Glb, Path::new("test.glb"), &METRES).unwrap()
}

type Triangle = [[i64; 3]; 3];
/// Code of a component type in glTF, and how an index is stored in it.
type IndexWidth = (u64, fn(u16) -> Vec<u8>);

/// Triangles as micrometres, each turned so that its least corner comes first: equal for equal surfaces and
/// windings.
fn surface(mesh: &Mesh) -> BTreeSet<Triangle> {
    let corner = |i: u32| mesh.vertices_m[i as usize].map(|x| (x * 1e6).round() as i64);
    let turned = |mut t: Triangle| {
        let least = (0..3).min_by_key(|&i| t[i]).unwrap();
        t.rotate_left(least);
        t
    };
    mesh.triangles.iter().map(|corners| turned(corners.map(corner))).collect()
}

/// Six times the signed volume: positive where triangles are wound outwards.
fn signed_volume_m3(mesh: &Mesh) -> f64 {
    let volume = |[a, b, c]: [glam::DVec3; 3]| a.dot(b.cross(c));
    mesh.triangles.iter().map(|t| volume(t.map(|i| mesh.vertices_m[i as usize].into()))).sum()
}

#[test]
fn gltf_axes_become_body_axes() {
    let mesh = read(&GlbFile::tetrahedron());
    // 1, 2, 3 m along glTF's x, y, z are left, up, forward.
    let expected = BTreeSet::from([[0, 0, 0], [0, 1_000_000, 0], [0, 0, 2_000_000], [3_000_000, 0, 0]]);
    assert_eq!(surface(&mesh).iter().flatten().copied().collect::<BTreeSet<_>>(), expected);
    assert_eq!(signed_volume_m3(&mesh), 6.0);
    assert_eq!(mesh.materials, ["paint"]);
    assert_eq!(mesh.name, "test.glb");
    let statistics = mesh.statistics;
    assert_eq!((statistics.triangles_read, statistics.degenerate, statistics.open_edges), (4, 0, 0));
    // Vertex 3, on glTF's z, has its normal along z: forward.
    let forward = mesh.vertices_m.iter().position(|v| *v == [3.0, 0.0, 0.0]).unwrap();
    assert_eq!(mesh.normals[forward], [1.0, 0.0, 0.0]);
}

#[test]
fn indices_of_any_width_or_none_give_the_same_surface() {
    let plain = GlbFile::tetrahedron();
    let expected = surface(&read(&plain));
    let corners: Vec<u16> = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].as_flattened().to_vec();
    let widths: [IndexWidth; 2] =
        [(5121, |i| vec![i as u8]), (5125, |i| u32::from(i).to_le_bytes().to_vec())];
    for (component, bytes) in widths {
        let mut file = plain.clone();
        let indices =
            file.add_accessor(corners.iter().flat_map(|&i| bytes(i)).collect(), 12, component, "SCALAR");
        assert_eq!(surface(&read(&file.set("/meshes/0/primitives/0/indices", json!(indices)))), expected);
    }
    let mut soup = plain.clone();
    let points: Vec<[f32; 3]> = corners
        .iter()
        .map(|&i| [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]][usize::from(i)])
        .collect();
    let positions = soup.add_accessor(floats(&points), 12, 5126, "VEC3");
    let soup = soup
        .set("/meshes/0/primitives/0/attributes", json!({ "POSITION": positions }))
        .without("/meshes/0/primitives/0/indices");
    let mesh = read(&soup);
    assert_eq!(surface(&mesh), expected);
    assert!(mesh.normals.is_empty());
    assert_eq!(
        (mesh.vertices_m.len(), mesh.statistics.open_edges),
        (12, 0),
        "nothing welded, edges equal by position"
    );
}

#[test]
fn strips_and_fans_wind_as_gltf_says() {
    let strip = |mode: u64, order: [u16; 4]| {
        let mut file = GlbFile::tetrahedron();
        let bytes = order.iter().flat_map(|i| i.to_le_bytes()).collect();
        let indices = file.add_accessor(bytes, 4, 5123, "SCALAR");
        let file = file.set("/meshes/0/primitives/0/indices", json!(indices));
        surface(&read(&file.set("/meshes/0/primitives/0/mode", json!(mode))))
    };
    let listed = |triangles: [[u16; 3]; 2]| {
        let mut file = GlbFile::tetrahedron();
        let bytes = triangles.as_flattened().iter().flat_map(|i| i.to_le_bytes()).collect();
        let indices = file.add_accessor(bytes, 6, 5123, "SCALAR");
        surface(&read(&file.set("/meshes/0/primitives/0/indices", json!(indices))))
    };
    assert_eq!(strip(5, [0, 1, 2, 3]), listed([[0, 1, 2], [1, 3, 2]]));
    assert_eq!(strip(6, [0, 1, 2, 3]), listed([[0, 1, 2], [0, 2, 3]]));
}

#[test]
fn nested_transforms_apply_from_the_inside_out() {
    // Parent: a quarter turn about glTF's y (z goes to x) and 10 m along x; child: twice as large, 1 m along
    // z.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let nodes = json!([
        { "children": [1], "rotation": [0, half, 0, half], "translation": [10, 0, 0] },
        { "mesh": 0, "scale": [2, 2, 2], "translation": [0, 0, 1] }]);
    let mesh = read(&GlbFile::tetrahedron().set("/nodes", nodes));
    // The corner 3 m along z: child 7 m along z; parent 17 m along x, which is to the left.
    let left = mesh.vertices_m.iter().map(|v| v[1]).fold(f64::MIN, f64::max);
    // The quaternion's two floats are 3e-8 off.
    assert!((left - 17.0).abs() < 17.0 * 6e-8, "{left}");
    assert!((signed_volume_m3(&centred(mesh)) - 48.0).abs() < 48.0 * 4e-7);
}

#[test]
fn a_matrix_and_its_parts_place_a_mesh_alike() {
    let parts =
        json!([{ "mesh": 0, "translation": [1, 2, 3], "rotation": [0, 0, 1, 0], "scale": [2, 3, 4] }]);
    let matrix = json!([{ "mesh": 0, "matrix": [-2, 0, 0, 0, 0, -3, 0, 0, 0, 0, 4, 0, 1, 2, 3, 1] }]);
    let file = GlbFile::tetrahedron();
    assert_eq!(
        surface(&read(&file.clone().set("/nodes", parts))),
        surface(&read(&file.set("/nodes", matrix)))
    );
}

#[test]
fn a_mirrored_body_stays_wound_outwards_with_its_normals_outward() {
    let mesh = read(&GlbFile::tetrahedron().set("/nodes/0/scale", json!([-1, 1, 1])));
    assert_eq!(signed_volume_m3(&mesh), 6.0);
    // Vertex 1, on glTF's x, has its normal along x: mirrored it points right.
    let right = mesh.vertices_m.iter().position(|v| *v == [0.0, -1.0, 0.0]).unwrap();
    assert_eq!(mesh.normals[right], [0.0, -1.0, 0.0]);
}

#[test]
fn normals_stay_perpendicular_under_unequal_scales() {
    // The slanted face x + y/2 + z/3 = 1 m; its normals, given at all its corners, must follow it.
    let mut file = GlbFile::tetrahedron();
    let normal = [6.0 / 7.0, 3.0 / 7.0, 2.0 / 7.0];
    let normals = file.add_accessor(floats(&[normal; 4]), 4, 5126, "VEC3");
    let file = file.set("/meshes/0/primitives/0/attributes/NORMAL", json!(normals));
    let mesh = read(&file.set("/nodes/0/scale", json!([1, 5, 0.2])));
    // x + y/10 + z/0.6 = 1 after scaling; body (z, x, y).
    let expected = glam::DVec3::new(1.0 / 0.6, 1.0, 0.1);
    let expected = expected / expected.length();
    for normal in &mesh.normals {
        assert!((glam::Vec3::from(*normal).as_dvec3() - expected).length() < 4.0 * f64::from(f32::EPSILON));
    }
}

#[test]
fn several_meshes_and_primitives_join_with_their_materials() {
    let file = GlbFile::tetrahedron()
        .set("/materials", json!([{ "name": "paint" }, { "name": "glass" }, {}]))
        .set(
            "/meshes",
            json!([
            { "primitives": [
                { "attributes": { "POSITION": 0, "NORMAL": 1 }, "indices": 2, "material": 1 },
                { "attributes": { "POSITION": 0, "NORMAL": 1 }, "indices": 2, "material": 0 },
                { "attributes": { "POSITION": 0 }, "mode": 1 }] },
            { "primitives": [
                { "attributes": { "POSITION": 0, "NORMAL": 1 }, "indices": 2, "material": 2 },
                { "attributes": { "POSITION": 0, "NORMAL": 1 }, "indices": 2 }] }]),
        )
        .set("/nodes", json!([{ "mesh": 0, "children": [1] }, { "mesh": 1 }]));
    let mesh = read(&file);
    assert_eq!(mesh.materials, ["glass", "paint", ""]);
    assert_eq!(mesh.material_of_triangle, [[0; 4], [1; 4], [2; 4], [2; 4]].as_flattened());
}

#[test]
fn a_part_without_normals_gets_those_of_its_facets_where_others_have_them() {
    let file = GlbFile::tetrahedron().set(
        "/meshes/0/primitives",
        json!([
        { "attributes": { "POSITION": 0, "NORMAL": 1 }, "indices": 2 },
        { "attributes": { "POSITION": 0 }, "indices": 2 }]),
    );
    let mesh = read(&file);
    assert_eq!((mesh.vertices_m.len(), mesh.normals.len()), (4 + 12, 16));
    for corners in &mesh.triangles[4..] {
        let [a, b, c] = corners.map(|i| glam::DVec3::from(mesh.vertices_m[i as usize]));
        let normal = (b - a).cross(c - a);
        for i in corners {
            let stored = glam::Vec3::from(mesh.normals[*i as usize]).as_dvec3();
            assert!((stored - normal / normal.length()).length() < 2.0 * f64::from(f32::EPSILON));
        }
    }
}

#[test]
fn a_normal_of_no_length_is_replaced_by_that_of_the_facets_around() {
    let mut file = GlbFile::tetrahedron();
    file.binary[48..60].copy_from_slice(&floats(&[[0.0; 3]]));
    let mesh = read(&file);
    let origin = mesh.vertices_m.iter().position(|v| *v == [0.0; 3]).unwrap();
    // Around the origin the facets' areas are 3, 1.5 and 1 m² against x, y and z of glTF.
    let expected = glam::Vec3::new(-1.0, -3.0, -1.5) / 12.25_f32.sqrt();
    assert!((glam::Vec3::from(mesh.normals[origin]) - expected).length() < 4.0 * f32::EPSILON);
}

#[test]
fn sparse_values_replace_those_of_the_base() {
    let mut file = GlbFile::tetrahedron();
    let indices = file.add_accessor(vec![3], 1, 5121, "SCALAR");
    let values = file.add_accessor(floats(&[[0.0, 0.0, 5.0]]), 1, 5126, "VEC3");
    let sparse = json!({ "count": 1, "indices": { "bufferView": indices, "componentType": 5121 },
                         "values": { "bufferView": values } });
    let mesh = read(&file.set("/accessors/0/sparse", sparse));
    assert_eq!(mesh.vertices_m.iter().map(|v| v[0]).fold(0.0, f64::max), 5.0);
}

#[test]
fn sparse_indices_replace_those_of_the_base_or_zeros() {
    let expected = surface(&read(&GlbFile::tetrahedron()));
    let corners = [0_u8, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3];
    let sparse = |file: &mut GlbFile, places: Vec<u8>| {
        let count = places.len() as u64;
        let values: Vec<u8> = places.iter().map(|i| corners[usize::from(*i)]).collect();
        let places = file.add_accessor(places, count, 5121, "SCALAR");
        let values = file.add_accessor(values, count, 5121, "SCALAR");
        json!({ "count": count, "indices": { "bufferView": places, "componentType": 5121 },
                "values": { "bufferView": values } })
    };
    let mut based = GlbFile::tetrahedron();
    let indices = based.add_accessor([&corners[..4], &[3, 1], &corners[6..]].concat(), 12, 5121, "SCALAR");
    let replaced = sparse(&mut based, vec![4, 5]);
    let based = based.set(&format!("/accessors/{indices}/sparse"), replaced);
    assert_eq!(surface(&read(&based.set("/meshes/0/primitives/0/indices", json!(indices)))), expected);
    let mut bare = GlbFile::tetrahedron();
    let replaced = sparse(&mut bare, vec![1, 2, 4, 5, 7, 8, 9, 10, 11]);
    let accessor = json!({ "componentType": 5121, "count": 12, "type": "SCALAR", "sparse": replaced });
    assert_eq!(surface(&read(&bare.set("/accessors/2", accessor))), expected);
}

#[test]
fn quantized_positions_are_scaled_by_their_node() {
    let mut file = GlbFile::tetrahedron();
    let packed = [[0_i16, 0, 0, 0], [32767, 0, 0, 0], [0, 32767, 0, 0], [0, 0, -32767, 0]];
    let bytes = packed.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    let positions = file.add_accessor(bytes, 4, 5122, "VEC3");
    let mesh = read(
        &file
            .set(&format!("/bufferViews/{positions}/byteStride"), json!(8))
            .set(&format!("/accessors/{positions}/normalized"), json!(true))
            .set("/meshes/0/primitives/0/attributes/POSITION", json!(positions))
            .set("/extensionsUsed", json!(["KHR_mesh_quantization"]))
            .set("/extensionsRequired", json!(["KHR_mesh_quantization"]))
            .set("/nodes/0/scale", json!([4, 4, 4])),
    );
    let corners: BTreeSet<_> = surface(&mesh).iter().flatten().copied().collect();
    assert_eq!(
        corners,
        BTreeSet::from([[0, 0, 0], [0, 4_000_000, 0], [0, 0, 4_000_000], [-4_000_000, 0, 0]])
    );
}

#[test]
fn a_gltf_finds_its_buffer_beside_it_or_inside() {
    let folder = tempfile::tempdir().unwrap();
    let expected = surface(&read(&GlbFile::tetrahedron()));
    let plain = GlbFile::tetrahedron();
    std::fs::write(folder.path().join("a b.bin"), &plain.binary).unwrap();
    let file = folder.path().join("model.gltf");
    let beside = plain.clone().set("/buffers/0/uri", json!("a%20b.bin"));
    std::fs::write(&file, serde_json::to_vec(&beside.json).unwrap()).unwrap();
    assert_eq!(surface(&read_mesh(&file, &METRES).unwrap()), expected);
    let inside = plain.clone().set(
        "/buffers/0/uri",
        json!(format!("data:application/gltf-buffer;base64,{}", base64(&plain.binary))),
    );
    std::fs::write(&file, serde_json::to_vec(&inside.json).unwrap()).unwrap();
    assert_eq!(surface(&read_mesh(&file, &METRES).unwrap()), expected);
}

#[test]
fn a_gltf_reads_files_of_its_own_folder_and_below_alone_however_their_names_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let own = folder.path().join("own");
    std::fs::create_dir_all(own.join("below")).unwrap();
    let plain = GlbFile::tetrahedron();
    for place in ["other.bin", "own/below/a.bin"] {
        std::fs::write(folder.path().join(place), &plain.binary).unwrap();
    }
    let file = own.join("model.gltf");
    let read_with = |uri: &str| {
        let document = plain.clone().set("/buffers/0/uri", json!(uri));
        std::fs::write(&file, serde_json::to_vec(&document.json).unwrap()).unwrap();
        read_mesh(&file, &METRES)
    };
    let absolute = folder.path().join("other.bin").display().to_string();
    let encoded = absolute.replace('/', "%2F");
    for uri in [
        &encoded,
        &absolute,
        "../other.bin",
        "%2e%2E/other.bin",
        "..%2Fother.bin",
        "below/../../other.bin",
        "below/../below/a.bin",
        "..\\other.bin",
        "..%5Cother.bin",
        "C%3A/other.bin",
        "%5C%5Chost%5Cother.bin",
        "below/a.bin%00",
    ] {
        let error = read_with(uri).unwrap_err();
        let said = error.to_string();
        assert!(!error.is_system(), "{uri}: {said}");
        let rule =
            "model.gltf: buffers[0]: `uri` may name files in the folder of this one and below it alone";
        assert!(said.contains(rule), "{uri}: {said}");
    }
    for uri in ["below/a.bin", "./below/a.bin", "below%2Fa.bin"] {
        assert_eq!(surface(&read_with(uri).unwrap()), surface(&read(&plain)), "{uri}");
    }
}

#[cfg(unix)]
#[test]
fn a_link_in_the_folder_of_a_gltf_is_the_users_own_and_is_followed() {
    let folder = tempfile::tempdir().unwrap();
    let plain = GlbFile::tetrahedron();
    std::fs::write(folder.path().join("other.bin"), &plain.binary).unwrap();
    std::fs::create_dir(folder.path().join("own")).unwrap();
    std::os::unix::fs::symlink("../other.bin", folder.path().join("own/linked.bin")).unwrap();
    let file = folder.path().join("own/model.gltf");
    let document = plain.clone().set("/buffers/0/uri", json!("linked.bin"));
    std::fs::write(&file, serde_json::to_vec(&document.json).unwrap()).unwrap();
    assert_eq!(surface(&read_mesh(&file, &METRES).unwrap()), surface(&read(&plain)));
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let group = |c: &[u8]| {
        let bits = (0..3).fold(0, |bits, i| bits << 8 | u32::from(c.get(i).copied().unwrap_or(0)));
        let digits = (0..4).map(|i| char::from(DIGITS[(bits >> (18 - 6 * i)) as usize & 63]));
        digits.enumerate().map(|(i, digit)| if i <= c.len() { digit } else { '=' }).collect::<String>()
    };
    bytes.chunks(3).map(group).collect()
}

#[test]
fn a_file_without_scenes_shows_its_root_nodes_and_one_without_nodes_its_meshes() {
    let expected = surface(&read(&GlbFile::tetrahedron()));
    let sceneless = GlbFile::tetrahedron().without("/scenes").without("/scene");
    let nested =
        json!([{ "mesh": 0, "translation": [7, 0, 0] }, { "children": [0], "translation": [-7, 0, 0] }]);
    assert_eq!(surface(&read(&sceneless.clone().set("/nodes", nested))), expected);
    assert_eq!(surface(&read(&sceneless.without("/nodes"))), expected);
}

#[test]
fn triangles_without_area_are_dropped_and_counted_and_open_edges_counted() {
    let mut file = GlbFile::tetrahedron();
    // The bottom twice by one corner, the slanted face missing.
    let faces = [[0_u16, 2, 1], [0, 1, 3], [0, 3, 2], [1, 1, 3]];
    let bytes = faces.as_flattened().iter().flat_map(|i| i.to_le_bytes()).collect();
    let indices = file.add_accessor(bytes, 12, 5123, "SCALAR");
    let mesh = read(&file.set("/meshes/0/primitives/0/indices", json!(indices)));
    let statistics = mesh.statistics;
    assert_eq!((statistics.triangles_read, statistics.degenerate, statistics.open_edges), (4, 1, 3));
    assert_eq!((mesh.triangles.len(), mesh.material_of_triangle.len()), (3, 3));
}

#[test]
fn a_sliver_far_from_the_origin_is_no_triangle_without_area() {
    // 1 µm high on 1 m, 500 m away: 10⁴ times what rounding of its corners could fake.
    let text = "v 500 500 0\nv 501 500 0\nv 500.5 500.000001 0\nf 1 2 3\n";
    let mesh = mesh_from_bytes(text.as_bytes(), Format::Obj, Path::new("s.obj"), &METRES).unwrap();
    assert_eq!((mesh.triangles.len(), mesh.statistics.degenerate), (1, 0));
    let collinear = "v 500.1 500.1 0\nv 500.2 500.2 0\nv 500.3 500.3 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n";
    let mesh = mesh_from_bytes(collinear.as_bytes(), Format::Obj, Path::new("s.obj"), &METRES).unwrap();
    assert_eq!((mesh.triangles.len(), mesh.statistics.degenerate), (1, 1));
}

#[test]
fn vertices_that_no_triangle_uses_move_no_bounding_box() {
    let mut file = GlbFile::tetrahedron();
    let positions =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0], [900.0, -5.0, f32::NAN]];
    let positions = file.add_accessor(floats(&positions), 5, 5126, "VEC3");
    let mesh = read(&file.set("/meshes/0/primitives/0/attributes", json!({ "POSITION": positions })));
    assert_eq!(mesh.vertices_m.len(), 4);
    let centred = centred(mesh);
    let sides = [0, 1, 2].map(|axis| extent(&centred, axis));
    assert_eq!(sides, [[-1.5, 1.5], [-0.5, 0.5], [0.0, 2.0]]);
}

#[test]
fn binary_and_text_stl_and_obj_hold_the_same_cube_corner() {
    let corners =
        [[[0.0_f32; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[0.0; 3], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]];
    let facet = |t: &[[f32; 3]; 3]| [floats(&[[0.0; 3]]), floats(t), vec![0; 2]].concat();
    // Binary files that begin with `solid` exist.
    let header = [&b"solid liar"[..], &[b' '; 70], &2_u32.to_le_bytes()].concat();
    let binary = [header, facet(&corners[0]), facet(&corners[1])].concat();
    let vertex = |v: &[f32; 3]| format!("vertex {} {} {}\n", v[0], v[1], v[2]);
    let facets = corners.iter().map(|t| {
        format!(
            "facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n",
            t.iter().map(vertex).collect::<String>()
        )
    });
    let text = format!("solid corner\n{}endsolid corner\n", facets.collect::<String>());
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1 1.0\no c\ng c\ns off\nusemtl  bare metal_#25 # why\nf 1 2 3\nf -4/1 -2/2 \\\n-1/3\n";
    let read = |bytes: &[u8], format| mesh_from_bytes(bytes, format, Path::new("c"), &METRES).unwrap();
    let from_binary = read(&binary, Format::Stl);
    for text in [&text, &text.to_uppercase()] {
        assert_eq!(surface(&from_binary), surface(&read(text.as_bytes(), Format::Stl)));
    }
    let from_obj = read(obj.as_bytes(), Format::Obj);
    assert_eq!(surface(&from_binary), surface(&from_obj));
    assert_eq!(from_obj.materials, ["bare metal_#25"]);
    assert_eq!((from_binary.statistics.open_edges, from_obj.statistics.open_edges), (4, 4));
    // Body axes already: forward stays forward.
    assert!(from_obj.vertices_m.contains(&[1.0, 0.0, 0.0]));
}

#[test]
fn obj_normals_and_polygons_are_read() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nvn 0 0 2\nvn 0 1 0\nf 1//1 2//1 3//1 4//1\nf 1//2 5//2 2//2\n";
    let mesh = mesh_from_bytes(text.as_bytes(), Format::Obj, Path::new("n.obj"), &METRES).unwrap();
    assert_eq!(
        (mesh.triangles.len(), mesh.vertices_m.len()),
        (3, 7),
        "a corner with two normals is two vertices"
    );
    let up = mesh.normals.iter().filter(|n| **n == [0.0, 0.0, 1.0]).count();
    assert_eq!((up, mesh.normals.len()), (4, 7));
    let idle = format!("v nan 0 0\nvn nan 0 0\n{}", text.replace("v 0 0 1", "v 0 0 1\nv 0 inf 0"));
    let idle = idle
        .replace("f 1//1 2//1 3//1 4//1", "f 2//2 3//2 4//2 5//2")
        .replace("1//2 5//2 2//2", "2//3 6//3 3//3");
    let again = mesh_from_bytes(idle.as_bytes(), Format::Obj, Path::new("n.obj"), &METRES).unwrap();
    assert_eq!((again.triangles, again.normals), (mesh.triangles, mesh.normals), "no face has those of NaN");
}

#[test]
fn the_projects_vehicles_come_back_from_their_files() {
    for name in scene::vehicles::NAMES {
        let vehicle = scene::vehicles::vehicle(name, 0).unwrap();
        let (made, bytes) = (&vehicle.mesh, scene::vehicles::glb(&vehicle));
        let back = mesh_from_bytes(&bytes, Format::Glb, Path::new(name), &METRES).unwrap();
        assert_eq!((back.triangles.len(), back.statistics.degenerate), (made.triangles.len(), 0), "{name}");
        let names = |mesh: &Mesh| mesh.materials.iter().cloned().collect::<BTreeSet<_>>();
        assert_eq!(names(&back), names(made), "{name}");
        let extents = |mesh: &Mesh| [0, 1, 2].map(|axis| extent(mesh, axis));
        for (read, written) in extents(&back).into_iter().flatten().zip(extents(made).into_iter().flatten()) {
            // Files hold 32-bit floats.
            assert!(
                (read - written).abs() <= f64::from(f32::EPSILON) * written.abs(),
                "{name}: {read} {written}"
            );
        }
        assert_eq!(back.normals.len(), back.vertices_m.len(), "{name} is smooth");
    }
}

/// Lowest and highest coordinate along an axis.
fn extent(mesh: &Mesh, axis: usize) -> [f64; 2] {
    let ends = |[low, high]: [f64; 2], v: &[f64; 3]| [low.min(v[axis]), high.max(v[axis])];
    mesh.vertices_m.iter().fold([f64::MAX, f64::MIN], ends)
}

#[test]
fn the_shared_vehicles_read_with_the_sizes_of_their_manifest() {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/vehicles"));
    let Ok(manifest) = std::fs::read_to_string(folder.join("manifest.toml")) else {
        println!("skipped: ../shared is not here");
        return;
    };
    let manifest: toml::Table = manifest.parse().unwrap();
    let vehicles = manifest["vehicle"].as_array().unwrap();
    assert!(vehicles.len() >= 19, "{} vehicles", vehicles.len());
    for vehicle in vehicles {
        let name = vehicle["name"].as_str().unwrap();
        let mesh = read_mesh(&folder.join(format!("{name}.glb")), &METRES).unwrap();
        let size = |axis: usize| extent(&mesh, axis)[1] - extent(&mesh, axis)[0];
        for (axis, key) in ["length_m", "width_m", "height_m"].into_iter().enumerate() {
            // The manifest is rounded to millimetres.
            assert!(
                (size(axis) - vehicle[key].as_float().unwrap()).abs() <= 0.0005 + 1e-6,
                "{name} {key}: {}",
                size(axis)
            );
        }
        let statistics = mesh.statistics;
        let counted = (statistics.triangles_read - statistics.degenerate) as i64;
        assert_eq!(Some(counted), vehicle["triangles"].as_integer(), "{name}");
        assert_eq!(mesh.materials.len(), vehicle["materials"].as_array().unwrap().len(), "{name}");
        assert_eq!(Some(statistics.open_edges as i64), vehicle["open_edges"].as_integer(), "{name}");
    }
}

#[test]
fn vehicles_of_the_project_are_read_back_as_they_were_written() {
    let folder = tempfile::tempdir().unwrap();
    for name in vehicles::names() {
        let vehicle = vehicles::vehicle(name, 0).unwrap();
        let (file, written) = (folder.path().join(format!("{name}.glb")), &vehicle.mesh);
        std::fs::write(&file, vehicles::glb(&vehicle)).unwrap();
        let read = read_mesh(&file, &METRES).unwrap();
        let (got, asked) = (triangles(&read), triangles(written));
        assert_eq!(got.len(), asked.len(), "{name}");
        for (got, asked) in got.iter().zip(&asked) {
            assert_eq!((&got.0, got.1), (&asked.0, asked.1), "{name}");
            // The reader makes them unit vectors again: an ulp or two of single precision.
            let are_as_written = got.2.iter().zip(&asked.2).all(|(g, a)| (g - a).abs() <= 2.4e-7);
            assert!(are_as_written, "{name}: {:?} for {:?}", got.2, asked.2);
        }
        assert_eq!(read.statistics, written.statistics, "{name}");
        wheels::check_wheels(name, &read, written);
    }
}

/// Material, corners' bits and normals of every triangle, in the order of the first two: a file has the body
/// first, then its wheels.
fn triangles(mesh: &Mesh) -> Vec<(String, [[u64; 3]; 3], Vec<f32>)> {
    let of = |(t, material): (&[u32; 3], &u16)| {
        let places = t.map(|corner| mesh.vertices_m[corner as usize].map(f64::to_bits));
        let normals = t.iter().flat_map(|corner| mesh.normals[*corner as usize]).collect();
        (mesh.materials[usize::from(*material)].clone(), places, normals)
    };
    let mut all: Vec<_> = mesh.triangles.iter().zip(&mesh.material_of_triangle).map(of).collect();
    all.sort_by(|a, b| (&a.0, a.1).cmp(&(&b.0, b.1)));
    all
}
