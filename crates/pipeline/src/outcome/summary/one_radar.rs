//! A scene through one radar: the whole file, its way to text and back.

use crate::host::failure::Failure;
use crate::host::files;
use crate::outcome::summary::frame::FrameSummary;
use crate::outcome::summary::radar::{LaneSummary, RadarSummary};
use crate::outcome::summary::words::StaticWord;
use crate::planning::plan_figures::PlanFigures;
use artifact::scene::SceneHeader;
use artifact::settings::StaticEchoes;
use evaluation::Metrics;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// A hundred thousand frames of ten targets.
const LIMIT_BYTES: u64 = 1 << 30;

/// Summary of a scene through one radar.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// The scene's name; with several radars `<scene>/<radar>`.
    pub scene: String,
    /// Seed of the noise and of all that is random.
    pub seed: u64,
    /// Wall-clock time from the first frame's begin to the last picture's end, s.
    pub frames_seconds: f64,
    /// Processor time of all threads within `frames_seconds`, s; `None` where the system does not tell.
    pub frames_processor_seconds: Option<f64>,
    /// Names of lanes by their numbers; empty where the scene has no lanes.
    pub lanes: Vec<LaneSummary>,
    /// Treatment of echoes at rest: kept, marked or removed.
    #[serde(rename = "static", with = "StaticWord")]
    pub static_echoes: StaticEchoes,
    /// Waveform, array size and limits of the radar.
    pub radar: RadarSummary,
    /// Plan by which the physics was chosen; `None`, and not in the file, where the scene says all itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plan: Option<PlanFigures>,
    /// Summaries of the frames, in order.
    pub frames: Vec<FrameSummary>,
    /// Objects and tracks beside the truth, over all frames.
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

    /// Reads a `summary.json` of one radar; keys that are not known are passed over.
    ///
    /// # Errors
    /// The file is unreadable, or is no such summary.
    pub fn read(file: &Path) -> Result<Self, Failure> {
        let text = files::read_own(file, LIMIT_BYTES).map_err(|e| Failure::system(file, "read", e))?;
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

/// Whether a text is a `summary.json`, of one radar or several, by its outermost keys; an empty one holds
/// nothing of anybody's.
pub fn is_summary(text: &[u8]) -> bool {
    let keys: BTreeMap<String, IgnoredAny> = serde_json::from_slice(text).unwrap_or_default();
    let has = |key: &str| keys.contains_key(key);
    text.is_empty() || has("scene") && has("frames") && (has("radar") || has("radars"))
}

/// Text of a summary by way of a `Value`, which has its keys in alphabetical order, as the file has them:
/// fields stand in the order in which they are read.
pub(super) fn text(summary: &impl Serialize) -> Result<String, Failure> {
    let value = serde_json::to_value(summary).map_err(Failure::refused)?;
    serde_json::to_string_pretty(&value).map_err(Failure::refused)
}
