//! Readers of what earlier runs have left and later ones take up: summaries, lines of datasets, runs of
//! studies, descriptions beside tables, checkpoints, and a cache.

use crate::commands::{note, noted, out};
use crate::envelope::{crafted, damaged};
use crate::sound::{self, made, place};
use artifact::classes::Classes;
use artifact::cube::Cube;
use artifact::paths::Paths;
use artifact::points::Points;
use artifact::rdm::Rdm;
use fuzzing::{Noise, Reader, change_json, change_json_like, change_numbers, changed_text};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use wayside::Summary;

pub(crate) fn readers() -> Vec<Reader> {
    vec![
        Reader::refusing("summary", 200, write_summary, read_summary),
        Reader::making_anew("dataset-lines", 40, write_lines, noted),
        Reader::making_anew("study-runs", 12, write_runs, noted),
        Reader::refusing("sidecar", 60, write_sidecar, noted),
        Reader::making_anew("checkpoint", 40, write_checkpoint, noted),
        Reader::making_anew("cache", 20, write_cache, noted),
    ]
}

/// A JSON text changed: values to ones of their kinds, values to others, or words.
fn changed_json_text(noise: &mut Noise, text: &[u8]) -> Vec<u8> {
    const WORDS: [&str; 10] = ["{", "}", "[", "]", "\"", ",", ":", "null", "1e999", "key"];
    let Ok(mut value) = serde_json::from_slice::<Value>(text) else { return text.to_vec() };
    let kind = noise.below(4);
    for _ in 0..=noise.below(3) {
        match kind {
            0 => change_json(noise, &mut value, &WORDS, strange),
            _ => change_json_like(noise, &mut value),
        }
    }
    let text = serde_json::to_vec(&value).unwrap();
    if kind == 1 { changed_text(noise, &text, &WORDS) } else { text }
}

