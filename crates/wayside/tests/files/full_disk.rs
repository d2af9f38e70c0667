//! A disk of 2 MiB that is full, and one that cannot be written: every command ends with exit code 2, says
//! so, and leaves nothing half-written.

#![cfg(target_os = "linux")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::{BOARD, Workplace, crops, tell_cases};
use std::process::Command;

/// Outcome of a command on a disk with so much room: its exit code, what it said, and what the disk held
/// afterwards.
struct Outcome {
    code: i32,
    said: String,
    left: Vec<String>,
}

/// Runs with a full disk at `disk`, but for so much room.
fn on_small_disk(place: &Workplace, words: &str, free_kib: u64) -> Option<Outcome> {
    let script = "mount -t tmpfs -o size=2m tmpfs disk || exit 99
        head -c $((2097152 - $1 * 1024)) /dev/zero > disk/filler 2>/dev/null
        shift; \"$@\" > said 2>&1; echo $? > code
        rm disk/filler; cd disk; find . -type f | sort > ../left
        for file in $(cat ../left); do mkdir -p ../kept/$(dirname $file); cp $file ../kept/$file; done";
    in_own_mount(place, script, &free_kib.to_string(), words)
}

/// Runs with a disk at `disk` that can be read alone.
fn on_unwritable_disk(place: &Workplace, words: &str) -> Option<Outcome> {
    let script = "mount -t tmpfs -o size=2m,ro tmpfs disk || exit 99
        shift; \"$@\" > said 2>&1; echo $? > code; cd disk; find . -type f > ../left";
    in_own_mount(place, script, "0", words)
}

/// Runs a script in a mount of its own, which no other program sees and which ends with it; its words are
/// `first` and those of the command. `None` where the system allows no such thing.
fn in_own_mount(place: &Workplace, script: &str, first: &str, words: &str) -> Option<Outcome> {
    std::fs::create_dir_all(place.path("disk")).unwrap();
    let _ = std::fs::remove_dir_all(place.path("kept"));
    let output = Command::new("unshare")
        .args(["--user", "--map-root-user", "--mount", "bash", "-c", script, "bash", first])
        .arg(crate::common::PROGRAM)
        .args(words.split_whitespace())
        .current_dir(place.root())
        .output()
        .ok()?;
    if !output.status.success() {
        println!("skipped, no mount here: {}", String::from_utf8_lossy(&output.stderr));
        return None;
    }
    let text = |name: &str| String::from_utf8(place.bytes(name)).unwrap();
    let left = text("left").lines().map(str::to_owned).collect();
    Some(Outcome { code: text("code").trim().parse().unwrap(), said: text("said"), left })
}

/// Artifacts that are read to their end; tables that end with a line; pictures and pages that end as such do.
fn is_whole(place: &Workplace, file: &str) -> bool {
    let bytes = place.bytes(&format!("kept/{file}"));
    match file.rsplit('.').next().unwrap() {
        "json" => serde_json::from_slice::<serde_json::Value>(&bytes).is_ok(),
        "csv" | "md" | "jsonl" | "toml" | "txt" => bytes.is_empty() || bytes.ends_with(b"\n"),
        "png" => bytes.ends_with(b"IEND\xaeB`\x82"),
        "html" => bytes.trim_ascii_end().ends_with(b"</html>"),
        "svg" => bytes.trim_ascii_end().ends_with(b"</svg>"),
        "scene" | "paths" | "rcs" | "cube" | "rdm" | "points" | "tracks" | "dataset" | "model"
        | "classes" => place.try_run(&format!("inspect kept/{file}")).status.success(),
        "npy" | "glb" | "exr" | "bin" | "sigmf-data" | "sigmf-meta" | "ply" | "pcd" | "mat"
        | "safetensors" => true,
        "TAG" => bytes.starts_with(b"Signature: 8a477f597d28d172789f06886806bc55"),
        "checkpoint" => bytes.starts_with(b"WAYSIDE CHECKPOINT") || b"WAYSIDE CHECKPOINT".starts_with(&bytes),
        other => panic!("{file}: a file of kind {other}"),
    }
}

