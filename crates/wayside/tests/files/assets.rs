//! Assets of OpenMATERIAL 3D as models: results are those of their glTF in the same materials.

#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use crate::common::Workplace;
use serde_json::{Value, json};

/// A painted and a bare plate of a tenth of a metre that meet at a right angle, as glTF with its buffer.
fn dihedral(place: &Workplace) {
    let corners: [[f32; 3]; 6] = [
        [0.0, 0.0, 0.1],
        [0.1, 0.0, 0.0],
        [0.1, 0.1, 0.0],
        [0.0, 0.1, 0.1],
        [-0.1, 0.0, 0.0],
        [-0.1, 0.1, 0.0],
    ];
    let facets: [[u16; 3]; 4] = [[0, 1, 2], [0, 2, 3], [4, 0, 3], [4, 3, 5]];
    let positions = corners.as_flattened().iter().flat_map(|x| x.to_le_bytes());
    let bytes: Vec<u8> =
        positions.chain(facets.as_flattened().iter().flat_map(|i| i.to_le_bytes())).collect();
    std::fs::write(place.path("d.bin"), bytes).unwrap();
    let view = |offset: u32, length: u32| json!({ "buffer": 0, "byteOffset": offset, "byteLength": length });
    let gltf = json!({
        "asset": { "version": "2.0" },
        "buffers": [{ "uri": "d.bin", "byteLength": 96 }],
        "bufferViews": [view(0, 72), view(72, 12), view(84, 12)],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" },
            { "bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR" }],
        "materials": [{ "name": "rubber" }, { "name": "rim" }],
        "meshes": [{ "primitives": [part(1, 0), part(2, 1)] }],
        "nodes": [{ "mesh": 0 }],
        "scenes": [{ "nodes": [0] }] });
    write(place, "d.gltf", gltf);
}

fn part(indices: u32, material: u32) -> Value {
    json!({ "attributes": { "POSITION": 0 }, "indices": indices, "material": material })
}

fn write(place: &Workplace, name: &str, value: Value) {
    std::fs::write(place.path(name), value.to_string()).unwrap();
}

fn write_openmaterial(place: &Workplace, name: &str, mut value: Value) {
    value["metadata"] = json!({ "name": name, "openMaterial3dVersion": "1.0.0" });
    write(place, name, value);
}

/// The asset: rubber of 4 − 0.4j at the frequencies asked for, and a rim of aluminium.
fn asset(place: &Workplace) {
    dihedral(place);
    write_openmaterial(place, "d.xoma", json!({ "materialMappingUri": "d.xomm" }));
    let entries = json!([["rubber", "rubber.xomp", "tyre"], ["rim", "rim.xomp", "aluminium"]]);
    write_openmaterial(place, "d.xomm", json!({ "materialMapping": entries }));
    for (name, real, loss) in [("rubber", 4.0, 0.4), ("rim", -3.2e4, 8.2e6)] {
        let properties = json!({ "electromagneticPropertiesUri": format!("{name}_emp.xompt") });
        write_openmaterial(place, &format!("{name}.xomp"), json!({ "materialProperties": properties }));
        let rows = json!([[0.0039, 293.15, 50.0, 1.0, 0.0, real, loss]]);
        write_openmaterial(place, &format!("{name}_emp.xompt"), json!({ "electromagneticProperties": rows }));
    }
}

#[test]
fn an_asset_has_the_table_of_its_gltf_in_the_same_materials_to_the_byte() {
    let place = Workplace::new();
    asset(&place);
    let map = "[materials]\nrubber = { permittivity = [4.0, 0.4] }\n";
    std::fs::write(place.path("m.toml"), map).unwrap();
    let asked = "--freq-ghz 76.5:77.5:3 --az-deg 12 --quiet --out";
    place.run(&format!("rcs d.xoma {asked} asset.npy"));
    place.run(&format!("rcs d.gltf --materials m.toml {asked} toml.npy"));
    place.run(&format!("rcs d.gltf {asked} metal.npy"));
    assert_eq!(place.bytes("asset.npy"), place.bytes("toml.npy"));
    assert_ne!(place.bytes("asset.npy"), place.bytes("metal.npy"));
    // An entry of the map wins over the mapping.
    std::fs::write(place.path("m.toml"), "[materials]\nrubber = { substance = \"metal\" }\n").unwrap();
    place.run(&format!("rcs d.xoma --materials m.toml {asked} all.npy"));
    assert_eq!(place.bytes("all.npy"), place.bytes("metal.npy"));
}

#[test]
fn a_broken_asset_is_refused_and_a_missing_file_of_it_is_the_systems_fault() {
    let place = Workplace::new();
    asset(&place);
    let code = |words: &str, told: &str| {
        let output = place.try_run(words);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(said.contains(told), "{said}");
        output.status.code()
    };
    let rcs = "rcs d.xoma --az-deg 0 --quiet --out s.npy --freq-ghz";
    assert_eq!(code(&format!("{rcs} 24"), "_emp.xompt: electromagneticProperties: knows 76.87 to"), Some(1));
    std::fs::remove_file(place.path("rim.xomp")).unwrap();
    assert_eq!(code(&format!("{rcs} 77"), "rim.xomp: cannot be read"), Some(2));
    let run = "run small.toml --model d.xoma --out a --quiet";
    assert_eq!(code(run, "target `corner-1`: rim.xomp: cannot be read"), Some(2));
    assert!(!place.path("s.npy").exists() && !place.path("a").exists());
}
