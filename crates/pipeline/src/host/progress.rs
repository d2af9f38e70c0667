//! Progress of long work. Work reports its name and, where it can count, its progress; it never prints.
//! Viewers poll [`line()`] or [`state`] as often as they like and receive remarks by [`listen`]; computed
//! results never depend on any of this.

mod running_work;
mod caller;

use artifact::dataset::Dataset;
use artifact::{ArtifactError, Reader, Schema};
use running_work::{RunningWork, WorkItem};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};

pub use caller::Caller;
pub use running_work::{FrameStage, ProgressState};

static RUNNING_WORK: Mutex<RunningWork> = Mutex::new(RunningWork::NOTHING);
static LISTENER: OnceLock<fn(&str)> = OnceLock::new();

/// Sends all remarks of this process to `listener`; only the first listener is kept.
pub fn listen(listener: fn(&str)) {
    let _ = LISTENER.set(listener);
}

/// Sends a remark that is no result; it is lost without a listener.
pub fn note(text: impl std::fmt::Display) {
    if let Some(listener) = LISTENER.get() {
        listener(&text.to_string());
    }
}

/// The line that is due for a log: for lasting work, within 2 s of its beginning and then every ten.
pub fn line(now: Instant) -> Option<String> {
    locked(&RUNNING_WORK).line(now)
}

/// State of the work for a progress bar; `None` until the outermost work has been under way for `after`.
pub fn state(now: Instant, after: Duration) -> Option<ProgressState> {
    locked(&RUNNING_WORK).state(now, after, |_| true)
}

/// State of the work for one caller; [`state`] returns that of all.
pub fn state_for(caller: Caller, now: Instant, after: Duration) -> Option<ProgressState> {
    locked(&RUNNING_WORK).state(now, after, |other| other == caller)
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A piece of work that is under way until it is dropped; others may be nested in it.
pub struct Work(Arc<WorkItem>);

impl Work {
    /// Begins work of the given name.
    pub fn begin(name: impl Into<String>) -> Self {
        Self::resumed(name, 0)
    }

    /// Begins work of which `found` steps are already done.
    pub fn resumed(name: impl Into<String>, found: usize) -> Self {
        Self(locked(&RUNNING_WORK).begin(name.into(), (found, &[]), Instant::now()))
    }

    /// Begins work on frames that each go through these stages, or on one stage of a frame: progress within a
    /// stage counts in the share of the frames.
    pub fn in_stages(name: impl Into<String>, stages: &[FrameStage]) -> Self {
        Self(locked(&RUNNING_WORK).begin(name.into(), (0, stages), Instant::now()))
    }

    /// Reports that `done` of `of` steps are done; callable from any thread.
    pub fn at(&self, done: usize, of: usize) {
        self.0.at(done, of);
    }
}

/// Runs work that may take long, under a name.
pub fn during<T>(name: impl Into<String>, work: impl FnOnce() -> T) -> T {
    let _under_way = Work::begin(name);
    work()
}

/// Iterates over a known number of items and reports each one taken: the work ends with the iterator.
pub fn counted<T>(
    name: impl Into<String>,
    items: impl IntoIterator<Item = T>,
    of: usize,
) -> impl Iterator<Item = T> {
    let work = Work::begin(name);
    items.into_iter().enumerate().map(move |(done, item)| {
        work.at(done, of);
        item
    })
}

/// Iterates over frames of an artifact, or samples of a dataset, and reports each one taken.
pub fn frames<S: Schema>(reader: Reader<S>) -> impl Iterator<Item = Result<S::Frame, ArtifactError>> {
    let of = reader.frames() as usize;
    counted(if S::NAME == Dataset::NAME { "samples" } else { "frames" }, reader, of)
}

/// Receives progress within a stage.
impl bart_rcs::Progress for Work {
    fn at(&self, phase: bart_rcs::Phase, done: usize, of: usize) {
        match phase {
            bart_rcs::Phase::Aspects | bart_rcs::Phase::Bodies => self.0.at(done, of),
            part => self.0.part_at((part_name(part), part_place(part)), [done, of], Instant::now()),
        }
    }
}

fn part_name(phase: bart_rcs::Phase) -> &'static str {
    match phase {
        bart_rcs::Phase::Aspects | bart_rcs::Phase::Bodies => "one after the other",
        bart_rcs::Phase::Building => "building the hierarchy",
        bart_rcs::Phase::Tracing => "tracing",
        bart_rcs::Phase::Integrating => "integrating",
        bart_rcs::Phase::Checking => "checking errors",
    }
}

/// Index of a part among those of one step, and their number.
fn part_place(phase: bart_rcs::Phase) -> [usize; 2] {
    let at = match phase {
        bart_rcs::Phase::Aspects | bart_rcs::Phase::Bodies | bart_rcs::Phase::Building => 0,
        bart_rcs::Phase::Tracing => 1,
        bart_rcs::Phase::Integrating => 2,
        bart_rcs::Phase::Checking => 3,
    };
    [at, 4]
}

impl Drop for Work {
    fn drop(&mut self) {
        locked(&RUNNING_WORK).end(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_caller_hears_of_its_own_work_alone() {
        let [one, other] = [Caller::unique(), Caller::unique()];
        let text = |caller| state_for(caller, Instant::now(), Duration::ZERO).map(|state| state.text);
        let at_the_same_time = || {
            let _work = Work::begin("the other's");
            assert_eq!(text(one).as_deref(), Some("the one's, for 0 s"));
            assert_eq!(text(other).as_deref(), Some("the other's, for 0 s"));
        };
        one.during(|| {
            let _work = Work::begin("the one's");
            std::thread::scope(|scope| {
                scope.spawn(|| other.during(at_the_same_time));
            });
            assert_eq!(Caller::current(), one);
        });
        assert_eq!([text(one), text(other)], [None, None]);
    }
}
