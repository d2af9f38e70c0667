//! Scenes with several radars, from the command line.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Part that both scenes share. Reflectors stand in lane 2 of their radar at 30 m and in lane 3 at 42 m.
const HEAD: &str = r#"
seed = 7
[radar]
boresight_el_deg = -6.0
[radar.array]
pattern = "cosine"
cosine_exponent = 1.0
[radar.waveform]
chirps = 32
[noise]
noise_figure_db = 12.0
"#;

fn reflector(id: &str, position_m: [f64; 3], velocity_mps: [f64; 3]) -> String {
    format!(
        "[[target]]\nkind = \"point\"\nid = \"{id}\"\nrcs_m2 = 10.0\nposition_m = {position_m:?}\nvelocity_mps = {velocity_mps:?}\n"
    )
}

/// Radars that look north from the origin and east from (−11, 11) m, with the same two reflectors before
/// each.
fn crossing() -> String {
    let radars = r#"[[radars]]
id = "north"
[[radars]]
id = "east"
position_m = [-11.0, 11.0, 6.0]
boresight_az_deg = 90.0
[radars.intersection]
lane_origin_m = [-11.0, 11.0]
lane_azimuth_deg = 90.0
"#;
    let reflectors = [
        reflector("north-near", [5.75, 30.0, 0.75], [0.0, -5.0, 0.0]),
        reflector("north-far", [9.5, 42.0, 0.75], [0.0, 3.0, 0.0]),
        reflector("east-near", [19.0, 5.25, 0.75], [-5.0, 0.0, 0.0]),
        reflector("east-far", [31.0, 1.5, 0.75], [3.0, 0.0, 0.0]),
    ];
    format!("name = \"crossing\"{HEAD}{radars}{}", reflectors.concat())
}

fn wayside(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(crate::common::PROGRAM).args(arguments).arg("--quiet").current_dir(folder).output().unwrap()
}

