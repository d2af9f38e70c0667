//! Promises of `run`: everything is there, nothing is computed twice, nothing depends on threads or on truth.

use crate::common::{SMALL_SCENE, Workplace};
use serde_json::Value;

const ARTIFACTS: [&str; 6] =
    ["scene.scene", "frames.paths", "frames.cube", "frames.rdm", "frames.points", "frames.tracks"];

#[test]
fn a_run_writes_every_artifact_and_picture_that_is_promised() {
    let place = Workplace::new();
    place.run("run small.toml --out out --quiet");
    let pictures = ["scene-0000.png", "rdm-0001.png", "points-0001.png", "rdm-0000.exr"]
        .map(|p| format!("pictures/{p}"));
    for name in ARTIFACTS
        .iter()
        .map(|a| (*a).to_owned())
        .chain(pictures)
        .chain(["summary.json".into(), "report.html".into()])
    {
        assert!(!place.bytes(&format!("out/{name}")).is_empty(), "{name}");
    }
    let summary = place.summary("out/summary.json");
    let frame = &summary["frames"][1];
    let targets = frame["targets"].as_array().unwrap();
    assert_eq!(targets.len(), 2);
    let (truth, estimate) = (&targets[1]["truth"], &targets[1]["estimate"]);
    let range = |v: &Value| v["range_m"].as_f64().unwrap();
    // Half a cell of c/2B = 0.96 m.
    assert!((range(estimate) - range(truth)).abs() < 0.48, "{estimate} {truth}");
}

