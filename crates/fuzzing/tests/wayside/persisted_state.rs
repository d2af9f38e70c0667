//! Readers of what earlier runs have left and later ones take up: summaries, lines of datasets, runs of
//! studies, descriptions beside tables, checkpoints, and a cache.

use crate::commands::{out, run_scheduled, schedule};
use crate::corpus::{self, place, run_ok};
use crate::envelope::{corrupt, mutated_artifact};
use artifact::classes::Classes;
use artifact::cube::Cube;
use artifact::paths::Paths;
use artifact::points::Points;
use artifact::rdm::Rdm;
use fuzzing::{FuzzRng, Reader, mutate_json, mutate_json_keeping_types, mutate_text, mutate_word32};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use wayside::Summary;

pub(crate) fn readers() -> Vec<Reader> {
    vec![
        Reader::refusing("summary", 200, write_summary, read_summary),
        Reader::regenerating("dataset-lines", 40, write_lines, run_scheduled),
        Reader::regenerating("study-runs", 12, write_runs, run_scheduled),
        Reader::refusing("sidecar", 60, write_sidecar, run_scheduled),
        Reader::regenerating("checkpoint", 40, write_checkpoint, run_scheduled),
        Reader::regenerating("cache", 20, write_cache, run_scheduled),
    ]
}

/// A JSON text changed: values to ones of their kinds, values to others, or words.
fn mutate_json_text(rng: &mut FuzzRng, text: &[u8]) -> Vec<u8> {
    const WORDS: [&str; 10] = ["{", "}", "[", "]", "\"", ",", ":", "null", "1e999", "key"];
    let Ok(mut value) = serde_json::from_slice::<Value>(text) else { return text.to_vec() };
    let kind = rng.below(4);
    for _ in 0..=rng.below(3) {
        match kind {
            0 => mutate_json(rng, &mut value, &WORDS, strange),
            _ => mutate_json_keeping_types(rng, &mut value),
        }
    }
    let text = serde_json::to_vec(&value).unwrap();
    if kind == 1 { mutate_text(rng, &text, &WORDS) } else { text }
}

fn strange(rng: &mut FuzzRng) -> Value {
    match rng.below(5) {
        0 => json!(rng.below(9)),
        1 => serde_json::from_str(&rng.number_text()).unwrap_or(Value::Null),
        2 => (0..rng.repeat_count().min(200)).fold(json!(1), |inner, _| json!([inner])),
        3 => json!("x".repeat(rng.repeat_count())),
        _ => Value::Null,
    }
}

fn copy_folder(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().flatten() {
        let (path, target) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copy_folder(&path, &target);
        } else {
            std::fs::copy(path, target).unwrap();
        }
    }
}

/// All files below a folder, in the order of their names.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .flatten()
        .map(|entry| entry.path())
        .flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] })
        .collect();
    found.sort();
    found
}

fn write_summary(rng: &mut FuzzRng, folder: &Path) {
    let whole = std::fs::read(corpus::of_run(folder, "summary.json")).unwrap();
    std::fs::write(folder.join("summary.json"), mutate_json_text(rng, &whole)).unwrap();
}

fn read_summary(folder: &Path) -> Result<(), String> {
    let summary = Summary::read(&folder.join("summary.json")).map_err(|failure| failure.to_string())?;
    summary.json().map(drop).map_err(|failure| failure.to_string())
}

fn write_lines(rng: &mut FuzzRng, folder: &Path) {
    let made_by_recipe = place(folder, "ds", |at| run_ok(at, "dataset @sound/recipe.toml --out @sound/ds"));
    let text = std::fs::read_to_string(made_by_recipe.join("shard-0000.jsonl")).unwrap();
    let line = rng.below(text.lines().count());
    let change = |(number, text): (usize, &str)| match number == line {
        true => mutate_json_text(rng, &without_checksum(text)),
        false => text.as_bytes().to_vec(),
    };
    let lines = text.lines().enumerate().map(change).collect::<Vec<_>>().join(&b'\n');
    let (shard, words) = match rng.one_in(4) {
        false => {
            let words = "dataset @sound/recipe.toml --out @O --shard 4294967295/4294967295";
            (made_by_recipe.join("shard-0000.dataset"), words)
        }
        true => (corpus::dataset(folder), "protocols @O --learner trees --seeds 1"),
    };
    std::fs::create_dir(out(folder)).unwrap();
    std::fs::copy(shard, out(folder).join("shard-0000.dataset")).unwrap();
    std::fs::write(out(folder).join("shard-0000.jsonl"), lines).unwrap();
    schedule(folder, words);
}

/// A line as earlier versions wrote them: of a changed one the checksum alone would be seen.
fn without_checksum(line: &str) -> Vec<u8> {
    let mut scene: Value = serde_json::from_str(line).unwrap();
    scene.as_object_mut().unwrap().remove("checksum");
    serde_json::to_vec(&scene).unwrap()
}

fn write_runs(rng: &mut FuzzRng, folder: &Path) {
    let kept = place(folder, "sw", |at| run_ok(at, "sweep @sound/study.toml --no-cache --out @sound/sw"))
        .join("runs");
    copy_folder(&kept, &out(folder).join("runs"));
    let runs = files(&out(folder));
    let run = &runs[rng.below(runs.len())];
    let whole = std::fs::read(run).unwrap();
    std::fs::write(run, mutate_json_text(rng, &whole)).unwrap();
    schedule(folder, "sweep @sound/study.toml --no-cache --out @O");
}

