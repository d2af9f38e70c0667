//! Work under way, outermost first, and the times at which a line about it is due.

use super::caller::Caller;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Work, and the time of its last line.
pub(super) struct RunningWork {
    items: Vec<Arc<WorkItem>>,
    last_line: Option<Instant>,
    /// Names, without figures, that already had a line of their own.
    told: BTreeSet<String>,
}

/// Silence after which work, or a part of it, has a line: with a look and the system's overhead, within 2 s.
const FIRST_LINE: Duration = Duration::from_millis(1500);
/// Least interval between lines of different work.
const BETWEEN_FIRST_LINES: Duration = Duration::from_millis(400);
/// Interval of further lines: short enough to show life, long enough for a log.
const BETWEEN_LINES: Duration = Duration::from_secs(10);

/// A piece of work.
pub(super) struct WorkItem {
    name: String,
    caller: Caller,
    began: Instant,
    /// Steps that an earlier run has done.
    found: usize,
    done: AtomicUsize,
    /// 0 where steps cannot be counted.
    of: AtomicUsize,
    part: Mutex<Option<WorkPart>>,
    /// Stages that each of the frames goes through; for work on one stage, that stage.
    stages: Vec<FrameStage>,
    /// Largest share shown, as its bits, which sort like the numbers.
    shown: AtomicU64,
}

/// Stage of a frame, as progress distinguishes them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrameStage {
    /// Paths, or tables of bodies.
    Scattering,
    /// The radar cube.
    Echo,
    /// Range-Doppler map, points and objects.
    Detection,
}

impl FrameStage {
    /// Usual part of a frame's time, in a unit common to the stages.
    fn weight(self) -> f64 {
        match self {
            Self::Scattering => 6.0,
            Self::Echo => 3.0,
            Self::Detection => 1.0,
        }
    }

    /// Shares of a frame of these stages at which this one begins and ends.
    fn between(self, stages: &[Self]) -> [f64; 2] {
        let sum = |stages: &[Self]| stages.iter().map(|stage| stage.weight()).sum::<f64>();
        let Some(at) = stages.iter().position(|stage| *stage == self) else { return [0.0; 2] };
        [&stages[..at], &stages[..=at]].map(|before| sum(before) / sum(stages))
    }
}

/// Part of a piece of work that is under way.
#[derive(Clone, Copy)]
struct WorkPart {
    name: &'static str,
    /// Index of this part, and how many parts one step has.
    place: [usize; 2],
    /// Number of times that the parts began anew, from coarse to finer; their total is unknown.
    round: i32,
    began: Instant,
    done: usize,
    of: usize,
}

/// State of the work for a progress bar.
pub struct ProgressState {
    /// Names of the work, and its progress.
    pub text: String,
    /// Completed share of the whole, 0 to 1.
    pub share: f64,
}

impl RunningWork {
    pub(super) const NOTHING: Self = Self { items: Vec::new(), last_line: None, told: BTreeSet::new() };

    pub(super) fn begin(
        &mut self,
        name: String,
        (found, stages): (usize, &[FrameStage]),
        now: Instant,
    ) -> Arc<WorkItem> {
        let (done, of, part) = (AtomicUsize::new(found), AtomicUsize::new(0), Mutex::new(None));
        let (caller, stages, shown) = (Caller::current(), stages.to_vec(), AtomicU64::new(0));
        let item = Arc::new(WorkItem { name, caller, began: now, found, done, of, part, stages, shown });
        self.items.push(Arc::clone(&item));
        item
    }

