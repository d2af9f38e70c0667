//! The accuracy of a run: the request, and the result of its worst frame.

use pipeline::outcome::summary::Summary;
use serde::{Deserialize, Serialize};

/// Run in which errors were measured.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum ErrorSource {
    /// The run itself.
    #[default]
    Own,
    /// Another one, in which they may have been smaller or larger than in this one.
    TakenOver,
}

/// Accuracy of a run over its frames; unknown for one kept by an earlier version.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct RunAccuracy {
    /// The largest error allowed, dB relative to the echo.
    pub(crate) asked_db: Option<f64>,
    /// Error of the worst frame, dB; `None` if it was not estimated, or, with `met`, if it is zero.
    pub(crate) reached_db: Option<f64>,
    /// Whether every frame with an estimated error met the request; `None` if there is none.
    pub(crate) met: Option<bool>,
    pub(crate) errors: ErrorSource,
}

impl RunAccuracy {
    pub(crate) fn of(summary: &Summary, errors: ErrorSource) -> Self {
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

    /// Whether the run missed its requested accuracy.
    pub(crate) fn is_missed(&self) -> bool {
        self.met == Some(false)
    }

    /// Whether the run meets its accuracy only by errors taken over from another run.
    pub(crate) fn is_not_measured(&self) -> bool {
        self.met == Some(true) && self.errors == ErrorSource::TakenOver
    }

    /// Excess of the error over the request, dB.
    pub(crate) fn excess_db(&self) -> f64 {
        self.reached_db.unwrap_or(f64::INFINITY) - self.asked_db.unwrap_or(0.0)
    }
}
