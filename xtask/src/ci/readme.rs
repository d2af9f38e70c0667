//! The README's two commands, taken from its text and run unchanged.

mod pictures;

use crate::ci::commands::{Tally, run_checked, run_tests};
use crate::project::project_root;
use std::path::{Path, PathBuf};
use std::process::Command;
use wayside::host::failure::Failure;
use wayside::outcome::summary::{FrameSummary, Summary};

/// The second command: all tests and doctests.
pub(super) fn tests(tally: &mut Tally) -> Result<(), Failure> {
    run_tests(&mut command(1)?, tally)
}

/// The first command: the main job, which must detect every body and reach its scene's accuracy, and draws
/// the pictures of the docs.
pub(super) fn main_job() -> Result<(), Failure> {
    let mut command = command(0)?;
    run_checked(&mut command)?;
    let file = summary_file(&command)?;
    let mut short = shortcomings(&Summary::read(&file)?.frames);
    short
        .extend(pictures::outdated(&project_root().join("docs/pictures"), &file.with_file_name("pictures"))?);
    match short[..] {
        [] => Ok(()),
        ref some => Err(Failure::Refused(format!("{}: {}", file.display(), some.join("; ")))),
    }
}

/// Finds the summary of a run without `--out`: below `out/`, under the name of its scene.
fn summary_file(run: &Command) -> Result<PathBuf, Failure> {
    let words = run.get_args().map(Path::new);
    let scene =
        words.filter(|word| word.extension().is_some_and(|kind| kind == "toml")).find_map(Path::file_stem);
    let scene = scene.ok_or_else(|| Failure::refused("README.md: the first command runs a scene"))?;
    Ok(project_root().join("out").join(scene).join("summary.json"))
}

/// Shortcomings of a run of the main job, frame by frame.
fn shortcomings(frames: &[FrameSummary]) -> Vec<String> {
    let none = frames.is_empty().then(|| "no frame".to_owned());
    none.into_iter()
        .chain(frames.iter().enumerate().flat_map(|(number, frame)| of_frame(number, frame)))
        .collect()
}

fn of_frame(number: usize, frame: &FrameSummary) -> Vec<String> {
    let FrameSummary { targets, accuracy, .. } = frame;
    let unseen: Vec<&str> =
        targets.iter().filter(|target| target.found != Some(true)).map(|target| target.id.as_str()).collect();
    let reached = accuracy.reached_db.map_or("null".into(), |db| format!("{db:?}"));
    let asked = accuracy.asked_db;
    let accuracy = (accuracy.met != Some(true))
        .then(|| format!("frame {number}: {reached} dB reached, {asked:?} dB asked"));
    let found = (!unseen.is_empty() || targets.is_empty())
        .then(|| format!("frame {number}: of {} targets not found: {}", targets.len(), unseen.join(", ")));
    accuracy.into_iter().chain(found).collect()
}

fn command(number: usize) -> Result<Command, Failure> {
    let file = project_root().join("README.md");
    let text = std::fs::read_to_string(&file).map_err(|e| Failure::system(&file, "read", e))?;
    let commands = shell_lines(&text);
    let line = commands
        .get(number)
        .ok_or_else(|| Failure::refused("README.md: two commands in ```sh blocks are promised"))?;
    let mut words = line.split_whitespace();
    let mut command = Command::new(words.next().unwrap_or("cargo"));
    command.args(words);
    Ok(command)
}

/// Lines that begin with `cargo` in the blocks marked `sh`.
fn shell_lines(text: &str) -> Vec<String> {
    let mut inside = false;
    let mut lines = Vec::new();
    for line in text.lines() {
        match line.trim() {
            "```sh" => inside = true,
            "```" => inside = false,
            line if inside && line.starts_with("cargo ") => {
                lines.push(line.split(" #").next().unwrap_or(line).trim().to_owned())
            }
            _ => {}
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use wayside::outcome::summary::{AccuracyVerdict, TargetSummary};

    #[test]
    fn commands_are_read_from_shell_blocks_without_their_remarks() {
        let text = "text `cargo no`\n```sh\ncargo xtask run a.toml   # the main job\n```\n```toml\ncargo no\n```\n```sh\ncargo test\n```";
        assert_eq!(shell_lines(text), ["cargo xtask run a.toml", "cargo test"]);
    }

    #[test]
    fn the_main_job_falls_short_where_a_body_is_missed_or_the_accuracy_is_not_reached() {
        let target = |id: &str, found| TargetSummary { id: id.to_owned(), found, ..TargetSummary::default() };
        let frame = |met, found| {
            let (asked_db, reached_db) = (-20.0, Some(-12.4));
            let accuracy = AccuracyVerdict { asked_db, reached_db, met, ..AccuracyVerdict::default() };
            let targets = vec![target("car-1", Some(true)), target("bus-1", found)];
            FrameSummary { accuracy, targets, ..FrameSummary::default() }
        };
        let of = |frames: &[FrameSummary]| shortcomings(frames).join("; ");
        let good = frame(Some(true), Some(true));
        assert_eq!(of(std::slice::from_ref(&good)), "");
        let missed = of(&[good, frame(Some(true), Some(false))]);
        assert_eq!(missed, "frame 1: of 2 targets not found: bus-1");
        assert_eq!(of(&[frame(Some(false), Some(true))]), "frame 0: -12.4 dB reached, -20.0 dB asked");
        assert_eq!(of(&[frame(None, Some(true))]), "frame 0: -12.4 dB reached, -20.0 dB asked");
        assert_eq!(of(&[]), "no frame");
    }

    #[test]
    fn the_main_jobs_summary_is_named_by_its_scene() {
        let file = summary_file(&command(0).unwrap()).unwrap();
        assert!(file.ends_with("out/intersection/summary.json"), "{}", file.display());
    }
}