fn run(folder: &Path, arguments: &[&str]) {
    let cache: &[&str] = if arguments.contains(&"--no-cache") { &[] } else { &["--cache", "cache"] };
    let output = wayside(folder, &[&["run", "scene.toml"], cache, arguments].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

fn folder_with(scene: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
    folder
}

fn summary(place: PathBuf) -> Value {
    serde_json::from_slice(&std::fs::read(place.join("summary.json")).unwrap()).unwrap()
}

#[test]
fn every_radar_has_its_folder_and_above_them_stands_what_they_have_in_common() {
    let folder = folder_with(&crossing());
    run(folder.path(), &["--out", "all"]);
    let all = summary(folder.path().join("all"));
    assert_eq!(all["scene"], "crossing");
    let typed: wayside::RadarsSummary = serde_json::from_value(all.clone()).unwrap();
    assert_eq!(typed.json().unwrap(), serde_json::to_string_pretty(&all).unwrap());
    let found = |i: usize| all["frames"][0]["targets"][i]["found_by"].clone();
    println!("{all:#}");
    // Each of the reflectors stands in the beam of its own radar; of the other's it may be seen at the rim.
    for (target, radar) in [(0, "north"), (1, "north"), (2, "east"), (3, "east")] {
        assert!(found(target).as_array().unwrap().contains(&radar.into()), "{target}: {}", found(target));
    }
    for file in ["report.html", "pictures/scene-0000.png", "north/report.html", "east/frames.points"] {
        assert!(folder.path().join("all").join(file).is_file(), "{file}");
    }
    // One alone is the same, to the byte.
    run(folder.path(), &["--radar", "east", "--out", "east", "--no-cache"]);
    for file in ["frames.paths", "frames.cube", "frames.rdm", "frames.points"] {
        let [alone, among] =
            ["east", "all/east"].map(|place| std::fs::read(folder.path().join(place).join(file)).unwrap());
        assert!(alone == among, "{file}");
    }
    let [north, east] = ["north", "east"]
        .map(|id| std::fs::read(folder.path().join("all").join(id).join("frames.cube")).unwrap());
    assert!(north != east);
}

#[test]
fn a_scene_turned_with_its_radar_is_told_the_same() {
    let folder = folder_with(&crossing());
    run(folder.path(), &["--out", "all"]);
    let frame = |radar: &str| summary(folder.path().join("all").join(radar))["frames"][0].clone();
    let estimate = |frame: &Value, id: &str| {
        let targets = frame["targets"].as_array().unwrap();
        let target = targets.iter().find(|target| target["id"] == id).unwrap();
        (target["truth"].clone(), target["estimate"].clone())
    };
    let number = |value: &Value| value.as_f64().unwrap();
    for which in ["near", "far"] {
        let [(north_truth, north), (east_truth, east)] =
            ["north", "east"].map(|radar| estimate(&frame(radar), &format!("{radar}-{which}")));
        for key in ["range_m", "radial_velocity_mps"] {
            let (a, b) = (number(&north_truth[key]), number(&east_truth[key]));
            assert!((a - b).abs() < 1e-9, "{which} {key}: {a} {b}");
        }
        // Noise is each radar's own: at 40 dB and more a hundredth of a cell and of a beam.
        for (key, allowed) in [("range_m", 0.01), ("radial_velocity_mps", 0.03)] {
            let (a, b) = (number(&north[key]), number(&east[key]));
            assert!((a - b).abs() < allowed, "{which} {key}: {a} {b}");
        }
        // Across and along of the one are across and along of the other.
        let (across, along) = (11.0 - number(&east["y_m"]), number(&east["x_m"]) + 11.0);
        let (x, y) = (number(&north["x_m"]), number(&north["y_m"]));
        println!("{which}: north ({x:.3}, {y:.3}), east ({across:.3}, {along:.3})");
        assert!((across - x).abs() < 0.3 && (along - y).abs() < 0.1, "{which}");
        assert_eq!(north["lane"], east["lane"], "{which}");
        assert_eq!(north["lane"], north_truth["lane"], "{which}");
    }
}

#[test]
fn a_command_that_sees_one_radar_asks_which() {
    let folder = folder_with(&crossing());
    let refused = wayside(folder.path(), &["paths", "scene.toml", "--out", "f.paths"]);
    let told = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(1), "{told}");
    assert!(told.contains("several radars") && told.contains("`north`, `east`; choose one"), "{told}");
    let done = wayside(folder.path(), &["paths", "scene.toml", "--radar", "north", "--out", "f.paths"]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let unknown = wayside(folder.path(), &["run", "scene.toml", "--radar", "south", "--no-cache"]);
    assert_eq!(unknown.status.code(), Some(1));
    assert!(!folder.path().join("out").exists(), "nothing is written of what was refused");
}

#[test]
fn a_radar_whose_folder_would_be_that_of_the_common_pictures_is_refused_beside_others() {
    let folder = folder_with(&crossing().replace("id = \"east\"", "id = \"pictures\""));
    let refused = wayside(folder.path(), &["run", "scene.toml", "--no-cache", "--out", "all"]);
    let told = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(1), "{told}");
    assert!(told.contains("scene.toml: [[radars]] `pictures`: its folder would be"), "{told}");
    assert!(!folder.path().join("all").exists(), "nothing is written of what was refused");
    run(folder.path(), &["--radar", "pictures", "--out", "alone", "--no-cache"]);
}

#[test]
fn what_stands_above_the_radars_and_what_each_of_them_leaves_is_claimed_before_any_work() {
    for taken in
        ["report.html", "summary.json", "pictures/scene-0000.png", "east/report.html", "east/frames.cube"]
    {
        let folder = folder_with(&crossing());
        std::fs::create_dir_all(folder.path().join("all").join(taken)).unwrap();
        let refused = wayside(folder.path(), &["run", "scene.toml", "--cache", "cache", "--out", "all"]);
        let told = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert_eq!(refused.status.code(), Some(2), "{taken}: {told}");
        assert!(told.contains(taken) && told.contains("it is a folder"), "{taken}: {told}");
        assert_eq!(files_below(&folder.path().join("all")), 0, "{taken}: something was computed before");
    }
}

#[test]
fn what_radars_have_in_common_stays_until_there_is_something_new_and_is_then_noted_as_old() {
    let folder = folder_with(&crossing());
    run(folder.path(), &["--out", "all"]);
    let common = folder.path().join("all/summary.json");
    let before = std::fs::read(&common).unwrap();
    let refused =
        wayside(folder.path(), &["run", "scene.toml", "--no-cache", "--out", "all", "--memory-limit", "1"]);
    let told = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(1), "{told}");
    assert!(std::fs::read(&common).unwrap() == before, "a refused run removed {}", common.display());
    let alone = ["run", "scene.toml", "--radar", "east", "--seed", "8", "--no-cache", "--out", "all/east"];
    let done = Command::new(crate::common::PROGRAM).args(alone).current_dir(folder.path()).output().unwrap();
    let told = String::from_utf8_lossy(&done.stderr).into_owned();
    assert!(done.status.success(), "{told}");
    assert!(told.contains("all/summary.json: describes an earlier run of radar `east`"), "{told}");
}

