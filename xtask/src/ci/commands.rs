//! Commands of a check, with counts of their tests.

use crate::project::project_root;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use wayside::host::failure::Failure;
use wayside::program::terminal;

/// Counts of tests.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Tally {
    pub(super) passed: u64,
    pub(super) failed: u64,
    /// Number of checks skipped for lack of their requirements.
    pub(super) skipped: u64,
}

impl Tally {
    /// Adds a line `test result: ok. 3 passed; 0 failed; …`.
    pub(super) fn count(&mut self, line: &str) {
        if let Some(rest) = line.strip_prefix("test result:") {
            self.passed += number_before(rest, " passed");
            self.failed += number_before(rest, " failed");
        }
    }
}

/// Counts a skipped check, and prints the reason.
pub(super) fn skip(tally: &mut Tally, why: &str) -> Result<(), Failure> {
    terminal::line(format!("skipped: {why}"));
    tally.skipped += 1;
    Ok(())
}

pub(super) fn number_before(line: &str, word: &str) -> u64 {
    let number = line.split(word).next().and_then(|l| l.split_whitespace().last());
    number.and_then(|n| n.parse().ok()).unwrap_or(0)
}

/// Runs a command in the project's root, and fails unless it succeeds.
pub(super) fn run_checked(command: &mut Command) -> Result<(), Failure> {
    run_checked_in(&project_root(), command)
}

/// Runs a command in a folder, and fails unless it succeeds.
pub(super) fn run_checked_in(folder: &Path, command: &mut Command) -> Result<(), Failure> {
    let words = command_line(command);
    let status = command.current_dir(folder).stdin(Stdio::null()).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(Failure::Refused(format!("`{words}` ended with {status}"))),
        Err(error) => Err(Failure::System(format!("`{words}`: {error}"))),
    }
}

/// Whether a command succeeds; its output is discarded.
pub(super) fn succeeds(command: &mut Command) -> bool {
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// Runs a command like [`run_checked`], showing each line of standard output and counting the tests in it.
pub(super) fn run_tests(command: &mut Command, tally: &mut Tally) -> Result<(), Failure> {
    let words = command_line(command);
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

pub(super) fn command_line(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|w| w.to_string_lossy().into_owned()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tests_are_counted_from_cargos_own_words() {
        let mut tally = Tally::default();
        tally.count(
            "test result: ok. 12 passed; 1 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.1s",
        );
        tally.count("test result: FAILED. 3 passed; 0 failed; 0 ignored");
        tally.count("test something_that_passed ... ok");
        assert_eq!(tally, Tally { passed: 15, failed: 1, skipped: 0 });
    }
}
