//! Objects against truth over a dataset of single vehicles.

use super::scene_files::{place_of, text_of, with_key};
use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{CHAIN, RUN, SourcePaths};
use wayside::Allowance;
use wayside::host::failure::Failure;
use wayside::host::files;
use wayside::host::progress::note;
use wayside::learning::dataset::{self, DatasetSettings, Task};

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[
    CHAIN,
    RUN,
    &["crates/learning/src/dataset", "crates/learning/src/dataset.rs"],
    &["scenes/vehicles.dataset.toml", "scenes/training/3x4.toml", file!()],
];

const RECIPE: &str = "vehicles.dataset";
const SCENES_PER_CLASS: u64 = 60;

/// The table that `cargo xtask dataset` writes beside its shards.
pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let folder = tempfile::tempdir().map_err(|e| Failure::System(format!("no temporary folder: {e}")))?;
    let (recipe, out) = (folder.path().join("recipe.toml"), folder.path().join("vehicles"));
    files::write_file(&recipe, recipe_of(extent)?.as_bytes())?;
    dataset::run(&DatasetSettings {
        recipe,
        out: out.clone(),
        seed: None,
        task: Task::Make { shard: [1, 1] },
        memory: Allowance::of(None),
        tell: &|line| note(format!("dataset: {line}")),
    })?;
    let table = out.join("detection.md");
    let text = std::fs::read_to_string(&table).map_err(|e| Failure::system(&table, "read", e))?;
    let mut part = PageSection::default();
    part.line(text.trim_end());
    Ok(part)
}

/// The recipe with this many scenes of each class.
fn recipe_of(extent: Extent) -> Result<String, Failure> {
    let scene = format!("{:?}", place_of("intersection"));
    let recipe = with_key(&text_of(RECIPE)?, "", "scene", scene);
    Ok(with_key(&recipe, "", "scenes_per_class", extent.case_count(SCENES_PER_CLASS)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_recipe_has_the_scenes_of_its_file() {
        let scenes = format!("scenes_per_class = {SCENES_PER_CLASS} ");
        assert!(text_of(RECIPE).unwrap().contains(&scenes));
        assert!(recipe_of(Extent::Quick).unwrap().contains("scenes_per_class = 2\n"));
    }
}
