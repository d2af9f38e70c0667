//! Datasets made in parts by several processes in one folder: the bytes of one machine, in whatever order
//! parts are made, killed and concluded.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::killing::{files, is_temporary};
use crate::common::{Workplace, bounded};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Child;

const BASE: &str = "name = \"base\"\n[radar.waveform]\nsamples = 64\nchirps = 16\n[radar.array]\n\
preset = \"1x4\"\n\
[noise]\nnoise_figure_db = 12.0\n[dsp]\ntraining_cells = [3, 6]\n[fidelity]\nbounces = 1\n";

/// Twelve scenes in five shards.
const RECIPE: &str = "scene = \"base.toml\"\nseed = 1\nscenes_per_class = 6\nrange_m = [25.0, 45.0]\n\
speed_mps = [1.0, 5.0]\nlanes = [1, 2]\nvehicle_seeds = 2\nscenes_per_shard = 3\n[models]\n\
motorcycle = [\"motorcycle-street\"]\ncar = [\"car-hatchback\"]\n";

const RESULTS: [&str; 3] = ["manifest.jsonl", "scenes.jsonl", "detection.md"];

fn prepared(recipe: &str) -> Workplace {
    let place = Workplace::new();
    std::fs::write(place.path("base.toml"), BASE).unwrap();
    std::fs::write(place.path("spec.toml"), recipe).unwrap();
    place
}

/// Files in a dataset's folder, by their names.
fn held(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let name = |file: &Path| file.strip_prefix(folder).unwrap().display().to_string();
    files(folder).iter().map(|file| (name(file), std::fs::read(file).unwrap())).collect()
}

/// Files that one machine makes.
fn whole() -> BTreeMap<String, Vec<u8>> {
    let place = prepared(RECIPE);
    place.run("dataset spec.toml --out d --quiet");
    let whole = held(&place.path("d"));
    assert_eq!(whole.len(), 2 * 4 + RESULTS.len());
    whole
}

fn made(place: &Workplace, words: &str) -> String {
    place.run(&format!("dataset spec.toml --out d --quiet {words}"))
}

fn begun(place: &Workplace, part: &str) -> Child {
    place.command(&format!("dataset spec.toml --out d --quiet --threads 1 --shard {part}")).spawn().unwrap()
}

fn ended(mut child: Child) {
    assert!(child.wait().unwrap().success());
}

#[test]
fn parts_in_any_order_and_at_once_make_the_bytes_of_one_machine() {
    let whole = whole();
    for parts in [["2/2", "1/2"].as_slice(), &["3/3", "1/3", "2/3"], &["1/3", "1/2", "3/3", "2/2"]] {
        let place = prepared(RECIPE);
        for (number, part) in parts.iter().enumerate() {
            let is_last = number + 1 == parts.len();
            let said = made(&place, &format!("--shard {part}"));
            assert_eq!(said.contains("samples of"), is_last, "{part}: {said}");
            assert_eq!(said.contains("not made yet"), !is_last, "{part}: {said}");
        }
        assert!(held(&place.path("d")) == whole, "{parts:?}");
    }
    // One of them twice, as an engine does that takes a living process for dead.
    let place = prepared(RECIPE);
    ["1/3", "2/3", "3/3", "2/3"].map(|part| begun(&place, part)).into_iter().for_each(ended);
    assert!(held(&place.path("d")) == whole);
}

#[test]
fn a_part_that_is_killed_loses_its_shard_and_whoever_is_last_concludes() {
    let whole = whole();
    let place = prepared(RECIPE);
    let (mut killed, other) = (begun(&place, "1/2"), begun(&place, "2/2"));
    // With its first shard made it is at work on its second one.
    while !place.path("d/shard-0000.jsonl").exists() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    killed.kill().unwrap();
    killed.wait().unwrap();
    ended(other);
    let before = held(&place.path("d"));
    assert!(RESULTS.iter().all(|name| !before.contains_key(*name)), "{:?}", before.keys());
    for (name, bytes) in before.iter().filter(|(name, _)| !is_temporary(Path::new(name))) {
        assert!(whole[name] == *bytes, "{name} is half-written");
    }
    let said = made(&place, "--shard 1/2");
    assert!(said.contains("samples of"), "{said}");
    assert!(held(&place.path("d")) == whole);
}

