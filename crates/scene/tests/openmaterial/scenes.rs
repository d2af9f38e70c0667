//! Scenes with assets as models, and with materials of OpenMATERIAL 3D among their own.

use crate::fixture::{Fixture, MATERIAL_FILES, row, with_metadata};
use artifact::material::{Backing, Layer, Material, Thickness};
use artifact::scene::{Mesh, SceneHeader};
use num_complex::Complex64;
use scene::{MeshLoading, ReadOptions, SceneErrors, read, read_materials};
use serde_json::json;

const WHOLE: ReadOptions = ReadOptions::whole();

fn scene_text(model: &str) -> String {
    format!(
        "name = \"s\"\n[[target]]\nkind = \"mesh\"\nid = \"a\"\nmodel = \"{model}\"\nposition_m = [5, 30, 0]\n"
    )
}

fn open(files: &Fixture, text: &str) -> Result<SceneHeader, SceneErrors> {
    files.write_bytes("s.toml", text.as_bytes());
    read(&files.path("s.toml"), &WHOLE)
}

fn refused(files: &Fixture, text: &str) -> String {
    files.told(&open(files, text).unwrap_err())
}

fn material(scene: &SceneHeader, name: &str) -> Material {
    let mesh = &scene.meshes[0];
    let slot = mesh.materials.iter().position(|known| known == name).unwrap();
    mesh.makeup.material(slot as u16).clone()
}

fn half_space(re: f64, im: f64) -> Material {
    Material::HalfSpace { permittivity: Complex64::new(re, im) }
}

#[test]
fn a_scene_with_an_asset_is_one_with_its_gltf_and_the_same_materials_by_toml() {
    let car = Fixture::car();
    let by_asset = open(&car, &scene_text("car.xoma")).unwrap();
    let materials =
        "[materials]\npaint = { permittivity = [3.0, 0.1] }\nglass = { permittivity = [6.0, 0.2] }\n";
    let by_toml = open(&car, &(scene_text("car.glb") + materials)).unwrap();
    let renamed = |mesh: &Mesh| Mesh { name: String::new(), ..mesh.clone() };
    assert_eq!(renamed(&by_asset.meshes[0]), renamed(&by_toml.meshes[0]));
    assert_eq!(material(&by_asset, "glass"), half_space(6.0, -0.2));
}

#[test]
fn clutter_and_the_option_for_models_take_assets_too() {
    let car = Fixture::car();
    let clutter = "name = \"s\"\n[[clutter]]\nid = \"k\"\nmodel = \"car.xoma\"\nposition_m = [5, 30, 0]\n";
    let by_asset = open(&car, clutter).unwrap();
    assert_eq!(material(&by_asset, "paint"), half_space(3.0, -0.1));
    car.write_bytes("s.toml", scene_text("car-suv").as_bytes());
    let options = ReadOptions { model: Some(car.path("car.xoma")), ..WHOLE };
    let replaced = read(&car.path("s.toml"), &options).unwrap();
    assert_eq!(material(&replaced, "paint"), half_space(3.0, -0.1));
}

#[test]
fn a_materials_entry_wins_over_the_mapping() {
    let car = Fixture::car();
    car.remove("m/glass.xomp");
    let text = scene_text("car.xoma") + "[materials]\nglass = { substance = \"metal\" }\n";
    let scene = open(&car, &text).unwrap();
    assert_eq!(material(&scene, "glass"), Material::Conductor);
    assert_eq!(material(&scene, "paint"), half_space(3.0, -0.1));
}

