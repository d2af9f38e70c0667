//! Callers of a process, each of which requests work of its own at the same time.

use std::cell::Cell;
use std::sync::atomic::{AtomicU64, Ordering};

/// The party that work is done for. A thread works for one caller; threads that it begins work for the same
/// one if they are begun by [`Caller::during`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Caller(u64);

static CALLERS: AtomicU64 = AtomicU64::new(1);
thread_local! {
    static HERE: Cell<Caller> = const { Cell::new(Caller(0)) };
}

impl Caller {
    /// A new caller, whose work is separate from that of all others.
    pub fn unique() -> Self {
        Self(CALLERS.fetch_add(1, Ordering::Relaxed))
    }

    /// The caller that this thread works for.
    pub fn current() -> Self {
        HERE.get()
    }

    /// Does work for this caller.
    pub fn during<T>(self, work: impl FnOnce() -> T) -> T {
        let before = HERE.replace(self);
        let result = work();
        HERE.set(before);
        result
    }
}
