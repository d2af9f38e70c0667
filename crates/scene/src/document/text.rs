//! The text of a file, and the errors if it cannot be read.

use crate::document::errors::{Place, Rule, SceneError, SceneErrors};
use artifact::bounded;
use std::path::Path;

/// Largest scene, a page of text; a larger file is another one given by mistake.
const LIMIT_BYTES: u64 = 4 << 20;

/// Reads the whole text, or returns the broken rule.
pub(crate) fn read_text(path: &Path) -> Result<String, Rule> {
    bounded::read_text(path, LIMIT_BYTES).map_err(Rule::File)
}

/// Makes an error from a single rule that concerns no line of the file.
pub(crate) fn without_position(path: &Path, rule: Rule) -> SceneErrors {
    SceneErrors(vec![SceneError { file: path.to_owned(), position: None, place: Place::Scene, rule }], 0)
}
