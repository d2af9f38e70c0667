//! Rivals that are separate programs: a script with NumPy, SciPy, FINUFFT or Embree, or an example of ours
//! with another crate. A missing program is no failure: the row says how to install it.

use crate::project::{project_root, this_program};
use num_complex::Complex64;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use wayside::host::failure::Failure;

/// Work with its input, as the rival's reader expects it.
pub(super) struct Job {
    pub(super) name: &'static str,
    pub(super) input: Vec<u8>,
}

/// Kind of a rival's program.
#[derive(Debug, Clone, Copy)]
pub(super) enum RivalProgram {
    /// `rivals.py` with this package.
    Python(&'static str),
    /// A built example: package, example, and the crate that it uses.
    Example(&'static str, &'static str, &'static str),
}

/// Result of a rival.
pub(super) struct RivalOutput {
    /// Name of the program with its version.
    pub(super) program: String,
    /// Seconds of the fastest run.
    pub(super) seconds: f64,
    pub(super) result: Vec<u8>,
}

/// Advice for installing a missing rival.
#[derive(Debug)]
pub(crate) struct MissingProgram {
    pub(crate) program: String,
    pub(crate) advice: String,
}

const SCRIPT: &str = include_str!("rivals.py");

impl Job {
    /// Has a rival do the work, with some arguments beside the input.
    pub(super) fn run_with(
        &self,
        rival: RivalProgram,
        words: &[String],
    ) -> Result<Result<RivalOutput, MissingProgram>, Failure> {
        let folder = tempfile::tempdir().map_err(|e| Failure::System(format!("no temporary folder: {e}")))?;
        let input = folder.path().join("input.raw");
        std::fs::write(&input, &self.input).map_err(|e| Failure::system(&input, "write", e))?;
        let mut command = rival.command();
        command.arg(self.name).args(rival.package()).arg(folder.path()).args(words);
        // A program that is missing, lacks a package, or fails is treated the same here.
        let done = command.output().ok().filter(|done| done.status.success());
        let answer = done.and_then(|done| answer(&String::from_utf8_lossy(&done.stdout), folder.path()));
        Ok(answer.ok_or_else(|| rival.missing()))
    }
}

/// Reads a rival's answer from the line `program|seconds` and the file `result.raw`.
fn answer(text: &str, folder: &Path) -> Option<RivalOutput> {
    let (program, seconds) = text.lines().last()?.split_once('|')?;
    let result = std::fs::read(folder.join("result.raw")).ok()?;
    Some(RivalOutput { program: program.into(), seconds: seconds.trim().parse().ok()?, result })
}

impl RivalOutput {
    /// The result as numbers in double precision.
    pub(super) fn numbers(&self) -> impl Iterator<Item = f64> {
        self.result.as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes))
    }
}

/// Pairs in single precision.
pub(super) fn complex(bytes: &[u8]) -> Vec<Complex64> {
    let single = |bytes: &[u8; 4]| f64::from(f32::from_le_bytes(*bytes));
    let numbers: Vec<f64> = bytes.as_chunks::<4>().0.iter().map(single).collect();
    numbers.as_chunks::<2>().0.iter().map(|[re, im]| Complex64::new(*re, *im)).collect()
}

impl RivalProgram {
    fn command(self) -> Command {
        match self {
            Self::Python(_) => {
                let mut command =
                    Command::new(std::env::var_os("PYTHON").unwrap_or_else(|| OsString::from("python3")));
                command.args(["-c", SCRIPT]);
                command
            }
            Self::Example(_, example, _) => Command::new(built(example)),
        }
    }

    fn package(self) -> Option<&'static str> {
        match self {
            Self::Python(package) => Some(package),
            Self::Example(..) => None,
        }
    }

    fn missing(self) -> MissingProgram {
        match self {
            Self::Python(package) => MissingProgram {
                program: package.into(),
                advice: format!("python3 -m pip install numpy {package}; PYTHON names another interpreter"),
            },
            Self::Example(package, example, holds) => MissingProgram {
                program: holds.into(),
                advice: format!("cargo build --release -p {package} --example {example}"),
            },
        }
    }
}

/// Path beside this program, else in the project's build folder.
fn built(example: &str) -> PathBuf {
    let beside =
        this_program().ok().and_then(|program| Some(program.parent()?.join("examples").join(example)));
    let name = PathBuf::from("target/release/examples").join(example);
    beside.filter(|program| program.is_file()).unwrap_or_else(|| project_root().join(name))
}
