//! What no case may do: panic, take long, or take much memory.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Several hundred times what a case takes on a busy machine.
const LONGEST: Duration = Duration::from_secs(60);
/// All of the process; a scene of vehicles takes a tenth.
const MOST_MIB: u64 = 3072;

static CASE: AtomicU64 = AtomicU64::new(u64::MAX);

/// Ends the program where a case goes on for too long; the case lies where it was read from.
pub(crate) fn start(folder: &Path) {
    let (start, folder) = (Instant::now(), folder.to_owned());
    CASE.store(u64::MAX, Ordering::Relaxed);
    std::thread::spawn(move || {
        let (mut seen, mut since) = (u64::MAX, start);
        loop {
            std::thread::sleep(Duration::from_secs(1));
            let case = CASE.load(Ordering::Relaxed);
            if case != seen {
                (seen, since) = (case, Instant::now());
            }
            if case != u64::MAX && since.elapsed() > LONGEST {
                println!("case {case} takes more than {} s: {}", LONGEST.as_secs(), folder.display());
                std::process::abort();
            }
        }
    });
}

/// A case begins: every one has another number.
pub(crate) fn begin(case: u64) {
    CASE.store(case, Ordering::Relaxed);
}

/// No case is read.
pub(crate) fn rest() {
    CASE.store(u64::MAX, Ordering::Relaxed);
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