#[test]
fn permittivities_are_those_at_the_centre_of_the_sweep() {
    let car = Fixture::car();
    car.material("m/glass", &[row(Some(70e9), [7.0, 0.0]), row(Some(90e9), [5.0, 0.0])]);
    for start_ghz in [76.0, 78.5] {
        let sweep = format!("[radar.waveform]\nstart_frequency_ghz = {start_ghz:?}\n");
        let scene = open(&car, &(scene_text("car.xoma") + &sweep)).unwrap();
        let centre_hz = scene.radar.waveform.centre_frequency_hz();
        assert!(centre_hz > 1e9 * start_ghz);
        let Material::HalfSpace { permittivity } = material(&scene, "glass") else { panic!() };
        let expected = 7.0 - 1e-10 * (centre_hz - 70e9);
        assert!((permittivity.re - expected).abs() < 32.0 * f64::EPSILON * expected);
    }
    let low = scene_text("car.xoma") + "[radar.waveform]\nstart_frequency_ghz = 24.0\n";
    let told = refused(&car, &low);
    assert!(
        told.starts_with("s.toml:5:9: target `a`: m/glass_emp.xompt: electromagneticProperties: "),
        "{told}"
    );
}

#[test]
fn all_files_of_an_asset_are_inputs_of_the_scene() {
    let car = Fixture::car();
    car.write_bytes("s.toml", scene_text("car.xoma").as_bytes());
    let files = car.paths(&["s.toml", "car.xoma", "car.glb"], &MATERIAL_FILES);
    assert_eq!(scene::inputs(&car.path("s.toml"), &WHOLE).unwrap(), files);
    car.remove("m/paint_emp.xompt");
    assert_eq!(scene::inputs(&car.path("s.toml"), &WHOLE).unwrap(), files[..7]);
    assert!(read(&car.path("s.toml"), &WHOLE).unwrap_err().is_system());
}

#[test]
fn a_material_of_a_scene_is_one_of_openmaterial_filled_or_layered() {
    let car = Fixture::car();
    let text = scene_text("car.glb")
        + "[materials]\nglass = { openmaterial = \"m/glass.xomp\", thickness_mm = 5.0, coherent = false }\n\
           paint = { layers = [{ openmaterial = \"m/paint.xomp\", thickness_mm = 0.1 }], backing = \"metal\" }\n";
    let scene = open(&car, &text).unwrap();
    let layer = |thickness_m, re, im| Layer { thickness_m, permittivity: Complex64::new(re, im) };
    let pane = Material::Layers {
        layers: vec![layer(5e-3, 6.0, -0.2)],
        backing: Backing::Air,
        thickness: Thickness::Averaged,
    };
    let coat = Material::Layers {
        layers: vec![layer(1e-4, 3.0, -0.1)],
        backing: Backing::Metal,
        thickness: Thickness::Exact,
    };
    assert_eq!([material(&scene, "glass"), material(&scene, "paint")], [pane, coat]);
    let inputs = scene::inputs(&car.path("s.toml"), &WHOLE).unwrap();
    for name in ["m/glass.xomp", "m/glass_emp.xompt", "m/paint.xomp", "m/paint_emp.xompt"] {
        assert!(inputs.contains(&car.path(name)), "{name}");
    }
}

#[test]
fn a_file_of_materials_names_its_own_from_its_own_folder() {
    let car = Fixture::car();
    car.write_bytes("m/m.toml", b"[materials]\nglass = { openmaterial = \"glass.xomp\" }\n");
    let map = read_materials(&car.path("m/m.toml"), 77e9).unwrap();
    assert_eq!(map.by_name, [("glass".to_owned(), half_space(6.0, -0.2))]);
    let scene = open(&car, &(scene_text("car.glb") + "[fidelity]\nmaterials = \"m/m.toml\"\n")).unwrap();
    assert_eq!(material(&scene, "glass"), half_space(6.0, -0.2));
    let inputs = scene::inputs(&car.path("s.toml"), &WHOLE).unwrap();
    let of_materials = ["m/m.toml", "m/glass.xomp", "m/glass_emp.xompt"].map(|name| car.path(name));
    assert_eq!(inputs[1..4], of_materials);
}

