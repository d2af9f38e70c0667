//! Several jobs at once, each of which is parallel too.

use crate::host::failure::Failure;
use crate::host::progress::Caller;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Results of all jobs, in any order, each done on one of the given number of threads: threads of the pool
/// would take up another job while they wait for a part of one, and hold more than was allowed.
pub fn parallel_jobs<J: Sync, T: Send>(
    jobs: &[J],
    at_once: usize,
    work: impl Fn(&J) -> Result<T, Failure> + Sync,
) -> Result<Vec<T>, Failure> {
    let next = AtomicUsize::new(0);
    let caller = Caller::current();
    let worker = || {
        let taken = std::iter::from_fn(|| jobs.get(next.fetch_add(1, Ordering::Relaxed)));
        taken.map(|job| caller.during(|| work(job))).collect::<Result<Vec<T>, Failure>>()
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..at_once.min(jobs.len())).map(|_| scope.spawn(worker)).collect();
        let joined = workers.into_iter().map(|w| w.join().unwrap_or_else(|p| std::panic::resume_unwind(p)));
        joined.collect::<Result<Vec<_>, _>>().map(|parts| parts.into_iter().flatten().collect())
    })
}
