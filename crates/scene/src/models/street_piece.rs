//! A piece of street furniture in the size that a table gives.

use crate::bodies::street::Piece;
use crate::document::errors::Rule;
use crate::document::section::Section;
use crate::wording::allowed::Allowed;

/// The piece of that name in the size that the section gives; `None` for any other name, or where a size is
/// wrong or missing.
pub(crate) fn read_size(section: &Section<'_>, name: &str) -> Option<Piece> {
    let (used, owner): (&[&str], _) = match name {
        "pole" => (&["height_m", "diameter_m"], "a pole"),
        "sign" => (&["height_m"], "a sign"),
        "guard-rail" => (&["length_m"], "a guard rail"),
        _ => (&["length_m"], "a kerb"),
    };
    for key in ["length_m", "height_m", "diameter_m", "unit_scale"] {
        if section.has(key) && !used.contains(&key) {
            section.note(key, Rule::Misplaced { key, owner });
        }
    }
    match name {
        // A lamp's column of a tube of ISO 4200's series; from a cane to a gantry's leg.
        "pole" => Some(Piece::Pole {
            height_m: size(section, "height_m", Allowed::Between(0.1, 100.0), 6.0)?,
            diameter_m: size(section, "diameter_m", Allowed::Between(0.01, 5.0), 0.1143)?,
        }),
        // The plate's lower edge 2.25 m over a footway.
        "sign" => {
            Some(Piece::Sign { height_m: size(section, "height_m", Allowed::Between(0.7, 20.0), 2.85)? })
        }
        "guard-rail" => Some(Piece::GuardRail { length_m: length(section)? }),
        "kerb" => Some(Piece::Kerb { length_m: length(section)? }),
        _ => None,
    }
}

/// `None` only where what is written is wrong.
fn size(section: &Section<'_>, key: &'static str, allowed: Allowed, otherwise: f64) -> Option<f64> {
    if section.has(key) { section.number(key, allowed) } else { Some(otherwise) }
}

fn length(section: &Section<'_>) -> Option<f64> {
    section.require("length_m");
    section.number("length_m", Allowed::Between(0.2, 1000.0))
}