#[test]
fn a_road_takes_permittivity_and_roughness() {
    let car = Fixture::car();
    let road = |height: serde_json::Value, more: &str| {
        let properties = json!({
            "surfaceRoughness": { "surfaceHeightRms": height },
            "electromagneticPropertiesUri": "glass_emp.xompt" });
        car.write("m/glass.xomp", &with_metadata(json!({ "materialProperties": properties })));
        open(&car, &format!("name = \"s\"\n[road]\nopenmaterial = \"m/glass.xomp\"\n{more}"))
    };
    let rough = road(json!(8e-4), "").unwrap().road.unwrap();
    assert_eq!((rough.material, rough.rms_height_m), (half_space(6.0, -0.2), 8e-4));
    assert_eq!(road(json!(8e-4), "rms_height_mm = 0.25\n").unwrap().road.unwrap().rms_height_m, 2.5e-4);
    assert!(road(json!(0.8), "rms_height_mm = 0.25\n").is_ok());
    let told = car.told(&road(json!(0.8), "").unwrap_err());
    let expected = "s.toml:3:16: [road]: m/glass.xomp: materialProperties.surfaceRoughness.surfaceHeightRms: a \
                    road's height in m, unless `rms_height_mm` says it, must be from 0 to 0.1, is 0.8";
    assert_eq!(told, expected);
    car.material("m/glass", &[row(None, [6.0, 0.2])]);
    let text = "name = \"s\"\n[road]\nopenmaterial = \"m/glass.xomp\"\n";
    assert_eq!(open(&car, text).unwrap().road.unwrap().rms_height_m, 5e-4, "the key's default");
}

#[test]
fn every_mistake_with_the_key_is_told_with_its_place() {
    let car = Fixture::car();
    car.material("metal", &[row(None, [1.0, 1e7])]);
    for (line, told) in [
        (
            "glass = { openmaterial = \"m/glass.xomp\", substance = \"glass\" }",
            "`openmaterial` and `substance` exclude one another",
        ),
        (
            "glass = { openmaterial = \"m/glass.xomp\", permittivity = [2, 0] }",
            "`openmaterial` and `permittivity` exclude one another",
        ),
        (
            "glass = { openmaterial = \"m/glass.xomp\", layers = [] }",
            "`openmaterial` and `layers` exclude one another",
        ),
        ("glass = { openmaterial = 5 }", "`openmaterial` must be a text in quotes, is a whole number"),
        ("glass = { openmaterial = \"m/none.xomp\" }", "m/none.xomp: cannot be read: "),
        ("glass = { openmaterial = \"s.toml\" }", "s.toml: is no JSON: "),
        (
            "glass = { openmaterial = \"metal.xomp\", thickness_mm = 1 }",
            "key `thickness_mm` has no meaning for metal",
        ),
        (
            "glass = { layers = [{ openmaterial = \"metal.xomp\", thickness_mm = 1 }] }",
            "key `openmaterial` has no meaning for a layer of metal: say backing = \"metal\"",
        ),
    ] {
        let found = refused(&car, &format!("name = \"s\"\n[materials]\n{line}\n"));
        assert!(found.starts_with("s.toml:3:") && found.contains(told), "{line}: {found}");
    }
    let mirror = refused(&car, "name = \"s\"\n[road]\nmirror = \"off\"\nopenmaterial = \"m/glass.xomp\"\n");
    assert!(mirror.contains("key `openmaterial` has no meaning for a road that is no mirror"), "{mirror}");
}

#[test]
fn a_broken_asset_is_told_once_at_its_model() {
    let car = Fixture::car();
    car.write_bytes("car.xoma", b"{}");
    let told = refused(&car, &scene_text("car.xoma"));
    assert_eq!(told, "s.toml:5:9: target `a`: car.xoma: key `metadata` is missing");
    let names_only = ReadOptions { meshes: MeshLoading::NamesOnly, ..WHOLE };
    assert!(read(&car.path("s.toml"), &names_only).is_ok(), "models are not opened");
}
