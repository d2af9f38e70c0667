//! Assets, mappings and materials that are refused: with file, place and rule.

use crate::fixture::{ASKED_HZ, Fixture, asset, mapping, row, with_metadata};
use artifact::material::MaterialMap;
use scene::{MeshOptions, asset_materials, read_mesh};
use serde_json::{Value, json};

const METRES: MeshOptions = MeshOptions { unit_scale: None };

/// The sentence of an asset that has no mesh.
fn refused_mesh(car: &Fixture) -> String {
    car.told(&read_mesh(&car.path("car.xoma"), &METRES).unwrap_err())
}

#[test]
fn an_asset_has_one_model_beside_it_of_a_format_that_is_read() {
    let car = Fixture::car();
    car.write_bytes("car.gltf", b"{}");
    assert_eq!(
        refused_mesh(&car),
        "car.xoma: has two models beside it, car.glb and car.gltf: leave one of them"
    );
    car.remove("car.glb");
    assert!(refused_mesh(&car).starts_with("car.gltf: "), "a fault of the model is told as that");
    car.remove("car.gltf");
    let missing = read_mesh(&car.path("car.xoma"), &METRES).unwrap_err();
    assert!(missing.is_system());
    let told = "car.xoma: has no model beside it: neither car.glb nor car.gltf is there";
    assert_eq!(refused_mesh(&car), told);
    for other in ["car.usd", "car.fbx"] {
        car.write_bytes(other, b"Kaydara FBX Binary");
        let told = format!(
            "car.xoma: its model {other} is of a format that is not read: write it as glTF, beside it as car.glb"
        );
        assert_eq!(refused_mesh(&car), told);
    }
}

#[test]
fn an_asset_of_other_assets_is_refused() {
    let car = Fixture::car();
    let others = json!([{ "referenceNode": "Hitch", "externalAssetUri": "trailer.xoma" }]);
    car.write("car.xoma", &asset(json!({ "externalAssetReferences": others })));
    let told = "is put together from other assets, which is not done here: join them in one model";
    assert_eq!(refused_mesh(&car), format!("car.xoma: externalAssetReferences: {told}"));
}

#[test]
fn every_file_has_a_version_that_is_known() {
    let car = Fixture::car();
    car.write("car.xoma", &json!({}));
    assert_eq!(refused_mesh(&car), "car.xoma: key `metadata` is missing");
    car.write("car.xoma", &json!({ "metadata": { "name": "car" } }));
    assert_eq!(refused_mesh(&car), "car.xoma: metadata: key `openMaterial3dVersion` is missing");
    for name in ["car.xomm", "m/glass.xomp", "m/glass_emp.xompt"] {
        let car = Fixture::car();
        let mut value: Value = serde_json::from_slice(&std::fs::read(car.path(name)).unwrap()).unwrap();
        value["metadata"]["openMaterial3dVersion"] = json!("2.0.0");
        car.write(name, &value);
        let told = "is of version `2.0.0` of OpenMATERIAL 3D; versions 1 are read";
        assert_eq!(car.refused(), format!("{name}: metadata.openMaterial3dVersion: {told}"));
    }
}

#[test]
fn text_that_is_no_json_is_refused_with_line_and_column_and_depth_is_bounded() {
    let car = Fixture::car();
    car.write_bytes("car.xomm", b"{\n  \"metadata\": }");
    assert_eq!(car.refused(), "car.xomm: is no JSON: expected value at line 2 column 15");
    car.write_bytes("car.xomm", b"\xff\xfe");
    assert!(car.refused().starts_with("car.xomm: is no JSON: "));
    car.write_bytes("car.xomm", "[".repeat(1 << 20).as_bytes());
    assert_eq!(car.refused(), "car.xomm: is no JSON: recursion limit exceeded at line 1 column 128");
    car.write_bytes("car.xomm", b"[1, 2]");
    assert_eq!(car.refused(), "car.xomm: must be an object, is a list of 2 values");
}

