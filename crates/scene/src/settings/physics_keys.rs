//! Physics that a scene file specifies, as input to the choice of the rest.

use crate::document::changes::{self, Change};
use crate::document::diagnostics::Diagnostics;
use crate::document::errors::SceneErrors;
use crate::document::keys::fidelity::{
    BETWEEN_BODIES, BOUNCES, EDGES, NODES, PLAN, Planning, SIDES, SURFACE, WHEELS,
};
use crate::document::keys::key::{DefaultValue, Key};
use crate::document::keys::kinds::Choice;
use crate::document::keys::scene::{FIDELITY_KEY, ROAD_KEY};
use crate::document::text::{read_text, without_position};
use artifact::settings::Fidelity;
use std::collections::BTreeSet;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// Physics specified by a scene file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PhysicsKeys {
    /// Party that chooses the unspecified physics.
    pub planning: Planning,
    /// Keys present in `[fidelity]`.
    pub keys: BTreeSet<String>,
    /// Whether the road is specified, present or not.
    pub road: bool,
}

/// Reads the physics that the scene in `path`, with the changes made, specifies.
/// [`read_changed`](crate::read_changed) reports its faults.
///
/// # Errors
/// The file cannot be read, or is not text.
pub fn physics_keys(path: &Path, changes: &[Change]) -> Result<PhysicsKeys, SceneErrors> {
    let text = read_text(path).map_err(|rule| without_position(path, rule))?;
    let diagnostics = Diagnostics::new(path, &text);
    let mut document = diagnostics.document();
    changes::apply(&mut document, changes, &diagnostics);
    Ok(of_document(&document))
}

fn of_document(document: &DeTable<'_>) -> PhysicsKeys {
    let fidelity = document.get(FIDELITY_KEY.name).and_then(|value| value.get_ref().as_table());
    let keys = fidelity.into_iter().flat_map(|table| table.keys()).map(|key| key.get_ref().to_string());
    let word = fidelity.and_then(|table| table.get(PLAN.name)).and_then(|value| word(value.get_ref()));
    PhysicsKeys {
        planning: if word == Some("accuracy") { Planning::ByAccuracy } else { Planning::AsSpecified },
        keys: keys.collect(),
        road: document.contains_key(ROAD_KEY.name),
    }
}

/// Keys of `[fidelity]` that paths depend on at any accuracy, with their values as in a file.
pub fn physics_settings(fidelity: &Fidelity) -> Vec<(&'static str, String)> {
    vec![
        (BOUNCES.name, fidelity.bounces.to_string()),
        setting(&EDGES, fidelity.edges),
        setting(&SURFACE, fidelity.surface),
        setting(&SIDES, fidelity.sides),
        setting(&NODES, fidelity.nodes),
        setting(&BETWEEN_BODIES, fidelity.between_bodies),
        setting(&WHEELS, fidelity.wheels),
    ]
}

fn setting<T: PartialEq>(key: &Key<Choice<T>, DefaultValue<T>>, value: T) -> (&'static str, String) {
    let words = (key.takes.0)();
    let word = words.into_iter().find(|(_, of_word)| *of_word == value).map_or("", |(word, _)| word);
    (key.name, format!("\"{word}\""))
}

fn word<'a>(value: &'a DeValue<'_>) -> Option<&'a str> {
    match value {
        DeValue::String(word) => Some(word),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> PhysicsKeys {
        of_document(&DeTable::parse_recoverable(text).0.into_inner())
    }

    #[test]
    fn keys_that_are_there_are_said_and_the_word_alone_hands_the_choice_over() {
        assert_eq!(of("name = \"a\""), PhysicsKeys::default());
        let said = of("[fidelity]\nbounces = 2\nplan = \"accuracy\"\n[road]\n");
        assert_eq!(said.planning, Planning::ByAccuracy);
        assert!(said.keys.contains("bounces") && !said.keys.contains("edges") && said.road);
        assert_eq!(of("[fidelity]\nplan = \"as-said\"").planning, Planning::AsSpecified);
    }
}