/// A table of a plate.
const TABLE: &str = "rcs @sound/plate.obj --freq-ghz 77:78:2 --az-deg 0:40:5";

fn write_sidecar(rng: &mut FuzzRng, folder: &Path) {
    let (sound, ending, words) = match rng.one_in(2) {
        true => {
            ("export.npy.json", ".npy.json", "export @sound/run/frames.cube --to npy --out @O.npy".to_owned())
        }
        false => ("table.json", ".json", format!("{TABLE} --out @O.npy")),
    };
    corpus::of_run(folder, "frames.cube");
    let whole = place(folder, sound, |at| {
        run_ok(at, "export @sound/run/frames.cube --to npy --out @sound/export.npy");
        run_ok(at, &format!("{TABLE} --out @sound/table.npy"));
    });
    let mut text = std::fs::read_to_string(whole).unwrap();
    let own = out(folder).file_name().unwrap().to_string_lossy().into_owned();
    text = text.replace("export.npy", &format!("{own}.npy"));
    let place = PathBuf::from(format!("{}{ending}", out(folder).display()));
    std::fs::write(place, mutate_json_text(rng, text.as_bytes())).unwrap();
    schedule(folder, &words);
}

const CHECKPOINT: &[u8] = b"WAYSIDE CHECKPOINT 1\n";

/// The checkpoint of a table that was made whole: the program removes it, and another name of it stays.
fn checkpoint(folder: &Path) -> Vec<u8> {
    let saved = place(folder, "checkpoint", |at| {
        let place = at.join("sound/k.npy.checkpoint");
        let of_other_work = [CHECKPOINT, &[b'0'; 64], b"\n"].concat();
        std::fs::write(&place, of_other_work).unwrap();
        std::fs::hard_link(&place, at.join("sound/checkpoint")).unwrap();
        run_ok(at, &format!("{TABLE} --out @sound/k.npy"));
    });
    std::fs::read(saved).unwrap()
}

fn write_checkpoint(rng: &mut FuzzRng, folder: &Path) {
    let whole = checkpoint(folder);
    let (head, mut left) = whole.split_at(CHECKPOINT.len() + 65);
    let mut records = vec![];
    while let Some((length, rest)) = left.split_first_chunk::<4>() {
        let (record, behind) = rest[16..].split_at(u32::from_le_bytes(*length) as usize);
        records.push(record.to_vec());
        left = behind;
    }
    assert!(!records.is_empty(), "aspects are kept");
    for _ in 0..=rng.below(3) {
        let (at, other) = (rng.below(records.len()), rng.below(records.len()));
        match rng.below(4) {
            0 => records.swap(at, other),
            1 => records.push(records[at].clone()),
            2 => corrupt(rng, &mut records[at]),
            _ => mutate_word32(rng, &mut records[at]),
        }
    }
    let sealed = |record: &Vec<u8>| {
        let sum = blake3::hash(record);
        [&(record.len() as u32).to_le_bytes(), &sum.as_bytes()[..16], record].concat()
    };
    let mut bytes = [head, &records.iter().flat_map(sealed).collect::<Vec<u8>>()].concat();
    if rng.one_in(8) {
        corrupt(rng, &mut bytes);
    }
    std::fs::write(format!("{}.npy.checkpoint", out(folder).display()), bytes).unwrap();
    schedule(folder, &format!("{TABLE} --out @O.npy"));
}

/// An entry of a cache is changed and sealed again, but for the scene: what a cache says of a scene is worked
/// on as if the scene said it, and sealing keeps damage out, not malice (docs/threats.md).
fn write_cache(rng: &mut FuzzRng, folder: &Path) {
    let sound = place(folder, "cache", |at| {
        run_ok(at, "run @sound/small.toml --cache @sound/cache --out @sound/cached");
    });
    copy_folder(&sound, &folder.join("cache"));
    let entries = files(&folder.join("cache"));
    let entry = &entries[rng.below(entries.len())];
    let mut whole = std::fs::read(entry).unwrap();
    let changed = match entry.extension().and_then(|e| e.to_str()) {
        Some("paths") => mutated_artifact::<Paths>(rng, &whole),
        Some("cube") => mutated_artifact::<Cube>(rng, &whole),
        Some("rdm") => mutated_artifact::<Rdm>(rng, &whole),
        Some("points") => mutated_artifact::<Points>(rng, &whole),
        Some("classes") => mutated_artifact::<Classes>(rng, &whole),
        Some("json") => with_new_hash(rng, &whole),
        _ => {
            corrupt(rng, &mut whole);
            whole
        }
    };
    std::fs::write(entry, changed).unwrap();
    schedule(
        folder,
        rng.choose(&[
            "run @sound/small.toml --cache @cache --out @O",
            "run @sound/small.toml --cache @cache --out @O --explain",
            "run @sound/small.toml --cache @cache --dry-run --explain",
            "cache --cache @cache",
        ]),
    );
}

/// A remark with its text changed and its hash made anew.
fn with_new_hash(rng: &mut FuzzRng, whole: &[u8]) -> Vec<u8> {
    let mut sealed: Value = serde_json::from_slice(whole).unwrap();
    let text = mutate_json_text(rng, sealed["text"].as_str().unwrap().as_bytes());
    let text = String::from_utf8_lossy(&text).into_owned();
    sealed["blake3"] = json!(blake3::hash(text.as_bytes()).to_hex().to_string());
    sealed["text"] = json!(text);
    serde_json::to_vec(&sealed).unwrap()
}
