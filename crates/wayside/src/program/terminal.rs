//! Results on standard output; on standard error, for people, a bar with the remaining time on a terminal and
//! plain lines elsewhere, which `--quiet` silences. One thread polls all running work ten times a second, so
//! that even a command within one long step shows a line 2 s after its beginning at the latest.

use indicatif::{ProgressBar, ProgressStyle};
use pipeline::host::cancellation::Cancellation;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use pipeline::host::safe_text;
use std::io::{ErrorKind, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

#[derive(Clone, Copy, PartialEq, Eq)]
enum ProgressDisplay {
    Bar,
    Lines,
}

static BAR: Mutex<Option<ProgressBar>> = Mutex::new(None);
static IS_OVER: AtomicBool = AtomicBool::new(false);

/// Interval of polling, short enough for the first line to come in time.
const POLL_INTERVAL: Duration = Duration::from_millis(100);

/// Starts polling and listening to remarks; called once.
pub(crate) fn show_progress() {
    let display = if std::io::stderr().is_terminal() { ProgressDisplay::Bar } else { ProgressDisplay::Lines };
    progress::listen(remark);
    // Without the thread, the command still works, but shows no progress.
    let _ = std::thread::Builder::new().name("progress".into()).spawn(move || poll_progress(display));
}

fn poll_progress(display: ProgressDisplay) {
    while !IS_OVER.load(Ordering::Relaxed) {
        let now = Instant::now();
        match display {
            ProgressDisplay::Bar => draw(now),
            ProgressDisplay::Lines => {
                _ = progress::line(now).map(|text| print_status(safe_text::in_a_line(&text)))
            }
        }
        std::thread::sleep(POLL_INTERVAL);
    }
}

fn remark(text: &str) {
    beside_the_bar(|| print_status(safe_text::in_a_line(text)));
}

/// Runs a printing function without the bar in its way.
fn beside_the_bar<T>(printing: impl FnOnce() -> T) -> T {
    match &*locked(&BAR) {
        Some(bar) => bar.suspend(printing),
        None => printing(),
    }
}

/// Removes the bar for good, before the last output.
pub(crate) fn end_progress() {
    IS_OVER.store(true, Ordering::Relaxed);
    if let Some(bar) = locked(&BAR).take() {
        bar.finish_and_clear();
    }
}

/// Shows work that has been under way for half a second.
fn draw(now: Instant) {
    const AFTER: Duration = Duration::from_millis(500);
    let mut bar = locked(&BAR);
    match progress::state(now, AFTER).filter(|_| !IS_OVER.load(Ordering::Relaxed)) {
        None => _ = bar.take().map(|bar| bar.finish_and_clear()),
        Some(state) => {
            let bar = bar.get_or_insert_with(empty_bar);
            bar.set_position((SHARES * state.share) as u64);
            bar.set_message(safe_text::in_a_line(&state.text).into_owned());
        }
    }
}

/// Number of counts of a full progress bar.
const SHARES: f64 = 1000.0;

fn empty_bar() -> ProgressBar {
    let style =
        ProgressStyle::with_template("{bar:24} {wide_msg}").unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(SHARES as u64).with_style(style)
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Kind of a command's results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResultKind {
    /// Files: if the reader of standard output goes away (`| head`), the command continues silently to its
    /// end.
    Files,
    /// Lines of standard output only: without a reader the command ends quietly.
    Lines,
}

/// Sets the kind of this command's results.
pub fn expect(results: ResultKind) {
    CONTINUES_UNREAD.store(results == ResultKind::Files, Ordering::Relaxed);
}

static CONTINUES_UNREAD: AtomicBool = AtomicBool::new(false);
static IS_MUTED: AtomicBool = AtomicBool::new(false);
/// First failure of standard output, until the program ends.
static FAILED: Mutex<Option<std::io::Error>> = Mutex::new(None);
static CANCELLATION: LazyLock<Cancellation> = LazyLock::new(Cancellation::default);

/// Switch that cancels work whose results can no longer be printed: the disk is full, or the reader of a
/// command that prints lines only has gone away.
pub fn cancellation() -> Cancellation {
    CANCELLATION.clone()
}

/// Silences the lines of results, for callers that need only a command's files and refusals.
pub fn mute() {
    IS_MUTED.store(true, Ordering::Relaxed);
}

/// Prints a line of results, in which no name breaks the line or moves the cursor. After a failed write
/// nothing more is printed, the work is cancelled ([`cancellation`]), and the program ends with this failure.
pub fn line(text: impl std::fmt::Display) {
    print(&safe_text::in_a_line(&text.to_string()));
}

/// Prints results of several lines, otherwise as [`line()`].
pub fn lines(text: &str) {
    print(&safe_text::in_lines(text));
}

fn print(text: &str) {
    if !IS_MUTED.load(Ordering::Relaxed) {
        record_print_result(beside_the_bar(|| writeln!(std::io::stdout(), "{text}")));
    }
}

/// Keeps a failure to print for the end of the program and cancels the work. A reader that has gone away is
/// no failure if the results are files.
pub(crate) fn record_print_result(printed: std::io::Result<()>) {
    let Err(error) = printed else { return };
    IS_MUTED.store(true, Ordering::Relaxed);
    if error.kind() != ErrorKind::BrokenPipe || !CONTINUES_UNREAD.load(Ordering::Relaxed) {
        locked(&FAILED).get_or_insert(error);
        CANCELLATION.cancel();
    }
}

/// Flushes standard output after work with this end. A failure to print takes the place of the end; if the
/// reader has gone away, the work that was cancelled for it has ended well.
pub(crate) fn finish(ended: Result<(), Failure>) -> Result<(), Failure> {
    if ended.is_ok() && !IS_MUTED.load(Ordering::Relaxed) {
        record_print_result(std::io::stdout().flush());
    }
    match locked(&FAILED).take() {
        Some(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::System(format!("standard output: cannot write: {error}")))
        }
        Some(_) if matches!(ended, Err(Failure::Cancelled)) => Ok(()),
        _ => ended,
    }
}

/// Whether the last line was printed; locked while a line is printed.
static IS_LAST_LINE_PRINTED: Mutex<bool> = Mutex::new(false);

/// Prints a line for people on standard error; a failure is ignored.
pub(crate) fn print_status(text: impl std::fmt::Display) {
    print_status_unless(&locked(&IS_LAST_LINE_PRINTED), text);
}

/// Prints the last line before the program ends: running threads print nothing after it.
pub(crate) fn print_last_status(text: impl std::fmt::Display) {
    end_progress();
    let mut is_last_printed = locked(&IS_LAST_LINE_PRINTED);
    print_status_unless(&is_last_printed, text);
    *is_last_printed = true;
}

fn print_status_unless(is_last_printed: &bool, text: impl std::fmt::Display) {
    if !is_last_printed {
        let _ = writeln!(std::io::stderr(), "{text}");
    }
}
