//! A piece of street furniture in the size given by a table.

use crate::document::errors::Rule;
use crate::document::keys::bodies::{DIAMETER, HEIGHT, LENGTH, POLE_HEIGHT, SIGN_HEIGHT, UNIT_SCALE};
use crate::document::keys::key::{DefaultValue, Key};
use crate::document::keys::kinds::Number;
use crate::document::section::Section;
use bodies::street::Furniture;

/// The piece of that name in the size given by the section; `None` for any other name, or if a size is wrong
/// or missing.
pub(crate) fn read_size(section: &Section<'_>, name: &str) -> Option<Furniture> {
    let (used, owner): (&[&str], _) = match name {
        "pole" => (&[HEIGHT.name, DIAMETER.name], "a pole"),
        "sign" => (&[HEIGHT.name], "a sign"),
        "guard-rail" => (&[LENGTH.name], "a guard rail"),
        _ => (&[LENGTH.name], "a kerb"),
    };
    for key in [LENGTH.name, HEIGHT.name, DIAMETER.name, UNIT_SCALE.name] {
        if section.has(key) && !used.contains(&key) {
            section.note(key, Rule::Misplaced { key, owner });
        }
    }
    match name {
        "pole" => Some(Furniture::Pole {
            height_m: size(section, &POLE_HEIGHT)?,
            diameter_m: size(section, &DIAMETER)?,
        }),
        "sign" => Some(Furniture::Sign { height_m: size(section, &SIGN_HEIGHT)? }),
        "guard-rail" => Some(Furniture::GuardRail { length_m: length(section)? }),
        "kerb" => Some(Furniture::Kerb { length_m: length(section)? }),
        _ => None,
    }
}

/// Reads a size; `None` only if the value is wrong.
fn size(section: &Section<'_>, key: &Key<Number, DefaultValue<f64>>) -> Option<f64> {
    if section.has(key.name) { section.read(key) } else { Some(key.absent.0) }
}

fn length(section: &Section<'_>) -> Option<f64> {
    section.require(LENGTH.name);
    section.read(&LENGTH)
}