#[test]
fn concluding_alone_names_what_lacks_makes_nothing_and_is_the_same_however_often() {
    let place = prepared(RECIPE);
    made(&place, "--shard 1/2");
    let before = held(&place.path("d"));
    let refused = place.try_run("dataset spec.toml --out d --quiet --conclude");
    let said = String::from_utf8_lossy(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2));
    assert!(said.contains("d/shard-0001.jsonl: not made yet") && said.contains("2 of 4"), "{said}");
    assert!(held(&place.path("d")) == before);
    made(&place, "--shard 2/2");
    let whole = held(&place.path("d"));
    std::fs::remove_file(place.path("d/manifest.jsonl")).unwrap();
    assert!(made(&place, "--conclude").contains("samples of"));
    assert!(held(&place.path("d")) == whole);
    // Lines that a loss of power has cut are no shard.
    std::fs::write(place.path("d/shard-0003.jsonl"), "").unwrap();
    assert_eq!(place.try_run("dataset spec.toml --out d --quiet --conclude").status.code(), Some(2));
    made(&place, "--shard 2/2");
    assert!(held(&place.path("d")) == whole);
    std::fs::write(place.path("spec.toml"), RECIPE.replace("45.0", "46.0")).unwrap();
    let refused = place.try_run("dataset spec.toml --out d --quiet --conclude");
    assert!(String::from_utf8_lossy(&refused.stderr).contains("another recipe"));
    assert!(held(&place.path("d")) == whole);
    let both = place.try_run("dataset spec.toml --out d --quiet --conclude --shard 1/2");
    assert_eq!(both.status.code(), Some(2));
}

#[test]
fn lines_that_tell_of_more_than_a_recipe_may_ask_for_are_made_anew_and_cost_no_minutes() {
    let place = prepared(RECIPE);
    made(&place, "");
    let whole = held(&place.path("d"));
    let text = String::from_utf8(place.bytes("d/shard-0000.jsonl")).unwrap();
    let (first, others) = text.split_once('\n').unwrap();
    let damages: [fn(&mut serde_json::Value); 3] = [
        |scene| {
            let vehicle = scene["frames"][0]["vehicles"][0].clone();
            scene["frames"][0]["vehicles"] = vec![vehicle; 20_000].into();
        },
        |scene| scene["frames"] = vec![scene["frames"][0].clone(); 20_000].into(),
        |scene| scene["base"] = "x".repeat(1 << 24).into(),
    ];
    for damage in damages {
        let mut scene: serde_json::Value = serde_json::from_str(first).unwrap();
        damage(&mut scene);
        std::fs::write(place.path("d/shard-0000.jsonl"), format!("{scene}\n{others}")).unwrap();
        let words = "dataset spec.toml --out d --quiet --threads 1";
        let ended = bounded::run(place.root(), words.split_whitespace());
        assert!(ended.status.success(), "{} after {:?}: {}", ended.status, ended.after, ended.said);
        assert!(held(&place.path("d")) == whole);
    }
}