#[test]
fn a_second_run_computes_nothing_and_says_so() {
    let place = Workplace::new();
    place.run("run small.toml --out a --quiet");
    let explained = place.run("run small.toml --out b --explain --quiet");
    assert!(!explained.contains("runs:"), "{explained}");
    let summary = place.summary("b/summary.json");
    for frame in summary["frames"].as_array().unwrap() {
        let cached: Vec<&str> =
            frame["cached"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
        assert!(["scene", "bart_rcs", "fmcw_echo", "dsp"].iter().all(|s| cached.contains(s)), "{cached:?}");
    }
    ARTIFACTS
        .iter()
        .for_each(|a| assert_eq!(place.bytes(&format!("a/{a}")), place.bytes(&format!("b/{a}")), "{a}"));
}

#[test]
fn a_changed_setting_of_the_detector_runs_from_there_and_says_why() {
    let place = Workplace::new();
    place.run("run small.toml --out a --quiet");
    let changed =
        SMALL_SCENE.replace("training_cells = [3, 6]", "training_cells = [3, 6]\nfalse_alarm_rate = 1e-3");
    std::fs::write(place.path("small.toml"), changed).unwrap();
    let explained = place.run("run small.toml --out a --explain --quiet");
    assert!(
        explained.contains("frame 0 bart_rcs: cached") && explained.contains("frame 1 fmcw_echo: cached"),
        "{explained}"
    );
    assert!(explained.contains("frame 0 dsp: runs: changed: dsp settings"), "{explained}");
}

#[test]
fn a_dry_run_tells_stages_time_and_memory_and_writes_nothing() {
    let place = Workplace::new();
    let told = place.run("run small.toml --out a --dry-run --quiet");
    assert!(told.contains("frames 0 to 1: runs bart_rcs, fmcw_echo, dsp") && told.contains("MiB"), "{told}");
    assert!(!place.path("a").exists());
}

#[test]
fn the_same_scene_gives_the_same_bytes_on_1_2_3_and_8_threads() {
    let place = Workplace::new();
    let on = |threads: u8, name: &str| {
        place.run(&format!("run small.toml --out {name} --threads {threads} --no-cache --quiet"));
        ARTIFACTS.map(|artifact| place.bytes(&format!("{name}/{artifact}")))
    };
    let one = on(1, "one");
    for (threads, name) in [(2, "two"), (3, "three"), (8, "eight")] {
        for (artifact, (one, other)) in ARTIFACTS.iter().zip(one.iter().zip(on(threads, name))) {
            assert!(*one == other, "{artifact} on {threads} threads");
        }
    }
}

#[test]
fn detections_do_not_change_when_the_truth_is_shuffled() {
    let place = Workplace::new();
    place.run("echo small.toml --out a.cube --quiet");
    let lied = SMALL_SCENE.replace("class = \"car\"", "class = \"motorcycle\"").replace("corner-1", "nobody");
    std::fs::write(place.path("lied.toml"), lied).unwrap();
    place.run("echo lied.toml --out b.cube --quiet");
    place.run("dsp a.cube --out a --quiet");
    place.run("dsp b.cube --out b --quiet");
    let frames = |name: &str| {
        place.run(&format!("export {name} --to csv --out points.csv")).len() + place.bytes("points.csv").len()
    };
    assert_eq!(frames("a/a.points"), frames("b/b.points"));
    let table = |name: &str| {
        place.run(&format!("export {name} --to csv --out points.csv"));
        place.bytes("points.csv")
    };
    assert_eq!(table("a/a.points"), table("b/b.points"));
    assert!(table("a/a.points").len() > 100, "there are points to compare");
}

#[test]
fn a_damaged_cache_entry_is_made_again() {
    let place = Workplace::new();
    place.run("run small.toml --out a --quiet");
    for folder in std::fs::read_dir(place.path("cache/fmcw_echo"))
        .unwrap()
        .flatten()
        .filter(|f| f.file_name() != "last")
    {
        for entry in std::fs::read_dir(folder.path()).unwrap().flatten() {
            let mut bytes = std::fs::read(entry.path()).unwrap();
            let middle = bytes.len() / 2;
            bytes[middle] ^= 1;
            std::fs::write(entry.path(), bytes).unwrap();
        }
    }
    place.run("run small.toml --out b --quiet");
    assert_eq!(place.bytes("a/frames.cube"), place.bytes("b/frames.cube"));
}

#[test]
fn the_cache_is_listed_and_cleared() {
    let place = Workplace::new();
    place.run("run small.toml --out a --quiet");
    assert!(place.run("cache").contains("bart_rcs"));
    place.run("cache --clear");
    assert!(place.run("run small.toml --out a --explain --quiet").contains("frame 0 bart_rcs: runs"));
}

#[test]
fn a_run_that_is_killed_leaves_nothing_half_written_and_the_next_goes_on() {
    let place = Workplace::new();
    let many = SMALL_SCENE.replace("frames = 2", "frames = 40");
    std::fs::write(place.path("small.toml"), many).unwrap();
    let mut child = place.command("run small.toml --out a --quiet").spawn().unwrap();
    let echoes = place.path("cache/fmcw_echo");
    while std::fs::read_dir(&echoes).map_or(0, Iterator::count) < 4 {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it could be killed");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!place.path("a/frames.cube").exists() && !place.path("a/summary.json").exists());
    let explained = place.run("run small.toml --out a --explain --quiet");
    // Frames are computed side by side, so that any of the first may not have been done.
    assert!(
        explained.contains(" fmcw_echo: cached") && explained.contains("frame 39 fmcw_echo: runs"),
        "{explained}"
    );
    assert_eq!(place.summary("a/summary.json")["frames"].as_array().unwrap().len(), 40);
}

#[test]
fn frames_of_bodies_at_rest_are_traced_once_and_are_the_same_bytes() {
    let place = Workplace::new();
    let at_rest = SMALL_SCENE.replace("velocity_mps = [0.0, -3.0, 0.0]", "velocity_mps = [0.0, 0.0, 0.0]");
    for echo in ["paths", "rcs-table"] {
        let text =
            format!("{}\n[fidelity]\necho = \"{echo}\"\n", at_rest.replace("frames = 2", "frames = 3"));
        std::fs::write(place.path("small.toml"), text).unwrap();
        place.run(&format!("run small.toml --out shared-{echo} --quiet"));
        place.run(&format!("run small.toml --out apart-{echo} --no-cache --quiet"));
        let frames =
            place.summary(&format!("shared-{echo}/summary.json"))["frames"].as_array().unwrap().clone();
        let is_shared = |frame: &Value| frame["cached"].as_array().unwrap().contains(&"bart_rcs".into());
        assert_eq!(frames.iter().map(is_shared).collect::<Vec<_>>(), [false, true, true]);
        let traced = if echo == "paths" { "frames.paths" } else { "frames.rcs" };
        for artifact in [traced, "frames.cube", "frames.rdm", "frames.points"] {
            let of = |how: &str| place.bytes(&format!("{how}-{echo}/{artifact}"));
            assert_eq!(of("shared"), of("apart"), "{echo} {artifact}");
        }
    }
}

#[test]
fn two_runs_at_once_do_not_hurt_each_other() {
    let place = Workplace::new();
    let start = |out: &str| place.command(&format!("run small.toml --out {out} --quiet")).spawn().unwrap();
    // Of two into one folder the second is refused, where it does not begin when the first has ended.
    let codes = [start("a"), start("b"), start("a")].map(|mut child| child.wait().unwrap().code().unwrap());
    assert!(codes[1] == 0 && matches!([codes[0], codes[2]], [0, 0 | 2] | [2, 0]), "{codes:?}");
    ARTIFACTS
        .iter()
        .for_each(|a| assert_eq!(place.bytes(&format!("a/{a}")), place.bytes(&format!("b/{a}")), "{a}"));
}

#[test]
fn an_imported_cube_is_processed_like_our_own() {
    let place = Workplace::new();
    place.run("echo small.toml --out a.cube --quiet");
    place.run("export a.cube --to npy --out a.npy");
    place.run("import a.npy --scene small.toml --out b.cube");
    place.run("dsp a.cube --out d --quiet");
    place.run("dsp b.cube --out d --quiet");
    let table = |name: &str| {
        place.run(&format!("export {name} --to csv --out points.csv"));
        place.bytes("points.csv")
    };
    assert_eq!(table("d/a.points"), table("d/b.points"));
}

#[test]
fn every_artifact_is_inspected_and_exported() {
    let place = Workplace::new();
    place.run("run small.toml --out a --quiet");
    ARTIFACTS
        .iter()
        .for_each(|a| assert!(place.run(&format!("inspect a/{a}")).contains(", version "), "{a}"));
    let exports = [
        ("scene.scene", "json"),
        ("frames.paths", "csv"),
        ("frames.paths", "json"),
        ("frames.cube", "npy"),
        ("frames.rdm", "npy"),
        ("frames.rdm", "exr"),
        ("frames.rdm", "png"),
        ("frames.points", "csv"),
        ("frames.points", "pcd"),
        ("frames.points", "ply"),
        ("frames.tracks", "csv"),
        ("frames.tracks", "json"),
    ];
    for (artifact, format) in exports {
        place.run(&format!("export a/{artifact} --to {format} --out x/{artifact}.{format}"));
        assert!(std::fs::read_dir(place.root().join("x")).unwrap().count() > 0, "{artifact} to {format}");
    }
    let refused = place.try_run("export a/frames.cube --to pcd --out x/y.pcd");
    assert_eq!(refused.status.code(), Some(1));
}
