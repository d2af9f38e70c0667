//! Endings of output files, each with the command that writes it: a result with another format's ending would
//! be mistaken for it.

use pipeline::host::failure::Failure;
use std::path::Path;

/// Endings of the program's output files, each with the command that writes it.
pub(crate) const WRITERS: [(&str, &str); 27] = [
    ("toml", "scene-from"),
    ("glb", "vehicles"),
    ("scene", "run"),
    ("paths", "paths"),
    ("rcs", "run"),
    ("cube", "echo"),
    ("rdm", "dsp"),
    ("points", "dsp"),
    ("tracks", "dsp"),
    ("classes", "run"),
    ("dataset", "dataset"),
    ("model", "train"),
    ("npy", "export FILE --to npy"),
    ("exr", "export FILE --to exr"),
    ("png", "export FILE --to png"),
    ("csv", "export FILE --to csv"),
    ("pcd", "export FILE --to pcd"),
    ("ply", "export FILE --to ply"),
    ("json", "export FILE --to json"),
    ("safetensors", "export FILE --to safetensors"),
    ("bin", "export FILE --to dca1000"),
    ("sigmf-meta", "export FILE --to sigmf"),
    ("sigmf-data", "export FILE --to sigmf"),
    ("osi", "export FILE --to osi"),
    ("mcap", "export FILE --to mcap"),
    ("mat", "export FILE --to uwcr"),
    ("parquet", "export FILE --to parquet"),
];

/// Writer of the format of a file's ending, unless it is one of `own`. Unknown endings count as parts of
/// names, and an existing folder is accepted.
pub(crate) fn other_format(out: &Path, own: &[&str]) -> Option<String> {
    let told = out.extension()?.to_string_lossy().to_lowercase();
    let (extension, writer) = WRITERS.iter().find(|(extension, _)| told == *extension)?;
    let is_taken = own.contains(extension) || out.is_dir();
    (!is_taken).then(|| format!(".{extension} is written by `wayside {writer}`"))
}

/// Refuses a file of an artifact of this name with the ending of another format.
///
/// # Errors
/// A sentence with the file and with the command that writes its ending.
pub fn check(out: &Path, artifact: &str) -> Result<(), Failure> {
    refused(out, &format!("`write` writes .{artifact}"), &[artifact])
}

/// Refuses a folder of results with the ending of a format.
///
/// # Errors
/// Those of [`check`].
pub fn check_folder(out: &Path) -> Result<(), Failure> {
    refused(out, "`run` writes a folder", &[])
}

fn refused(out: &Path, what: &str, own: &[&str]) -> Result<(), Failure> {
    let written = other_format(out, own);
    let rule = written.map(|written| format!("{}: {what}; {written}", out.display()));
    rule.map_or(Ok(()), |rule| Err(Failure::System(rule)))
}