const BASE: &str = "name = \"base\"\n[radar.waveform]\nsamples = 64\nchirps = 16\n[radar.array]\npreset = \"1x4\"\n\
[dsp]\ntraining_cells = [3, 6]\n[fidelity]\nbounces = 1\n";

const RECIPE: &str = "scene = \"base.toml\"\nseed = 1\nscenes_per_class = 5\nrange_m = [25.0, 45.0]\n\
speed_mps = [1.0, 5.0]\nlanes = [1, 2]\nvehicle_seeds = 2\n[models]\nmotorcycle = [\"motorcycle-street\"]\n";

const STUDY: &str = "scene = \"small.toml\"\nrepeats = 2\n[[vary]]\nname = \"chirps\"\nkey = \"radar.waveform.chirps\"\n\
values = [16, 32]\n[goal]\nmetric = \"coverage\"\n";

fn filled() -> Workplace {
    let place = Workplace::new();
    std::fs::write(place.path("study.toml"), STUDY).unwrap();
    std::fs::write(place.path("base.toml"), BASE).unwrap();
    std::fs::write(place.path("spec.toml"), RECIPE).unwrap();
    place.run("run small.toml --out a --no-cache --quiet");
    place.run("export a/frames.cube --to npy --out f.npy");
    place.run("dataset spec.toml --out d --quiet");
    std::fs::write(place.path("b.cfg"), BOARD).unwrap();
    place.run("export a/frames.points --to kitti --scene a/scene.scene --out k --quiet");
    let small = std::fs::read_to_string(place.path("small.toml")).unwrap();
    let radars = "[[radars]]\nid = \"near\"\n\
        [[radars]]\nid = \"far\"\nposition_m = [0.0, 80.0, 6.0]\nboresight_az_deg = 180.0\n";
    std::fs::write(place.path("radars.toml"), format!("{small}{radars}")).unwrap();
    crops::write(&place.path("crops"), 10);
    place
}

/// Commands that write to `disk`; MODEL and SHIPPED stand for two files of the project.
const COMMANDS: [&str; 32] = [
    "run small.toml --no-cache --quiet --out disk/o",
    "rcs corner.obj --freq-ghz 76:78:16 --az-deg 0:90:40 --pictures --quiet --out disk/s.npy",
    "paths small.toml --quiet --out disk/f.paths",
    "echo small.toml --quiet --out disk/f.cube",
    "dsp a/frames.cube --pictures --quiet --out disk/d",
    "dataset spec.toml --quiet --out disk/d",
    "import f.npy --scene small.toml --quiet --out disk/f.cube",
    "calibrate a/frames.cube --at-m 2,30,1 --out disk/e.csv",
    "export a/frames.cube --to npy --out disk/f.npy",
    "export a/frames.rdm --to npy --out disk/f.npy",
    "export a/frames.rdm --to exr --out disk/f.exr",
    "export a/frames.points --to csv --out disk/f.csv",
    "export a/frames.paths --to json --out disk/f.json",
    "export MODEL --to safetensors --out disk/f.safetensors",
    "vehicles --quiet --out disk/v",
    "train crops --learner trees --quiet --out disk/m",
    "export crops/shard-0000.dataset --to csv --out disk/f.csv",
    "evaluate SHIPPED crops --out disk/e.md",
    "protocols crops --learner trees --seeds 1 --out disk/p.md",
    "sweep study.toml --no-cache --quiet --out disk/w",
    "scene-from b.cfg --device xwr1443 --out disk/b.toml",
    "export a/frames.cube --to sigmf --out disk/f",
    "export a/frames.cube --to dca1000 --out disk/f.bin",
    "export a/frames.rdm --to png --axes on --out disk/f.png",
    "export a/frames.points --to pcd --out disk/f.pcd",
    "export a/frames.points --to ply --out disk/f.ply",
    "export a/frames.tracks --to json --out disk/f.json",
    "export a/frames.cube --to uwcr --scene a/scene.scene --out disk/u",
    "export a/frames.points --to kitti --scene a/scene.scene --out disk/k",
    "export a/frames.points --to nuscenes --scene a/scene.scene --out disk/n",
    "import k/training/velodyne --scene small.toml --out disk/f.points",
    "run radars.toml --no-cache --quiet --out disk/o",
];

