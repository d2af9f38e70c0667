//! Sidecars, which describe the file beside them: `F.json` appended to the file's whole name, so that no two
//! files share one.
//!
//! Each names its file in `of`; the description of a table of `rcs` is recognized by its content. A
//! description of another file, or a file that is not a sidecar, is never replaced.

use pipeline::host::failure::Failure;
use pipeline::host::files;
use serde_json::{Value, json};
use std::io::Read;
use std::path::{Path, PathBuf};

/// `x.npy` → `x.npy.json`.
pub(crate) fn beside(file: &Path) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(".json");
    PathBuf::from(name)
}

/// `S.npy` → `S.json`, the name of a table's description in `docs/interface.md`; for `S.json` itself
/// `S.axes.json`.
pub fn of_table(table: &Path) -> PathBuf {
    let json = table.with_extension("json");
    if json == table { table.with_extension("axes.json") } else { json }
}

/// Writes the sidecar of an exported file: its axes, and the file's name in `of`.
pub(crate) fn write(file: &Path, axes: &Value) -> Result<(), Failure> {
    put(&beside(file), file, &named(file, axes))
}

/// Values of a sidecar with the name of its file.
fn named(file: &Path, told: &Value) -> Value {
    let mut told = told.clone();
    if let Some(map) = told.as_object_mut() {
        map.insert(OF.into(), name(file).into());
    }
    told
}

/// Writes the description of a table, with the same bytes under any name.
pub fn write_of_table(table: &Path, described: &Value) -> Result<(), Failure> {
    put(&of_table(table), table, described)
}

/// Refuses, before the work, to write a file or its sidecar if another file would be lost.
pub(crate) fn claim(file: &Path) -> Result<(), Failure> {
    files::claim(&[file.to_owned(), beside(file)])?;
    refuse_foreign(&beside(file), file)
}

/// Claims a table and its description, as `claim` does for an exported file and its sidecar.
pub fn claim_table(table: &Path) -> Result<(), Failure> {
    files::claim(&[table.to_owned(), of_table(table)])?;
    refuse_foreign(&of_table(table), table)
}

/// Removes the sidecar of a file immediately before the file is replaced: if the command ends between the
/// two, the old sidecar must not describe the new file.
pub(crate) fn remove_outdated(file: &Path) -> std::io::Result<()> {
    remove_description(&beside(file), file)
}

/// Removes the description of a table that is replaced next, as `remove_outdated` does.
///
/// # Errors
/// The description belongs to another file, or cannot be removed.
pub fn remove_outdated_table(table: &Path) -> std::io::Result<()> {
    remove_description(&of_table(table), table)
}

/// Replaces the sidecar of a file, immediately before the file is replaced, by one with these values alone:
/// if the command ends before it writes the new one, `has_own` still finds them.
pub(crate) fn leave_only(file: &Path, told: &Value) -> std::io::Result<()> {
    refuse_foreign(&beside(file), file).map_err(std::io::Error::other)?;
    let text = named(file, told).to_string();
    files::overwrite(&beside(file), text.as_bytes()).map_err(std::io::Error::other)
}

/// Whether a file has a sidecar that names it and has a value of this key.
pub(crate) fn has_own(file: &Path, key: &str) -> bool {
    let place = beside(file);
    let told = text_of(|| std::fs::File::open(&place), &place);
    told.is_some_and(|told| told[OF] == name(file) && told.get(key).is_some())
}

fn remove_description(place: &Path, file: &Path) -> std::io::Result<()> {
    refuse_foreign(place, file).map_err(std::io::Error::other)?;
    files::remove_description(place, json!({ OF: name(file) }).to_string().as_bytes())
}

/// Content of a sidecar; `None` if there is no readable one.
pub fn read(place: &Path) -> Option<Value> {
    text_of(|| artifact::inputs::open(place), place)
}

fn text_of(open: impl FnOnce() -> std::io::Result<std::fs::File>, place: &Path) -> Option<Value> {
    let file = place.is_file().then(|| open().ok()).flatten()?;
    let mut text = Vec::new();
    file.take(LIMIT_BYTES).read_to_end(&mut text).ok()?;
    serde_json::from_slice(&text).ok()
}

/// Largest sidecar: axes of the largest table, as text.
const LIMIT_BYTES: u64 = 256 << 20;

/// Key of the file's name in a sidecar.
const OF: &str = "of";

fn put(place: &Path, file: &Path, told: &Value) -> Result<(), Failure> {
    refuse_foreign(place, file)?;
    let text = serde_json::to_string_pretty(told).map_err(Failure::refused)?;
    files::write_file(place, text.as_bytes())
}

fn name(file: &Path) -> String {
    file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Refuses a `place` that holds a file other than a sidecar of `file`: the requested file is replaced, but
/// files beside it only if they are its own.
fn refuse_foreign(place: &Path, file: &Path) -> Result<(), Failure> {
    let rule = format!("does not belong to {}, beside which it would be written", name(file));
    files::refuse_unless(place, &rule, || {
        let told = text_of(|| std::fs::File::open(place), place);
        told.is_some_and(|told| match told.get(OF).and_then(Value::as_str) {
            Some(of) => of == name(file),
            None => is_of_a_table(&told),
        })
    })
}

fn is_of_a_table(told: &Value) -> bool {
    ["axes", "settings", "mesh"].iter().all(|key| told[key].is_object())
}
