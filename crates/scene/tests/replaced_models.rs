//! An option of one run that replaces the models of a scene's targets, and no others.

#![allow(clippy::unwrap_used, reason = "a test ends where it meets what it did not expect")]

use artifact::scene::{SceneHeader, TargetKind};
use artifact::settings::Class;
use scene::ReadOptions;
use std::path::Path;

/// A sheet of 4 × 2 m.
const SHEET: &str = "v 0 0 0\nv 4 0 0.5\nv 4 2 0.5\nv 0 2 0\nf 1 2 3 4\n";

const RECORDING: &str = r#"<fcd-export>
<timestep time="0"><vehicle id="a" x="2" y="30" angle="180" type="car" speed="9"/>
<vehicle id="b" x="5" y="30" angle="180" type="bus" speed="9"/></timestep>
<timestep time="0.1"><vehicle id="a" x="2" y="29.1" angle="180" type="car" speed="9"/>
<vehicle id="b" x="5" y="29.1" angle="180" type="bus" speed="9"/></timestep>
</fcd-export>
"#;

/// A scene beside a sheet and a recording, read with this model for that of each target.
fn read_with(model: &str, rest: &str) -> Result<SceneHeader, String> {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    std::fs::write(place("t.fcd.xml"), RECORDING).unwrap();
    std::fs::write(place("sheet.obj"), SHEET).unwrap();
    std::fs::write(place("large.obj"), SHEET.replace("v 4 ", "v 4000 ")).unwrap();
    std::fs::write(place("scene.toml"), format!("name = \"test\"\nframes = 1\n{rest}")).unwrap();
    let model = if model.contains('.') { place(model) } else { Path::new(model).to_owned() };
    let options = ReadOptions { model: Some(model), ..ReadOptions::whole() };
    scene::read(&place("scene.toml"), &options).map_err(|errors| errors.to_string())
}

/// A mesh target with that model and other keys.
fn target(model: &str, keys: &str) -> String {
    format!("[[target]]\nkind = \"mesh\"\nid = \"m\"\nposition_m = [2, 50, 0]\nmodel = \"{model}\"\n{keys}\n")
}

#[test]
fn vehicles_of_recorded_traffic_keep_their_models_and_classes() {
    let traffic = "[traffic]\nfcd = \"t.fcd.xml\"\nmodels = { car = { model = \"car-sedan\" } }\n";
    let scene = read_with("truck-box", &(traffic.to_owned() + &target("car-suv", ""))).unwrap();
    let recorded = scene.traffic.iter().flat_map(|traffic| &traffic.vehicles);
    let models: Vec<(&str, Option<Class>)> = std::iter::once(&scene.targets[0].kind)
        .chain(recorded.map(|vehicle| &vehicle.kind))
        .filter_map(|kind| match kind {
            TargetKind::Mesh { model, class, .. } => Some((model.as_str(), *class)),
            TargetKind::Point { .. } => None,
        })
        .collect();
    let expected =
        [("truck-box", Some(Class::Truck)), ("car-sedan", Some(Class::Car)), ("bus-city", Some(Class::Bus))];
    assert_eq!(models, expected);
}

#[test]
fn scale_and_seed_belong_to_what_is_replaced() {
    let extents = |model: &str, written: &str, keys: &str| {
        read_with(model, &target(written, keys)).map(|scene| scene.meshes[0].bounds_m())
    };
    let plain = extents("sheet.obj", "car-suv", "").unwrap();
    assert_eq!(extents("sheet.obj", "large.obj", "unit_scale = 0.001").unwrap(), plain);
    let sedan = extents("car-sedan", "car-suv", "").unwrap();
    assert_eq!(extents("car-sedan", "car-suv", "vehicle_seed = 5").unwrap(), sedan);
    let said = extents("large.obj", "large.obj", "unit_scale = 0.001").unwrap_err();
    assert!(
        said.contains("is 4000 m large, not 0.001 to 1000 m, and `--model` takes files in metres"),
        "{said}"
    );
}
