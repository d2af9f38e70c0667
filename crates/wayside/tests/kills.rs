//! Programs that are killed at any time: nothing half-written, nothing left once the next one has run, and
//! that one goes on to the same bytes. A few kills by default; as many of each command as `WAYSIDE_KILLS`
//! says when asked for, at other times by `WAYSIDE_SEED`.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

mod common;

use common::killing::{begin_anew, files, is_temporary, killed_after};
use common::{CORNER, SMALL_SCENE, Workplace, asked, crops, tell_cases};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::time::{Duration, Instant};

/// A command, the results of which are compared, and how often it is killed at most before it may end.
struct Work<'a> {
    words: &'a str,
    /// Files that are the same to the byte however often it was ended, relative to the folder.
    same: &'a [&'a str],
}

impl Work<'_> {
    /// Runs it undisturbed, then kills it at random times until it was killed often enough, and lets it end.
    fn is_resumed_to_the_same_bytes(&self, seed: u64) {
        let (whole, place) = (prepared(), prepared());
        let start = Instant::now();
        whole.run(self.words);
        let duration = start.elapsed();
        let mut random = ChaCha8Rng::seed_from_u64(seed + asked("WAYSIDE_SEED", 0));
        let (mut kills, mut left) = (0, 0);
        let asked_for = asked("WAYSIDE_KILLS", 3);
        while kills < asked_for {
            let after = Duration::from_secs_f64(duration.as_secs_f64() * random.random::<f64>());
            match killed_after(&place, self.words, after) {
                true => kills += 1,
                false => begin_anew(&place),
            }
            left += files(place.root()).iter().filter(|file| is_temporary(file)).count();
            whole_or_absent(&place, &whole, self.same);
        }
        place.run(self.words);
        let temporary: Vec<_> = files(place.root()).into_iter().filter(|file| is_temporary(file)).collect();
        assert!(temporary.is_empty(), "{}: left behind: {temporary:?}", self.words);
        for file in self.same {
            assert!(place.bytes(file) == whole.bytes(file), "{}: {file} differs", self.words);
        }
        let command = self.words.split(' ').next().unwrap_or_default();
        let came = format!("{left} temporary files met and swept, the same bytes in the end");
        tell_cases(&format!("kills of {command} within {duration:.1?}"), kills, &came);
    }
}

fn prepared() -> Workplace {
    let place = Workplace::new();
    std::fs::write(place.path("long.toml"), SMALL_SCENE.replace("frames = 2", "frames = 12")).unwrap();
    std::fs::write(place.path("base.toml"), BASE).unwrap();
    std::fs::write(place.path("spec.toml"), RECIPE).unwrap();
    std::fs::write(place.path("corner.obj"), CORNER).unwrap();
    crops::write(&place.path("crops"), 10);
    place
}

const BASE: &str = "name = \"base\"\n[radar.waveform]\nsamples = 64\nchirps = 16\n[radar.array]\npreset = \"1x4\"\n\
[dsp]\ntraining_cells = [3, 6]\n[fidelity]\nbounces = 1\n";

const RECIPE: &str = "scene = \"base.toml\"\nseed = 1\nscenes_per_class = 10\nrange_m = [25.0, 45.0]\n\
speed_mps = [1.0, 5.0]\nlanes = [1, 2]\nvehicle_seeds = 2\nscenes_per_shard = 8\n[models]\nmotorcycle = [\"motorcycle-street\"]\n\
car = [\"car-hatchback\"]\n";

/// No result is there in part.
fn whole_or_absent(place: &Workplace, whole: &Workplace, same: &[&str]) {
    for file in same.iter().filter(|file| place.path(file).exists()) {
        assert!(place.bytes(file) == whole.bytes(file), "{file} is half-written");
    }
}

#[test]
fn a_run_that_is_killed_goes_on() {
    let same =
        ["out/scene.scene", "out/frames.paths", "out/frames.cube", "out/frames.rdm", "out/frames.points"];
    Work { words: "run long.toml --out out --quiet", same: &same }.is_resumed_to_the_same_bytes(1);
}

#[test]
fn a_table_that_is_killed_goes_on() {
    let words = "rcs corner.obj --freq-ghz 76:78:32 --az-deg 0:90:400 --el-deg 20 --accuracy-db -30 --quiet --out out/s.npy";
    Work { words, same: &["out/s.npy"] }.is_resumed_to_the_same_bytes(2);
}

#[test]
fn a_dataset_that_is_killed_goes_on() {
    let same = ["out/shard-0000.dataset", "out/shard-0001.dataset", "out/shard-0002.dataset"];
    Work { words: "dataset spec.toml --out out --quiet", same: &same }.is_resumed_to_the_same_bytes(3);
}

/// Training begins anew and ends with the same weights.
#[test]
#[ignore = "builds the learning library: WAYSIDE_PROJECT=$PWD cargo test --release -p wayside --test kills -- --ignored a_training"]
fn a_training_that_is_killed_leaves_nothing_half_written_and_ends_the_same_way() {
    let same = ["out/weights.model", "out/metrics.json", "out/curves.csv"];
    let words = "train crops --learner paper --iterations 3 --quiet --out out";
    Work { words, same: &same }.is_resumed_to_the_same_bytes(4);
}

#[test]
fn trees_whose_training_is_killed_are_not_half_written_and_end_the_same_way() {
    let same = ["out/weights.model", "out/metrics.json", "out/curves.csv"];
    Work { words: "train crops --learner trees --quiet --out out", same: &same }
        .is_resumed_to_the_same_bytes(6);
}