#[test]
fn shards_beyond_a_thousand_have_a_folder_and_stay_where_earlier_versions_put_them() {
    let many = RECIPE
        .replace("scenes_per_class = 6", "scenes_per_class = 501")
        .replace("scenes_per_shard = 3", "scenes_per_shard = 1");
    let place = prepared(&many);
    let in_folder = "d/shards-1000/shard-1001";
    assert!(made(&place, "--shard 1002/1002").contains("d/shard-0000.jsonl: not made yet"));
    assert!(place.path("d/shards-1000/shard-1001.dataset").exists());
    let line: serde_json::Value =
        serde_json::from_slice(&place.bytes(&format!("{in_folder}.jsonl"))).unwrap();
    assert_eq!((&line["file"], &line["scene"]), (&"shards-1000/shard-1001.dataset".into(), &1001.into()));
    let model = Workplace::project_file("fixtures/classifier.model");
    let classes = place.run(&format!("classify {model} d"));
    for ending in ["dataset", "jsonl"] {
        let [from, to] = [format!("{in_folder}.{ending}"), format!("d/shard-1001.{ending}")];
        std::fs::rename(place.path(&from), place.path(&to)).unwrap();
    }
    let before = held(&place.path("d"));
    made(&place, "--shard 1002/1002");
    assert!(held(&place.path("d")) == before, "it is not made again");
    assert_eq!(place.run(&format!("classify {model} d")), classes);
}

/// Megabytes before a word of what `--dry-run` says.
fn told_mib(said: &str, before: &str) -> f64 {
    said.split(before).next().unwrap().split_whitespace().last().unwrap().parse().unwrap()
}

#[test]
fn a_dry_run_tells_files_and_bytes_and_makes_nothing() {
    let place = prepared(RECIPE);
    let said = made(&place, "--dry-run");
    assert!(!place.path("d").exists());
    made(&place, "");
    let whole = held(&place.path("d"));
    let files = format!("12 scenes in 4 shards of 3: {} files in 1 folders, {0} in one", whole.len());
    assert!(said.contains(&files), "{said}");
    let bytes = |is_of: &dyn Fn(&str) -> bool| {
        whole.iter().filter(|(name, _)| is_of(name)).map(|(_, bytes)| bytes.len()).sum::<usize>() as f64
    };
    // It counts every vehicle as found.
    let vehicles = 12.0 / String::from_utf8_lossy(&whole["manifest.jsonl"]).lines().count() as f64;
    let samples_mib = vehicles * bytes(&|name| name.ends_with(".dataset")) / 1048576.0;
    assert!((told_mib(&said, " MiB of samples") / samples_mib - 1.0).abs() < 0.05, "{said} {samples_mib}");
    // Lines of vehicles that were not found are shorter, and the manifest has none of them.
    let lines_mib = bytes(&|name| name.ends_with(".jsonl")) / 1048576.0;
    assert!((told_mib(&said, " MiB of lines") / lines_mib - 1.0).abs() < 0.5, "{said} {lines_mib}");
    assert!(said.contains(" core-hours, "), "{said}");
}

/// Address space in which a recipe is read and one of its shards is drawn, KiB; two million scenes of eight
/// vehicles have no place there.
const MOST_KIB: u64 = 1 << 20;

#[test]
fn scenes_are_drawn_a_shard_at_a_time() {
    let many = "scenes_per_class = 1000000\nvehicles_per_scene = [8, 8]";
    let place = prepared(&RECIPE.replace("scenes_per_class = 6", many));
    let words = "dataset spec.toml --out d --shard 4294967295/4294967295 --quiet --threads 1";
    let ended = bounded::run_within(MOST_KIB, place.root(), words.split_whitespace());
    assert!(ended.status.success(), "{}", ended.said);
    assert!(ended.printed.contains("shard-0000.jsonl: not made yet"), "{}", ended.printed);
}

#[test]
fn a_shard_that_would_replace_the_base_scene_is_refused_before_its_scenes_are_made() {
    let place = prepared(&RECIPE.replace("base.toml", "d/shard-0000.jsonl"));
    std::fs::create_dir(place.path("d")).unwrap();
    std::fs::write(place.path("d/shard-0000.jsonl"), BASE).unwrap();
    let output = place.try_run("dataset spec.toml --out d --quiet");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("d/shard-0000.jsonl: cannot be written: it is an input of this command"), "{said}");
    assert!(!place.path("d/shard-0000.dataset").exists(), "it was made for nothing");
    assert_eq!(place.bytes("d/shard-0000.jsonl"), BASE.as_bytes());
}
