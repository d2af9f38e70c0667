//! A dataset's recipe, `SPEC.toml`; its keys are in `docs/datasets.md`.

mod keys;
mod error;
mod manifest;
mod models;
mod document;
mod rules;

pub(super) use document::Base;
pub(super) use keys::{FRAMES_LIMIT, VEHICLES_LIMIT};
pub(super) use models::Model;
pub(super) use rules::NEAREST_ALONG_M;

use artifact::bounded;
use artifact::scene::SceneHeader;
use artifact::settings::Class;
use document::Document;
use error::RecipeError;
use models::ModelFiles;
use pipeline::chain::loading;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use pipeline::planning;
use scene::document::diagnostics::Diagnostics;
use scene::document::section::Section;
use std::collections::BTreeMap;
use std::path::Path;

/// Largest recipe, a page of text.
const LIMIT_BYTES: u64 = 4 << 20;

/// A recipe, checked.
pub(super) struct Recipe {
    /// Content of the recipe's file, which determines the draws.
    pub(super) document: Document,
    pub(super) bases: Vec<Base>,
    pub(super) models: BTreeMap<Class, Vec<Model>>,
    pub(super) seed: u64,
    /// Files of the recipe with their hashes; the recipe itself first.
    pub(super) inputs: Vec<(String, String)>,
    pub(super) text: String,
}

impl Recipe {
    /// The recipe in `file`; every rule that it breaks is told, not only the first.
    pub(super) fn read(file: &Path, seed: Option<u64>) -> Result<Self, Failure> {
        let read = || bounded::read_text(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault));
        let (text, mut inputs) = loading::read_hashed(&[file.to_owned()], read)?;
        let (document, bases, named) = read_document(file, &text, &mut inputs)?;
        let headers: Vec<&SceneHeader> = bases.iter().map(|base| &base.header).collect();
        let models = models::read(named, &headers, &mut inputs).map_err(|failure| failure.named_in(file))?;
        let seed = seed.unwrap_or(document.seed);
        Ok(Self { inputs, document, bases, models, seed, text })
    }

    /// Whether a recipe of that text, read from those inputs, draws the same scenes; their number may differ,
    /// because additional scenes leave the first ones unchanged.
    pub(super) fn draws_as(&self, text: &str, inputs: &[(String, String)]) -> bool {
        let open = |known: Document| Document { scenes_per_class: 0, ..known };
        let its = Document::of_text(text).map(open);
        let is_same = its.is_some_and(|its| its == open(self.document.clone()));
        // All but the recipe's own, which is open above. A model is called as its file is.
        is_same && inputs.get(1..) == self.inputs.get(1..)
    }
}

/// The recipe's content, its base scenes, and its models by their names.
fn read_document(
    file: &Path,
    text: &str,
    inputs: &mut Vec<(String, String)>,
) -> Result<(Document, Vec<Base>, ModelFiles), Failure> {
    let faults = Diagnostics::of_tables(file, text, keys::TABLES);
    let toml_document = faults.document();
    let root = Section::root(&toml_document, &keys::RECIPE, &faults);
    let of_models = root.section(&keys::MODELS);
    let document = Document::of(&root, &of_models);
    rules::check_alone(&root, &document);
    let bases = bases(file, &document, &root, inputs);
    for base in bases.iter().flatten() {
        rules::check_before(&root, &document, base);
    }
    let folder = file.parent().unwrap_or(Path::new("."));
    let listed = models::listed(&document.models, file, inputs);
    let named = listed.map(|listed| models::named(&document.models, listed, folder, &of_models));
    // What the recipe says wrongly is told before what stands in the files that it names.
    faults.into_errors().map_err(loading::scene_failure)?;
    Ok((document, bases?, named?))
}

/// The base scenes, without those of several radars, which are noted; `inputs` gets the files that they were
/// read from, with hashes.
fn bases(
    file: &Path,
    document: &Document,
    root: &Section<'_>,
    inputs: &mut Vec<(String, String)>,
) -> Result<Vec<Base>, Failure> {
    let named = |failure: Failure| failure.named_in(file);
    let folder = file.parent().unwrap_or(Path::new("."));
    let key = if root.has(keys::SCENE.name) { keys::SCENE.name } else { keys::SCENES.name };
    let mut bases = Vec::new();
    for (number, written) in document.scenes.iter().enumerate() {
        let scene = folder.join(written);
        let radars = scene::radars(&scene).map_err(loading::scene_failure).map_err(named)?;
        if !radars.is_empty() {
            let scene = written.display().to_string();
            root.note_element(key, number, RecipeError::SeveralRadars { key, scene, radars }.into());
            continue;
        }
        let files = loading::files_of_radar(&scene).map_err(named)?;
        let (base, hashed) = loading::read_hashed(&files, || base(&scene)).map_err(named)?;
        bases.push(base);
        inputs.extend(hashed);
    }
    Ok(bases)
}

fn base(scene: &Path) -> Result<Base, Failure> {
    let name = scene.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let unplanned = planning::unplanned(scene, "a dataset")?;
    unplanned.into_iter().for_each(|sentence| progress::note(format!("note: {sentence}")));
    Ok(Base { name, header: loading::radar_only(scene, None)? })
}

#[cfg(test)]
mod tests {
    use super::*;

    const BASE: &str = "name = \"base\"\nframe_interval_s = 0.001\n[radar.waveform]\nchirps = 64\n";

    const NEEDED: &str = "scene = \"base.toml\"\nseed = 1\nscenes_per_class = 1\nrange_m = [30.0, 30.0]\n\
speed_mps = [1.0, 5.0]\nlanes = [2]\n";

    /// Refusal of a recipe with these keys, if any.
    fn refusal(base: &str, keys: &str) -> Option<String> {
        let folder = tempfile::tempdir().unwrap();
        let spec = folder.path().join("spec.toml");
        std::fs::write(folder.path().join("base.toml"), base).unwrap();
        std::fs::write(&spec, format!("{NEEDED}{keys}\n[models]\ncar = [\"car-hatchback\"]\n")).unwrap();
        Recipe::read(&spec, None).err().map(|failure| failure.to_string())
    }

    #[test]
    fn frames_that_overlap_at_the_interval_of_the_base_scene_are_refused() {
        let refused = refusal(BASE, "frames = 2").unwrap();
        assert!(refused.contains("spec.toml:7:10: `frames` follow each other every 0.001 s"), "{refused}");
        assert_eq!(refusal(BASE, ""), None, "one frame follows no other");
        assert_eq!(refusal(BASE, "frames = 2\nframe_interval_s = 0.1"), None);
        // Both sub-frames are of one cycle; the third is of the next.
        let cycle = format!("{BASE}sub_frame_idle_us = [10.0, 37.0]\n");
        assert_eq!(refusal(&cycle, "frames = 2"), None);
        assert!(refusal(&cycle, "frames = 3").is_some());
    }
}
