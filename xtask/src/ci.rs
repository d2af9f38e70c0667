//! `ci`: every check of the project, cheapest first. The first that fails ends it.

mod circles;
mod commands;
mod features;
mod layers;
mod readme;
mod rooms;
mod size;
mod training;

use commands::{Tally, finished};
use std::process::Command;
use std::time::Instant;
use training::Training;
use wayside::host::failure::Failure;
use wayside::program::terminal;

type Check = fn(&mut Tally) -> Result<(), Failure>;

const CHECKS: [(&str, Check); 10] = [
    ("format", |_| cargo(&["fmt", "--all", "--check"])),
    ("layer rule", |_| layers::check()),
    ("room rule", |_| rooms::check()),
    ("no circle of files, no crowded folder", |_| circles::check()),
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

fn documentation() -> Result<(), Failure> {
    finished(Command::new("cargo").args(["doc", "--release", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings"))
}

fn cargo(arguments: &[&str]) -> Result<(), Failure> {
    finished(Command::new("cargo").args(arguments))
}