    pub(super) fn end(&mut self, item: &Arc<WorkItem>) {
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
        // Many consecutive short pieces are silent together.
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
    pub(super) fn state(
        &self,
        now: Instant,
        after: Duration,
        is_told: impl Fn(Caller) -> bool,
    ) -> Option<ProgressState> {
        let items: Vec<_> = self.items.iter().filter(|item| is_told(item.caller)).cloned().collect();
        let is_long = now.saturating_duration_since(items.first()?.began) >= after;
        is_long.then(|| ProgressState { text: text(&items, now), share: share(&items) })
    }
}

/// Completed share of the outermost counted work, with its steps under way; it never decreases.
fn share(items: &[Arc<WorkItem>]) -> f64 {
    let Some(at) = items.iter().position(|item| item.counts().is_some()) else { return 0.0 };
    let (outer, within) = (&items[at], &items[at + 1..]);
    let Some((done, of)) = outer.counts() else { return 0.0 };
    let share = ((done as f64 + outer.steps_under_way(within)) / of as f64).min(1.0);
    let before = outer.shown.fetch_max(share.to_bits(), Ordering::Relaxed);
    share.max(f64::from_bits(before))
}

/// Names of the outermost work, the counted one, the one that counts a step of it, and the latest.
fn text(items: &[Arc<WorkItem>], now: Instant) -> String {
    let last = items.len().saturating_sub(1);
    let counts = |from: usize| (from..items.len()).find(|&index| items[index].counts().is_some());
    let counting = counts(0).unwrap_or(last);
    let is_of_steps = items.get(counting).is_some_and(|item| item.stages.is_empty());
    let of_step = counts(counting + 1).filter(|_| is_of_steps).unwrap_or(counting);
    let mut told = [0, counting, of_step, last].to_vec();
    told.dedup();
    let of = |index: usize| items.get(index).map(|item| item.text(now));
    told.into_iter().filter_map(of).collect::<Vec<_>>().join("; ")
}

impl WorkItem {
    pub(super) fn at(&self, done: usize, of: usize) {
        self.of.store(of, Ordering::Relaxed);
        self.done.store(done, Ordering::Relaxed);
    }

