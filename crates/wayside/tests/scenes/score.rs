//! `score` says of a run's own artifacts what its summary says, and refuses what does not belong together.

#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::{SMALL_SCENE, Workplace};
use artifact::scene::Scene;
use artifact::{Reader, Writer};
use serde_json::Value;

const TRAFFIC: &str = "name = \"driving\"\n[radar.waveform]\nsamples = 64\nchirps = 16\nslope_mhz_per_us = 6.25\n\
    [radar.array]\npreset = \"1x4\"\n[noise]\nnoise_figure_db = 12.0\n[dsp]\ntraining_cells = [3, 6]\n\
    [fidelity]\naccuracy_db = -10.0\nbounces = 1\n[traffic]\nfcd = \"driving.fcd.xml\"\n";

/// Two cars, the first of which comes into view a step later than the other one.
const RECORDING: &str = "<fcd-export>\
    <timestep time=\"0.00\"><vehicle id=\"b\" x=\"5.75\" y=\"40\" angle=\"180\" type=\"car\" speed=\"8\"/></timestep>\
    <timestep time=\"0.10\"><vehicle id=\"a\" x=\"2\" y=\"30\" angle=\"180\" type=\"car\" speed=\"8\"/>\
    <vehicle id=\"b\" x=\"5.75\" y=\"39.2\" angle=\"180\" type=\"car\" speed=\"8\"/></timestep>\
    <timestep time=\"0.20\"><vehicle id=\"a\" x=\"2\" y=\"29.2\" angle=\"180\" type=\"car\" speed=\"8\"/></timestep>\
    </fcd-export>";

fn scored(place: &Workplace, more: &str) -> Value {
    let told = place.run(&format!(
        "score out/frames.points --scene out/scene.scene --paths out/frames.paths {more} --quiet"
    ));
    serde_json::from_str(&told).unwrap()
}

#[test]
fn the_score_of_a_run_is_the_one_of_its_summary_with_its_tracks_and_with_those_made_anew() {
    let place = Workplace::new();
    std::fs::write(place.path("driving.toml"), TRAFFIC).unwrap();
    std::fs::write(place.path("driving.fcd.xml"), RECORDING).unwrap();
    for scene in ["small.toml", "driving.toml"] {
        place.run(&format!("run {scene} --out out --quiet"));
        let metrics = place.summary("out/summary.json")["metrics"].clone();
        assert!(metrics["objects"]["found"].as_u64().unwrap() > 0, "{scene}: {metrics}");
        assert_eq!(scored(&place, "--tracks out/frames.tracks"), metrics, "{scene}");
        assert_eq!(scored(&place, ""), metrics, "{scene}");
    }
}

#[test]
fn a_scene_of_fewer_frames_than_the_points_is_refused_by_name() {
    let place = Workplace::new();
    place.run("run small.toml --out out --quiet");
    let shorter =
        std::fs::read_to_string(place.path("small.toml")).unwrap().replace("frames = 2", "frames = 1");
    std::fs::write(place.path("shorter.toml"), shorter).unwrap();
    place.run("run shorter.toml --out shorter --quiet");
    let output = place.try_run("score out/frames.points --scene shorter/scene.scene");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("shorter/scene.scene: frame 1 of the points is not in it"), "{said}");
}

#[test]
fn a_scene_of_more_poses_than_bodies_is_refused_with_file_and_frame() {
    let place = Workplace::new();
    place.run("run small.toml --out out --quiet");
    let reader = Reader::<Scene>::open(&place.path("out/scene.scene")).unwrap();
    let (more, from) = (place.path("more.scene"), &reader.preamble().provenance);
    let mut writer = Writer::<Scene>::create(&more, from, reader.header()).unwrap();
    for frame in reader {
        let mut frame = frame.unwrap();
        frame.poses.push(frame.poses[0]);
        writer.write(&frame).unwrap();
    }
    writer.finish().unwrap();
    let output = place.try_run("score out/frames.points --scene more.scene");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("more.scene: frame 0 has 3 poses of 2 bodies in view"), "{said}");
}

