//! From a recipe to a classifier's model: datasets of labelled signatures and crops, what learns from them,
//! and how right it is (`docs/datasets.md`, `docs/classification.md`).
//!
//! Each room has a function `run` and its `Settings`; lines of results go to whoever listens, figures that a
//! page holds are handed back.
//!
//! Reading order is that of the rooms below; each uses only those that stand before it.

pub mod dataset; // recipes to labelled signatures and crops
pub mod training; // datasets to a model
pub mod evaluation; // how often a model is right
pub mod protocols; // how right learners are on scenes and vehicles that they never saw
