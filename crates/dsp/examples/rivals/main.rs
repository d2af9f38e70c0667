//! Our processing beside others' in one run: `cargo run --release -p dsp --example rivals`.
//!
//! Beside us: mmwcore, a Rust crate, and, where `python3` finds them, NumPy, SciPy and OpenRadar (`rivals.py`
//! in this folder). `rivals JOB FOLDER …` does one job for `cargo xtask bench` (`one_job.rs`). All are given
//! the same noise. The quickest of several runs counts; every program uses the threads that it knows to use.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a measurement, not a library")]

mod task; // what all are asked for
mod our_way;
mod mmwcore_way;
mod python_way;
mod alarms;
mod one_job;

use task::{Measurement, common, header};

fn main() {
    if std::env::args().any(|argument| argument == "alarms") {
        return alarms::print_table();
    }
    if one_job::done(&std::env::args().skip(1).collect::<Vec<_>>()) {
        return;
    }
    let mut all = Vec::new();
    for (elements, chirps, samples) in
        [(common::elements_3x4(), 128, 256), (common::elements_12x16(), 256, 512)]
    {
        let header = header(elements, chirps, samples);
        let frame = common::cube(&header, &[], 1);
        all.extend(our_way::measured(&header, &frame));
        all.extend(mmwcore_way::measured(&header, &frame));
        all.extend(python_way::measured(&header, &frame));
    }
    print_table(&all);
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