#[test]
fn files_are_bounded_alone_and_together() {
    let car = Fixture::car();
    car.write_bytes("m/glass.xomp", &vec![b' '; (4 << 20) + 1]);
    assert_eq!(car.refused(), "m/glass.xomp: has more than 4194304 bytes, the most that are read");
    car.write_bytes("car.xoma", &vec![b' '; (4 << 20) + 1]);
    assert_eq!(refused_mesh(&car), "car.xoma: has more than 4194304 bytes, the most that are read");

    let names: Vec<String> = (0..17).map(|i| format!("m{i}")).collect();
    let car = Fixture::car();
    let files: Vec<String> = names.iter().map(|name| format!("{name}.xomp")).collect();
    let entries: Vec<[&str; 2]> = names.iter().zip(&files).map(|(n, f)| [n.as_str(), f.as_str()]).collect();
    car.write("car.xomm", &mapping(&entries));
    for name in &names {
        car.material(name, &[row(None, [4.0, 0.1])]);
        let file = car.path(&format!("{name}.xomp"));
        let mut bytes = std::fs::read(&file).unwrap();
        bytes.resize(4 << 20, b' ');
        std::fs::write(&file, bytes).unwrap();
    }
    let asked = |names: &[String]| {
        asset_materials(&car.path("car.xoma"), names, &MaterialMap::default(), ASKED_HZ)
            .map_err(|error| car.told(&error))
    };
    assert_eq!(asked(&names[..15]).unwrap().by_name.len(), 15);
    let told = "the files of its asset have more than 67108864 bytes together, the most that are read";
    assert_eq!(asked(&names).unwrap_err(), format!("m15.xomp: {told}"));
}

#[test]
fn references_lead_to_files_of_the_same_folder_and_below_alone() {
    let outside = "leads elsewhere: files in the folder of this one and below it are read alone; no absolute \
                   path, no `..`, no `\\`, no `:`";
    let malformed = "is no relative path to a file";
    for (stem, rule) in [
        ("../a", outside),
        ("m/../../a", outside),
        ("%2e%2e/a", outside),
        ("/etc/a", outside),
        ("%2Fetc/a", outside),
        ("m\\a", outside),
        ("C%3Aa", outside),
        ("http://example.invalid/a", malformed),
        ("file:///a", malformed),
        ("C:a", malformed),
        ("a%2", malformed),
        ("%ff", malformed),
    ] {
        let car = Fixture::car();
        car.write("car.xoma", &asset(json!({ "materialMappingUri": format!("{stem}.xomm") })));
        let told = format!("car.xoma: materialMappingUri: `{stem}.xomm` {rule}");
        assert_eq!(refused_mesh(&car), told, "and the mesh alone is refused too");
        let car = Fixture::car();
        let file = format!("{stem}.xomp");
        car.write("car.xomm", &mapping(&[["paint", "m/paint.xomp"], ["glass", &file]]));
        assert_eq!(car.refused(), format!("car.xomm: materialMapping[1][1]: `{file}` {rule}"));
        let car = Fixture::car();
        let table = format!("{stem}_emp.xompt");
        let properties = json!({ "electromagneticPropertiesUri": table });
        car.write("m/paint.xomp", &with_metadata(json!({ "materialProperties": properties })));
        let place = "m/paint.xomp: materialProperties.electromagneticPropertiesUri";
        assert_eq!(car.refused(), format!("{place}: `{table}` {rule}"));
    }
}

#[test]
fn references_end_as_the_standard_says() {
    let car = Fixture::car();
    car.write("car.xoma", &asset(json!({ "materialMappingUri": "car.json" })));
    assert_eq!(refused_mesh(&car), "car.xoma: materialMappingUri: `car.json` must end in `.xomm`");
    let car = Fixture::car();
    car.write("car.xomm", &mapping(&[["paint", ""]]));
    assert_eq!(car.refused(), "car.xomm: materialMapping[0][1]: `` must end in `.xomp`");
    let properties = json!({ "electromagneticPropertiesUri": "paint_optical.xompt" });
    let car = Fixture::car();
    car.write("m/paint.xomp", &with_metadata(json!({ "materialProperties": properties })));
    assert!(car.refused().ends_with("`paint_optical.xompt` must end in `_emp.xompt`"));
}

#[test]
fn a_file_that_is_not_there_is_the_systems() {
    for name in ["car.xomm", "m/paint.xomp", "m/paint_emp.xompt"] {
        let car = Fixture::car();
        car.remove(name);
        let error = car.materials(ASKED_HZ).unwrap_err();
        assert!(error.is_system());
        assert!(car.told(&error).starts_with(&format!("{name}: cannot be read: ")));
    }
}

