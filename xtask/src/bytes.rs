//! `bytes`: checksums of all files that a program makes from every scene and for ten tables, so that two
//! versions can be compared to the byte. Values that differ between runs (seconds, memory, cached stages) are
//! removed from `summary.json`; `report.html` contains the same values and is left out.

mod runs;

use crate::cli::BytesArguments;
use crate::house::folders::files_below;
use crate::project::{project_root, read_text, this_program};
use runs::CommandRun;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Stdio};
use wayside::host::failure::Failure;
use wayside::host::files;
use wayside::host::progress::Work;
use wayside::program::terminal;

/// Keys of `summary.json` that differ between runs.
const RUN_DEPENDENT_KEYS: [&str; 6] = [
    "stage_seconds",
    "frames_seconds",
    "frames_processor_seconds",
    "cached",
    "peak_memory_mib",
    "memory_estimate_mib",
];

/// Names of files and their checksums.
type Checksums = BTreeMap<String, String>;

pub(crate) fn run(arguments: &BytesArguments) -> Result<(), Failure> {
    files::claim(std::slice::from_ref(&arguments.out))?;
    let program = arguments.program.clone().map_or_else(this_program, Ok)?;
    let mut sums = Checksums::new();
    let runs: Vec<CommandRun> =
        runs::all(&project_root())?.into_iter().filter(|run| is_selected(arguments, run)).collect();
    let work = Work::begin("runs");
    for (number, run) in runs.iter().enumerate() {
        work.at(number, runs.len());
        sums.extend(checksums_of_run(&program, run)?);
    }
    let text: String = sums.iter().map(|(name, sum)| format!("{sum}  {name}\n")).collect();
    files::write_file(&arguments.out, text.as_bytes())?;
    match &arguments.against {
        Some(file) => {
            compare(&sums, file, &|name| runs.iter().any(|run| name.starts_with(&format!("{}/", run.name))))
        }
        None => {
            let _: () = terminal::line(format!("{} files", sums.len()));
            Ok(())
        }
    }
}

fn is_selected(arguments: &BytesArguments, run: &CommandRun) -> bool {
    arguments.only.is_empty() || arguments.only.contains(&run.name)
}

/// Runs `program` in a separate folder and computes the checksum of every file that it leaves.
fn checksums_of_run(program: &Path, run: &CommandRun) -> Result<Checksums, Failure> {
    let system = |e: std::io::Error| Failure::System(format!("{}: {e}", run.name));
    let folder = tempfile::tempdir().map_err(system)?;
    let words: Vec<String> =
        run.words.iter().map(|word| word.replace("OUT", &folder.path().display().to_string())).collect();
    let mut command = Command::new(program);
    command.args(&words).current_dir(project_root()).stdin(Stdio::null()).stdout(Stdio::null());
    let status = command.status().map_err(system)?;
    if !status.success() {
        return Err(Failure::Refused(format!("`{}`: {status}", words.join(" "))));
    }
    let mut sums = Checksums::new();
    for place in files_below(folder.path()) {
        let name = place.strip_prefix(folder.path()).unwrap_or(&place).display().to_string();
        if let Some(bytes) = comparable_bytes(&name, &std::fs::read(&place).map_err(system)?) {
            sums.insert(format!("{}/{name}", run.name), blake3::hash(&bytes).to_hex()[..32].to_owned());
        }
    }
    Ok(sums)
}

/// The part of a file that is the same in every run; `None` for files that are not compared.
fn comparable_bytes(name: &str, bytes: &[u8]) -> Option<Vec<u8>> {
    match Path::new(name).extension().and_then(|kind| kind.to_str()) {
        Some("html") => None,
        // The file beside a table contains seconds, which differ, and values that follow from the table.
        Some("json") if name != "summary.json" => None,
        Some("json") => {
            let mut summary: Value = serde_json::from_slice(bytes).ok()?;
            remove_keys(&mut summary, &RUN_DEPENDENT_KEYS);
            Some(summary.to_string().into_bytes())
        }
        _ => Some(bytes.to_vec()),
    }
}

fn remove_keys(value: &mut Value, keys: &[&str]) {
    match value {
        Value::Object(map) => {
            keys.iter().for_each(|key| _ = map.remove(*key));
            map.values_mut().for_each(|value| remove_keys(value, keys));
        }
        Value::Array(list) => list.iter_mut().for_each(|value| remove_keys(value, keys)),
        _ => {}
    }
}

/// Prints the differences from an earlier list; fails if there are any.
fn compare(sums: &Checksums, file: &Path, is_selected: &dyn Fn(&str) -> bool) -> Result<(), Failure> {
    let text = read_text(file)?;
    let pairs = text.lines().filter_map(|line| line.split_once("  "));
    let known: Checksums =
        pairs.map(|(sum, name)| (name.to_owned(), sum.to_owned())).filter(|(n, _)| is_selected(n)).collect();
    let names: std::collections::BTreeSet<&String> = sums.keys().chain(known.keys()).collect();
    let verdict = |name: &String| match (known.get(name), sums.get(name)) {
        (Some(a), Some(b)) if a == b => None,
        (Some(_), Some(_)) => Some(format!("{name}: other bytes")),
        (None, _) => Some(format!("{name}: new")),
        (_, None) => Some(format!("{name}: gone")),
    };
    let other: Vec<String> = names.iter().filter_map(|name| verdict(name)).collect();
    other.iter().for_each(terminal::line);
    terminal::line(format!("{} files, {} other than in {}", sums.len(), other.len(), file.display()));
    if other.is_empty() { Ok(()) } else { Err(Failure::Refused(format!("{} files differ", other.len()))) }
}
