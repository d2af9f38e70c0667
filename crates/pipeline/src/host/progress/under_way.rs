//! Work that is under way, outermost first, and when a line about it is due.

use super::caller::Caller;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Work and when it was last told of.
pub(super) struct UnderWay {
    items: Vec<Arc<Item>>,
    last_line: Option<Instant>,
    /// Names, without figures, that had a line of their own.
    told: BTreeSet<String>,
}

/// Work, or a part of it, that is silent for so long has a line: with a look and what the system takes,
/// within 2 s.
const FIRST_LINE: Duration = Duration::from_millis(1500);
/// Lines of other work are at least so far apart.
const BETWEEN_FIRST_LINES: Duration = Duration::from_millis(400);
/// Enough to see that it lives, few enough for a log.
const BETWEEN_LINES: Duration = Duration::from_secs(10);

/// A piece of work.
pub(super) struct Item {
    name: String,
    caller: Caller,
    began: Instant,
    /// Steps that an earlier run has done.
    found: usize,
    done: AtomicUsize,
    /// 0 where steps cannot be counted.
    of: AtomicUsize,
    part: Mutex<Option<Part>>,
}

/// Part of a piece of work that is being done.
#[derive(Clone, Copy)]
struct Part {
    name: &'static str,
    began: Instant,
    /// Time at which these steps began; steps of another number are counted anew.
    counted_from: Instant,
    done: usize,
    of: usize,
}

/// State of the work for a progress bar.
pub struct Shown {
    /// Names of the work, and how far it is.
    pub text: String,
    /// Share of the whole that is done, 0 to 1.
    pub share: f64,
}

impl UnderWay {
    pub(super) const NOTHING: Self = Self { items: Vec::new(), last_line: None, told: BTreeSet::new() };

    pub(super) fn begin(&mut self, name: String, found: usize, now: Instant) -> Arc<Item> {
        let (done, of, part) = (AtomicUsize::new(found), AtomicUsize::new(0), Mutex::new(None));
        let item = Arc::new(Item { name, caller: Caller::here(), began: now, found, done, of, part });
        self.items.push(Arc::clone(&item));
        item
    }

    pub(super) fn end(&mut self, item: &Arc<Item>) {
        self.items.retain(|other| !Arc::ptr_eq(other, item));
    }

    /// The line that is due.
    pub(super) fn line(&mut self, now: Instant) -> Option<String> {
        let item = self.items.last()?;
        let part = item.part();
        let (name, began) = part.map_or((item.name.as_str(), item.began), |part| (part.name, part.began));
        let kind: String = name.chars().filter(|c| !c.is_ascii_digit()).collect();
        let since = self.last_line.map(|line| now.saturating_duration_since(line));
        let is_first = now.saturating_duration_since(began) >= FIRST_LINE
            && since.is_none_or(|since| since >= BETWEEN_FIRST_LINES)
            && !self.told.contains(&kind);
        // Many short pieces one after the other are silent together.
        let quiet_since = self.last_line.or(self.items.first().map(|item| item.began))?;
        let quiet_for = now.saturating_duration_since(quiet_since);
        let is_again = quiet_for >= if self.last_line.is_some() { BETWEEN_LINES } else { FIRST_LINE };
        if !(is_first || is_again) {
            return None;
        }
        self.told.insert(kind);
        self.last_line = Some(now);
        Some(text(&self.items, now))
    }

    /// State of the work of some callers for a progress bar; `None` until the outermost work has been under
    /// way for `after`.
    pub(super) fn shown(
        &self,
        now: Instant,
        after: Duration,
        is_told: impl Fn(Caller) -> bool,
    ) -> Option<Shown> {
        let items: Vec<_> = self.items.iter().filter(|item| is_told(item.caller)).cloned().collect();
        let is_long = now.saturating_duration_since(items.first()?.began) >= after;
        let share = items.iter().find_map(|item| item.share()).unwrap_or(0.0);
        is_long.then(|| Shown { text: text(&items, now), share })
    }
}

/// The outermost work, the one that counts, and the last begun.
fn text(items: &[Arc<Item>], now: Instant) -> String {
    let last = items.len().saturating_sub(1);
    let counting = items.iter().position(|item| item.share().is_some()).unwrap_or(last);
    let mut told = [0, counting, last].to_vec();
    told.dedup();
    let of = |index: usize| items.get(index).map(|item| item.text(now));
    told.into_iter().filter_map(of).collect::<Vec<_>>().join("; ")
}

impl Item {
    pub(super) fn at(&self, done: usize, of: usize) {
        self.of.store(of, Ordering::Relaxed);
        self.done.store(done, Ordering::Relaxed);
    }

    pub(super) fn part_at(&self, name: &'static str, done: usize, of: usize, now: Instant) {
        let mut part = self.part.lock().unwrap_or_else(PoisonError::into_inner);
        let same = part.filter(|part| part.name == name);
        let began = same.map_or(now, |part| part.began);
        let counted_from = same.filter(|part| part.of == of).map_or(now, |part| part.counted_from);
        *part = Some(Part { name, began, counted_from, done, of });
    }

