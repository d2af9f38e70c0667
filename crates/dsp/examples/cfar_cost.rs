//! Seconds of the four detectors' masks on the same noise, in one run: `cargo run --release -p dsp --example
//! cfar_cost`.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a measurement, not a library")]

#[path = "../tests/common/mod.rs"]
mod common;

use artifact::settings::Detector;
use common::{NOISE_12_DB, cube, elements_1x1, header};
use dsp::cfar::Cfar;
use std::time::Instant;

const RUNS: usize = 61;

fn main() {
    let mut header = header(256, 128, elements_1x1());
    header.noise = NOISE_12_DB;
    let map = dsp::Receiver::new(&header).unwrap().range_doppler(&cube(&header, &[], 1)).unwrap();
    let power: Vec<f64> = dsp::power_map(&header, &map).unwrap().into_raw_vec_and_offset().0;
    let mut of_averages = 0.0;
    println!("map 128 × 256, guard [2, 2], training [4, 8], quickest of {RUNS} masks");
    for detector in [Detector::CaCfar, Detector::GoCfar, Detector::SoCfar, Detector::OsCfar] {
        header.dsp.detector = detector;
        let start = Instant::now();
        let cfar = Cfar::new(&header).unwrap();
        let thresholds_s = start.elapsed().as_secs_f64();
        let mut seconds: Vec<f64> = (0..RUNS).map(|_| timed(&cfar, &power)).collect();
        seconds.sort_unstable_by(f64::total_cmp);
        let quickest_s = seconds[0];
        if detector == Detector::CaCfar {
            of_averages = quickest_s;
        }
        println!(
            "{detector:?}: {:.3} ms a mask, {:.2} of CA; thresholds once {:.1} ms",
            1e3 * quickest_s,
            quickest_s / of_averages,
            1e3 * thresholds_s
        );
    }
}

fn timed(cfar: &Cfar, power: &[f64]) -> f64 {
    let start = Instant::now();
    std::hint::black_box(cfar.mask(power, 0.0));
    start.elapsed().as_secs_f64()
}
