//! Limits that no case may break: it does not panic, take long, or take much memory.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Processor time: a hundred times what the slowest case takes, and nothing that other programs change.
const CASE_CPU_TIMEOUT: Duration = Duration::from_secs(60);
/// A case that waits for something takes no processor time.
const CASE_WALL_TIMEOUT: Duration = Duration::from_secs(1800);
/// Most memory of the whole process; a scene of vehicles takes a tenth.
const MAX_MEMORY_MIB: u64 = 3072;

/// Number of the trial that is under way; no two that follow each other have one number.
static TRIAL: AtomicU64 = AtomicU64::new(IDLE);
static BEGUN: AtomicU64 = AtomicU64::new(0);
static ABOUT: Mutex<String> = Mutex::new(String::new());
const IDLE: u64 = u64::MAX;

/// Ends the program where a case goes on for too long; the case lies where it was read from.
pub(crate) fn start(folder: &Path) {
    let folder = folder.to_owned();
    std::thread::spawn(move || {
        let (mut seen, mut since, mut spent) = (IDLE, Instant::now(), processor_time());
        loop {
            std::thread::sleep(Duration::from_secs(1));
            let trial = TRIAL.load(Ordering::Relaxed);
            if trial != seen {
                (seen, since, spent) = (trial, Instant::now(), processor_time());
            }
            let is_long = processor_time().saturating_sub(spent) > CASE_CPU_TIMEOUT
                || since.elapsed() > CASE_WALL_TIMEOUT;
            if trial != IDLE && is_long {
                println!(
                    "{} takes more than {} s: {}",
                    about(),
                    CASE_CPU_TIMEOUT.as_secs(),
                    folder.display()
                );
                std::process::abort();
            }
        }
    });
}

fn about() -> String {
    ABOUT.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

/// A case begins; `about` tells which.
pub(crate) fn begin_case(about: &str) {
    about.clone_into(&mut ABOUT.lock().unwrap_or_else(PoisonError::into_inner));
    TRIAL.store(BEGUN.fetch_add(1, Ordering::Relaxed), Ordering::Relaxed);
}

/// No case is read.
pub(crate) fn set_idle() {
    TRIAL.store(IDLE, Ordering::Relaxed);
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

/// Begins to look for the most memory anew, where the system can.
pub(crate) fn reset_peak() {
    let _ = std::fs::write("/proc/self/clear_refs", "5"); // else it is the most of the whole process
}

/// Most memory that this process has had; `None` where the system does not tell.
pub(crate) fn peak_mib() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().trim_end_matches(" kB").parse::<u64>().ok().map(|kib| kib / 1024)
}

/// Refuses more memory than a case may take.
pub(crate) fn check_memory(what: &str) {
    let peak = peak_mib().unwrap_or(0);
    assert!(peak < MAX_MEMORY_MIB, "{what}: {peak} MiB");
}
