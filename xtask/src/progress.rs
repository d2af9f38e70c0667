//! Long work shows a bar with the time left on a terminal and plain lines elsewhere; `--quiet` silences both.

use crate::cli::Arguments;
use crate::output;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

#[derive(Clone, Copy, PartialEq, Eq)]
enum Voice {
    Bar,
    Lines,
    Silent,
}

static VOICE: OnceLock<Voice> = OnceLock::new();
static BAR: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// Chooses the voice once, from `--quiet` and the terminal.
pub(crate) fn configure(arguments: &Arguments) {
    let voice = match arguments.quiet {
        true => Voice::Silent,
        false if std::io::stderr().is_terminal() => Voice::Bar,
        false => Voice::Lines,
    };
    let _ = VOICE.set(voice);
}

fn voice() -> Voice {
    *VOICE.get().unwrap_or(&Voice::Silent)
}

/// A remark on standard error.
pub(crate) fn note(text: impl std::fmt::Display) {
    if voice() != Voice::Silent {
        match &*BAR.lock().unwrap_or_else(PoisonError::into_inner) {
            Some(bar) => bar.suspend(|| output::say(text)),
            None => output::say(text),
        }
    }
}

/// Removes the bar.
pub(crate) fn finish() {
    if let Some(bar) = BAR.lock().unwrap_or_else(PoisonError::into_inner).take() {
        bar.finish_and_clear();
    }
}

/// A piece of long work that counts its steps.
pub(crate) struct Work {
    name: String,
    last_line: Mutex<Instant>,
    started: Instant,
    /// Steps that an earlier run has done.
    found: usize,
}

impl Work {
    /// Begins work of the given name; a previous bar is removed.
    pub(crate) fn begin(name: impl Into<String>) -> Self {
        Self::resumed(name, 0)
    }

    /// The same where so many steps are there already.
    pub(crate) fn resumed(name: impl Into<String>, found: usize) -> Self {
        let name = name.into();
        finish();
        if voice() == Voice::Bar {
            let style = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} {eta} left");
            let bar = ProgressBar::new(0).with_message(name.clone());
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            *BAR.lock().unwrap_or_else(PoisonError::into_inner) = Some(bar);
        }
        Self { name, last_line: Mutex::new(Instant::now()), started: Instant::now(), found }
    }

    /// `done` of `of` steps are done; callable from any thread.
    pub(crate) fn at(&self, done: usize, of: usize) {
        match voice() {
            Voice::Bar => {
                if let Some(bar) = &*BAR.lock().unwrap_or_else(PoisonError::into_inner) {
                    bar.set_length(of as u64);
                    bar.set_position(done as u64);
                }
            }
            Voice::Lines => self.line(done, of),
            Voice::Silent => {}
        }
    }

    /// A line every ten seconds: enough to see that it lives, few enough for a log.
    fn line(&self, done: usize, of: usize) {
        let mut last = self.last_line.lock().unwrap_or_else(PoisonError::into_inner);
        if last.elapsed() < Duration::from_secs(10) || done == 0 {
            return;
        }
        *last = Instant::now();
        let here = done.saturating_sub(self.found).max(1);
        let left = self.started.elapsed().as_secs_f64() * (of - done.min(of)) as f64 / here as f64;
        output::say(format_args!("{}: {done} of {of}, about {left:.0} s left", self.name));
    }
}

impl Drop for Work {
    fn drop(&mut self) {
        finish();
    }
}
