//! What one run changes in a scene.

use std::path::PathBuf;

/// What one run changes in a scene.
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

/// What is read of the models that a scene names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meshes {
    /// All of them.
    Whole,
    /// Their names: each mesh stays empty. For those who need the radar and the settings only.
    NamesOnly,
}
