//! Changes that one run makes to a scene.

use std::path::PathBuf;

/// Changes that one run makes to a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadOptions {
    /// Replaces the model of every mesh target, with its scale and seed: a file in metres or the name of one
    /// of the project's vehicles. Unlike paths in a scene, this one is relative to the working directory.
    /// Clutter and recorded traffic keep their models.
    pub model: Option<PathBuf>,
    /// Id of the radar with which the scene is read; `None` if it has only one.
    pub radar: Option<String>,
    /// Whether the models are opened.
    pub meshes: MeshLoading,
}

impl ReadOptions {
    /// The scene as in its file, with whole meshes.
    pub const fn whole() -> Self {
        Self { model: None, radar: None, meshes: MeshLoading::Whole }
    }

    /// The scene as in its file, its models unopened.
    pub const fn names_only() -> Self {
        Self { model: None, radar: None, meshes: MeshLoading::NamesOnly }
    }
}

/// Extent to which the scene's models are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshLoading {
    /// Meshes with their triangles.
    Whole,
    /// Names of the models only, with empty meshes: for callers that need only the radar and the settings.
    NamesOnly,
}
