//! The text of a file, and what is said where there is none.

use crate::document::errors::{Place, Rule, SceneError, SceneErrors};
use artifact::bounded;
use std::path::Path;

/// A scene is a page of text; more than this is another file given by mistake.
const LIMIT_BYTES: u64 = 4 << 20;

/// The whole text, or the rule that it breaks.
pub(crate) fn read_text(path: &Path) -> Result<String, Rule> {
    bounded::read_text(path, LIMIT_BYTES).map_err(Rule::File)
}

/// A rule that no line of a file breaks, as the only one.
pub(crate) fn at_no_place(path: &Path, rule: Rule) -> SceneErrors {
    SceneErrors(vec![SceneError { file: path.to_owned(), position: None, place: Place::Scene, rule }], 0)
}
