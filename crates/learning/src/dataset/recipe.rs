//! A dataset's recipe, `SPEC.toml`; its keys are in `docs/datasets.md`.

mod error;
mod models;
mod document;
mod rules;

pub(super) use document::Base;
pub(super) use models::Model;
pub(super) use rules::{FRAMES_LIMIT, NEAREST_ALONG_M, VEHICLES_LIMIT};

use artifact::bounded;
use artifact::scene::SceneHeader;
use artifact::settings::Class;
use document::Document;
use error::RecipeError;
use pipeline::chain::loading;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use pipeline::host::toml_text;
use pipeline::planning;
use std::collections::BTreeMap;
use std::path::Path;

/// Largest recipe, a page of text.
const LIMIT_BYTES: u64 = 4 << 20;

/// A recipe, checked.
pub(super) struct Recipe {
    /// Content of the recipe's file, which determines the draws.
    pub(super) asked: Document,
    pub(super) bases: Vec<Base>,
    pub(super) models: BTreeMap<Class, Vec<Model>>,
    pub(super) seed: u64,
    /// Files of the recipe with their hashes; the recipe itself first.
    pub(super) inputs: Vec<(String, String)>,
    pub(super) text: String,
}

impl Recipe {
    pub(super) fn read(file: &Path, seed: Option<u64>) -> Result<Self, Failure> {
        let read = || bounded::read_text(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault));
        let (text, mut inputs) = loading::read_of(&[file.to_owned()], read)?;
        let refused = |error: RecipeError| Failure::refused(error).about(file);
        let asked: Document = toml_text::read(&text).map_err(|fault| refused(fault.into()))?;
        let named = |failure: Failure| failure.named_in(file);
        let folder = file.parent().unwrap_or(Path::new("."));
        let mut bases = Vec::new();
        for written in asked.base_scenes().map_err(refused)? {
            let scene = folder.join(written);
            let radars = scene::radars(&scene).map_err(loading::of_scene).map_err(named)?;
            if !radars.is_empty() {
                return Err(refused(asked.of_several_radars(written, radars)));
            }
            let files = loading::files_of_radar(&scene).map_err(named)?;
            let (base, hashed) = loading::read_of(&files, || base(&scene)).map_err(named)?;
            bases.push(base);
            inputs.extend(hashed);
        }
        rules::check(&asked, &bases).map_err(refused)?;
        let headers: Vec<&SceneHeader> = bases.iter().map(|base| &base.header).collect();
        let models = models::read(&asked.models, file, &headers, &mut inputs)?;
        let seed = seed.unwrap_or(asked.seed);
        Ok(Self { inputs, asked, bases, models, seed, text })
    }

    /// Whether a recipe of that text, read from those inputs, draws the same scenes; their number may differ,
    /// because additional scenes leave the first ones unchanged.
    pub(super) fn draws_as(&self, text: &str, inputs: &[(String, String)]) -> bool {
        let open = |text: &str| {
            toml_text::read::<Document>(text).map(|known| Document { scenes_per_class: 0, ..known })
        };
        let is_same = matches!((open(text), open(&self.text)), (Ok(its), Ok(own)) if its == own);
        // All but the recipe's own, which is open above. A model is called as its file is.
        is_same && inputs.get(1..) == self.inputs.get(1..)
    }
}

fn base(scene: &Path) -> Result<Base, Failure> {
    let name = scene.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let unplanned = planning::unplanned(scene, "a dataset")?;
    unplanned.into_iter().for_each(|sentence| progress::note(format!("note: {sentence}")));
    Ok(Base { name, header: loading::radar_only(scene, None)? })
}
