//! Wheels of mesh files: found by names, and again in files of the project's own vehicles.

use crate::glb_file::{GlbFile, floats};
use crate::{METRES, read};
use artifact::scene::{Mesh, RoadWheel};
use scene::mesh::{Format, mesh_from_bytes};
use scene::{centred, vehicles};
use serde_json::json;
use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn wheels_are_found_again_in_the_file_of_a_vehicle_whose_own_name_is_that_of_wheels() {
    // Of 9 and of other numbers of sectors; the bodies of the last two have the name of wheels.
    let vehicles = [
        ("car-classic", 3, 4),
        ("car-pickup", 5, 4),
        ("truck-sixwheel-plain", 2020412072409598, 6),
        ("truck-sixwheel-plain", 2, 6),
    ];
    for (name, seed, wheels) in vehicles {
        let vehicle = vehicles::vehicle(name, seed).unwrap();
        assert_eq!(vehicle.mesh.wheels.len(), wheels, "{name}");
        let bytes = vehicles::glb(&vehicle);
        let read = mesh_from_bytes(&bytes, Format::Glb, Path::new(name), &METRES).unwrap();
        check_wheels(name, &read, &vehicle.mesh);
    }
}

#[test]
fn the_name_of_a_whole_body_is_not_that_of_its_parts_but_a_root_beside_others_may_be_a_wheel() {
    let named = |file: &GlbFile, nodes: serde_json::Value, roots: &[usize]| {
        let file = file.clone().set("/nodes", nodes).set("/scenes", json!([{ "nodes": roots }]));
        read(&file).wheels.len()
    };
    let wheel = wheel_file("", "big wheels", "");
    let whole = json!([{ "name": "big wheels", "mesh": 0, "children": [1] }, {}]);
    assert_eq!(named(&wheel, whole, &[0]), 0, "the body's own mesh");
    let other = json!([{ "name": "monster", "mesh": 0, "children": [1] }, {}]);
    assert_eq!(named(&wheel, other, &[0]), 1, "a mesh with a name of its own");
    let wheel = wheel_file("", "", "");
    let beside = json!([{ "name": "Wheel_FL", "mesh": 0, "children": [1] }, {}, {}]);
    assert_eq!(named(&wheel, beside, &[0, 2]), 1, "one root of two");
    let alone = json!([{ "name": "Wheel_FL", "mesh": 0 }]);
    assert_eq!(named(&wheel, alone, &[0]), 1, "a root without children");
}

/// The wheels of a mesh with their triangles' places, against those of another.
pub(crate) fn check_wheels(name: &str, read: &Mesh, written: &Mesh) {
    let places = |mesh: &Mesh, wheel: &RoadWheel| {
        let triangle =
            |t: &u32| mesh.triangles[*t as usize].map(|c| mesh.vertices_m[c as usize].map(f64::to_bits));
        wheel.triangles.iter().map(triangle).collect::<BTreeSet<_>>()
    };
    assert_eq!(read.wheels.len(), written.wheels.len(), "{name}");
    for (got, asked) in read.wheels.iter().zip(&written.wheels) {
        let off = got.hub_m.iter().zip(&asked.hub_m).map(|(g, a)| (g - a).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9 && (got.radius_m - asked.radius_m).abs() < 1e-9, "{name}: {got:?} for {asked:?}");
        assert_eq!(places(read, got), places(written, asked), "{name}");
    }
}

/// A tube of 24 sectors about glTF's x axis, to the left of a body, with three spokes: wheel and names of its
/// node, mesh and material.
fn wheel_file(node: &str, mesh: &str, material: &str) -> GlbFile {
    let mut file = GlbFile::tetrahedron();
    let (radius, spokes) = (0.3_f32, 3_u16);
    let at = |x: f32, radius: f32, angle: f32| [x, radius * angle.sin(), radius * angle.cos()];
    let step = std::f32::consts::TAU / 24.0;
    let mut points: Vec<[f32; 3]> = vec![];
    (0..24).for_each(|k| points.extend([-0.1, 0.1].map(|x| at(x, radius, step * k as f32))));
    for k in 0..spokes {
        let angle = f32::from(k) * std::f32::consts::TAU / f32::from(spokes);
        points.extend([at(0.0, 0.02, angle), at(0.0, 0.25, angle - 0.1), at(0.0, 0.25, angle + 0.1)]);
    }
    let tube = (0..24_u16).flat_map(|k| {
        let [a, b, c, d] = [2 * k, 2 * k + 1, (2 * k + 2) % 48, (2 * k + 3) % 48];
        [a, b, c, b, d, c]
    });
    let corners: Vec<u16> = tube.chain(48..48 + 3 * spokes).collect();
    let positions = file.add_accessor(floats(&points), points.len() as u64, 5126, "VEC3");
    let bytes = corners.iter().flat_map(|i| i.to_le_bytes()).collect();
    let indices = file.add_accessor(bytes, corners.len() as u64, 5123, "SCALAR");
    file.set("/materials", json!([{ "name": material }]))
        .set(
            "/meshes",
            json!([{ "name": mesh, "primitives": [
            { "attributes": { "POSITION": positions }, "indices": indices, "material": 0, "mode": 4 }] }]),
        )
        .set(
            "/nodes",
            json!([{ "children": [1] },
            { "name": node, "children": [2] },
            { "mesh": 0, "translation": [0.7, 0.3, 1.2] }]),
        )
        .set("/scenes", json!([{ "nodes": [0] }]))
}

#[test]
fn nodes_meshes_and_materials_named_so_are_wheels_whose_spokes_turn() {
    for names in [["Wheel_FL", "", ""], ["", "front tyre", ""], ["", "", "wheel_rim"]] {
        let [node, mesh, material] = names;
        let read = centred(read(&wheel_file(node, mesh, material)));
        let [wheel] = &read.wheels[..] else { panic!("{names:?}: {:?}", read.wheels) };
        // Its origin is under its middle then.
        assert!((wheel.hub_m[0].hypot(wheel.hub_m[1])) < 1e-6 && (wheel.hub_m[2] - 0.3).abs() < 1e-6);
        assert!((wheel.radius_m - 0.3).abs() < 1e-6);
        assert_eq!(wheel.triangles, [48, 49, 50], "the tube looks the same however far it has turned");
    }
    for names in [["body", "", ""], ["", "steering wheel", ""], ["", "", "wheel arch"]] {
        let [node, mesh, material] = names;
        assert_eq!(read(&wheel_file(node, mesh, material)).wheels, [], "{names:?}");
    }
}

#[test]
fn own_vehicles_have_their_wheels_on_the_ground() {
    for (name, wheels) in [("car-sedan", 4), ("motorcycle-street", 2), ("truck-box", 4)] {
        let mesh = vehicles::mesh(name, 0).unwrap();
        assert_eq!(mesh.wheels.len(), wheels, "{name}");
        for wheel in &mesh.wheels {
            assert!((wheel.hub_m[2] / wheel.radius_m - 1.0).abs() < 0.04, "{name}: {:?}", wheel.hub_m);
            let named = wheel.triangles.iter().all(|i| (*i as usize) < mesh.triangles.len());
            assert!(named && wheel.triangles.len() > 50);
        }
    }
}
