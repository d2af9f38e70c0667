//! `[[clutter]]`: what stands about in a street, of its own making or from a file. It scatters and hides as targets do, and stands
//! still.

use crate::document::Section;
use crate::errors::{Allowed, Rule};
use crate::models::Models;
use crate::radar::COORDINATES_M;
use crate::street::Piece;
use artifact::scene::{Pose, Role, Target, TargetKind};

/// The scene's clutter; pieces that break a rule are noted and left out.
pub(crate) fn read_clutter(sections: &[Section<'_>], ids: &[Option<&str>], models: &mut Models) -> Vec<Target> {
    sections.iter().zip(ids).filter_map(|(section, id)| read_piece(section, *id, models)).collect()
}

fn read_piece(section: &Section<'_>, id: Option<&str>, models: &mut Models) -> Option<Target> {
    section.require("model");
    section.require("position_m");
    let position_m = section.vector("position_m", COORDINATES_M);
    // As targets that stand still: down the road.
    let yaw_deg = section.number("yaw_deg", Allowed::Between(-360.0, 360.0)).unwrap_or(-90.0);
    let chosen = models.choose_clutter(section, section.text("model")?)?;
    let start = Pose {
        position_m: position_m?,
        yaw_rad: yaw_deg.to_radians(),
        velocity_mps: [0.0; 3],
        acceleration_mps2: [0.0; 3],
    };
    let kind = TargetKind::Mesh { class: None, model: chosen.name, mesh: chosen.mesh };
    Some(Target { id: id?.to_owned(), role: Role::Clutter, kind, start })
}

/// The piece of that name in the size that the section gives; `None` for any other name, or where a size is wrong or missing.
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
        "sign" => Some(Piece::Sign { height_m: size(section, "height_m", Allowed::Between(0.7, 20.0), 2.85)? }),
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
