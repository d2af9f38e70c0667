//! NumPy, SciPy and OpenRadar, by a script; what is not installed is left out and said.

use crate::task::{CANDIDATES, GUARD, Measurement, TRAINING, bytes_of, job};
use artifact::cube::{CubeFrame, CubeHeader};
use std::process::Command;

pub(crate) fn measured(header: &CubeHeader, frame: &CubeFrame) -> Vec<Measurement> {
    let folder = tempfile::tempdir().unwrap();
    let cube = folder.path().join("cube.raw");
    std::fs::write(&cube, bytes_of(frame)).unwrap();
    let numbers = header.shape().into_iter().chain([GUARD as usize, TRAINING as usize, CANDIDATES]);
    let mut command = Command::new("python3");
    command.args(["-c", include_str!("rivals.py")]).arg(&cube).args(numbers.map(|n| n.to_string()));
    let Ok(done) = command.output() else {
        println!("skipped: python3 is not here");
        return Vec::new();
    };
    print!("{}", String::from_utf8_lossy(&done.stderr));
    let text = String::from_utf8_lossy(&done.stdout).into_owned();
    text.lines().filter_map(|line| measurement(header, line)).collect()
}

/// Reads the measurement of a line `job|program|seconds`; other lines are notes.
fn measurement(header: &CubeHeader, line: &str) -> Option<Measurement> {
    let mut fields = line.split('|');
    let (what, program, seconds) = (fields.next()?, fields.next(), fields.next());
    let (Some(program), Some(Ok(seconds))) = (program, seconds.map(str::parse)) else {
        println!("{line}");
        return None;
    };
    Some(Measurement { job: job(header, what), program: program.into(), seconds })
}
