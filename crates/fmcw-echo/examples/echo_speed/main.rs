//! Seconds and error of the fast sum beside the direct one: `cargo run --release -p fmcw-echo --example
//! echo_speed -- [paths [bodies [direct|finufft]]]`, 3 × 4 elements, 128 chirps of 256 samples; the last word
//! also times the direct sum, or FINUFFT's transforms of the same tones at -60 dB, where `python3` finds it.

mod finufft;
#[path = "../../tests/echo/setting.rs"]
mod setting;

use artifact::Accuracy;
use artifact::radar::Multiplexing;
use fmcw_echo::direct_sum::DirectSum;
use fmcw_echo::{fast_sum, reference};
use num_complex::Complex64;
use rayon::prelude::*;
use std::time::Instant;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |place: usize, default: usize| {
        arguments.get(place).and_then(|text| text.parse().ok()).unwrap_or(default)
    };
    let (count, bodies) = (number(0, 67_000), number(1, 1));
    let radar = setting::radar(setting::experiment(1), &setting::presets()[2], Multiplexing::Simultaneous);
    let paths: Vec<_> = (0..bodies)
        .flat_map(|i| {
            let (x, y) = ([2.0, 5.75, 9.5][i % 3], 25.0 + 7.0 * (i / 3) as f64);
            let paths = setting::body(i as u64, count / bodies, [x, y, 0.7], [0.0, -10.0 + i as f64, 0.0]);
            paths.into_iter().map(move |path| artifact::paths::Path { target: i as u32, ..path })
        })
        .collect();
    let centre_hz = radar.waveform.centre_frequency_hz();
    let (chirps, samples) = (128, 256);
    let probes: Vec<[usize; 3]> = (0..40).map(|i| [i * 5 % 12, i * 37 % chirps, i * 101 % samples]).collect();
    let exact: Vec<Complex64> =
        probes.par_iter().map(|at| reference::cube_sample(&radar, centre_hz, &paths, *at, None)).collect();
    let error_db = |cube: &[Complex64]| {
        let got: Vec<Complex64> =
            probes.iter().map(|[c, n, m]| cube[(c * chirps + n) * samples + m]).collect();
        setting::error_db(&got, &exact)
    };
    println!("{} paths of {bodies} bodies, {} threads", paths.len(), rayon::current_num_threads());
    for asked_db in [-40.0, -60.0, -80.0, -100.0, -120.0] {
        let mut seconds = Vec::new();
        let mut cube = Vec::new();
        for _ in 0..3 {
            let start = Instant::now();
            cube = fast_sum::cube(&radar, centre_hz, &paths, Accuracy::from_db(asked_db));
            seconds.push(start.elapsed().as_secs_f64());
        }
        seconds.sort_by(f64::total_cmp);
        println!("fast, {asked_db} dB asked: {:.1} dB, {:.1} ms", error_db(&cube), 1e3 * seconds[1]);
    }
    if arguments.get(2).is_some_and(|word| word == "direct") {
        let start = Instant::now();
        let sum = DirectSum::new(&radar, centre_hz, &paths);
        let rows: Vec<Vec<Complex64>> =
            (0..12 * chirps).into_par_iter().map(|r| sum.row(r / chirps, r % chirps)).collect();
        let seconds = start.elapsed().as_secs_f64();
        println!("direct: {:.1} dB, {:.1} ms", error_db(&rows.concat()), 1e3 * seconds);
    }
    if arguments.get(2).is_some_and(|word| word == "finufft") {
        finufft::print_seconds(&radar, &paths);
    }
}