#[test]
fn folders_of_radars_that_the_scene_no_longer_has_stay_and_are_told() {
    let folder = folder_with(&crossing());
    run(folder.path(), &["--out", "all"]);
    std::fs::create_dir(folder.path().join("all/mine")).unwrap();
    std::fs::write(folder.path().join("all/mine/summary.json"), "{}").unwrap();
    std::fs::write(folder.path().join("scene.toml"), crossing().replace("\"east\"", "\"west\"")).unwrap();
    let again = ["run", "scene.toml", "--no-cache", "--out", "all"];
    for _ in 0..2 {
        let mut command = Command::new(crate::common::PROGRAM);
        let done = command.args(again).current_dir(folder.path()).output().unwrap();
        let told = String::from_utf8_lossy(&done.stderr).into_owned();
        assert!(done.status.success(), "{told}");
        assert!(told.contains("all: east (1 in all) were left by an earlier run"), "{told}");
    }
    assert!(folder.path().join("all/east/summary.json").is_file());
}

/// Number of files in a folder and those below it.
fn files_below(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.map(|path| if path.is_dir() { files_below(&path) } else { 1 }).sum()
}

#[test]
fn a_radar_named_like_a_file_that_stands_above_it_is_refused_before_any_work() {
    let folder = folder_with(&crossing().replace("id = \"east\"", "id = \"summary.json\""));
    let refused = wayside(folder.path(), &["run", "scene.toml", "--no-cache", "--out", "all"]);
    let told = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(2), "{told}");
    assert!(told.contains("all/summary.json: cannot be written: it is a folder"), "{told}");
    assert_eq!(files_below(&folder.path().join("all")), 0, "nothing was computed before");
}

#[test]
fn a_dry_run_of_several_radars_ends_with_what_all_of_them_take() {
    let folder = folder_with(&crossing());
    let output = wayside(folder.path(), &["run", "scene.toml", "--no-cache", "--dry-run"]);
    let told = String::from_utf8(output.stdout).unwrap();
    let totals: Vec<&str> = told.lines().filter(|line| line.contains(" frames: ")).collect();
    let [first, second, all] = totals[..] else { panic!("{told}") };
    assert!(told.trim_end().ends_with(all) && told.contains("all radars\n"), "{told}");
    let frames = |line: &str| line.split(' ').next().unwrap().parse::<u32>().unwrap();
    assert_eq!(frames(all), frames(first) + frames(second));
    let seconds = |line: &str| line.split(' ').nth(2).unwrap().parse::<f64>().unwrap();
    assert!(seconds(all) > seconds(first).max(seconds(second)), "{told}");
}

#[test]
fn the_report_of_all_radars_says_what_accuracy_each_reached_and_what_made_its_false_objects() {
    // Some of ten thousand cells are alarms of the noise alone.
    let alarms = crossing().replace("[noise]", "[dsp]\nfalse_alarm_rate = 1e-3\n[noise]");
    let folder = folder_with(&alarms);
    run(folder.path(), &["--out", "all"]);
    let page = std::fs::read_to_string(folder.path().join("all/report.html")).unwrap();
    for radar in ["north", "east"] {
        let of_radar = summary(folder.path().join("all").join(radar));
        let frame = &of_radar["frames"][0];
        assert!(page.contains(&format!("<h3>Accuracy asked and reached of {radar}</h3>")), "{page}");
        assert!(page.contains(&format!("<h3>False objects of {radar}</h3>")), "{page}");
        let false_ones = frame["false_objects"].as_array().unwrap();
        assert!(!false_ones.is_empty() && false_ones.iter().all(|object| object["cause"] == "noise"));
        let heading = format!("False objects of {radar}</h3>");
        let section = page.split(&heading).nth(1).unwrap().split("<h").next().unwrap();
        assert_eq!(section.matches(">noise</td>").count(), false_ones.len(), "{section}");
        let reached = format!("{:.1} dB", frame["accuracy"]["reached_db"].as_f64().unwrap());
        assert!(page.contains(&reached.replace('-', "−")), "{reached}");
    }
}
