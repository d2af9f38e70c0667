//! `ci`: every check of the project, cheapest first. The first that fails ends it.

mod circles;
mod columns;
mod commands;
mod features;
mod layers;
mod pages;
mod readme;
mod rooms;
mod size;
mod training;

use crate::cli::CiArguments;
use commands::{Tally, counted, finished};
use std::process::Command;
use std::time::Instant;
use training::Training;
use wayside::host::failure::Failure;
use wayside::program::terminal;

type Check = fn(&mut Tally) -> Result<(), Failure>;

const CHECKS: [(&str, Check); 12] = [
    ("format", |_| cargo(&["fmt", "--all", "--check"])),
    ("layer rule", |_| layers::check()),
    ("room rule", |_| rooms::check()),
    ("no circle of files, no crowded folder", |_| circles::check()),
    ("sizes of files and functions", |_| size::check()),
    ("lines of code and comments", |_| columns::check()),
    ("pages name what is there", |_| pages::check()),
    ("one set of features", |_| features::check()),
    ("lints", |_| cargo(&["clippy", "--release", "--all-targets", "--", "-D", "warnings"])),
    ("docs", |_| documentation()),
    ("tests and doctests (README)", |tally| readme::tests(tally)),
    ("main job (README)", |_| readme::main_job()),
];

/// Of one crate alone: format, the cheap rules of all, then its own lints and tests.
const OF_ONE: usize = 8;

pub(crate) fn run(arguments: &CiArguments) -> Result<(), Failure> {
    match &arguments.only {
        Some(package) => only(package),
        None => all(),
    }
}

fn only(package: &str) -> Result<(), Failure> {
    let mut tally = Tally::default();
    for (name, check) in &CHECKS[..OF_ONE] {
        good(name, || check(&mut tally))?;
    }
    let words = ["clippy", "--release", "--all-targets", "--package", package, "--", "-D", "warnings"];
    good("lints", || cargo(&words))?;
    let mut tests = Command::new("cargo");
    tests.args(["test", "--release", "--package", package]);
    good("tests and doctests", || counted(&mut tests, &mut tally))?;
    terminal::line(format!("{} passed, {} failed", tally.passed, tally.failed));
    Ok(())
}

fn all() -> Result<(), Failure> {
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

fn documentation() -> Result<(), Failure> {
    finished(Command::new("cargo").args(["doc", "--release", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings"))
}

fn cargo(arguments: &[&str]) -> Result<(), Failure> {
    finished(Command::new("cargo").args(arguments))
}