#[test]
fn a_scene_of_other_bodies_than_the_points_and_one_that_was_changed_are_refused() {
    let place = Workplace::new();
    place.run("run small.toml --out out --quiet");
    let renamed = SMALL_SCENE.replace("id = \"", "id = \"other-");
    std::fs::write(place.path("renamed.toml"), renamed).unwrap();
    place.run("run renamed.toml --out renamed --no-cache --quiet");
    std::fs::create_dir(place.path("later")).unwrap();
    std::fs::copy(place.path("corner.obj"), place.path("later/corner.obj")).unwrap();
    std::fs::write(place.path("later/small.toml"), SMALL_SCENE.to_owned() + "\n# changed\n").unwrap();
    place.run("run later/small.toml --out changed --no-cache --quiet");
    for (words, rule) in [
        ("score out/frames.points --scene renamed/scene.scene", "renamed/scene.scene: has no body `"),
        (
            "score out/frames.points --scene changed/scene.scene",
            "scene.scene: was made of another `small.toml`",
        ),
        ("export out/frames.rdm --to raddet --scene changed/scene.scene --out s", "another `small.toml`"),
        ("export out/frames.points --to kitti --scene renamed/scene.scene --out s", "has no body `"),
    ] {
        let output = place.try_run(words);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{words}: {said}");
        assert!(said.contains(rule), "{words}: {said}");
    }
    let output = place.try_run("export out/frames.rdm --to raddet --scene renamed/scene.scene --out s");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("was made of renamed.toml, the frames of small.toml"), "{said}");
}

/// Frames are joined by index: those of another time are of another truth.
#[test]
fn points_paths_and_tracks_of_other_times_or_bodies_than_the_scenes_are_refused_with_file_and_frame() {
    let place = Workplace::new();
    let (slower, other) =
        (SMALL_SCENE.replace("frames = 2", "frames = 2\nframe_interval_s = 0.2"), SMALL_SCENE);
    let one_body = other.split("\n[[target]]\nkind = \"point\"").next().unwrap();
    for (name, text) in [("slower", &*slower), ("alone", one_body)] {
        std::fs::write(place.path(&format!("{name}.toml")), text).unwrap();
    }
    // The same bodies and times: another file, another place of the radar, and the file of the same name.
    std::fs::write(place.path("twin.toml"), SMALL_SCENE.to_owned() + "\n# twin\n").unwrap();
    std::fs::write(
        place.path("moved.toml"),
        SMALL_SCENE.to_owned() + "[radar]\nposition_m = [1.0, 0.0, 6.0]\n",
    )
    .unwrap();
    for name in ["small", "slower", "alone", "twin", "moved"] {
        place.run(&format!("run {name}.toml --out {name} --quiet"));
    }
    let times = "frame 1 begins at 0.2 s, that of the scene at 0.1 s";
    let moved =
        "its radar is at [1.0, 0.0, 6.0] m, boresight 0.000°, 0.000°, the scene's at [0.0, 0.0, 6.0] m";
    let own = "score small/frames.points --scene small/scene.scene";
    let output = place.try_run(&format!("{own} --tracks twin/frames.tracks"));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success() && said.contains("small.toml, the tracks of twin.toml"), "{said}");
    for (words, file, rule) in [
        ("score slower/frames.points --scene small/scene.scene", "slower/frames.points", times),
        (&format!("{own} --paths slower/frames.paths"), "slower/frames.paths", times),
        (&format!("{own} --tracks slower/frames.tracks"), "slower/frames.tracks", times),
        (&format!("{own} --paths alone/frames.paths"), "alone/frames.paths", "its body 1 is none"),
        (&format!("{own} --tracks moved/frames.tracks"), "moved/frames.tracks", moved),
        (&format!("{own} --paths moved/frames.paths"), "moved/frames.paths", moved),
        ("score moved/frames.points --scene small/scene.scene", "moved/frames.points", moved),
        (
            "export slower/frames.points --to kitti --scene small/scene.scene --out k",
            "small/scene.scene",
            "frame 1 begins at 0.1 s, that of the frames beside it at 0.2 s",
        ),
    ] {
        let output = place.try_run(words);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{words}: {said}");
        assert!(said.contains(&format!("{file}: {rule}")), "{words}: {said}");
    }
}
