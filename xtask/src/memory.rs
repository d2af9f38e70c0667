//! How much memory this process has held, and how much tracing may take.

use crate::failure::Failure;
use bart_rcs::MemoryLimit;
use std::sync::OnceLock;

const MIB: f64 = 1024.0 * 1024.0;

/// Largest resident size so far, MiB; `None` where the system does not tell (it is read from `/proc/self/status`).
pub(crate) fn peak_mib() -> Option<f64> {
    peak_mib_of("self")
}

/// The same of another process, by its number.
pub(crate) fn peak_mib_of(process: &str) -> Option<f64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|l| l.starts_with("VmHWM:"))?;
    let kib: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib / 1024.0)
}

/// Bytes as MiB.
pub(crate) fn mib(bytes: u64) -> f64 {
    bytes as f64 / MIB
}

/// Asked for by `--memory-limit`, set once before any work.
static LIMIT_BYTES: OnceLock<Option<u64>> = OnceLock::new();

/// Sets what tracing may take.
pub(crate) fn set_limit(limit_mib: Option<u64>) {
    let nine_tenths = |bytes: u64| bytes / 10 * 9;
    let _ = LIMIT_BYTES.set(limit_mib.map(|n| n << 20).or_else(|| available_bytes().map(nine_tenths)));
}

/// What tracing may take: what was asked for, else nine tenths of what was free at the start, where the system tells.
pub(crate) fn limit() -> MemoryLimit {
    limit_bytes().map_or(MemoryLimit::NONE, MemoryLimit::of_bytes)
}

/// The same in MiB; `None` where there is none.
pub(crate) fn limit_mib() -> Option<f64> {
    limit_bytes().map(mib)
}

/// Refuses what is expected to need more at least.
pub(crate) fn check(least_mib: f64) -> Result<(), Failure> {
    match limit_mib() {
        Some(limit_mib) if least_mib > limit_mib => Err(Failure::Refused(format!(
            "a frame is expected to hold {least_mib:.0} MiB at least; the limit is {limit_mib:.0} MiB (--memory-limit): fewer \
             bounces or coarser models need less"
        ))),
        _ => Ok(()),
    }
}

fn limit_bytes() -> Option<u64> {
    LIMIT_BYTES.get().copied().flatten()
}

/// `MemAvailable` of `/proc/meminfo`.
fn available_bytes() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find(|l| l.starts_with("MemAvailable:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kib| kib << 10)
}
