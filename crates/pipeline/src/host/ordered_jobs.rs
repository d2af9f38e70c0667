//! Parallel jobs whose results are handed on in order while later jobs run.

use crate::host::failure::Failure;
use crate::host::progress::Caller;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::Result as Joined;

/// Limits of concurrent jobs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ConcurrencyLimits {
    /// Running jobs, each on a thread of its own: threads of the pool would take up another job while they
    /// wait for a part of one, and hold more than was allowed.
    pub workers: usize,
    /// Jobs that run, wait to be handed on, or are being handed on; at least one.
    pub held: usize,
}

/// Hands the results of jobs to `take`, in order and on this thread; `needed` lists for each job the jobs
/// that it needs.
///
/// A job begins once all earlier jobs have begun and those that it needs are done; it never waits for a later
/// job.
///
/// # Errors
/// The first failure, in the order of the jobs, of `work` or of `take`: all earlier results were taken, and
/// no further job begins.
pub fn run_in_order<T: Send>(
    needed: &[Vec<usize>],
    at_once: ConcurrencyLimits,
    work: impl Fn(usize) -> Result<T, Failure> + Sync,
    mut take: impl FnMut(T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let (jobs, held) = (needed.len(), at_once.held.max(1));
    let queue = Queue { needed, held, state: Mutex::new(JobStates::of(jobs)), changed: Condvar::new() };
    let caller = Caller::current();
    let worker = || {
        while let Some(job) = queue.begin() {
            queue.end(job, catch_unwind(AssertUnwindSafe(|| caller.during(|| work(job)))));
        }
    };
    std::thread::scope(|scope| {
        (0..at_once.workers.clamp(1, jobs.max(1))).for_each(|_| drop(scope.spawn(worker)));
        let stop_guard = StopGuard(&queue);
        for job in 0..jobs {
            take(queue.result(job).unwrap_or_else(|panic| resume_unwind(panic))?)?;
            queue.taken(job);
        }
        drop(stop_guard);
        Ok(())
    })
}

/// Jobs with their states, shared by the threads.
struct Queue<'a, T> {
    /// Jobs that each job needs.
    needed: &'a [Vec<usize>],
    held: usize,
    state: Mutex<JobStates<T>>,
    changed: Condvar,
}

struct JobStates<T> {
    /// Number of jobs that may begin.
    jobs: usize,
    /// Number of jobs that have begun, in order.
    begun: usize,
    /// Number of jobs that were handed on, in order.
    taken: usize,
    /// Finished jobs, with their results until these are handed on.
    done: BTreeMap<usize, Option<Joined<Result<T, Failure>>>>,
}

impl<T> JobStates<T> {
    fn of(jobs: usize) -> Self {
        Self { jobs, begun: 0, taken: 0, done: BTreeMap::new() }
    }

    fn is_done(&self, job: usize) -> bool {
        job < self.taken || self.done.contains_key(&job)
    }
}

