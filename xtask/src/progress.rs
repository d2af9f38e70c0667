//! How far long work is: a bar with the time left on a terminal, plain lines elsewhere; `--quiet` silences both.
//!
//! Work says what it is and, where it can count, how far it is; it never prints. One thread looks at all work that is under
//! way ten times a second: so a command that is silent inside one long step is heard of all the same, 2 s after its begin
//! at the latest, and nothing of it depends on what is computed.

mod under_way;

use crate::cli::Arguments;
use crate::output;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};
use under_way::{Item, UnderWay};

#[derive(Clone, Copy, PartialEq, Eq)]
enum Voice {
    Bar,
    Lines,
    Silent,
}

static VOICE: OnceLock<Voice> = OnceLock::new();
static UNDER_WAY: Mutex<UnderWay> = Mutex::new(UnderWay::NOTHING);
static BAR: Mutex<Option<ProgressBar>> = Mutex::new(None);
static IS_OVER: AtomicBool = AtomicBool::new(false);

/// Looks a second are enough for the first line to come in time.
const LOOK: Duration = Duration::from_millis(100);

/// Chooses the voice once, from `--quiet` and the terminal, and begins to look.
pub(crate) fn configure(arguments: &Arguments) {
    let voice = match arguments.quiet {
        true => Voice::Silent,
        false if std::io::stderr().is_terminal() => Voice::Bar,
        false => Voice::Lines,
    };
    if VOICE.set(voice).is_ok() && voice != Voice::Silent {
        // Without the thread a command works as well, and says less.
        let _ = std::thread::Builder::new().name("progress".into()).spawn(move || look_again_and_again(voice));
    }
}

fn voice() -> Voice {
    *VOICE.get().unwrap_or(&Voice::Silent)
}

fn look_again_and_again(voice: Voice) {
    while !IS_OVER.load(Ordering::Relaxed) {
        let now = Instant::now();
        match voice {
            Voice::Bar => draw(&locked(&UNDER_WAY), now),
            Voice::Lines => _ = locked(&UNDER_WAY).line(now).map(print),
            Voice::Silent => return,
        }
        std::thread::sleep(LOOK);
    }
}

/// A remark on standard error.
pub(crate) fn note(text: impl std::fmt::Display) {
    if voice() != Voice::Silent {
        beside_the_bar(|| print(text.to_string()));
    }
}

/// Does what prints, without a bar in its way.
pub(crate) fn beside_the_bar<T>(printing: impl FnOnce() -> T) -> T {
    match &*locked(&BAR) {
        Some(bar) => bar.suspend(printing),
        None => printing(),
    }
}

/// Removes the bar for good: what is printed from now on is the last.
pub(crate) fn finish() {
    IS_OVER.store(true, Ordering::Relaxed);
    if let Some(bar) = locked(&BAR).take() {
        bar.finish_and_clear();
    }
}

fn print(text: String) {
    output::say(text);
}

/// Shows what is under way once it has been for half a second.
fn draw(under_way: &UnderWay, now: Instant) {
    const AFTER: Duration = Duration::from_millis(500);
    let mut bar = locked(&BAR);
    match under_way.shown(now, AFTER).filter(|_| !IS_OVER.load(Ordering::Relaxed)) {
        None => _ = bar.take().map(|bar| bar.finish_and_clear()),
        Some(shown) => {
            let bar = bar.get_or_insert_with(empty_bar);
            bar.set_position((SHARES * shown.share) as u64);
            bar.set_message(shown.text);
        }
    }
}

/// What a whole bar counts.
const SHARES: f64 = 1000.0;

fn empty_bar() -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:24} {wide_msg}").unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(SHARES as u64).with_style(style)
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A piece of work that is under way until it is dropped; within it there may be others.
pub(crate) struct Work(Arc<Item>);

impl Work {
    /// Begins work of the given name.
    pub(crate) fn begin(name: impl Into<String>) -> Self {
        Self::resumed(name, 0)
    }

    /// The same where so many steps are there already.
    pub(crate) fn resumed(name: impl Into<String>, found: usize) -> Self {
        Self(locked(&UNDER_WAY).begin(name.into(), found, Instant::now()))
    }

    /// `done` of `of` steps are done; callable from any thread.
    pub(crate) fn at(&self, done: usize, of: usize) {
        self.0.at(done, of);
    }
}

/// Work that may take long, by its name.
pub(crate) fn during<T>(name: impl Into<String>, work: impl FnOnce() -> T) -> T {
    let _under_way = Work::begin(name);
    work()
}

/// A part of the work heard from a stage.
impl bart_rcs::Progress for Work {
    fn at(&self, phase: bart_rcs::Phase, done: usize, of: usize) {
        match phase {
            bart_rcs::Phase::Aspects | bart_rcs::Phase::Bodies => self.0.at(done, of),
            part => self.0.part_at(part_name(part), done, of, Instant::now()),
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

impl Drop for Work {
    fn drop(&mut self) {
        locked(&UNDER_WAY).end(&self.0);
    }
}