fn strange(noise: &mut Noise) -> Value {
    match noise.below(5) {
        0 => json!(noise.below(9)),
        1 => serde_json::from_str(&noise.number()).unwrap_or(Value::Null),
        2 => (0..noise.times().min(200)).fold(json!(1), |inner, _| json!([inner])),
        3 => json!("x".repeat(noise.times())),
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

fn write_summary(noise: &mut Noise, folder: &Path) {
    let whole = std::fs::read(sound::of_run(folder, "summary.json")).unwrap();
    std::fs::write(folder.join("summary.json"), changed_json_text(noise, &whole)).unwrap();
}

fn read_summary(folder: &Path) -> Result<(), String> {
    let summary = Summary::read(&folder.join("summary.json")).map_err(|failure| failure.to_string())?;
    summary.json().map(drop).map_err(|failure| failure.to_string())
}

fn write_lines(noise: &mut Noise, folder: &Path) {
    let made_by_recipe = place(folder, "ds", |at| made(at, "dataset @sound/recipe.toml --out @sound/ds"));
    let text = std::fs::read_to_string(made_by_recipe.join("shard-0000.jsonl")).unwrap();
    let line = noise.below(text.lines().count());
    let change = |(number, text): (usize, &str)| match number == line {
        true => changed_json_text(noise, &without_checksum(text)),
        false => text.as_bytes().to_vec(),
    };
    let lines = text.lines().enumerate().map(change).collect::<Vec<_>>().join(&b'\n');
    let (shard, words) = match noise.one_in(4) {
        false => {
            let words = "dataset @sound/recipe.toml --out @O --shard 4294967295/4294967295";
            (made_by_recipe.join("shard-0000.dataset"), words)
        }
        true => (sound::dataset(folder), "protocols @O --learner trees --seeds 1"),
    };
    std::fs::create_dir(out(folder)).unwrap();
    std::fs::copy(shard, out(folder).join("shard-0000.dataset")).unwrap();
    std::fs::write(out(folder).join("shard-0000.jsonl"), lines).unwrap();
    note(folder, words);
}

/// A line as earlier versions wrote them: of a changed one the checksum alone would be seen.
fn without_checksum(line: &str) -> Vec<u8> {
    let mut scene: Value = serde_json::from_str(line).unwrap();
    scene.as_object_mut().unwrap().remove("checksum");
    serde_json::to_vec(&scene).unwrap()
}

fn write_runs(noise: &mut Noise, folder: &Path) {
    let kept =
        place(folder, "sw", |at| made(at, "sweep @sound/study.toml --no-cache --out @sound/sw")).join("runs");
    copy_folder(&kept, &out(folder).join("runs"));
    let runs = files(&out(folder));
    let run = &runs[noise.below(runs.len())];
    let whole = std::fs::read(run).unwrap();
    std::fs::write(run, changed_json_text(noise, &whole)).unwrap();
    note(folder, "sweep @sound/study.toml --no-cache --out @O");
}

/// A table of a plate.
const TABLE: &str = "rcs @sound/plate.obj --freq-ghz 77:78:2 --az-deg 0:40:5";

fn write_sidecar(noise: &mut Noise, folder: &Path) {
    let (sound, ending, words) = match noise.one_in(2) {
        true => {
            ("export.npy.json", ".npy.json", "export @sound/run/frames.cube --to npy --out @O.npy".to_owned())
        }
        false => ("table.json", ".json", format!("{TABLE} --out @O.npy")),
    };
    sound::of_run(folder, "frames.cube");
    let whole = place(folder, sound, |at| {
        made(at, "export @sound/run/frames.cube --to npy --out @sound/export.npy");
        made(at, &format!("{TABLE} --out @sound/table.npy"));
    });
    let mut text = std::fs::read_to_string(whole).unwrap();
    let own = out(folder).file_name().unwrap().to_string_lossy().into_owned();
    text = text.replace("export.npy", &format!("{own}.npy"));
    let place = PathBuf::from(format!("{}{ending}", out(folder).display()));
    std::fs::write(place, changed_json_text(noise, text.as_bytes())).unwrap();
    note(folder, &words);
}

const CHECKPOINT: &[u8] = b"WAYSIDE CHECKPOINT 1\n";

/// The checkpoint of a table that was made whole: the program removes it, and another name of it stays.
fn checkpoint(folder: &Path) -> Vec<u8> {
    let saved = place(folder, "checkpoint", |at| {
        let place = at.join("sound/k.npy.checkpoint");
        let of_other_work = [CHECKPOINT, &[b'0'; 64], b"\n"].concat();
        std::fs::write(&place, of_other_work).unwrap();
        std::fs::hard_link(&place, at.join("sound/checkpoint")).unwrap();
        made(at, &format!("{TABLE} --out @sound/k.npy"));
    });
    std::fs::read(saved).unwrap()
}

fn write_checkpoint(noise: &mut Noise, folder: &Path) {
    let whole = checkpoint(folder);
    let (head, mut left) = whole.split_at(CHECKPOINT.len() + 65);
    let mut records = vec![];
    while let Some((length, rest)) = left.split_first_chunk::<4>() {
        let (record, behind) = rest[16..].split_at(u32::from_le_bytes(*length) as usize);
        records.push(record.to_vec());
        left = behind;
    }
    assert!(!records.is_empty(), "aspects are kept");
    for _ in 0..=noise.below(3) {
        let (at, other) = (noise.below(records.len()), noise.below(records.len()));
        match noise.below(4) {
            0 => records.swap(at, other),
            1 => records.push(records[at].clone()),
            2 => damaged(noise, &mut records[at]),
            _ => change_numbers(noise, &mut records[at]),
        }
    }
    let sealed = |record: &Vec<u8>| {
        let sum = blake3::hash(record);
        [&(record.len() as u32).to_le_bytes(), &sum.as_bytes()[..16], record].concat()
    };
    let mut bytes = [head, &records.iter().flat_map(sealed).collect::<Vec<u8>>()].concat();
    if noise.one_in(8) {
        damaged(noise, &mut bytes);
    }
    std::fs::write(format!("{}.npy.checkpoint", out(folder).display()), bytes).unwrap();
    note(folder, &format!("{TABLE} --out @O.npy"));
}

/// An entry of a cache is changed and sealed again, but for the scene: what a cache says of a scene is worked
/// on as if the scene said it, and sealing keeps damage out, not malice (docs/threats.md).
fn write_cache(noise: &mut Noise, folder: &Path) {
    let sound = place(folder, "cache", |at| {
        made(at, "run @sound/small.toml --cache @sound/cache --out @sound/cached");
    });
    copy_folder(&sound, &folder.join("cache"));
    let entries = files(&folder.join("cache"));
    let entry = &entries[noise.below(entries.len())];
    let mut whole = std::fs::read(entry).unwrap();
    let changed = match entry.extension().and_then(|e| e.to_str()) {
        Some("paths") => crafted::<Paths>(noise, &whole),
        Some("cube") => crafted::<Cube>(noise, &whole),
        Some("rdm") => crafted::<Rdm>(noise, &whole),
        Some("points") => crafted::<Points>(noise, &whole),
        Some("classes") => crafted::<Classes>(noise, &whole),
        Some("json") => resealed(noise, &whole),
        _ => {
            damaged(noise, &mut whole);
            whole
        }
    };
    std::fs::write(entry, changed).unwrap();
    note(
        folder,
        noise.pick(&[
            "run @sound/small.toml --cache @cache --out @O",
            "run @sound/small.toml --cache @cache --out @O --explain",
            "run @sound/small.toml --cache @cache --dry-run --explain",
            "cache --cache @cache",
        ]),
    );
}

/// A remark with its text changed and its hash made anew.
fn resealed(noise: &mut Noise, whole: &[u8]) -> Vec<u8> {
    let mut sealed: Value = serde_json::from_slice(whole).unwrap();
    let text = changed_json_text(noise, sealed["text"].as_str().unwrap().as_bytes());
    let text = String::from_utf8_lossy(&text).into_owned();
    sealed["blake3"] = json!(blake3::hash(text.as_bytes()).to_hex().to_string());
    sealed["text"] = json!(text);
    serde_json::to_vec(&sealed).unwrap()
}
