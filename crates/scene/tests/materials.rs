//! Materials and the road: what is read, and what is refused where.

#![allow(clippy::unwrap_used, reason = "a test ends where it meets what it did not expect")]

use artifact::material::{Backing, Layer, Material, Road, Thickness, Transmission};
use artifact::scene::{Backscatter, SceneHeader};
use num_complex::Complex64;
use scene::street::Furniture;
use scene::{ReadOptions, read, read_materials};
use std::path::{Path, PathBuf};

const OPTIONS: ReadOptions = ReadOptions::whole();
const TARGET: &str = "[[target]]\nkind = \"mesh\"\nid = \"a\"\nmodel = \"car-sedan\"\nlane = 1\ny_m = 30.0\n";

fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path
}

fn scene(text: &str) -> SceneHeader {
    let folder = tempfile::tempdir().unwrap();
    read(&write(folder.path(), "s.toml", text), &OPTIONS).unwrap()
}

/// The errors of a scene without the folder.
fn refused(text: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let errors = read(&write(folder.path(), "s.toml", text), &OPTIONS).unwrap_err();
    errors.to_string().replace(&format!("{}/", folder.path().display()), "")
}

fn material_of(scene: &SceneHeader, name: &str) -> Material {
    let mesh = &scene.meshes[0];
    let slot = mesh.materials.iter().position(|known| known == name).unwrap();
    mesh.makeup.material(slot as u16).clone()
}

#[test]
fn a_scene_without_materials_and_road_is_all_conductor() {
    let scene = scene(&format!("name = \"s\"\n{TARGET}"));
    assert!(scene.meshes[0].makeup.is_perfect_conductor() && scene.road.is_none());
    assert_eq!(scene.meshes[0].makeup.transmission, Transmission::Ignored);
}

#[test]
fn inline_materials_dress_the_meshes_that_name_them() {
    let text = format!(
        "name = \"s\"\n{TARGET}[fidelity]\ntransmission = \"on\"\n[materials]\n\
         glass = {{ substance = \"glass\", thickness_mm = 5.0, coherent = false }}\n\
         rubber = {{ permittivity = [4.1, 0.5] }}\nsteel = {{ substance = \"metal\" }}\n\
         paint = {{ layers = [{{ substance = \"clear-coat\", thickness_mm = 0.1 }}], backing = \"metal\" }}\n"
    );
    let scene = scene(&text);
    let layer = |thickness_m, re, im| Layer { thickness_m, permittivity: Complex64::new(re, im) };
    let glass = Material::Layers {
        layers: vec![layer(5e-3, 6.5, -0.15)],
        backing: Backing::Air,
        thickness: Thickness::Averaged,
    };
    let paint = Material::Layers {
        layers: vec![layer(1e-4, 3.0, -0.1)],
        backing: Backing::Metal,
        thickness: Thickness::Exact,
    };
    assert_eq!(material_of(&scene, "glass"), glass);
    assert_eq!(material_of(&scene, "paint"), paint);
    assert_eq!(
        material_of(&scene, "rubber"),
        Material::HalfSpace { permittivity: Complex64::new(4.1, -0.5) }
    );
    assert_eq!(material_of(&scene, "steel"), Material::Conductor);
    assert_eq!(material_of(&scene, "plastic"), Material::Conductor, "not named in the map");
    assert_eq!(scene.meshes[0].makeup.transmission, Transmission::Followed);
}

#[test]
fn a_road_is_asphalt_unless_it_says_otherwise() {
    let road = |table: &str| scene(&format!("name = \"s\"\n{table}\n")).road;
    let half_space = |re, im| Material::HalfSpace { permittivity: Complex64::new(re, im) };
    assert_eq!(road("[road]"), Some(Road { material: half_space(9.5, -0.3), rms_height_m: 5e-4 }));
    let wet = road("[road]\nsubstance = \"water\"\nrms_height_mm = 0.0").unwrap();
    assert_eq!(wet, Road { material: half_space(8.8, -15.9), rms_height_m: 0.0 });
    assert_eq!(road("[road]\nsubstance = \"metal\"").unwrap().material, Material::Conductor);
}

#[test]
fn a_road_sends_back_of_itself_where_it_is_told_to_mirror_or_not() {
    let road = |table: &str| scene(&format!("name = \"s\"\n{table}\n"));
    assert_eq!(road("[road]").backscatter, None);
    let floor = road("[road]\nmirror = \"off\"\nbackscatter = \"floor\"");
    assert_eq!((floor.road, floor.backscatter), (None, Some(Backscatter { gamma: 0.01 })));
    let both = road("[road]\nbackscatter = \"floor\"\nbackscatter_gamma_db = -30.0");
    assert!(both.road.is_some() && both.backscatter == Some(Backscatter { gamma: 1e-3 }));
}

