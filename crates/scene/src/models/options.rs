//! Changes that one run makes to a scene.

use std::path::PathBuf;

/// Changes that one run makes to a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadOptions {
    /// Takes the place of the model of every mesh target: a file or the name of one of the project's
    /// vehicles. Unlike the paths inside a scene this one starts at the working directory.
    pub model: Option<PathBuf>,
    /// Through which of the scene's radars it is read; `None` where it has but one.
    pub radar: Option<String>,
    /// Whether the models are opened.
    pub meshes: Meshes,
}

impl ReadOptions {
    /// The scene as its file says it, with whole meshes.
    pub const fn whole() -> Self {
        Self { model: None, radar: None, meshes: Meshes::Whole }
    }

    /// The scene as its file says it, its models unopened.
    pub const fn names_only() -> Self {
        Self { model: None, radar: None, meshes: Meshes::NamesOnly }
    }
}

/// Extent to which the models that a scene names are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meshes {
    /// Meshes with their triangles.
    Whole,
    /// Names of the models only: each mesh stays empty. For those who need the radar and the settings only.
    NamesOnly,
}
