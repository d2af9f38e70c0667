//! Seconds and path-samples a second of the reference form and of the direct sum, on the main job's array and
//! waveform.
//!
//! `cargo run --release -p fmcw-echo --example direct_sum_speed [paths]` (40 000 without a number).

#[path = "../tests/echo/setting.rs"]
mod setting;

use artifact::radar::Multiplexing;
use artifact::settings::Noise;
use fmcw_echo::{direct_sum::DirectSum, reference};
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count = std::env::args().nth(1).map_or(Ok(40_000), |n| n.parse())?;
    let radar = setting::radar(setting::experiment(1), &setting::presets()[2], Multiplexing::Simultaneous);
    let (f_c, length) = (radar.waveform.centre_frequency_hz(), radar.waveform.samples as usize);
    let paths = setting::random_paths(1, count);

    let start = Clock::now();
    let reference: Vec<_> =
        (0..length).map(|n| reference::cube_sample(&radar, f_c, &paths, [5, 64, n], None)).collect();
    print_rate("reference form, one row, one thread", start, count * length);

    let sum = DirectSum::new(&radar, f_c, &paths);
    let start = Clock::now();
    let rows: Vec<_> = (0..16).map(|chirp| sum.row(5, 56 + chirp)).collect();
    print_rate("direct sum, 16 rows, one thread", start, 16 * count * length);
    println!("  error of the row in f64: {:.1} dB", setting::error_db(&rows[8], &reference));

    let header = setting::header(radar, Noise::Figure { noise_figure_db: 12.0, temperature_k: 290.0 });
    let start = Clock::now();
    let cube = setting::synthesized(&header, 1, &setting::frame(paths))?;
    print_rate("synthesize, whole cube with noise and error", start, cube.samples.len() * count);
    println!("  threads: {}, error.synthesis: {:?}", rayon::current_num_threads(), cube.error.synthesis);
    Ok(())
}

/// Wall clock and, where Linux tells it, the processor time of all threads: other work on the machine spoils
/// the first.
struct Clock {
    wall: Instant,
    cpu_s: Option<f64>,
}

impl Clock {
    fn now() -> Self {
        Self { wall: Instant::now(), cpu_s: processor_seconds() }
    }
}

/// User time of this process: field 14 of /proc/self/stat, in hundredths of a second.
fn processor_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let after_name = stat.rsplit_once(')')?.1;
    Some(after_name.split_whitespace().nth(11)?.parse::<f64>().ok()? / 100.0)
}

fn print_rate(name: &str, start: Clock, path_samples: usize) {
    let rate = |seconds: f64| format!("{seconds:.2} s, {:.3e} path-samples/s", path_samples as f64 / seconds);
    let cpu = processor_seconds().zip(start.cpu_s).map_or("unknown".into(), |(end, start)| rate(end - start));
    println!("{name}: wall {}; processor {cpu}", rate(start.wall.elapsed().as_secs_f64()));
}
