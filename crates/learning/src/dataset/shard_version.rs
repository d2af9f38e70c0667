//! Version of the program that makes shards, by its sources: shards of different versions do not form a
//! dataset.

use artifact::envelope::fingerprint;
use pipeline::chain::stages::{SOURCES_OF_EVALUATION, Stage};

/// Sources that draw scenes and write samples and lines.
const OWN_SOURCES: [&str; 14] = [
    include_str!("draws.rs"),
    include_str!("lines.rs"),
    include_str!("placement.rs"),
    include_str!("recipe.rs"),
    include_str!("recipe/document.rs"),
    include_str!("recipe/keys.rs"),
    include_str!("recipe/manifest.rs"),
    include_str!("recipe/models.rs"),
    include_str!("recipe/rules.rs"),
    include_str!("observed_frame.rs"),
    include_str!("scene_line.rs"),
    include_str!("shard.rs"),
    include_str!("computed_scene.rs"),
    include_str!("staging.rs"),
];

/// Version of the program, and the beginning of the hash of all sources that a shard depends on.
pub(super) fn shard_version() -> String {
    let stages = Stage::ALL.map(Stage::sources);
    let sources = fingerprint(&(stages, SOURCES_OF_EVALUATION, OWN_SOURCES));
    format!("{}+{}", env!("CARGO_PKG_VERSION"), sources.chars().take(16).collect::<String>())
}
