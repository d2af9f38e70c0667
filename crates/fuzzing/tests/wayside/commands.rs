//! Commands of the program in this process, on the files of a case.

use clap::Parser;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use wayside::host::failure::Failure;
use wayside::host::memory::Allowance;
use wayside::program::cli::Command;
use wayside::program::command_context::CommandContext;
use wayside::program::commands::dispatch;
use wayside::program::terminal;
use wayside::report::ReportOrigin;

/// Command line of the program without those that all commands have.
#[derive(Debug, Parser)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

/// A process writes no result twice, so each case has results of its own name.
static CASE: AtomicU64 = AtomicU64::new(0);

/// Removes what the case before has left; sound files stay.
pub(crate) fn prepare(folder: &Path) {
    CASE.fetch_add(1, Ordering::Relaxed);
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let (path, kind) = (entry.path(), entry.file_type().unwrap());
        match kind.is_dir() {
            true if entry.file_name() == "sound" => {}
            true => std::fs::remove_dir_all(path).unwrap(),
            false => std::fs::remove_file(path).unwrap(),
        }
    }
}

/// Place of a case's results.
pub(crate) fn out(folder: &Path) -> PathBuf {
    folder.join(format!("out-{}", CASE.load(Ordering::Relaxed)))
}

/// Puts a file into the folder of a case.
pub(crate) fn put(folder: &Path, name: &str, bytes: &[u8]) {
    std::fs::write(folder.join(name), bytes).unwrap();
}

/// Carries out a command: `@NAME` is a file of the folder, `@O` the place of the case's results.
pub(crate) fn execute(folder: &Path, words: &str) -> Result<(), Failure> {
    let word = |word: &str| -> OsString {
        let Some((before, name)) = word.split_once('@') else { return word.into() };
        let place = match name.strip_prefix('O') {
            Some(ending) => [out(folder).as_os_str(), ending.as_ref()].concat_all(),
            None => folder.join(name).into_os_string(),
        };
        [before.as_ref(), place.as_os_str()].concat_all()
    };
    terminal::mute();
    let command = words.split_whitespace().next().unwrap_or_default().to_owned();
    let words = ["wayside".into()].into_iter().chain(words.split_whitespace().map(word));
    let words = CommandLine::try_parse_from(words).unwrap_or_else(|error| panic!("{error}"));
    let context =
        CommandContext { command, memory: Allowance::of(Some(1024)), origin: ReportOrigin::default() };
    dispatch(words.command, &context)
}

/// Has a command carried out when the case is read.
pub(crate) fn schedule(folder: &Path, words: &str) {
    std::fs::write(folder.join("words"), words).unwrap();
}

/// Carries out what was scheduled.
pub(crate) fn run_scheduled(folder: &Path) -> Result<(), String> {
    let words = std::fs::read_to_string(folder.join("words")).unwrap();
    execute(folder, &words).map_err(|failure| failure.to_string())
}

/// Carries out what was scheduled, where the content of a file alone can be at fault, or names of results
/// that it asks for twice.
pub(crate) fn run_scheduled_on_content(folder: &Path) -> Result<(), String> {
    let words = std::fs::read_to_string(folder.join("words")).unwrap();
    execute(folder, &words).map_err(|failure| {
        // As it is told, not as it is held: what is too long is left out where it is told.
        let sentence = failure.to_string();
        match failure {
            Failure::Refused(_) => sentence,
            // A shard that was left as it is, beside the sound one.
            Failure::System(_) if sentence.ends_with("each is taken once") => sentence,
            Failure::System(_) if sentence.contains(&*out(folder).to_string_lossy()) => sentence,
            // An artifact of another kind than the words are for: they name no file.
            Failure::System(_) if sentence.starts_with("--axes on") => folder.display().to_string(),
            other => panic!("{words}: {other:?} is no refusal of what a file holds"),
        }
    })
}

trait ConcatAll {
    fn concat_all(self) -> OsString;
}

impl<const N: usize> ConcatAll for [&std::ffi::OsStr; N] {
    fn concat_all(self) -> OsString {
        self.into_iter().collect()
    }
}
