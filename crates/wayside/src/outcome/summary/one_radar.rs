//! A scene through one radar: the whole file, its way to text and back.

use crate::host::failure::Failure;
use crate::outcome::summary::frame::FrameSummary;
use crate::outcome::summary::radar::{LaneSummary, RadarSummary};
use crate::outcome::summary::words::StaticWord;
use artifact::scene::SceneHeader;
use artifact::settings::StaticEchoes;
use evaluation::Metrics;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What is told of a scene through one radar.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// The scene's name; with several radars `<scene>/<radar>`.
    pub scene: String,
    /// Of noise and all that is random.
    pub seed: u64,
    /// By the clock, from the first frame's begin to the last picture's end, s.
    pub frames_seconds: f64,
    /// What all threads spent on processors in it, s; `None` where the system does not tell.
    pub frames_processor_seconds: Option<f64>,
    /// What lanes are called by their numbers; empty where nothing says any.
    pub lanes: Vec<LaneSummary>,
    /// What becomes of echoes at rest.
    #[serde(rename = "static", with = "StaticWord")]
    pub static_echoes: StaticEchoes,
    /// What the radar is.
    pub radar: RadarSummary,
    /// In order.
    pub frames: Vec<FrameSummary>,
    /// Objects and tracks beside the truth, over all frames.
    pub metrics: Metrics,
}

impl Summary {
    /// Of a scene without what its frames tell.
    pub(crate) fn of(header: &SceneHeader, frames: Vec<FrameSummary>, metrics: Metrics) -> Self {
        Self {
            scene: header.name.clone(),
            seed: header.seed,
            frames_seconds: 0.0,
            frames_processor_seconds: None,
            lanes: LaneSummary::all(header),
            static_echoes: header.dsp.static_echoes,
            radar: RadarSummary::of(header),
            frames,
            metrics,
        }
    }

    /// Reads a `summary.json` of one radar; keys that are not known are passed over.
    ///
    /// # Errors
    /// The file is unreadable, or is no such summary.
    pub fn read(file: &Path) -> Result<Self, Failure> {
        let text = std::fs::read(file).map_err(|e| Failure::system(file, "read", e))?;
        serde_json::from_slice(&text).map_err(Failure::refused).map_err(|failure| failure.about(file))
    }

    /// The text of `summary.json`.
    ///
    /// # Errors
    /// None that a summary of a run can make.
    pub fn json(&self) -> Result<String, Failure> {
        text(self)
    }
}

/// By way of a `Value`, which has its keys in alphabetical order, as the file has them: fields stand in the
/// order in which they are read.
pub(super) fn text(summary: &impl Serialize) -> Result<String, Failure> {
    let value = serde_json::to_value(summary).map_err(Failure::refused)?;
    serde_json::to_string_pretty(&value).map_err(Failure::refused)
}