#[test]
fn the_map_of_the_own_vehicles_and_street_furniture_names_every_material_of_theirs() {
    let file = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/vehicles.materials.toml"));
    let map = read_materials(file, 77e9).unwrap();
    let [pole, sign] =
        [Furniture::Pole { height_m: 6.0, diameter_m: 0.1 }, Furniture::Sign { height_m: 3.0 }];
    let street = [pole, sign, Furniture::GuardRail { length_m: 4.0 }, Furniture::Kerb { length_m: 4.0 }];
    let vehicles = scene::vehicles::NAMES.map(|name| scene::vehicles::mesh(name, 0).unwrap());
    for mesh in vehicles.into_iter().chain(street.iter().map(scene::street::mesh)) {
        for material in mesh.materials {
            assert!(map.by_name.iter().any(|(known, _)| *known == material), "{}: {material}", mesh.name);
        }
    }
}

#[test]
fn a_file_of_materials_is_read_from_beside_the_scene_and_is_an_input_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let map = write(folder.path(), "m.toml", "[materials]\nglass = { substance = \"glass\" }\n");
    let text = format!("name = \"s\"\n{TARGET}[fidelity]\nmaterials = \"m.toml\"\n");
    let file = write(folder.path(), "s.toml", &text);
    assert!(matches!(material_of(&read(&file, &OPTIONS).unwrap(), "glass"), Material::HalfSpace { .. }));
    assert_eq!(scene::inputs(&file, &OPTIONS).unwrap(), [file, map]);
}

#[test]
fn every_mistake_in_materials_is_told_with_its_place() {
    let head = "name = \"s\"\n[materials]\n";
    for (line, told) in [
        (
            "glass = { substnce = \"glass\" }",
            "s.toml:3:11: material `glass`: unknown key `substnce`; the nearest is `substance`",
        ),
        (
            "glass = { substance = \"glas\" }",
            "s.toml:3:23: material `glass`: there is no substance `glas`; the nearest is `glass`",
        ),
        ("glass = 5", "s.toml:3:9: material `glass`: `material` must be a table such as"),
        ("glass = { thickness_mm = 5 }", "key `substance` is missing"),
        (
            "glass = { substance = \"glass\", permittivity = [6, 0] }",
            "`permittivity` and `substance` exclude one another",
        ),
        ("glass = { permittivity = [0.5, 0] }", "`permittivity` must be a number from 1 to 1000000, is 0.5"),
        (
            "glass = { permittivity = [6.5, -0.1] }",
            "`permittivity` must be a number from 0 to 1000000, is -0.1",
        ),
        (
            "glass = { substance = \"glass\", thickness_mm = 0 }",
            "`thickness_mm` must be a number above 0, up to 1000, is 0",
        ),
        (
            "glass = { substance = \"glass\", backing = \"metal\" }",
            "`backing` needs `thickness_mm` beside it",
        ),
        ("glass = { layers = [], backing = \"air\" }", "`layers` must have from 1 to 32 values, has 0"),
        ("glass = { layers = [{ substance = \"glass\" }] }", "key `thickness_mm` is missing"),
        (
            "glass = { layers = [{ substance = \"metal\", thickness_mm = 1 }] }",
            "key `substance` has no meaning for a layer of metal",
        ),
        (
            "glass = { substance = \"glass\", thickness_mm = 1, coherent = 1 }",
            "`coherent` must be true or false, is a whole number",
        ),
        (
            "glass = { substance = \"glass\", thickness_mm = 1, backing = \"wood\" }",
            "`backing` cannot be `wood`; it can be `air`, `metal`",
        ),
    ] {
        let errors = refused(&format!("{head}{line}\n"));
        assert!(errors.contains(told) && errors.starts_with("s.toml:3:"), "{line}: {errors}");
    }
}

#[test]
fn mistakes_in_a_file_of_materials_name_that_file() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "m.toml", "[materials]\nglass = { thicknes_mm = 5 }\n");
    let both = "name = \"s\"\n[fidelity]\nmaterials = \"m.toml\"\n";
    let errors = read(&write(folder.path(), "s.toml", both), &OPTIONS).unwrap_err();
    assert!(
        errors.to_string().contains(
            "m.toml:2:11: material `glass`: unknown key `thicknes_mm`; the nearest is `thickness_mm`"
        ),
        "{errors}"
    );
    let missing =
        read(&write(folder.path(), "t.toml", &both.replace("m.toml", "n.toml")), &OPTIONS).unwrap_err();
    assert!(missing.is_system(), "{missing}");
    let twice = refused("name = \"s\"\n[fidelity]\nmaterials = \"m.toml\"\n[materials]\n");
    assert!(twice.contains("`materials` and `[materials]` exclude one another"), "{twice}");
}

#[test]
fn a_key_of_a_scene_in_a_file_of_materials_is_not_sent_to_a_table_that_such_a_file_has_not() {
    let folder = tempfile::tempdir().unwrap();
    let text = "name = \"first\"\nsamples = 3\n[materials]\nsteel = { substance = \"metal\" }\n";
    let errors = read_materials(&write(folder.path(), "m.toml", text), 77e9).unwrap_err().to_string();
    assert!(errors.contains("m.toml:1:1: unknown key `name`\n"), "{errors}");
    assert!(errors.contains("m.toml:2:1: unknown key `samples`"), "{errors}");
    assert!(!errors.contains('['), "no heading of a scene: {errors}");
}
