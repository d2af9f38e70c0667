//! Folders of datasets as inputs: checks that all shards exist, that no two are the same, and that no output
//! replaces one of their files.

use crate::host::failure::Failure;
use crate::host::progress;
use artifact::dataset::Dataset;
use artifact::{Reader, bounded, inputs};
use serde::Deserialize;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Read};
use std::path::{Path, PathBuf};

/// Files made from all shards, in the order of their writing: a line per sample, a line per scene, and the
/// errors of all vehicles.
pub const SUMMARY_FILES: [&str; 3] = ["manifest.jsonl", SCENES, "detection.md"];
const SCENES: &str = "scenes.jsonl";

/// A folder of a dataset with all its shards.
#[derive(Debug, Clone)]
pub struct DatasetFolder {
    /// Folder as the caller named it.
    pub folder: PathBuf,
    /// Shards, at least one, in the order of their numbers.
    pub shards: Vec<PathBuf>,
}

impl DatasetFolder {
    /// Finds the shards of a folder; all of its files count as inputs from then on.
    ///
    /// # Errors
    /// The folder has no shards, or lacks some that its `scenes.jsonl` names. Without that file the dataset
    /// is unfinished: this is noted, and the present shards are taken.
    pub fn open(folder: &Path) -> Result<Self, Failure> {
        let shards = shards(folder);
        if shards.is_empty() {
            return Err(Failure::System(format!("{}: no shards of a dataset here", folder.display())));
        }
        for shard in &shards {
            inputs::register_path(shard);
            inputs::register_path(&lines_file(shard));
        }
        SUMMARY_FILES.iter().for_each(|name| inputs::register_path(&folder.join(name)));
        check_completeness(folder, &shards)?;
        Ok(Self { folder: folder.to_owned(), shards })
    }

    /// Finds the shards of several folders, which must not share any.
    ///
    /// # Errors
    /// Those of [`Self::open`], and two shards with the same bytes: their samples would count twice, or be in
    /// both training and test.
    pub fn open_all(folders: &[PathBuf]) -> Result<Vec<Self>, Failure> {
        let opened: Vec<Self> = folders.iter().map(|folder| Self::open(folder)).collect::<Result<_, _>>()?;
        check_duplicates(opened.iter().flat_map(|folder| &folder.shards))?;
        Ok(opened)
    }
}

/// File with a line for each scene of a shard.
pub fn lines_file(shard: &Path) -> PathBuf {
    shard.with_extension("jsonl")
}

/// Part of a scene's line that names the shard of its samples.
#[derive(Deserialize)]
struct SceneLine {
    file: Option<String>,
}

/// Checks the shards of a folder against those that its `scenes.jsonl` names.
fn check_completeness(folder: &Path, shards: &[PathBuf]) -> Result<(), Failure> {
    let scenes = folder.join(SCENES);
    let file = match bounded::open(&scenes) {
        Ok(file) => file,
        Err(error) if error.kind() == ErrorKind::NotFound => {
            note_unfinished(folder, shards.len());
            return Ok(());
        }
        Err(error) => return Err(Failure::system(&scenes, "read", error)),
    };
    let here: BTreeSet<&Path> = shards.iter().map(PathBuf::as_path).collect();
    let named = shards_named(file, &scenes)?;
    let places: BTreeSet<PathBuf> = named.iter().map(|name| folder.join(name)).collect();
    let others: Vec<&PathBuf> = shards.iter().filter(|shard| !places.contains(*shard)).collect();
    if let (Some(first), false) = (others.first(), named.is_empty()) {
        let (first, others, all) = (first.display(), others.len(), shards.len());
        progress::note(format!(
            "note: {first}: {SCENES} does not tell of it; so it is of {others} of the {all} shards here, which \
             a recipe of more scenes has left, and which are taken too"
        ));
    }
    let lacks = named.iter().find(|name| !here.contains(folder.join(name).as_path()));
    lacks.map_or(Ok(()), |name| Err(missing_shard(folder, name)))
}

/// Largest line of a scene, bytes: a thousand frames of sixteen vehicles.
const LINE_LIMIT_BYTES: u64 = 1 << 26;

/// Names of the shards in the lines of scenes.
fn shards_named(file: File, scenes: &Path) -> Result<BTreeSet<String>, Failure> {
    let mut reader = BufReader::new(file);
    let mut named = BTreeSet::new();
    for number in 1.. {
        let mut line = Vec::new();
        let read = reader.by_ref().take(LINE_LIMIT_BYTES).read_until(b'\n', &mut line);
        if read.map_err(|error| Failure::system(scenes, "read", error))? == 0 {
            break;
        }
        let told: SceneLine = serde_json::from_slice(&line).map_err(|error| {
            Failure::Refused(format!("{}:{number}: is no line of a scene: {error}", scenes.display()))
        })?;
        named.extend(told.file);
    }
    Ok(named)
}

fn note_unfinished(folder: &Path, shards: usize) {
    let folder = folder.display();
    progress::note(format!(
        "note: {folder}: has no {SCENES}, so whether shards lack is not known; the {shards} here are taken"
    ));
}

fn missing_shard(folder: &Path, shard: &str) -> Failure {
    let rule = "is not there, and scenes.jsonl tells of its scenes; `dataset` makes it anew";
    Failure::System(format!("{}: {rule}", folder.join(shard).display()))
}

/// Refuses two shards with the same bytes; only shards of equal length are read. Shards without samples, in
/// whose scenes nothing was found, are all alike.
fn check_duplicates<'a>(shards: impl Iterator<Item = &'a PathBuf>) -> Result<(), Failure> {
    let mut of_length: BTreeMap<u64, Vec<&PathBuf>> = BTreeMap::new();
    for shard in shards {
        let about = std::fs::metadata(shard).map_err(|error| Failure::system(shard, "read", error))?;
        of_length.entry(about.len()).or_default().push(shard);
    }
    let mut known: BTreeMap<String, &PathBuf> = BTreeMap::new();
    for shard in of_length.into_values().filter(|alike| alike.len() > 1).flatten() {
        let (_, hash) = inputs::named_hash(shard).map_err(|error| Failure::system(shard, "read", error))?;
        if let Some(other) = known.insert(hash, shard)
            && Reader::<Dataset>::open(shard)?.frames() > 0
        {
            let (one, other) = (shard.display(), other.display());
            return Err(Failure::System(format!("{one}: has the samples of {other}; each is taken once")));
        }
    }
    Ok(())
}

/// Shards of a dataset folder and of its subfolders of a thousand shards each, in the order of their numbers;
/// files with other names come first, by name.
fn shards(folder: &Path) -> Vec<PathBuf> {
    let folders = entries(folder).filter(|place| name(place).starts_with("shards-") && place.is_dir());
    let all = entries(folder).chain(folders.flat_map(|folder| entries(&folder)));
    let mut shards: Vec<PathBuf> =
        all.filter(|place| place.extension().is_some_and(|e| e == "dataset")).collect();
    let number = |shard: &Path| name(shard).strip_prefix("shard-")?.split('.').next()?.parse::<u64>().ok();
    shards.sort_by_cached_key(|shard| (number(shard), shard.clone()));
    shards
}

fn entries(folder: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path())
}

fn name(place: &Path) -> Cow<'_, str> {
    place.file_name().unwrap_or_default().to_string_lossy()
}
