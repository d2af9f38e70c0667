//! `echo --paths` takes the paths of its scene, whatever noise that has now, and of no other scene.

#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::{SMALL_SCENE, Workplace};
use artifact::cube::Cube;
use artifact::paths::Paths;
use artifact::{Provenance, Reader, Writer};

/// A workplace with the small scene's paths.
fn traced() -> Workplace {
    let place = Workplace::new();
    place.run("paths small.toml --out f.paths --quiet");
    place
}

#[test]
fn paths_serve_the_scene_with_other_noise_and_are_named_among_its_inputs() {
    let place = traced();
    std::fs::write(place.path("loud.toml"), SMALL_SCENE.replace("12.0", "20.0")).unwrap();
    place.run("echo loud.toml --paths f.paths --out loud.cube --quiet");
    let reader = Reader::<Cube>::open(&place.path("loud.cube")).unwrap();
    let names: Vec<&str> =
        reader.preamble().provenance.inputs.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["loud.toml", "corner.obj", "f.paths"]);
}

#[test]
fn paths_of_a_plan_serve_the_scene_without_one() {
    let place = Workplace::new();
    place.run("paths small.toml --accuracy-db -30 --out f.paths --quiet");
    place.run("echo small.toml --paths f.paths --out f.cube --quiet");
}

/// A scene that says a key of `[fidelity]` itself takes no paths of another one; where it says nothing the
/// paths may be those of a plan, and what is otherwise is told.
#[test]
fn paths_of_other_physics_are_refused_by_key_or_told() {
    let place = Workplace::new();
    let with = |keys: &str| format!("{SMALL_SCENE}\n[fidelity]\n{keys}\n");
    assert!(!SMALL_SCENE.contains("[fidelity]"));
    std::fs::write(place.path("single.toml"), with("bounces = 1\nedges = \"on\"")).unwrap();
    place.run("paths single.toml --out single.paths --quiet");
    place.run("echo single.toml --paths single.paths --out f.cube --quiet");
    for (keys, rule) in [
        ("bounces = 2", "single.paths: traced with bounces = 1, [fidelity] of the scene has 2"),
        ("edges = \"off\"", "single.paths: traced with edges = \"on\", [fidelity] of the scene has \"off\""),
    ] {
        std::fs::write(place.path("other.toml"), with(keys)).unwrap();
        let output = place.try_run("echo other.toml --paths single.paths --out other.cube --quiet");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(1) && said.contains(rule), "{said}");
    }
    let output = place.try_run("echo small.toml --paths single.paths --out f.cube");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    assert!(said.contains("traced with bounces = 1, where the scene takes 3: the cube is theirs"), "{said}");
}

#[test]
fn paths_of_another_scene_are_refused_by_what_is_other() {
    let place = traced();
    std::fs::copy(place.path("corner.obj"), place.path("panel.obj")).unwrap();
    let radar = "[radar]\nposition_m = [0.0, 0.0, 4.0]\n\n[radar.waveform]";
    for (from, to, rule) in [
        ("samples = 64", "samples = 128", "amplitudes hold for the sweep that they were traced for"),
        ("[radar.waveform]", radar, "the scene's radar is at [0.0, 0.0, 4.0] m"),
        (
            "id = \"reflector\"",
            "id = \"mirror\"",
            "traced of the bodies `corner-1`, `reflector`, the scene has",
        ),
        ("frames = 2", "frames = 1", "frame 1 is none of the scene's 1"),
        ("frames = 2", "frames = 2\nframe_interval_s = 0.3", "frame 1 begins at"),
        (
            "[2.0, 30.0, 1.0]",
            "[2.0, 30.25, 1.0]",
            "`reflector`: position_m was [2.0,30.0,1.0], the scene's is [2.0,30.25,1.0]",
        ),
        ("[-5.75, 40.0, 0.0]", "[-5.75, 40.25, 0.0]", "`corner-1`: position_m was [-5.75,40.0,0.0], "),
        ("[0.0, -3.0, 0.0]", "[0.0, -3.5, 0.0]", "`corner-1`: velocity_mps was [0.0,-3.0,0.0], "),
        ("[0.0, 0.0, 0.0]", "[0.0, 9.0, 0.0]", "`reflector`: velocity_mps was [0.0,0.0,0.0], "),
        ("class = \"car\"", "yaw_deg = -80.0", "`corner-1`: yaw_deg was -90.0, the scene's is -80.0"),
        ("class = \"car\"", "yaw_rate_dps = 5.0", "`corner-1`: yaw_rate_dps was 0.0, the scene's is 5.0"),
        ("rcs_m2 = 10.0", "rcs_m2 = 11.0", "`reflector`: rcs_m2 was 10.0, the scene's is 11.0"),
        ("\"corner.obj\"", "\"panel.obj\"", "not traced of the scene's mesh `panel.obj`"),
    ] {
        let scene = SMALL_SCENE.replacen(from, to, 1);
        assert_ne!(scene, SMALL_SCENE, "{from}");
        std::fs::write(place.path("other.toml"), scene).unwrap();
        let output = place.try_run("echo other.toml --paths f.paths --out other.cube --quiet");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{to}: {said}");
        assert!(said.contains("f.paths: ") && said.contains(rule), "{to}: {said}");
        assert!(!place.path("other.cube").exists(), "{to}");
    }
    let output = place.try_run("echo small.toml --paths f.paths --model panel.obj --out other.cube --quiet");
    assert_eq!(output.status.code(), Some(1));
    std::fs::write(
        place.path("corner.obj"),
        std::fs::read_to_string(place.path("corner.obj")).unwrap() + "\n#\n",
    )
    .unwrap();
    let output = place.try_run("echo small.toml --paths f.paths --out other.cube --quiet");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("f.paths: was made of another `corner.obj`, or before that was changed"), "{said}");
}

#[test]
fn paths_that_do_not_tell_of_bodies_are_refused_where_these_were_lit_elsewhere() {
    let place = traced();
    let reader = Reader::<Paths>::open(&place.path("f.paths")).unwrap();
    let from = Provenance { settings: String::new(), ..reader.preamble().provenance.clone() };
    let mut writer = Writer::<Paths>::create(&place.path("old.paths"), &from, reader.header()).unwrap();
    reader.for_each(|frame| writer.write(&frame.unwrap()).unwrap());
    writer.finish().unwrap();
    place.run("echo small.toml --paths old.paths --out old.cube --quiet");
    for (from, to, body) in [
        ("[2.0, 30.0, 1.0]", "[2.0, 20.0, 1.0]", "`reflector`"),
        ("[-5.75, 40.0, 0.0]", "[-5.75, 50.0, 0.0]", "`corner-1`"),
    ] {
        std::fs::write(place.path("other.toml"), SMALL_SCENE.replacen(from, to, 1)).unwrap();
        let output = place.try_run("echo other.toml --paths old.paths --out other.cube --quiet");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        let rule = format!("frame 0: {body} was lit where it is not in the scene");
        assert!(output.status.code() == Some(1) && said.contains(&rule), "{said}");
    }
}
