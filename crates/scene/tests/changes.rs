//! Changes of a scene before it is read: what they make of it, and where they are refused.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use artifact::scene::SceneHeader;
use scene::{Change, ReadOptions, SceneErrors, inputs_of_changed, read_changed};

const SCENE: &str = "name = \"base\"\nframes = 2\n[radar]\nposition_m = [0, 0, 6]\n[radar.array]\npreset = \"3x4\"\n\
    [[target]]\nkind = \"point\"\nid = \"p\"\nposition_m = [2, 30, 1]\nrcs_m2 = 1\n\
    [[target]]\nkind = \"mesh\"\nid = \"c\"\nmodel = \"car-suv\"\nlane = 2\ny_m = 40.0\n";

fn read(text: &str, changes: &[(&str, &str)]) -> Result<SceneHeader, SceneErrors> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, text).unwrap();
    let change = |(key, value): &(&str, &str)| Change { key: (*key).into(), value: (*value).into() };
    let changes: Vec<Change> = changes.iter().map(change).collect();
    let options = ReadOptions::names_only();
    read_changed(&file, &changes, &options)
}

#[test]
fn a_changed_scene_is_that_of_a_file_that_says_so() {
    for (key, value, found, instead) in [
        ("frames", "5", "frames = 2", "frames = 5"),
        ("radar.array.preset", "\"6x8\"", "\"3x4\"", "\"6x8\""),
        ("radar.position_m", "[1.0, 2.0, 7.5]", "[0, 0, 6]", "[1.0, 2.0, 7.5]"),
        ("radar.position_m.2", "7.5", "[0, 0, 6]", "[0, 0, 7.5]"),
        ("target.0.position_m.1", "33.0", "[2, 30, 1]", "[2, 33.0, 1]"),
        ("target.1.lane", "3", "lane = 2", "lane = 3"),
        ("target.1.model", "\"car-sedan\"", "car-suv", "car-sedan"),
        // What the file leaves out: a key, a table, a table in a table.
        ("seed", "9", "frames = 2", "frames = 2\nseed = 9"),
        ("noise.noise_figure_db", "14", "[radar]", "[noise]\nnoise_figure_db = 14\n[radar]"),
        ("radar.waveform.chirps", "64", "[radar.array]", "[radar.waveform]\nchirps = 64\n[radar.array]"),
        ("dsp", "{ training_cells = [4, 6] }", "[radar]", "[dsp]\ntraining_cells = [4, 6]\n[radar]"),
    ] {
        assert!(SCENE.contains(found), "{found}");
        let changed = read(SCENE, &[(key, value)]).unwrap();
        assert!(changed == read(&SCENE.replace(found, instead), &[]).unwrap(), "{key} = {value}");
        assert!(changed != read(SCENE, &[]).unwrap(), "{key} = {value} changes something");
    }
}

#[test]
fn changes_are_made_in_their_order() {
    let twice = read(SCENE, &[("frames", "4"), ("radar.position_m.2", "8"), ("frames", "7")]).unwrap();
    assert_eq!((twice.frames, twice.radar.position_m[2]), (7, 8.0));
}

#[test]
fn a_change_that_is_refused_stands_where_the_value_stood_or_its_table() {
    for (key, value, place, rule) in [
        ("frames", "0", "2:10:", "frames"),
        ("radar.hight_m", "6", "3:1: [radar]", "unknown key `hight_m`"),
        ("radar.array.preset", "\"3x5\"", "6:10:", "3x5"),
        (
            "radar.position_m.3",
            "1",
            "4:14:",
            "`radar.position_m.3`: `3` is no entry of a list of 3, counted from 0",
        ),
        ("target.first.lane", "1", "", "`first` is no entry of a list of 2"),
        ("frames.of", "1", "2:10:", "`of` is asked of what is neither table nor list"),
        (
            "dsp.training_cells.0",
            "4",
            "",
            "`training_cells` is a list that the scene leaves out: change all of it",
        ),
        ("radar..x", "1", "", "a key between two points is empty"),
        ("frames", "1 2", "", "`frames`: "),
        ("frames", "", "", "`frames`: "),
    ] {
        let said = read(SCENE, &[(key, value)]).unwrap_err().to_string();
        assert!(
            said.contains(&format!("scene.toml:{place}")) && said.contains(rule),
            "{key} = {value}: {said}"
        );
    }
}

#[test]
fn a_change_deeper_than_any_scene_is_refused_before_it_is_made() {
    let key = vec!["name"; 1 << 16].join(".");
    let tables = format!("{{ {} = ", vec!["a"; 79].join("."));
    let value = format!("{}1{}", tables.repeat(79), " }".repeat(79));
    for (key, value) in [(key.as_str(), "1"), ("radar.x", value.as_str())] {
        let said = read(SCENE, &[(key, value)]).unwrap_err().to_string();
        assert!(said.contains("lies within more than 64 tables and lists"), "{said}");
    }
}

#[test]
fn the_files_of_a_changed_scene_are_those_that_it_names() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, SCENE).unwrap();
    std::fs::write(folder.path().join("sign.obj"), "v 0 0 1\nv 0 1 1\nv 0 1 2\nf 1 2 3\n").unwrap();
    let options = ReadOptions::names_only();
    let change = Change { key: "target.1.model".into(), value: "\"sign.obj\"".into() };
    let names = |changes: &[Change]| {
        let files = inputs_of_changed(&file, changes, &options).unwrap();
        files.iter().map(|f| f.file_name().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(names(&[]), ["scene.toml"]);
    assert_eq!(names(&[change]), ["scene.toml", "sign.obj"]);
}
