//! Our processing beside others' in one run: `cargo run --release -p dsp --example rivals`.
//!
//! Beside us: mmwcore, a Rust crate, and, where `python3` finds them, NumPy, SciPy and OpenRadar (`rivals.py` in this folder).
//! `rivals JOB FOLDER …` does one job for `cargo xtask bench` (`one_job.rs`). All are given the same noise. The quickest of several runs counts; every program uses the threads that it knows to use.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a measurement, not a library")]

#[path = "../../tests/common/mod.rs"]
mod common;
mod alarms;
mod mmwcore_way;
mod one_job;
mod our_way;
mod python_way;

use artifact::cube::{CubeFrame, CubeHeader};
use artifact::settings::Detector;
use std::time::Instant;

/// One job by one program.
pub(crate) struct Measurement {
    pub(crate) job: String,
    pub(crate) program: String,
    pub(crate) seconds: f64,
}

/// Training and guard cells of every detector here, in both directions: mmwcore and SciPy know squares only.
pub(crate) const TRAINING: u32 = 6;
pub(crate) const GUARD: u32 = 2;
/// Cells that the angle is asked of.
pub(crate) const CANDIDATES: usize = 1000;

fn main() {
    if std::env::args().any(|argument| argument == "alarms") {
        return alarms::print_table();
    }
    if one_job::done(&std::env::args().skip(1).collect::<Vec<_>>()) {
        return;
    }
    let mut all = Vec::new();
    for (elements, chirps, samples) in [(common::elements_3x4(), 128, 256), (common::elements_12x16(), 256, 512)] {
        let header = header(elements, chirps, samples);
        let frame = common::cube(&header, &[], 1);
        all.extend(our_way::measured(&header, &frame));
        all.extend(mmwcore_way::measured(&header, &frame));
        all.extend(python_way::measured(&header, &frame));
    }
    print_table(&all);
}

fn header(elements: [Vec<[f64; 2]>; 2], chirps: u32, samples: u32) -> CubeHeader {
    let mut header = common::header(samples, chirps, elements);
    header.noise = common::NOISE_12_DB;
    header.dsp.guard_cells = [GUARD; 2];
    header.dsp.training_cells = [TRAINING; 2];
    header.dsp.detector = Detector::CaCfar;
    header
}

/// The quickest run of three at least and of half a second, s: threads are awake by then.
pub(crate) fn quickest_s<T>(mut work: impl FnMut() -> T) -> f64 {
    let start = Instant::now();
    let (mut quickest, mut runs) = (f64::INFINITY, 0);
    while runs < 3 || start.elapsed().as_secs_f64() < 0.5 {
        let run = Instant::now();
        std::hint::black_box(work());
        (quickest, runs) = (quickest.min(run.elapsed().as_secs_f64()), runs + 1);
    }
    quickest
}

/// What a job is called.
pub(crate) fn job(header: &CubeHeader, what: &str) -> String {
    let [channels, chirps, samples] = header.shape();
    format!("{what}, {channels} × {chirps} × {samples}")
}

fn print_table(all: &[Measurement]) {
    println!("| job | program | ms | of ours |\n|---|---|---|---|");
    let mut jobs: Vec<&str> = all.iter().map(|m| m.job.as_str()).collect();
    jobs.dedup();
    jobs.sort_unstable();
    jobs.dedup();
    for name in jobs {
        let of_job = || all.iter().filter(|m| m.job == name);
        let ours = of_job().find(|m| m.program == "ours").map_or(f64::NAN, |m| m.seconds);
        for m in of_job() {
            println!("| {} | {} | {:.3} | {:.1} |", m.job, m.program, 1e3 * m.seconds, m.seconds / ours);
        }
    }
}

/// A frame's samples as raw bytes, little-endian pairs.
pub(crate) fn bytes_of(frame: &CubeFrame) -> Vec<u8> {
    frame.samples.iter().flat_map(|x| [x.re.to_le_bytes(), x.im.to_le_bytes()].concat()).collect()
}
