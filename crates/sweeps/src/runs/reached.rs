//! The accuracy of a run: what was asked for, and what the worst of its frames reached.

use pipeline::outcome::summary::Summary;
use serde::{Deserialize, Serialize};

/// Run that errors were measured in.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Errors {
    /// The run itself.
    #[default]
    Own,
    /// Another one, in which they may have been smaller or larger than in this.
    TakenOver,
}

/// Accuracy of a run over its frames; nothing is known of one that an earlier version kept.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Reached {
    /// The largest error allowed, dB relative to the echo.
    pub(crate) asked_db: Option<f64>,
    /// Error of the worst frame, dB; `None` where it was not estimated, and with `met` of no error at all.
    pub(crate) reached_db: Option<f64>,
    /// Whether every frame whose error was estimated reached what was asked; `None` where none was.
    pub(crate) met: Option<bool>,
    pub(crate) errors: Errors,
}

impl Reached {
    pub(crate) fn of(summary: &Summary, errors: Errors) -> Self {
        let frames = || summary.frames.iter().map(|frame| &frame.accuracy);
        let known = frames().filter_map(|accuracy| Some((accuracy.level_db()?, accuracy)));
        let worst = known.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, accuracy)| accuracy);
        Self {
            asked_db: worst.or(frames().next()).map(|accuracy| accuracy.asked_db),
            reached_db: worst.and_then(|accuracy| accuracy.reached_db),
            met: worst.and_then(|accuracy| accuracy.met),
            errors,
        }
    }

    /// Whether the run did not reach what it asked for.
    pub(crate) fn is_missed(&self) -> bool {
        self.met == Some(false)
    }

    /// Whether it would have reached it, were its errors those of the run that they are taken over from.
    pub(crate) fn is_not_measured(&self) -> bool {
        self.met == Some(true) && self.errors == Errors::TakenOver
    }

    /// Level of the error above what was asked for, dB.
    pub(crate) fn excess_db(&self) -> f64 {
        self.reached_db.unwrap_or(f64::INFINITY) - self.asked_db.unwrap_or(0.0)
    }
}
