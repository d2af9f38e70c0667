//! `ci`: every check of the project, cheapest first. The first that fails ends it.

mod circles;
mod columns;
mod commands;
mod features;
mod findings;
mod layers;
mod limits;
mod outside;
mod pages;
mod readme;
mod rooms;
mod sentences;
mod size;
mod studies;
mod training;

use crate::cli::CiArguments;
use crate::study;
use commands::{Tally, counted, finished};
use outside::{engines, installed, interchange, python, report_view, site, training_sets};
use std::process::Command;
use std::time::Instant;
use training::Training;
use wayside::host::failure::Failure;
use wayside::program::terminal;

type Check = fn(&mut Tally) -> Result<(), Failure>;

/// Rules of the source, which together take seconds.
const CHEAP: [(&str, Check); 12] = [
    ("format", |_| cargo(&["fmt", "--all", "--check"])),
    ("layer rule", |_| layers::check()),
    ("room rule", |_| rooms::check()),
    ("no circle of files, no crowded folder", |_| circles::check()),
    ("sizes of files and functions", |_| size::check()),
    ("lines of code and comments", |_| columns::check()),
    ("doc comments are sentences", |_| sentences::check()),
    ("pages name what is there", |_| pages::check()),
    ("pages say how they are made", |_| studies::check()),
    ("every page is on the site", |_| pages::navigation::check()),
    ("limits are told", |_| limits::check()),
    ("one set of features", |_| features::check()),
];

/// Checks that build and run all crates.
const WHOLE: [(&str, Check); 7] = [
    ("lints", |_| cargo(&["clippy", "--release", "--all-targets", "--", "-D", "warnings"])),
    ("docs", |_| documentation()),
    ("a crate outside (docs/install.md)", |_| outside::check()),
    ("tests and doctests (README)", |tally| readme::tests(tally)),
    ("real capture", |_| study::compare("real-captures")),
    ("engines", engines::check),
    ("main job (README)", |_| readme::main_job()),
];

/// Checks of the installed program and with third-party programs, each with a build or programs of its own:
/// run by name, or all of them by `beside`, but not by `ci` as a whole, which would take half as long again.
const BESIDE: [(&str, Check); 6] = [
    ("install", |_| installed::check()),
    ("osi", interchange::check),
    ("sets", training_sets::check),
    ("python", python::check),
    ("report", report_view::check),
    ("site", site::check),
];

pub(crate) fn run(arguments: &CiArguments) -> Result<(), Failure> {
    let mut tally = Tally::default();
    match arguments.only.as_deref() {
        Some("beside") => each(&BESIDE, &mut tally)?,
        Some(name) => one(name, &mut tally)?,
        None => all(&mut tally)?,
    }
    let skipped = if tally.skipped > 0 { format!(", {} skipped", tally.skipped) } else { String::new() };
    terminal::line(format!("{} passed, {} failed{skipped}", tally.passed, tally.failed));
    Ok(())
}

/// Runs the check of this name, or the checks of a crate.
fn one(name: &str, tally: &mut Tally) -> Result<(), Failure> {
    match WHOLE.iter().chain(&BESIDE).find(|(of, _)| *of == name) {
        Some(check) => each(&[*check], tally),
        None => only(name, tally),
    }
}

/// Runs the rules of the source, then lints and tests of one crate.
fn only(package: &str, tally: &mut Tally) -> Result<(), Failure> {
    each(&CHEAP, tally)?;
    let words = ["clippy", "--release", "--all-targets", "--package", package, "--", "-D", "warnings"];
    good("lints", || cargo(&words))?;
    let mut tests = Command::new("cargo");
    tests.args(["test", "--release", "--package", package]);
    good("tests and doctests", || counted(&mut tests, tally))
}

fn all(tally: &mut Tally) -> Result<(), Failure> {
    // Its library is a single job of minutes, which costs least beside the others.
    let training = Training::begin()?;
    each(&CHEAP, tally)?;
    each(&WHOLE, tally)?;
    good("training", || training.end(tally))
}

fn each(checks: &[(&str, Check)], tally: &mut Tally) -> Result<(), Failure> {
    checks.iter().try_for_each(|(name, check)| good(name, || check(tally)))
}

fn good(name: &str, check: impl FnOnce() -> Result<(), Failure>) -> Result<(), Failure> {
    terminal::line(format!("== {name}"));
    terminal::call_off().check()?;
    let start = Instant::now();
    check().map_err(|e| Failure::Refused(format!("ci: {name}: {e}")))?;
    terminal::line(format!("== {name}: good, {:.0} s", start.elapsed().as_secs_f64()));
    Ok(())
}

fn documentation() -> Result<(), Failure> {
    finished(Command::new("cargo").args(["doc", "--release", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings"))
}

fn cargo(arguments: &[&str]) -> Result<(), Failure> {
    finished(Command::new("cargo").args(arguments))
}
