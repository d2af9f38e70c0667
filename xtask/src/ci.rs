//! `ci`: every check of the project, cheapest first. The first that fails ends it.

mod cycles;
mod columns;
mod commands;
mod features;
mod findings;
mod layers;
mod limits;
mod external;
mod pages;
mod readme;
mod rooms;
mod sentences;
mod size;
mod studies;
mod training;

use crate::cli::CiArguments;
use crate::study;
use commands::{Tally, run_checked, run_tests};
use external::{engines, installed, interchange, python, report_view, site, training_sets};
use std::process::Command;
use std::time::Instant;
use training::Training;
use wayside::host::failure::Failure;
use wayside::program::terminal;

type Check = fn(&mut Tally) -> Result<(), Failure>;

/// Rules of the source, which together take seconds.
const SOURCE_CHECKS: [(&str, Check); 12] = [
    ("format", |_| cargo(&["fmt", "--all", "--check"])),
    ("layer rule", |_| layers::check()),
    ("room rule", |_| rooms::check()),
    ("no circle of files, no crowded folder", |_| cycles::check()),
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
const BUILD_CHECKS: [(&str, Check); 7] = [
    ("lints", |_| cargo(&["clippy", "--release", "--all-targets", "--", "-D", "warnings"])),
    ("docs", |_| documentation()),
    ("a crate outside (docs/install.md)", |_| external::check()),
    ("tests and doctests (README)", |tally| readme::tests(tally)),
    ("real capture", |_| study::compare("real-captures")),
    ("engines", engines::check),
    ("main job (README)", |_| readme::main_job()),
];

/// Checks of the installed program and with third-party programs, each with a build or programs of its own:
/// run by name, or all of them by `beside`, but not by `ci` as a whole, which would take half as long again.
const EXTERNAL_CHECKS: [(&str, Check); 6] = [
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
        Some("beside") => run_each(&EXTERNAL_CHECKS, &mut tally)?,
        Some(name) => run_named(name, &mut tally)?,
        None => run_all(&mut tally)?,
    }
    let skipped = if tally.skipped > 0 { format!(", {} skipped", tally.skipped) } else { String::new() };
    terminal::line(format!("{} passed, {} failed{skipped}", tally.passed, tally.failed));
    Ok(())
}

/// Runs the check of this name, or the checks of a crate.
fn run_named(name: &str, tally: &mut Tally) -> Result<(), Failure> {
    match BUILD_CHECKS.iter().chain(&EXTERNAL_CHECKS).find(|(of, _)| *of == name) {
        Some(check) => run_each(&[*check], tally),
        None => check_package(name, tally),
    }
}

/// Runs the rules of the source, then lints and tests of one crate.
fn check_package(package: &str, tally: &mut Tally) -> Result<(), Failure> {
    run_each(&SOURCE_CHECKS, tally)?;
    let words = ["clippy", "--release", "--all-targets", "--package", package, "--", "-D", "warnings"];
    run_check("lints", || cargo(&words))?;
    let mut tests = Command::new("cargo");
    tests.args(["test", "--release", "--package", package]);
    run_check("tests and doctests", || run_tests(&mut tests, tally))
}

fn run_all(tally: &mut Tally) -> Result<(), Failure> {
    // Its library is a single job of minutes, which costs least beside the others.
    let training = Training::begin()?;
    run_each(&SOURCE_CHECKS, tally)?;
    run_each(&BUILD_CHECKS, tally)?;
    run_check("training", || training.end(tally))
}

fn run_each(checks: &[(&str, Check)], tally: &mut Tally) -> Result<(), Failure> {
    checks.iter().try_for_each(|(name, check)| run_check(name, || check(tally)))
}

fn run_check(name: &str, check: impl FnOnce() -> Result<(), Failure>) -> Result<(), Failure> {
    terminal::line(format!("== {name}"));
    terminal::cancellation().check()?;
    let start = Instant::now();
    check().map_err(|e| Failure::Refused(format!("ci: {name}: {e}")))?;
    terminal::line(format!("== {name}: good, {:.0} s", start.elapsed().as_secs_f64()));
    Ok(())
}

fn documentation() -> Result<(), Failure> {
    run_checked(
        Command::new("cargo").args(["doc", "--release", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings"),
    )
}

fn cargo(arguments: &[&str]) -> Result<(), Failure> {
    run_checked(Command::new("cargo").args(arguments))
}
