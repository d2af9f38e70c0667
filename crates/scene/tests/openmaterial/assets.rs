//! Whole assets: geometry and materials.

use crate::fixture::{ASKED_HZ, Fixture, MATERIAL_FILES, asset, mapping, row, text_model};
use artifact::material::{Material, MaterialMap};
use artifact::scene::Mesh;
use num_complex::Complex64;
use scene::{MeshOptions, asset_materials, read_mesh};
use serde_json::json;

const METRES: MeshOptions = MeshOptions { unit_scale: None };

fn half_space(re: f64, im: f64) -> Material {
    Material::HalfSpace { permittivity: Complex64::new(re, im) }
}

fn names(map: &MaterialMap) -> Vec<&str> {
    map.by_name.iter().map(|(name, _)| name.as_str()).collect()
}

#[test]
fn an_asset_has_the_triangles_of_the_gltf_beside_it() {
    let car = Fixture::car();
    let [asset, model] = ["car.xoma", "car.glb"].map(|name| read_mesh(&car.path(name), &METRES).unwrap());
    assert_eq!(asset.name, "car.xoma");
    assert_eq!(Mesh { name: "car.glb".to_owned(), ..asset }, model);
    assert_eq!(model.triangles.len(), 6);
    assert_eq!(model.materials, ["paint", "glass", ""]);
}

#[test]
fn a_text_gltf_and_its_buffer_are_read_and_are_files_of_the_asset() {
    let car = Fixture::car();
    let whole = read_mesh(&car.path("car.xoma"), &METRES).unwrap();
    car.remove("car.glb");
    let (json, buffer) = text_model("car.bin");
    car.write("car.gltf", &json);
    car.write_bytes("car.bin", &buffer);
    assert_eq!(read_mesh(&car.path("car.xoma"), &METRES).unwrap(), whole);
    let files = car.paths(&["car.xoma", "car.gltf", "car.bin"], &MATERIAL_FILES);
    assert_eq!(scene::mesh::files(&car.path("car.xoma")), files);
}

#[test]
fn a_scale_is_that_of_the_model() {
    let car = Fixture::car();
    let scaled = MeshOptions { unit_scale: Some(0.5) };
    let [whole, half] = [METRES, scaled].map(|options| read_mesh(&car.path("car.xoma"), &options).unwrap());
    let height_m = |mesh: &Mesh| mesh.vertices_m.iter().map(|v| v[2]).fold(0.0, f64::max);
    assert_eq!(height_m(&half), 0.5 * height_m(&whole));
}

#[test]
fn materials_are_those_of_the_mapping() {
    let map = Fixture::car().materials(ASKED_HZ).unwrap();
    let expected = [("paint", half_space(3.0, -0.1)), ("glass", half_space(6.0, -0.2))];
    assert_eq!(map.by_name, expected.map(|(name, material)| (name.to_owned(), material)));
    let mesh = read_mesh(&Fixture::car().path("car.xoma"), &METRES).unwrap();
    let makeup = map.mesh_materials(&mesh.materials);
    assert_eq!(makeup.materials[2], Material::Conductor, "no material");
}

#[test]
fn a_name_that_the_map_has_is_not_looked_up() {
    let car = Fixture::car();
    car.remove("m/glass.xomp");
    let own =
        MaterialMap { by_name: vec![("glass".to_owned(), Material::Conductor)], ..MaterialMap::default() };
    let names_of_model = ["paint", "glass", ""].map(str::to_owned);
    let map = asset_materials(&car.path("car.xoma"), &names_of_model, &own, ASKED_HZ).unwrap();
    assert_eq!(names(&map), ["glass", "paint"]);
    assert_eq!(map.by_name[0].1, Material::Conductor);
    assert!(car.refused().starts_with("m/glass.xomp: cannot be read"));
}

#[test]
fn a_mesh_of_another_format_says_nothing_of_its_materials() {
    let car = Fixture::car();
    let map = asset_materials(&car.path("car.glb"), &["paint".to_owned()], &MaterialMap::default(), ASKED_HZ);
    assert_eq!(map.unwrap(), MaterialMap::default());
}

#[test]
fn an_asset_without_a_mapping_conducts_all_over() {
    let car = Fixture::car();
    car.write("car.xoma", &asset(json!({})));
    assert_eq!(car.materials(ASKED_HZ).unwrap(), MaterialMap::default());
}

#[test]
fn replacements_are_looked_for_by_name_and_by_colour() {
    let car = Fixture::car();
    let replaced = json!([["glass", "rgb:255;0;11"], ["paint", "lacquer"]]);
    car.write(
        "car.xoma",
        &asset(json!({ "materialMappingUri": "./car.xomm", "materialReplacements": replaced })),
    );
    car.write("car.xomm", &mapping(&[["rgb:255;0;11", "m/paint.xomp"], ["lacquer", "m/glass.xomp"]]));
    let map = car.materials(ASKED_HZ).unwrap();
    let expected = [("paint", half_space(6.0, -0.2)), ("glass", half_space(3.0, -0.1))];
    assert_eq!(map.by_name, expected.map(|(name, material)| (name.to_owned(), material)));
}

#[test]
fn references_are_percent_decoded_and_start_at_the_file_that_they_stand_in() {
    let car = Fixture::car();
    car.write("car.xoma", &asset(json!({ "materialMappingUri": "of%20all/all.xomm" })));
    car.write("of all/all.xomm", &mapping(&[["glass", "m/glass.xomp"], ["paint", "m/glass.xomp"]]));
    car.material("of all/m/glass", &[row(None, [2.25, 0.0])]);
    let map = car.materials(ASKED_HZ).unwrap();
    assert!(map.by_name.iter().all(|(_, material)| *material == half_space(2.25, 0.0)));
}

#[test]
fn what_the_standard_adds_for_others_is_passed_over() {
    let car = Fixture::car();
    let others = json!({
        "materialMappingUri": "car.xomm",
        "externalAssetReferences": [],
        "lightDefinitions": [{ "node": "Grp_Light", "luminousIntensity": 20 }],
        "geometryProperties": [{ "node": "Pane", "thickness": 0.004 }],
        "customProperties": { "anything": [1, null] } });
    car.write("car.xoma", &asset(others));
    assert_eq!(names(&car.materials(ASKED_HZ).unwrap()), ["paint", "glass"]);
}
