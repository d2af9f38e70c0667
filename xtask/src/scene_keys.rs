//! `scene-keys`: outputs of the keys of scenes, for readers and for editors.

use crate::project::project_root;
use wayside::Failure;
use wayside::host::files;

/// Writes the tables of `docs/scenes.md` and the whole of `docs/scene.schema.json`.
pub(crate) fn run() -> Result<(), Failure> {
    let docs = project_root().join("docs");
    let page = docs.join("scenes.md");
    let text = std::fs::read_to_string(&page).map_err(|e| Failure::system(&page, "read", e))?;
    files::write_file(&page, scene::keys::with_tables(&text).as_bytes())?;
    let schema = format!("{:#}\n", scene::keys::json_schema());
    files::write_file(&docs.join("scene.schema.json"), schema.as_bytes())
}
