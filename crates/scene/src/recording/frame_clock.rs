//! Times of the frames of a scene with recorded traffic, checked against the recording.

use crate::recording::fcd::FcdRule;

/// Requested frames and their times in the recording.
#[derive(Clone, Copy)]
pub(crate) struct FrameTimes {
    /// Number of frames in the scene; `None` for as many as possible.
    pub(crate) frames: Option<u32>,
    /// Interval from one frame to the next.
    pub(crate) interval_s: f64,
    /// Time of the first frame; `None` for the recording's first step.
    pub(crate) begin_s: Option<f64>,
    /// Latest time of the last frame; `None` for the recording's last step.
    pub(crate) end_s: Option<f64>,
}

/// Times of frames, one after the other.
pub(crate) struct FrameClock {
    times: FrameTimes,
    first_s: f64,
    begin_s: f64,
    next: u32,
}

/// Largest number of frames in a scene.
pub(crate) const FRAME_LIMIT: u32 = 1_000_000;

/// Rounding error of times: SUMO writes milliseconds.
const ROUNDING_S: f64 = 1e-6;

impl FrameClock {
    pub(crate) fn of(times: FrameTimes, first_s: f64) -> Self {
        Self { times, first_s, begin_s: times.begin_s.unwrap_or(first_s), next: 0 }
    }

    fn at(&self, frame: u32) -> f64 {
        self.begin_s + f64::from(frame) * self.times.interval_s
    }

    /// Whether no frame is left.
    pub(crate) fn is_done(&self) -> bool {
        let ended = self.times.end_s.is_some_and(|end_s| self.at(self.next) > end_s + ROUNDING_S);
        self.times.frames.map_or(ended, |frames| self.next >= frames)
    }

    /// The next frame's time if the recording reaches it.
    pub(crate) fn frame_until(&mut self, end_s: f64) -> Result<Option<f64>, FcdRule> {
        let time_s = self.at(self.next);
        let is_known = !self.is_done() && time_s >= self.first_s - ROUNDING_S && time_s <= end_s + ROUNDING_S;
        if is_known && self.next == FRAME_LIMIT {
            let (begin_s, interval_s) = (self.begin_s, self.times.interval_s);
            return Err(FcdRule::TooManyFrames { begin_s, interval_s, limit: FRAME_LIMIT });
        }
        self.next += u32::from(is_known);
        Ok(is_known.then_some(time_s))
    }

    /// Whether all requested frames are done, if their number is limited.
    pub(crate) fn is_complete(&self) -> bool {
        self.is_done() && self.next > 0 && self.is_within_end()
    }

    fn is_within_end(&self) -> bool {
        let both = self.times.frames.zip(self.times.end_s);
        both.is_none_or(|(frames, end_s)| self.at(frames - 1) <= end_s + ROUNDING_S)
    }

    /// Refuses a recording that ended before all requested frames, and an `end_s` before its beginning.
    pub(crate) fn checked(&self, last_s: f64) -> Result<(), FcdRule> {
        let first_s = self.first_s;
        if let Some(end_s) = self.times.end_s.filter(|end_s| first_s > end_s + ROUNDING_S) {
            return Err(FcdRule::EndsBeforeRecording { end_s, first_s, last_s });
        }
        if let Some((frames, end_s)) =
            self.times.frames.zip(self.times.end_s).filter(|_| !self.is_within_end())
        {
            let (begin_s, found_s) = (self.begin_s, self.at(frames - 1));
            return Err(FcdRule::FramesBeyondEnd { frames, begin_s, found_s, end_s, first_s, last_s });
        }
        let until_s = match (self.times.frames, self.times.end_s) {
            (Some(frames), Some(end_s)) => self.at(frames - 1).max(end_s),
            (Some(frames), None) => self.at(frames - 1),
            (None, Some(end_s)) => end_s,
            (None, None) => self.begin_s,
        };
        let are_unbounded = self.times.frames.is_none() && self.times.end_s.is_none();
        let is_there = self.is_complete() || (are_unbounded && self.next > 0);
        let rule = FcdRule::OutsideRecording { first_s, last_s, begin_s: self.begin_s, end_s: until_s };
        if is_there { Ok(()) } else { Err(rule) }
    }
}
