//! Limits that no case may break: it does not panic, take long, or take much memory.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Processor time: a hundred times what the slowest case takes, and nothing that other programs change.
const LONGEST: Duration = Duration::from_secs(60);
/// A case that waits for something takes no processor time.
const LONGEST_WAIT: Duration = Duration::from_secs(1800);
/// Most memory of the whole process; a scene of vehicles takes a tenth.
const MOST_MIB: u64 = 3072;

/// Number of the case that is read; no two that follow each other have one number.
static CASE: AtomicU64 = AtomicU64::new(REST);
const REST: u64 = u64::MAX;

/// Ends the program where a case goes on for too long; the case lies where it was read from.
pub(crate) fn start(folder: &Path) {
    let folder = folder.to_owned();
    std::thread::spawn(move || {
        let (mut seen, mut since, mut spent) = (REST, Instant::now(), processor_time());
        loop {
            std::thread::sleep(Duration::from_secs(1));
            let case = CASE.load(Ordering::Relaxed);
            if case != seen {
                (seen, since, spent) = (case, Instant::now(), processor_time());
            }
            let is_long = processor_time().saturating_sub(spent) > LONGEST || since.elapsed() > LONGEST_WAIT;
            if case != REST && is_long {
                println!("case {case} takes more than {} s: {}", LONGEST.as_secs(), folder.display());
                std::process::abort();
            }
        }
    });
}

/// A case begins.
pub(crate) fn begin(case: u64) {
    CASE.store(case, Ordering::Relaxed);
}

/// No case is read.
pub(crate) fn rest() {
    CASE.store(REST, Ordering::Relaxed);
}

/// Processor time of all threads; zero where the system does not tell.
pub(crate) fn processor_time() -> Duration {
    const TICKS_PER_SECOND: u64 = 100; // USER_HZ of Linux
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // Behind the program's name in brackets, utime and stime are the 12th and 13th.
    let behind = stat.rsplit_once(')').map_or("", |(_, behind)| behind);
    let ticks: u64 =
        behind.split_ascii_whitespace().skip(11).take(2).filter_map(|t| t.parse::<u64>().ok()).sum();
    Duration::from_millis(ticks * 1000 / TICKS_PER_SECOND)
}

/// Most memory that this process has had; `None` where the system does not tell.
pub(crate) fn peak_mib() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().trim_end_matches(" kB").parse::<u64>().ok().map(|kib| kib / 1024)
}

pub(crate) fn check_memory(what: &str) {
    let peak = peak_mib().unwrap_or(0);
    assert!(peak < MOST_MIB, "{what}: {peak} MiB");
}
