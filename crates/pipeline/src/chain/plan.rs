//! Plan of every frame, from the requested result to the missing data: which stages run and why.

use crate::chain::cache::Cache;
use crate::chain::keys::FrameKeys;
use crate::chain::stages::Stage;
use artifact::Schema;
use artifact::classes::Classes;
use artifact::cube::Cube;
use artifact::paths::Paths;
use artifact::points::Points;
use artifact::rcs::Rcs;
use artifact::scene::SceneHeader;
use artifact::settings::EchoMode;

/// Stages that run per frame.
const PER_FRAME: [Stage; 4] = [Stage::BartRcs, Stage::FmcwEcho, Stage::Dsp, Stage::Classifier];

/// Plan of one frame: its keys, and which stages run.
pub struct FramePlan {
    /// Number of the frame, from 0.
    pub index: u32,
    /// Keys of its stages.
    pub keys: FrameKeys,
    /// Each stage of the run, with `None` if its frame is cached, otherwise the reason why it runs.
    pub(crate) steps: Vec<(Stage, Option<String>)>,
}

impl FramePlan {
    /// Looks up the frame of each stage; `cache` is `None` with `--no-cache`.
    pub(crate) fn of(cache: Option<&Cache>, header: &SceneHeader, index: u32, keys: FrameKeys) -> Self {
        let reason = |stage: &Stage| (*stage, why_it_runs(cache, header, index, *stage, &keys));
        let steps = PER_FRAME.iter().filter(|stage| keys.get(**stage).is_some()).map(reason).collect();
        Self { index, keys, steps }
    }

    /// Whether the stage's frame must be computed.
    pub(crate) fn runs(&self, stage: Stage) -> bool {
        self.steps.iter().any(|(s, why)| *s == stage && why.is_some())
    }

    /// A line for each stage.
    pub fn explained(&self) -> Vec<String> {
        let line = |(stage, why): &(Stage, Option<String>)| {
            let verdict = why.as_ref().map_or("cached".into(), |why| format!("runs: {why}"));
            format!("frame {} {}: {verdict}", self.index, stage.name())
        };
        self.steps.iter().map(line).collect()
    }
}

/// File kind of a stage's cached frame.
pub(crate) fn kind(stage: Stage, mode: EchoMode) -> &'static str {
    match (stage, mode) {
        (Stage::Scene, _) => artifact::scene::Scene::NAME,
        (Stage::BartRcs, EchoMode::Paths) => Paths::NAME,
        (Stage::BartRcs, EchoMode::RcsTable) => Rcs::NAME,
        (Stage::FmcwEcho, _) => Cube::NAME,
        (Stage::Dsp, _) => Points::NAME,
        (Stage::Classifier, _) => Classes::NAME,
    }
}

fn why_it_runs(
    cache: Option<&Cache>,
    header: &SceneHeader,
    index: u32,
    stage: Stage,
    keys: &FrameKeys,
) -> Option<String> {
    let key = keys.get(stage)?;
    let Some(cache) = cache else { return Some("--no-cache".into()) };
    let maps_missing = stage == Stage::Dsp && !cache.holds(stage, key, artifact::rdm::Rdm::NAME);
    if cache.holds(stage, key, kind(stage, header.fidelity.echo)) && !maps_missing {
        return None;
    }
    let last = cache.last_key(stage, &header.name, index);
    Some(match last.as_ref().map(|last| key.changed_since(last)) {
        None => "never computed for this scene".into(),
        Some(parts) if parts.is_empty() => "its cached frame was removed".into(),
        Some(parts) => format!("changed: {}", parts.join(", ")),
    })
}