    fn part(&self) -> Option<Part> {
        *self.part.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn counts(&self) -> Option<(usize, usize)> {
        let of = self.of.load(Ordering::Relaxed);
        (of > 0).then(|| (self.done.load(Ordering::Relaxed).min(of), of))
    }

    /// Share of the steps that are done; `None` where they cannot be counted.
    fn share(&self) -> Option<f64> {
        self.counts().map(|(done, of)| done as f64 / of as f64)
    }

    fn text(&self, now: Instant) -> String {
        let ran = now.saturating_duration_since(self.began);
        let mut text = self.name.clone();
        match self.counts() {
            Some((done, of)) => add_counts(&mut text, [done, of, self.found], ran),
            None => _ = write!(text, ", for {} s", ran.as_secs()),
        }
        if let Some(part) = self.part() {
            let ran = now.saturating_duration_since(part.counted_from);
            _ = write!(text, ", {}", part.name);
            if part.of > 0 {
                add_counts(&mut text, [part.done.min(part.of), part.of, 0], ran);
            }
        }
        text
    }
}

/// Adds how far the work is, and how long it will take if it goes on as it went so far, once a few steps tell
/// that: the first frame measures errors that those after it take over.
fn add_counts(text: &mut String, [done, of, found]: [usize; 3], ran: Duration) {
    _ = write!(text, ": {done} of {of}");
    let here = done.saturating_sub(found);
    if here >= FEW_STEPS || 5 * here >= of && here > 0 {
        let left_s = ran.as_secs_f64() * (of - done) as f64 / here as f64;
        _ = write!(text, ", about {left_s:.0} s left");
    }
}

/// Steps that tell how long others take; of fewer than fifteen a fifth does.
const FEW_STEPS: usize = 3;

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    /// Lines over time, looked for ten times a second; `work` may begin and end items.
    fn lines(seconds: u32, mut work: impl FnMut(&mut UnderWay, u32, Instant)) -> Vec<(f64, String)> {
        let (mut under_way, start) = (UnderWay::NOTHING, Instant::now());
        let at = |tenth: u32| start + tenth * SECOND / 10;
        let mut lines = Vec::new();
        for tenth in 0..=10 * seconds {
            work(&mut under_way, tenth, at(tenth));
            lines.extend(under_way.line(at(tenth)).map(|line| (f64::from(tenth) / 10.0, line)));
        }
        lines
    }

    #[test]
    fn one_long_step_has_a_line_within_two_seconds_and_every_ten() {
        let mut item = None;
        let lines = lines(25, |under_way, tenth, now| {
            if tenth == 0 {
                item = Some(under_way.begin("reading bus.glb".into(), 0, now));
            }
        });
        let expected =
            [(1.5, 1), (11.5, 11), (21.5, 21)].map(|(at, s)| (at, format!("reading bus.glb, for {s} s")));
        assert_eq!(lines, expected);
    }

    #[test]
    fn many_short_steps_one_after_the_other_are_not_silent_either() {
        let mut item = None;
        let lines = lines(13, |under_way, tenth, now| {
            if tenth == 0 {
                under_way.begin("run".into(), 0, now);
            }
            if tenth % 5 == 0 {
                item.take().inspect(|item| under_way.end(item));
                item = Some(under_way.begin(format!("frame {tenth} echo"), 0, now));
            }
        });
        assert_eq!(lines.iter().map(|(at, _)| *at).collect::<Vec<_>>(), [1.5, 11.5]);
        assert_eq!(lines[0].1, "run, for 1 s; frame 15 echo, for 0 s");
    }

    #[test]
    fn a_part_that_lasts_has_its_line_within_two_seconds_of_its_begin() {
        let mut item: Option<Arc<Item>> = None;
        let lines = lines(9, |under_way, tenth, now| {
            let item = item.get_or_insert_with(|| under_way.begin("rcs".into(), 0, now));
            if (30..60).contains(&tenth) {
                item.part_at("tracing", tenth as usize - 30, 60, now);
            } else if tenth >= 60 {
                item.part_at("checking errors", 0, 0, now);
            }
        });
        let at: Vec<f64> = lines.iter().map(|(at, _)| *at).collect();
        assert_eq!(at, [1.5, 4.5, 7.5], "{lines:?}");
        assert_eq!(lines[1].1, "rcs, for 4 s, tracing: 15 of 60, about 4 s left");
    }

    #[test]
    fn steps_of_an_earlier_run_took_none_of_this_ones_time() {
        let (mut under_way, start) = (UnderWay::NOTHING, Instant::now());
        let item = under_way.begin("rcs".into(), 300, start);
        item.at(310, 360);
        assert_eq!(text(&under_way.items, start + 5 * SECOND), "rcs: 310 of 360, about 25 s left");
        under_way.end(&item);
        assert!(under_way.line(start + 60 * SECOND).is_none(), "nothing is under way");
    }
}
