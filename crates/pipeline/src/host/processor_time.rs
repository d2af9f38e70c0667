//! Processor time of this process: what other programs do beside it does not count.

use std::time::Instant;

/// Seconds that all threads so far have spent on processors, ended ones included; `None` where the system
/// does not tell.
///
/// Read from `/proc/self/stat` (`proc(5)`: utime and stime), which counts in hundredths of a second: for
/// differences of a tenth of a second and more.
pub fn of_process() -> Option<f64> {
    ticks(&std::fs::read_to_string("/proc/self/stat").ok()?).map(|ticks| ticks as f64 / TICKS_PER_SECOND)
}

/// Seconds that the threads that are alive have spent on processors, read in nanoseconds (`proc(5)`,
/// schedstat): for differences between two moments between which no thread ends; `None` where the system does
/// not tell.
pub fn of_living_threads() -> Option<f64> {
    let mut sum_ns = 0_u64;
    for task in std::fs::read_dir("/proc/self/task").ok()?.flatten() {
        let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        sum_ns += text.split_whitespace().next()?.parse::<u64>().ok()?;
    }
    Some(1e-9 * sum_ns as f64)
}

/// Clock by which seconds of work are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Counted {
    /// Time of all threads on processors.
    Processor,
    /// Time by the clock on the wall, where the system does not tell that of processors.
    Clock,
}

impl Counted {
    /// Clock that this system offers: processors where their time is told.
    pub(crate) fn here() -> Self {
        if of_living_threads().is_some() { Self::Processor } else { Self::Clock }
    }

    /// Name of the clock in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Processor => "processor",
            Self::Clock => "clock",
        }
    }
}

/// Seconds of work since `start`, while no thread ends: of processors, else of the clock.
pub struct WorkClock {
    start: Instant,
    counted: Counted,
    at_start_s: f64,
}

impl WorkClock {
    /// Begins to count seconds.
    pub fn start() -> Self {
        let (start, counted) = (Instant::now(), Counted::here());
        Self { start, counted, at_start_s: of_living_threads().unwrap_or(0.0) }
    }

    /// Time that is counted: of processors, or of the clock.
    pub fn counted(&self) -> Counted {
        self.counted
    }

    /// Seconds since the start.
    pub fn seconds(&self) -> f64 {
        match self.counted {
            Counted::Processor => of_living_threads().map_or(0.0, |now_s| now_s - self.at_start_s),
            Counted::Clock => self.start.elapsed().as_secs_f64(),
        }
    }
}

/// Seconds that the processes that this one has begun and waited for have spent on processors; `None` where
/// the system does not tell.
pub fn of_ended_children() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    ticks_from(&stat, 13).map(|ticks| ticks as f64 / TICKS_PER_SECOND)
}

/// `USER_HZ`, which Linux shows to programs on every architecture that Rust builds for.
const TICKS_PER_SECOND: f64 = 100.0;

/// Fields 14 and 15: of the process itself.
fn ticks(stat: &str) -> Option<u64> {
    ticks_from(stat, 11)
}

/// Two fields, the first `place` fields behind the program's name. That is the second, in parentheses, and
/// may hold anything.
fn ticks_from(stat: &str, place: usize) -> Option<u64> {
    let mut behind_name = stat.rsplit_once(')')?.1.split_whitespace().skip(place);
    let mut next = || behind_name.next()?.parse::<u64>().ok();
    Some(next()? + next()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_with_blanks_and_parentheses_hides_no_field() {
        let stat = "7 (a ) R (b) S 1 7 7 0 -1 4194304 101 0 0 0 250 17 3 4 20 0 1 0 71184 3133440 355\n";
        assert_eq!(ticks(stat), Some(267));
        assert_eq!(ticks("7 (a) S 1 7 7 0 -1"), None);
    }

    #[test]
    fn work_of_a_thread_that_has_ended_counts() {
        let Some(before) = of_process() else { return };
        let worked_s = || {
            let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
            1e-9 * text.split_whitespace().next().unwrap().parse::<f64>().unwrap()
        };
        let busy = move || while worked_s() < 0.3 {};
        std::thread::spawn(busy).join().unwrap();
        let counted = of_process().unwrap() - before;
        // Two readings of hundredths.
        assert!(counted >= 0.3 - 0.02, "{counted} s");
    }
}
