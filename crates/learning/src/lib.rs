//! The way from a recipe to a classifier's model: datasets of labelled signatures and crops, training on
//! them, and evaluation (`docs/datasets.md`, `docs/classification.md`).
//!
//! Each room has a function `run` with its settings; lines of results go to a listener, and the figures of
//! a page are returned.
//!
//! Read the rooms below in their order; each uses only those before it.

pub mod dataset; // recipes to labelled signatures and crops
pub mod training; // datasets to a model
pub mod evaluation; // accuracy of a model
pub mod protocols; // accuracy of learners on unseen scenes and vehicles