#[test]
fn a_material_that_is_not_mapped_is_refused_with_its_name() {
    let car = Fixture::car();
    car.write("car.xomm", &mapping(&[["paint", "m/paint.xomp"]]));
    let told = "car.xomm: materialMapping: maps no material `glass`, which `glass` of the model looks for: map \
                it, or name it in [materials]";
    assert_eq!(car.refused(), told);
    car.write("car.xomm", &mapping(&[]));
    let replaced =
        json!({ "materialMappingUri": "car.xomm", "materialReplacements": [["paint", "rgb:1;2;3"]] });
    car.write("car.xoma", &asset(replaced));
    let told = "car.xomm: materialMapping: maps no material `rgb:1;2;3`, which `paint` of the model (and 1 \
                more are not mapped) looks for: map it, or name it in [materials]";
    assert_eq!(car.refused(), told);
}

#[test]
fn a_material_by_a_texture_is_refused() {
    let car = Fixture::car();
    let textured =
        json!({ "materialMappingUri": "car.xomm", "materialTextureAssignment": [["paint", "a.png"]] });
    car.write("car.xoma", &asset(textured));
    let told =
        "material `paint` is told by the colours of a texture, which are not read: name it in [materials]";
    assert_eq!(car.refused(), format!("car.xoma: {told}"));
}

#[test]
fn a_material_without_electromagnetic_properties_is_refused() {
    let car = Fixture::car();
    let others = json!({ "densityData": { "density": 2699.0, "sources": "by hand" } });
    car.write("m/paint.xomp", &with_metadata(json!({ "materialProperties": others })));
    let told = "names no electromagnetic properties (`electromagneticPropertiesUri`): name it in [materials]";
    assert_eq!(car.refused(), format!("m/paint.xomp: materialProperties: {told}"));
}

#[test]
fn a_name_that_is_there_twice_is_refused() {
    let car = Fixture::car();
    car.write("car.xomm", &mapping(&[["paint", "m/paint.xomp"], ["paint", "m/glass.xomp"]]));
    assert_eq!(car.refused(), "car.xomm: materialMapping[1][0]: `paint` is there twice");
    let twice = json!([["paint", "a"], ["glass", "b"], ["paint", "c"]]);
    car.write("car.xoma", &asset(json!({ "materialReplacements": twice })));
    assert_eq!(refused_mesh(&car), "car.xoma: materialReplacements[2][0]: `paint` is there twice");
}

#[test]
fn values_of_another_kind_are_refused_with_their_place() {
    for (key, value, told) in [
        ("materialMappingUri", json!(5), ": must be a text, is 5"),
        ("materialReplacements", json!("paint"), ": must be a list, is the text `paint`"),
        (
            "materialReplacements",
            json!([["paint"]]),
            "[0]: must be a list of two texts, is a list of 1 values",
        ),
        ("materialTextureAssignment", json!([[1, "a.png"]]), "[0][0]: must be a text, is 1"),
        ("externalAssetReferences", json!({}), ": must be a list, is an object"),
        ("metadata", json!(true), ": must be an object, is true"),
    ] {
        let car = Fixture::car();
        let mut value_of_all = asset(json!({}));
        value_of_all[key] = value;
        car.write("car.xoma", &value_of_all);
        assert_eq!(refused_mesh(&car), format!("car.xoma: {key}{told}"));
    }
    let car = Fixture::car();
    let roughness = json!({ "surfaceRoughness": { "surfaceHeightRms": -1.0 } });
    car.write("m/paint.xomp", &with_metadata(json!({ "materialProperties": roughness })));
    let place = "m/paint.xomp: materialProperties.surfaceRoughness.surfaceHeightRms";
    assert_eq!(car.refused(), format!("{place}: the height in m must be from 0 to 1000, is -1"));
    let car = Fixture::car();
    car.write("car.xomm", &with_metadata(json!({ "materialMapping": [["paint", "m/paint.xomp", null]] })));
    assert_eq!(car.refused(), "car.xomm: materialMapping[0][2]: must be a text, is null");
}
