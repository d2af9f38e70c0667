//! Memory used by this process, and memory allowed for tracing.

use crate::host::failure::Failure;
use bart_rcs::MemoryLimit;

const MIB: f64 = 1024.0 * 1024.0;

/// Peak resident size so far, MiB; `None` where the system does not report it (read from
/// `/proc/self/status`).
pub fn peak_mib() -> Option<f64> {
    peak_mib_of("self")
}

/// Peak resident size so far of the process of this number, MiB; `None` where the system does not report it.
pub fn peak_mib_of(process: &str) -> Option<f64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|l| l.starts_with("VmHWM:"))?;
    let kib: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib / 1024.0)
}

/// Converts bytes to MiB.
pub fn mib(bytes: u64) -> f64 {
    bytes as f64 / MIB
}

/// Memory allowed for tracing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Allowance {
    bytes: Option<u64>,
}

impl Allowance {
    /// Allows `limit_mib`; `None`: nine tenths of the memory that is free now, where the system reports it,
    /// otherwise unlimited.
    pub fn of(limit_mib: Option<u64>) -> Self {
        let nine_tenths = |bytes: u64| bytes / 10 * 9;
        Self { bytes: limit_mib.map(|n| n << 20).or_else(|| available_bytes().map(nine_tenths)) }
    }

    /// The limit in the tracer's type.
    pub fn limit(self) -> MemoryLimit {
        self.bytes.map_or(MemoryLimit::NONE, MemoryLimit::of_bytes)
    }

    /// Memory in MiB; `None` where there is no limit.
    pub fn mib(self) -> Option<f64> {
        self.bytes.map(mib)
    }

    /// Remaining allowance beside `held_mib`.
    pub(crate) fn reduced_by(self, held_mib: f64) -> Self {
        let left = |bytes: u64| bytes.saturating_sub((held_mib * MIB) as u64);
        Self { bytes: self.bytes.map(left) }
    }

    /// Refuses work whose least expected memory exceeds the allowance.
    pub(crate) fn check(self, least_mib: f64) -> Result<(), Failure> {
        match self.mib() {
            Some(limit_mib) if least_mib > limit_mib => Err(Failure::refused(format!(
                "a frame is expected to hold {least_mib:.0} MiB at least; the limit is {limit_mib:.0} MiB \
                 (--memory-limit): fewer bounces, coarser models, or fewer channels, chirps and samples need \
                 less"
            ))),
            _ => Ok(()),
        }
    }
}

/// Bytes of free memory: `MemAvailable` of `/proc/meminfo`.
fn available_bytes() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find(|l| l.starts_with("MemAvailable:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kib| kib << 10)
}
