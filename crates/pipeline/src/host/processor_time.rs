//! Processor time of this process: other programs do not count.

use std::time::Instant;

/// Processor seconds of all threads so far, ended ones included; `None` where the system does not report
/// them.
///
/// Read from `/proc/self/stat` (`proc(5)`: utime and stime), which counts in hundredths of a second: for
/// differences of a tenth of a second and more.
pub fn of_process() -> Option<f64> {
    ticks(&std::fs::read_to_string("/proc/self/stat").ok()?).map(|ticks| ticks as f64 / TICKS_PER_SECOND)
}

/// Processor seconds of the living threads, read in nanoseconds (`proc(5)`, schedstat): for differences
/// between two moments between which no thread ends; `None` where the system does not report them.
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
pub enum ClockKind {
    /// Processor time of all threads.
    Processor,
    /// Wall-clock time, where the system does not report processor time.
    Clock,
}

impl ClockKind {
    /// Clock of this system: processor time where it is reported.
    pub(crate) fn of_system() -> Self {
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

/// Seconds of work since `start`, while no thread ends: of processor time where it is reported, otherwise of
/// the wall clock.
pub struct WorkClock {
    start: Instant,
    kind: ClockKind,
    at_start_s: f64,
}

impl WorkClock {
    /// Begins to count seconds.
    pub fn start() -> Self {
        let (start, kind) = (Instant::now(), ClockKind::of_system());
        Self { start, kind, at_start_s: of_living_threads().unwrap_or(0.0) }
    }

    /// Kind of time that is counted.
    pub fn kind(&self) -> ClockKind {
        self.kind
    }

    /// Seconds since the start.
    pub fn seconds(&self) -> f64 {
        match self.kind {
            ClockKind::Processor => of_living_threads().map_or(0.0, |now_s| now_s - self.at_start_s),
            ClockKind::Clock => self.start.elapsed().as_secs_f64(),
        }
    }
}

/// Processor seconds of the child processes that this one has waited for; `None` where the system does not
/// report them.
pub fn of_ended_children() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    ticks_from(&stat, 13).map(|ticks| ticks as f64 / TICKS_PER_SECOND)
}

/// `USER_HZ`, which Linux reports to programs on every architecture that Rust builds for.
const TICKS_PER_SECOND: f64 = 100.0;

/// Sum of fields 14 and 15, the times of the process itself.
fn ticks(stat: &str) -> Option<u64> {
    ticks_from(stat, 11)
}

/// Sum of two fields, of which the first is `place` fields after the program's name. The name is the second
/// field, in parentheses, and may contain anything.
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