    /// Records the progress of a part of the step under way, by its name and its place among the step's
    /// parts.
    pub(super) fn part_at(
        &self,
        (name, place): (&'static str, [usize; 2]),
        [done, of]: [usize; 2],
        now: Instant,
    ) {
        let mut part = self.part.lock().unwrap_or_else(PoisonError::into_inner);
        let same = part.filter(|part| part.name == name);
        let began = same.map_or(now, |part| part.began);
        let round = part.map_or(0, |part| part.round + i32::from(place[0] < part.place[0]));
        *part = Some(WorkPart { name, place, round, began, done, of });
    }

    fn part(&self) -> Option<WorkPart> {
        *self.part.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn counts(&self) -> Option<(usize, usize)> {
        let of = self.of.load(Ordering::Relaxed);
        (of > 0).then(|| (self.done.load(Ordering::Relaxed).min(of), of))
    }

    /// Completed steps' worth of the steps under way, given the work begun since: for frames from their
    /// stages; for other steps from the parts of one, or from the counted work within it.
    fn steps_under_way(&self, within: &[Arc<WorkItem>]) -> f64 {
        if self.stages.is_empty() {
            return self.part_share().max(share(within));
        }
        within.iter().map(|item| item.share_of_frame(&self.stages)).sum()
    }

    /// Completed share of the step under way by its parts; 0 if no step has parts. Each round is taken for
    /// half of the remainder.
    fn part_share(&self) -> f64 {
        let Some(WorkPart { place: [at, parts], round, done, of, .. }) = self.part() else { return 0.0 };
        let of_part = if of > 0 { done.min(of) as f64 / of as f64 } else { 0.0 };
        let of_round = ((at as f64 + of_part) / parts as f64).min(1.0);
        let left = 0.5_f64.powi(round);
        1.0 - left + 0.5 * left * of_round
    }

    /// Completed share of a frame of these stages at this work's progress; 0 for work on no stage of a frame.
    fn share_of_frame(&self, stages: &[FrameStage]) -> f64 {
        let [stage] = self.stages[..] else { return 0.0 };
        let [from, to] = stage.between(stages);
        let (done, of) = self.counts().unwrap_or((0, 1));
        let own = ((done as f64 + self.part_share()) / of as f64).min(1.0);
        from + (to - from) * own
    }

    fn text(&self, now: Instant) -> String {
        let ran = now.saturating_duration_since(self.began);
        let mut text = self.name.clone();
        match self.counts() {
            Some((done, of)) => add_counts(&mut text, [done, of, self.found], ran),
            None => _ = write!(text, ", for {} s", ran.as_secs()),
        }
        if let Some(part) = self.part() {
            _ = write!(text, ", {}", part.name);
            if part.of > 0 {
                // Parts begin anew, and others follow: the time of this one does not predict that of the
                // work.
                _ = write!(text, ": {} of {}", part.done.min(part.of), part.of);
            }
        }
        text
    }
}

/// Adds the progress and the remaining time at the present rate, once a few steps allow a prediction: the
/// first frame measures errors that later ones take over.
fn add_counts(text: &mut String, [done, of, found]: [usize; 3], ran: Duration) {
    _ = write!(text, ": {done} of {of}");
    let here = done.saturating_sub(found);
    if here >= FEW_STEPS || 5 * here >= of && here > 0 {
        let left_s = ran.as_secs_f64() * (of - done) as f64 / here as f64;
        _ = write!(text, ", about {left_s:.0} s left");
    }
}

/// Number of steps needed for a prediction; with fewer than fifteen steps, a fifth suffices.
const FEW_STEPS: usize = 3;

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    /// Lines over time, looked for ten times a second; `work` may begin and end items.
    fn lines(seconds: u32, mut work: impl FnMut(&mut RunningWork, u32, Instant)) -> Vec<(f64, String)> {
        let (mut running, start) = (RunningWork::NOTHING, Instant::now());
        let at = |tenth: u32| start + tenth * SECOND / 10;
        let mut lines = Vec::new();
        for tenth in 0..=10 * seconds {
            work(&mut running, tenth, at(tenth));
            lines.extend(running.line(at(tenth)).map(|line| (f64::from(tenth) / 10.0, line)));
        }
        lines
    }

    #[test]
    fn one_long_step_has_a_line_within_two_seconds_and_every_ten() {
        let mut item = None;
        let lines = lines(25, |running, tenth, now| {
            if tenth == 0 {
                item = Some(running.begin("reading bus.glb".into(), (0, &[]), now));
            }
        });
        let expected =
            [(1.5, 1), (11.5, 11), (21.5, 21)].map(|(at, s)| (at, format!("reading bus.glb, for {s} s")));
        assert_eq!(lines, expected);
    }

    #[test]
    fn many_short_steps_one_after_the_other_are_not_silent_either() {
        let mut item = None;
        let lines = lines(13, |running, tenth, now| {
            if tenth == 0 {
                running.begin("run".into(), (0, &[]), now);
            }
            if tenth % 5 == 0 {
                item.take().inspect(|item| running.end(item));
                item = Some(running.begin(format!("frame {tenth} echo"), (0, &[]), now));
            }
        });
        assert_eq!(lines.iter().map(|(at, _)| *at).collect::<Vec<_>>(), [1.5, 11.5]);
        assert_eq!(lines[0].1, "run, for 1 s; frame 15 echo, for 0 s");
    }

    #[test]
    fn a_part_that_lasts_has_its_line_within_two_seconds_of_its_begin() {
        let mut item: Option<Arc<WorkItem>> = None;
        let lines = lines(9, |running, tenth, now| {
            let item = item.get_or_insert_with(|| running.begin("rcs".into(), (0, &[]), now));
            if (30..60).contains(&tenth) {
                item.part_at(("tracing", [1, 4]), [tenth as usize - 30, 60], now);
            } else if tenth >= 60 {
                item.part_at(("checking errors", [3, 4]), [0, 0], now);
            }
        });
        let at: Vec<f64> = lines.iter().map(|(at, _)| *at).collect();
        assert_eq!(at, [1.5, 4.5, 7.5], "{lines:?}");
        assert_eq!(lines[1].1, "rcs, for 4 s, tracing: 15 of 60");
    }

    #[test]
    fn steps_of_an_earlier_run_took_none_of_this_ones_time() {
        let (mut running, start) = (RunningWork::NOTHING, Instant::now());
        let item = running.begin("rcs".into(), (300, &[]), start);
        item.at(310, 360);
        assert_eq!(text(&running.items, start + 5 * SECOND), "rcs: 310 of 360, about 25 s left");
        running.end(&item);
        assert!(running.line(start + 60 * SECOND).is_none(), "nothing is under way");
    }

    #[test]
    fn parts_that_begin_anew_take_half_of_what_is_left_each_time() {
        let (mut running, now) = (RunningWork::NOTHING, Instant::now());
        let item = running.begin("aspects".into(), (0, &[]), now);
        item.at(0, 1);
        let mut shares = vec![];
        for (name, at) in [("tracing", 1), ("checking errors", 3), ("tracing", 1), ("checking errors", 3)] {
            item.part_at((name, [at, 4]), [1, 1], now);
            shares.push(share(&running.items));
        }
        assert_eq!(shares, [0.25, 0.5, 0.625, 0.75]);
    }

    #[test]
    fn frames_of_one_of_several_radars_count_in_the_share_of_the_radars() {
        let (mut running, start) = (RunningWork::NOTHING, Instant::now());
        running.begin("run".into(), (0, &[]), start);
        let radars = running.begin("radars".into(), (0, &[]), start);
        let mut shares = vec![];
        for radar in 0..2 {
            radars.at(radar, 2);
            let frames = running.begin("frames".into(), (0, &[FrameStage::Echo]), start);
            for done in [0, 3, 4] {
                frames.at(done, 4);
                shares.push(share(&running.items));
            }
            let told = text(&running.items, start + 4 * SECOND);
            assert!(told.contains("radars: ") && told.ends_with("frames: 4 of 4, about 0 s left"), "{told}");
            running.end(&frames);
        }
        assert_eq!(shares, [0.0, 0.375, 0.5, 0.5, 0.875, 1.0]);
    }

    #[test]
    fn the_share_has_what_is_done_of_frames_under_way_and_never_falls() {
        use FrameStage::{Detection, Echo, Scattering};
        let (mut running, now) = (RunningWork::NOTHING, Instant::now());
        let frames = running.begin("frames".into(), (0, &[Scattering, Echo]), now);
        frames.at(0, 2);
        let mut shares = vec![share(&running.items)];
        let first = running.begin("frame 0, paths".into(), (0, &[Scattering]), now);
        first.part_at(("tracing", [1, 4]), [1, 2], now);
        shares.push(share(&running.items));
        let second = running.begin("frame 1, paths".into(), (0, &[Scattering]), now);
        second.part_at(("tracing", [1, 4]), [1, 2], now);
        shares.push(share(&running.items));
        // Mirrors of the next order are counted anew.
        second.part_at(("tracing", [1, 4]), [0, 9], now);
        shares.push(share(&running.items));
        running.end(&first);
        let echo = running.begin("frame 0, echo, percent".into(), (0, &[Echo]), now);
        echo.at(50, 100);
        shares.push(share(&running.items));
        let (of_paths, of_echo) = (6.0 / 9.0, 3.0 / 9.0);
        let expected = [
            0.0,
            0.1875 * of_paths,
            0.375 * of_paths,
            0.375 * of_paths,
            0.125 * of_paths + of_paths + 0.5 * of_echo,
        ];
        for (found, expected) in shares.iter().zip(expected) {
            assert!((found - 0.5 * expected).abs() < 1e-12, "{shares:?}");
        }
        running.end(&echo);
        running.begin("frame 0, range-Doppler map and points".into(), (0, &[Detection]), now);
        assert_eq!(share(&running.items), shares[4], "no stage of these frames");
        second.at(1, 1);
        frames.at(2, 2);
        assert_eq!(share(&running.items), 1.0);
    }
}
