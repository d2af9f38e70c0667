//! The five stages, as named in plans and in the cache.

use serde::{Deserialize, Serialize};

/// Hash of the sources of `evaluation` and of the leaf crates that it uses, made by `build.rs`; used in keys
/// of cached errors.
pub const SOURCES_OF_EVALUATION: &str = env!("SOURCES_OF_EVALUATION");

/// A stage of the chain; JSON holds its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// Scene files and the bodies in them.
    Scene,
    /// Scattering.
    BartRcs,
    /// Echoes and noise.
    FmcwEcho,
    /// Range-Doppler maps, points and objects.
    Dsp,
    /// Classes of objects.
    Classifier,
}

impl Stage {
    /// All stages, in the order of the chain.
    pub const ALL: [Self; 5] = [Self::Scene, Self::BartRcs, Self::FmcwEcho, Self::Dsp, Self::Classifier];

    /// Name of the stage in `summary.json` and the cache's folders.
    pub fn name(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::BartRcs => "bart_rcs",
            Self::FmcwEcho => "fmcw_echo",
            Self::Dsp => "dsp",
            Self::Classifier => "classifier",
        }
    }

    /// Hash of the stage's sources and of those of `artifact`, made by `build.rs`.
    pub fn sources(self) -> &'static str {
        match self {
            Self::Scene => env!("SOURCES_OF_SCENE"),
            Self::BartRcs => env!("SOURCES_OF_BART_RCS"),
            Self::FmcwEcho => env!("SOURCES_OF_FMCW_ECHO"),
            Self::Dsp => env!("SOURCES_OF_DSP"),
            Self::Classifier => env!("SOURCES_OF_CLASSIFIER"),
        }
    }
}
