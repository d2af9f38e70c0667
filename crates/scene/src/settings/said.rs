//! Physics that a scene file specifies, as input to the choice of the rest.

use crate::document::changes::{self, Change};
use crate::document::errors::SceneErrors;
use crate::document::faults::Faults;
use crate::document::keys::fidelity::{
    BETWEEN_BODIES, BOUNCES, EDGES, NODES, PLAN, Planning, SIDES, SURFACE, WHEELS,
};
use crate::document::keys::key::{Key, Or};
use crate::document::keys::kinds::Words;
use crate::document::keys::scene::{OF_FIDELITY, OF_ROAD};
use crate::document::text::{at_no_place, read_text};
use artifact::settings::Fidelity;
use std::collections::BTreeSet;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// Physics specified by a scene file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SaidPhysics {
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
pub fn said_physics(path: &Path, changes: &[Change]) -> Result<SaidPhysics, SceneErrors> {
    let text = read_text(path).map_err(|rule| at_no_place(path, rule))?;
    let faults = Faults::new(path, &text);
    let mut document = faults.document();
    changes::make(&mut document, changes, &faults);
    Ok(of_document(&document))
}

fn of_document(document: &DeTable<'_>) -> SaidPhysics {
    let fidelity = document.get(OF_FIDELITY.name).and_then(|value| value.get_ref().as_table());
    let keys = fidelity.into_iter().flat_map(|table| table.keys()).map(|key| key.get_ref().to_string());
    let word = fidelity.and_then(|table| table.get(PLAN.name)).and_then(|value| word(value.get_ref()));
    SaidPhysics {
        planning: if word == Some("accuracy") { Planning::ByAccuracy } else { Planning::AsSaid },
        keys: keys.collect(),
        road: document.contains_key(OF_ROAD.name),
    }
}

/// Keys of `[fidelity]` that paths depend on at any accuracy, with their values as in a file.
pub fn told_physics(fidelity: &Fidelity) -> Vec<(&'static str, String)> {
    vec![
        (BOUNCES.name, fidelity.bounces.to_string()),
        told(&EDGES, fidelity.edges),
        told(&SURFACE, fidelity.surface),
        told(&SIDES, fidelity.sides),
        told(&NODES, fidelity.nodes),
        told(&BETWEEN_BODIES, fidelity.between_bodies),
        told(&WHEELS, fidelity.wheels),
    ]
}

fn told<T: PartialEq>(key: &Key<Words<T>, Or<T>>, value: T) -> (&'static str, String) {
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

    fn of(text: &str) -> SaidPhysics {
        of_document(&DeTable::parse_recoverable(text).0.into_inner())
    }

    #[test]
    fn keys_that_are_there_are_said_and_the_word_alone_hands_the_choice_over() {
        assert_eq!(of("name = \"a\""), SaidPhysics::default());
        let said = of("[fidelity]\nbounces = 2\nplan = \"accuracy\"\n[road]\n");
        assert_eq!(said.planning, Planning::ByAccuracy);
        assert!(said.keys.contains("bounces") && !said.keys.contains("edges") && said.road);
        assert_eq!(of("[fidelity]\nplan = \"as-said\"").planning, Planning::AsSaid);
    }
}
