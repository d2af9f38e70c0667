//! Division of processor time among aspects processed in parallel.
//!
//! Threads that wait for a part of one aspect take up another one, so neither a thread's time nor wall-clock
//! time is an aspect's. Whenever an aspect starts, changes its phase or ends, the program's work since the
//! last such event is divided equally among those in progress: together they have all of it.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A clock of processor work and the pieces in progress.
pub(crate) struct WorkMeter<'a> {
    clock_s: &'a (dyn Fn() -> f64 + Sync),
    state: Mutex<State>,
}

struct State {
    /// Seconds of those in progress since their last query, by number.
    under_way_s: BTreeMap<u64, f64>,
    next: u64,
    read_s: f64,
    read_at: Instant,
    reading_took: Duration,
}

/// Minimum interval between readings of the clock, relative to the cost of one; otherwise reading would be
/// most of the work.
const READINGS_APART: u32 = 20;

impl<'a> WorkMeter<'a> {
    /// Meter based on a clock that advances with the program's work, s.
    pub(crate) fn new(clock_s: &'a (dyn Fn() -> f64 + Sync)) -> Self {
        let (under_way_s, read_at) = (BTreeMap::new(), Instant::now());
        let read_s = clock_s();
        let state = State { under_way_s, next: 0, read_s, read_at, reading_took: read_at.elapsed() };
        Self { clock_s, state: Mutex::new(state) }
    }

    /// Starts a piece of work.
    pub(crate) fn begin(&self) -> MeteredWork<'_> {
        let mut state = self.read();
        let number = state.next;
        state.next += 1;
        state.under_way_s.insert(number, 0.0);
        MeteredWork { meter: self, number }
    }

    /// Total time of all work so far, s.
    pub(crate) fn total_s(&self) -> f64 {
        (self.clock_s)()
    }

    fn read(&self) -> MutexGuard<'_, State> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if state.under_way_s.is_empty() || state.read_at.elapsed() >= READINGS_APART * state.reading_took {
            let start = Instant::now();
            let now_s = (self.clock_s)();
            let share_s = (now_s - state.read_s).max(0.0) / state.under_way_s.len().max(1) as f64;
            state.under_way_s.values_mut().for_each(|seconds| *seconds += share_s);
            (state.read_s, state.read_at, state.reading_took) = (now_s, Instant::now(), start.elapsed());
        }
        state
    }
}

/// A piece of work, in progress until it is dropped.
pub(crate) struct MeteredWork<'m> {
    meter: &'m WorkMeter<'m>,
    number: u64,
}

impl MeteredWork<'_> {
    /// Share since the piece started, or since the last call, s.
    pub(crate) fn lap_s(&self) -> f64 {
        let mut state = self.meter.read();
        state.under_way_s.get_mut(&self.number).map(std::mem::take).unwrap_or(0.0)
    }
}

impl Drop for MeteredWork<'_> {
    fn drop(&mut self) {
        self.meter.read().under_way_s.remove(&self.number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicU64, Ordering};

    #[test]
    fn what_is_done_side_by_side_is_shared_and_nothing_is_counted_twice() {
        let ticks = AtomicU64::new(0);
        let clock = || ticks.load(Ordering::Relaxed) as f64;
        // Longer than the clock may stay unread.
        let work = |seconds: u64| {
            ticks.fetch_add(seconds, Ordering::Relaxed);
            std::thread::sleep(Duration::from_millis(5));
        };
        let meter = WorkMeter::new(&clock);
        work(7);
        let first = meter.begin();
        work(4);
        let second = meter.begin();
        work(10);
        assert_eq!((first.lap_s(), second.lap_s()), (4.0 + 5.0, 5.0));
        work(6);
        drop(first);
        work(2);
        // Work before the first piece started, and what the first had not queried, belongs to nobody.
        assert_eq!((second.lap_s(), meter.total_s()), (3.0 + 2.0, 29.0));
    }
}
