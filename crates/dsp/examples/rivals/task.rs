//! The task that all programs are given, and how it is timed.

#[path = "../../tests/common/mod.rs"]
pub(crate) mod common; // radars and cubes

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

/// The radar of these elements with noise and the detector that all know.
pub(crate) fn header(elements: [Vec<[f64; 2]>; 2], chirps: u32, samples: u32) -> CubeHeader {
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

/// Name of a job.
pub(crate) fn job(header: &CubeHeader, what: &str) -> String {
    let [channels, chirps, samples] = header.shape();
    format!("{what}, {channels} × {chirps} × {samples}")
}

/// A frame's samples as raw bytes, little-endian pairs.
pub(crate) fn bytes_of(frame: &CubeFrame) -> Vec<u8> {
    frame.samples.iter().flat_map(|x| [x.re.to_le_bytes(), x.im.to_le_bytes()].concat()).collect()
}
