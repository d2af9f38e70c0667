//! Programs of the same source, and their command lines.

use crate::project::{project_root, this_program};
use crate::study::extent::Extent;
use crate::study::pages::same_bytes::differences::Differences;
use std::ffi::OsString;
use std::process::{Command, Stdio};
use wayside::host::failure::Failure;

/// A program, and the promise for its results relative to those of the first.
pub(super) struct Variant {
    pub(super) name: &'static str,
    pub(super) promise: Promise,
    /// Program and the words before the command's.
    begin: Vec<OsString>,
    /// Words after the command's.
    end: Vec<String>,
}

/// Similarity of results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Promise {
    /// The same bytes.
    Bytes,
    /// Values within the bound for another instruction set.
    Values,
}

/// Largest difference of values with another instruction set, relative to all of them, dB: samples of a cube
/// have 24 bits.
const OTHER_INSTRUCTIONS_DB: f64 = -120.0;

impl Promise {
    /// A sentence about a broken promise; `others` is the number of differing files.
    pub(super) fn broken(self, others: usize, differences: &Differences) -> Option<String> {
        match self {
            Self::Bytes => (others > 0).then(|| format!("{others} files have other bytes")),
            Self::Values => {
                let worst = differences.worst_db();
                (worst > OTHER_INSTRUCTIONS_DB).then(|| format!("values differ by {worst:.0} dB"))
            }
        }
    }
}

impl Variant {
    /// Runs a command of `wayside`.
    pub(super) fn run(&self, words: &[&str]) -> Result<(), Failure> {
        let mut command = Command::new(&self.begin[0]);
        command.args(&self.begin[1..]).args(words).args(&self.end);
        command.current_dir(project_root()).stdin(Stdio::null()).stdout(Stdio::null());
        let status = command.status().map_err(|e| Failure::System(format!("{}: {e}", self.name)))?;
        if status.success() { Ok(()) } else { Err(Failure::Refused(format!("{}: {status}", self.name))) }
    }
}

/// This program on 1, 2, 3 and 8 threads; and for the whole study one without optimization, and this one on a
/// processor without AVX and FMA.
pub(super) fn all(extent: Extent) -> Result<Vec<Variant>, Failure> {
    let this = this_program()?;
    let by_threads = [("1 thread", "1"), ("2 threads", "2"), ("3 threads", "3"), ("8 threads", "8")];
    let mut variants: Vec<Variant> = by_threads
        .into_iter()
        .map(|(name, threads)| Variant {
            name,
            promise: Promise::Bytes,
            begin: vec![this.clone().into()],
            end: ["--threads".into(), threads.into()].into(),
        })
        .collect();
    if extent == Extent::Full {
        let name = "without optimisation (`cargo build`)";
        variants.push(Variant { name, promise: Promise::Bytes, begin: vec![unoptimised()?], end: vec![] });
        let emulator = ["qemu-x86_64".into(), "-cpu".into(), "Nehalem".into()];
        variants.push(Variant {
            name: "without AVX and FMA (`qemu-x86_64 -cpu Nehalem`)",
            promise: Promise::Values,
            begin: emulator.into_iter().chain([this.into()]).collect(),
            end: vec![],
        });
    }
    Ok(variants)
}

/// Builds the program as `cargo build` does by default.
fn unoptimised() -> Result<OsString, Failure> {
    let root = project_root();
    let mut build = Command::new("cargo");
    build.args(["build", "--quiet", "--package", "wayside", "--bin", "wayside"]).current_dir(&root);
    let status = build.status().map_err(|e| Failure::System(format!("cargo: {e}")))?;
    if status.success() {
        Ok(root.join("target/debug/wayside").into_os_string())
    } else {
        Err(Failure::System(format!("cargo build: {status}")))
    }
}
