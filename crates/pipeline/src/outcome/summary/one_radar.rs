//! Summary of a scene with one radar, with its reading and writing.

use crate::host::failure::Failure;
use crate::host::files;
use crate::outcome::summary::frame::FrameSummary;
use crate::outcome::summary::radar::{LaneSummary, RadarSummary};
use crate::outcome::summary::words::StaticWord;
use crate::planning::plan_figures::PlanFigures;
use artifact::scene::SceneHeader;
use artifact::settings::StaticEchoes;
use evaluation::Metrics;
use serde::de::{DeserializeOwned, IgnoredAny};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// Largest file: a hundred thousand frames of ten targets.
const LIMIT_BYTES: u64 = 1 << 30;

/// Summary of a scene with one radar.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// The scene's name; with several radars `<scene>/<radar>`.
    pub scene: String,
    /// Seed of the noise and of all other random draws.
    pub seed: u64,
    /// Wall-clock time from the beginning of the first frame to the end of the last picture, s.
    pub frames_seconds: f64,
    /// Processor time of all threads within `frames_seconds`, s; `None` where the system does not report it.
    pub frames_processor_seconds: Option<f64>,
    /// Names of lanes by their numbers; empty where the scene has no lanes.
    pub lanes: Vec<LaneSummary>,
    /// Treatment of echoes at rest: kept, marked or removed.
    #[serde(rename = "static", with = "StaticWord")]
    pub static_echoes: StaticEchoes,
    /// Waveform, array size and limits of the radar.
    pub radar: RadarSummary,
    /// Plan by which the physics was chosen; `None`, and not in the file, if the scene specifies all of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plan: Option<PlanFigures>,
    /// Summaries of the frames, in order.
    pub frames: Vec<FrameSummary>,
    /// Metrics of objects and tracks against the ground truth, over all frames.
    pub metrics: Metrics,
}

impl Summary {
    /// Makes the summary of a scene; both times are 0 until the run is done.
    pub fn of(header: &SceneHeader, frames: Vec<FrameSummary>, metrics: Metrics) -> Self {
        Self {
            scene: header.name.clone(),
            seed: header.seed,
            frames_seconds: 0.0,
            frames_processor_seconds: None,
            lanes: LaneSummary::all(header),
            static_echoes: header.dsp.static_echoes,
            radar: RadarSummary::of(header),
            plan: None,
            frames,
            metrics,
        }
    }

    /// Reads a `summary.json` of one radar; unknown keys are ignored.
    ///
    /// # Errors
    /// The file is unreadable, or is not such a summary.
    pub fn read(file: &Path) -> Result<Self, Failure> {
        read(file)
    }

    /// The text of `summary.json`.
    ///
    /// # Errors
    /// None for a summary of a run.
    pub fn json(&self) -> Result<String, Failure> {
        text(self)
    }
}

/// Whether a text is a `summary.json`, of one radar or several, by its outermost keys; an empty one counts
/// too, because it holds no data.
pub fn is_summary(text: &[u8]) -> bool {
    let keys: BTreeMap<String, IgnoredAny> = serde_json::from_slice(text).unwrap_or_default();
    let has = |key: &str| keys.contains_key(key);
    text.is_empty() || has("scene") && has("frames") && (has("radar") || has("radars"))
}

/// Reads a summary of one radar or of several.
pub(super) fn read<S: DeserializeOwned>(file: &Path) -> Result<S, Failure> {
    let text = files::read_own(file, LIMIT_BYTES).map_err(|e| Failure::system(file, "read", e))?;
    serde_json::from_slice(&text).map_err(Failure::refused).map_err(|failure| failure.about(file))
}

/// Text of a summary by way of a `Value`, which sorts its keys alphabetically as the file does; the struct's
/// fields are in reading order.
pub(super) fn text(summary: &impl Serialize) -> Result<String, Failure> {
    let value = serde_json::to_value(summary).map_err(Failure::refused)?;
    serde_json::to_string_pretty(&value).map_err(Failure::refused)
}