impl<T> Queue<'_, T> {
    /// Waits for the next job that may begin; `None` if none is left.
    fn begin(&self) -> Option<usize> {
        let mut state = self.lock();
        loop {
            let job = state.begun;
            if job >= state.jobs {
                return None;
            }
            let has_room = job < state.taken + self.held;
            let is_ready = |earlier: &usize| *earlier >= job || state.is_done(*earlier);
            if has_room && self.needed[job].iter().all(is_ready) {
                state.begun += 1;
                return Some(job);
            }
            state = self.wait(state);
        }
    }

    /// Stores the result of a job; after a failure no further job begins.
    fn end(&self, job: usize, result: Joined<Result<T, Failure>>) {
        let mut state = self.lock();
        if !matches!(result, Ok(Ok(_))) {
            state.jobs = state.begun;
        }
        state.done.insert(job, Some(result));
        self.changed.notify_all();
    }

    /// Waits for the result of a job.
    fn result(&self, job: usize) -> Joined<Result<T, Failure>> {
        let mut state = self.lock();
        loop {
            match state.done.get_mut(&job).and_then(Option::take) {
                Some(result) => return result,
                None => state = self.wait(state),
            }
        }
    }

    fn taken(&self, job: usize) {
        let mut state = self.lock();
        state.done.remove(&job);
        state.taken = job + 1;
        self.changed.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, JobStates<T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(&self, state: MutexGuard<'a, JobStates<T>>) -> MutexGuard<'a, JobStates<T>> {
        self.changed.wait(state).unwrap_or_else(PoisonError::into_inner)
    }
}

/// Prevents further jobs from beginning when dropped, also after a failure or a panic of the receiver.
struct StopGuard<'a, T>(&'a Queue<'a, T>);

impl<T> Drop for StopGuard<'_, T> {
    fn drop(&mut self) {
        let mut state = self.0.lock();
        state.jobs = state.begun;
        self.0.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    const LIMITS: ConcurrencyLimits = ConcurrencyLimits { workers: 3, held: 4 };

    /// Jobs of which none needs another.
    fn independent(jobs: usize) -> Vec<Vec<usize>> {
        vec![vec![]; jobs]
    }

    /// Work that takes longer the earlier it is among its neighbours.
    fn slow_first(job: usize) -> usize {
        std::thread::sleep(Duration::from_millis(3 - job as u64 % 3));
        job
    }

    #[test]
    fn results_come_in_their_order_and_no_more_are_held_than_may_be() {
        let (begun, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let mut taken = vec![];
        let work = |job| {
            begun.fetch_add(1, Ordering::SeqCst);
            Ok(slow_first(job))
        };
        let take = |job| {
            most.fetch_max(begun.load(Ordering::SeqCst) - taken.len(), Ordering::SeqCst);
            taken.push(job);
            Ok(())
        };
        run_in_order(&independent(40), LIMITS, work, take).expect("no job fails");
        assert_eq!(taken, (0..40).collect::<Vec<_>>());
        let most = most.into_inner();
        assert!((2..=LIMITS.held).contains(&most), "{most}");
    }

    #[test]
    fn a_job_waits_for_those_that_it_needs_and_for_no_later_one() {
        let done: Vec<AtomicUsize> = (0..20).map(|_| AtomicUsize::new(0)).collect();
        let needed: Vec<Vec<usize>> = (0..20).map(|job| vec![job - job % 5, 19]).collect();
        let work = |job: usize| {
            let is_ready = job.is_multiple_of(5) || done[job - job % 5].load(Ordering::SeqCst) == 1;
            slow_first(job);
            done[job].store(1, Ordering::SeqCst);
            Ok(is_ready)
        };
        let mut ready = 0;
        let take = |is_ready| {
            ready += usize::from(is_ready);
            Ok(())
        };
        run_in_order(&needed, LIMITS, work, take).expect("no job fails");
        assert_eq!(ready, 20);
    }

    #[test]
    fn the_first_failure_is_told_behind_what_came_before_it_and_nothing_more_is_begun() {
        for failing in [0, 7] {
            let begun = AtomicUsize::new(0);
            let mut taken = 0;
            let work = |job| {
                begun.fetch_add(1, Ordering::SeqCst);
                slow_first(job);
                if job >= failing { Err(Failure::refused(format!("job {job}"))) } else { Ok(()) }
            };
            let take = |()| {
                taken += 1;
                Ok(())
            };
            let failure = run_in_order(&independent(1000), LIMITS, work, take).expect_err("a job fails");
            assert_eq!(failure.to_string(), format!("job {failing}"));
            assert_eq!(taken, failing);
            assert!(begun.into_inner() <= failing + LIMITS.held);
        }
    }

    #[test]
    fn who_takes_may_refuse_and_a_panic_of_work_is_one_here() {
        let refused = run_in_order(&independent(50), LIMITS, Ok, |job| match job {
            5 => Err(Failure::refused("full")),
            _ => Ok(()),
        });
        assert_eq!(refused.expect_err("it is full").to_string(), "full");
        let work = |job| {
            assert_ne!(job, 4, "four");
            Ok(())
        };
        let panics = AssertUnwindSafe(|| run_in_order(&independent(50), LIMITS, work, Ok));
        assert!(catch_unwind(panics).is_err());
    }

    #[test]
    fn no_jobs_are_no_work_and_one_thread_does_them_one_by_one() {
        run_in_order(&[], LIMITS, Ok, |_: usize| Ok(())).expect("there is nothing to fail");
        let running = AtomicUsize::new(0);
        let work = |_| {
            let beside = running.fetch_add(1, Ordering::SeqCst);
            slow_first(0);
            running.fetch_sub(1, Ordering::SeqCst);
            Ok(beside)
        };
        let alone = ConcurrencyLimits { workers: 1, held: 1 };
        let mut beside = 0;
        let take = |others| {
            beside += others;
            Ok(())
        };
        run_in_order(&independent(5), alone, work, take).expect("no job fails");
        assert_eq!(beside, 0);
    }
}
