//! Cache keys: what a stage's frame depends on, part by part, so that a plan can say which part changed.

use crate::stages::Stage;
use artifact::cube::CubeHeader;
use artifact::envelope::fingerprint;
use artifact::scene::{SceneFrame, SceneHeader};
use artifact::settings::Noise;

/// Everything that one frame of one stage depends on.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Key {
    /// Name and fingerprint of each part.
    pub(crate) parts: Vec<(String, String)>,
}

impl Key {
    fn of(stage: Stage, parts: Vec<(&str, String)>) -> Self {
        let sources = std::iter::once(("sources", stage.sources().to_owned()));
        Self { parts: sources.chain(parts).map(|(name, hash)| (name.to_owned(), hash)).collect() }
    }

    /// Name of the cached frame.
    pub(crate) fn id(&self) -> String {
        fingerprint(&self.parts)
    }

    /// Names of the parts that differ from `other`.
    pub(crate) fn changed_since(&self, other: &Self) -> Vec<&str> {
        self.parts.iter().filter(|part| !other.parts.contains(part)).map(|(name, _)| name.as_str()).collect()
    }
}

/// Scene stage: `files` are the scene file and the models it reads, name and content hash.
pub(crate) fn scene(files: &[(String, String)], overrides: &impl serde::Serialize) -> Key {
    Key::of(Stage::Scene, vec![("files", fingerprint(&files)), ("options", fingerprint(overrides))])
}

/// What all frames of a scene share, fingerprinted once: meshes are large.
pub(crate) struct SceneParts {
    bodies: String,
    radar: String,
    fidelity: String,
}

impl SceneParts {
    pub(crate) fn of(header: &SceneHeader) -> Self {
        Self {
            bodies: fingerprint(&(&header.meshes, &header.targets, &header.materials, &header.road)),
            radar: fingerprint(&header.radar),
            fidelity: fingerprint(&header.fidelity),
        }
    }
}

/// Keys of one frame along the chain.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FrameKeys {
    pub(crate) bart_rcs: Key,
    pub(crate) fmcw_echo: Key,
    pub(crate) dsp: Key,
    /// `None` without a model.
    pub(crate) classifier: Option<Key>,
}

impl FrameKeys {
    pub(crate) fn of(header: &SceneHeader, parts: &SceneParts, frame: &SceneFrame, model: Option<&str>) -> Self {
        let bart_rcs = bart_rcs(parts, frame);
        let fmcw_echo = fmcw_echo(header, parts, &bart_rcs, frame);
        let dsp = Key::of(Stage::Dsp, vec![("echo", fmcw_echo.id()), ("dsp settings", fingerprint(&header.dsp))]);
        let of_model = |model: &str| Key::of(Stage::Classifier, vec![("maps", dsp.id()), ("model", model.to_owned())]);
        let classifier = model.map(of_model);
        Self { bart_rcs, fmcw_echo, dsp, classifier }
    }

    pub(crate) fn get(&self, stage: Stage) -> Option<&Key> {
        match stage {
            Stage::Scene => None,
            Stage::BartRcs => Some(&self.bart_rcs),
            Stage::FmcwEcho => Some(&self.fmcw_echo),
            Stage::Dsp => Some(&self.dsp),
            Stage::Classifier => self.classifier.as_ref(),
        }
    }
}

fn bart_rcs(parts: &SceneParts, frame: &SceneFrame) -> Key {
    let poses = fingerprint(&(frame.index, frame.time_s, &frame.poses));
    let parts = [("bodies", &parts.bodies), ("radar", &parts.radar), ("fidelity", &parts.fidelity), ("poses", &poses)];
    Key::of(Stage::BartRcs, parts.map(|(name, hash)| (name, hash.clone())).to_vec())
}

fn fmcw_echo(header: &SceneHeader, parts: &SceneParts, scattering: &Key, frame: &SceneFrame) -> Key {
    // Windows enter only where the noise is told as a ratio in the windowed map.
    let windows = match header.noise {
        Noise::SnrDb(_) => fingerprint(&(header.dsp.range_window, header.dsp.doppler_window)),
        Noise::Absent | Noise::Figure { .. } => String::new(),
    };
    let noise = fingerprint(&(header.noise, header.seed, frame.index, windows));
    Key::of(
        Stage::FmcwEcho,
        vec![("scattering", scattering.id()), ("radar", parts.radar.clone()), ("noise and seed", noise)],
    )
}

/// What a detector may know of a scene.
pub(crate) fn cube_header(header: &SceneHeader) -> CubeHeader {
    CubeHeader { radar: header.radar.clone(), noise: header.noise, dsp: header.dsp.clone() }
}
