//! Seconds and memory of work.

use serde::{Deserialize, Serialize};
use std::time::Instant;
use wayside::host::failure::Failure;
use wayside::host::memory;
use wayside::host::processor_time::WorkClock;

/// Seconds and memory of work.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(in crate::study) struct Cost {
    /// Wall-clock seconds.
    pub(super) seconds: f64,
    /// Processor seconds of all threads; wall-clock seconds if the system does not report them.
    pub(super) processor_s: f64,
    /// Peak resident size of the program during the work, MiB.
    pub(super) peak_mib: Option<f64>,
}

impl Cost {
    /// Cost of both, one after the other.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            seconds: self.seconds + other.seconds,
            processor_s: self.processor_s + other.processor_s,
            peak_mib: self.peak_mib.zip(other.peak_mib).map(|(a, b)| a.max(b)),
        }
    }
}

/// A result with its cost.
pub(super) struct Measured<T> {
    pub(super) value: T,
    pub(super) cost: Cost,
}

/// Processor seconds that are accurate on a system that counts in hundredths of a second.
const MIN_TIMED_S: f64 = 0.2;
const RUNS_MAX: f64 = 1000.0;

/// Does the work, repeatedly if it is too fast to time once; the peak is that of the whole program meanwhile.
pub(super) fn measured<T>(mut work: impl FnMut() -> Result<T, Failure>) -> Result<Measured<T>, Failure> {
    let is_fresh = reset_peak();
    let (start, clock) = (Instant::now(), WorkClock::start());
    let value = work()?;
    let more = (MIN_TIMED_S / start.elapsed().as_secs_f64()).min(RUNS_MAX) as u32;
    for _ in 0..more {
        work()?;
    }
    let runs = f64::from(more + 1);
    let (seconds, processor_s) = (start.elapsed().as_secs_f64() / runs, clock.seconds() / runs);
    let peak_mib = if is_fresh { memory::peak_mib() } else { None };
    Ok(Measured { value, cost: Cost { seconds, processor_s, peak_mib } })
}

/// Resets the system's peak resident size (`proc(5)`, clear_refs, 5); false if that is not possible.
fn reset_peak() -> bool {
    std::fs::write("/proc/self/clear_refs", "5").is_ok()
}