/// A command's words with the files that they stand for.
fn with_models(words: &str) -> String {
    words
        .replace("MODEL", &Workplace::project_file("fixtures/paper-network.model"))
        .replace("SHIPPED", &Workplace::project_file("fixtures/classifier.model"))
}

#[test]
fn every_command_ends_with_2_and_leaves_nothing_half_written() {
    let place = filled();
    let ended: u64 =
        COMMANDS.iter().map(|words| ends_with_2_on_a_full_disk(&place, &with_models(words))).sum();
    let came = format!("{ended} ended with exit code 2, the others whole");
    tell_cases("commands on a disk with little room", (COMMANDS.len() * ROOM_KIB.len()) as u64, &came);
}

#[test]
fn every_command_ends_with_2_where_nothing_can_be_written() {
    let place = filled();
    for words in COMMANDS {
        let Some(Outcome { code, said, left }) = on_unwritable_disk(&place, &with_models(words)) else {
            return;
        };
        assert!(code == 2 && left.is_empty(), "`{words}`: exit {code}: {said}\nleft: {left:?}");
        assert!(said.contains("error: ") && said.contains("Read-only file system"), "`{words}`: {said}");
    }
    let ended = COMMANDS.len() as u64;
    tell_cases(
        "commands on a disk that cannot be written",
        ended,
        &format!("{ended} ended with exit code 2"),
    );
}

#[test]
#[ignore = "builds the learning library: WAYSIDE_PROJECT=$PWD cargo test --release -p wayside --test files -- --ignored a_training"]
fn a_training_ends_with_2_and_leaves_nothing_half_written() {
    ends_with_2_on_a_full_disk(&filled(), "train crops --learner paper --iterations 1 --quiet --out disk/m");
}

/// Room that is left on the disk.
const ROOM_KIB: [u64; 6] = [0, 4, 16, 64, 256, 1024];

/// Number of runs that ended so; with more room the command ends well.
fn ends_with_2_on_a_full_disk(place: &Workplace, words: &str) -> u64 {
    let mut failed = 0;
    for free_kib in ROOM_KIB {
        let Some(Outcome { code, said, left }) = on_small_disk(place, words, free_kib) else { return 0 };
        let what = format!("`{words}` with {free_kib} KiB: exit {code}: {said}\nleft: {left:?}");
        assert!(matches!(code, 0 | 2), "{what}");
        if code == 2 {
            assert!(said.contains("error: ") && said.contains("No space left"), "{what}");
            failed += 1;
        }
        assert!(left.iter().all(|file| !file.contains(".part") && is_whole(place, file)), "{what}");
    }
    assert!(failed > 0, "{words}: the disk was never full");
    failed
}

#[test]
fn a_cache_on_a_full_disk_costs_only_time() {
    let place = filled();
    for free_kib in [0, 4, 64] {
        let words = format!("run small.toml --cache disk/cache --out b{free_kib}");
        let Some(Outcome { code, said, left }) = on_small_disk(&place, &words, free_kib) else { return };
        assert_eq!(code, 0, "{said}");
        assert_eq!(said.matches("not cached").count(), 1, "{said}");
        assert!(left.iter().all(|file| !file.contains(".part") && is_whole(&place, file)), "{left:?}");
        assert_eq!(place.bytes(&format!("b{free_kib}/frames.cube")), place.bytes("a/frames.cube"));
    }
}
