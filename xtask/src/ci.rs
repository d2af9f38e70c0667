//! `ci`: every check of the project, cheapest first. The first that fails ends it.

mod features;
mod layers;
mod readme;
mod rooms;
mod size;
mod training;

use crate::project::project_root;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};
use std::time::Instant;
use training::Training;
use wayside::host::failure::Failure;
use wayside::program::terminal;

type Check = fn(&mut Tally) -> Result<(), Failure>;

const CHECKS: [(&str, Check); 9] = [
    ("format", |_| cargo(&["fmt", "--all", "--check"])),
    ("layer rule", |_| layers::check()),
    ("room rule", |_| rooms::check()),
    ("sizes of files and functions", |_| size::check()),
    ("one set of features", |_| features::check()),
    ("lints", |_| cargo(&["clippy", "--release", "--all-targets", "--", "-D", "warnings"])),
    ("docs", |_| documentation()),
    ("tests and doctests (README)", |tally| readme::tests(tally)),
    ("main job (README)", |_| readme::main_job()),
];

pub(crate) fn run() -> Result<(), Failure> {
    let mut tally = Tally::default();
    // Its library is one piece of work for minutes: beside the others it costs least.
    let training = Training::begin()?;
    for (name, check) in CHECKS {
        good(name, || check(&mut tally))?;
    }
    good("training", || training.end(&mut tally))?;
    terminal::line(format!("{} passed, {} failed", tally.passed, tally.failed));
    Ok(())
}

fn good(name: &str, check: impl FnOnce() -> Result<(), Failure>) -> Result<(), Failure> {
    terminal::line(format!("== {name}"));
    let start = Instant::now();
    check().map_err(|e| Failure::Refused(format!("ci: {name}: {e}")))?;
    terminal::line(format!("== {name}: good, {:.0} s", start.elapsed().as_secs_f64()));
    Ok(())
}

/// Tests that ran.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Tally {
    passed: u64,
    failed: u64,
}

impl Tally {
    /// Adds a line `test result: ok. 3 passed; 0 failed; …`.
    fn count(&mut self, line: &str) {
        if let Some(rest) = line.strip_prefix("test result:") {
            self.passed += before(rest, " passed");
            self.failed += before(rest, " failed");
        }
    }
}

fn before(line: &str, word: &str) -> u64 {
    let number = line.split(word).next().and_then(|l| l.split_whitespace().last());
    number.and_then(|n| n.parse().ok()).unwrap_or(0)
}

fn documentation() -> Result<(), Failure> {
    finished(Command::new("cargo").args(["doc", "--release", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings"))
}

fn cargo(arguments: &[&str]) -> Result<(), Failure> {
    finished(Command::new("cargo").args(arguments))
}

/// Runs a command in the project's root to a good end.
fn finished(command: &mut Command) -> Result<(), Failure> {
    let words = said(command);
    let status = command.current_dir(project_root()).stdin(Stdio::null()).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(Failure::Refused(format!("`{words}` ended with {status}"))),
        Err(error) => Err(Failure::System(format!("`{words}`: {error}"))),
    }
}

/// As [`finished`], showing each line of standard output and counting the tests in it.
fn counted(command: &mut Command, tally: &mut Tally) -> Result<(), Failure> {
    let words = said(command);
    let failed = |e: std::io::Error| Failure::System(format!("`{words}`: {e}"));
    command.current_dir(project_root()).stdin(Stdio::null()).stdout(Stdio::piped());
    let mut child = command.spawn().map_err(failed)?;
    if let Some(stdout) = child.stdout.take() {
        for line in BufReader::new(stdout).lines().map_while(Result::ok) {
            tally.count(&line);
            terminal::line(line);
        }
    }
    let status = child.wait().map_err(failed)?;
    if status.success() { Ok(()) } else { Err(Failure::Refused(format!("`{words}` ended with {status}"))) }
}

fn said(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|w| w.to_string_lossy().into_owned()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tests_are_counted_from_cargos_own_words() {
        let mut tally = Tally::default();
        tally.count("test result: ok. 12 passed; 1 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.1s");
        tally.count("test result: FAILED. 3 passed; 0 failed; 0 ignored");
        tally.count("test something_that_passed ... ok");
        assert_eq!(tally, Tally { passed: 15, failed: 1 });
    }
}
