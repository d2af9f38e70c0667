//! `[[clutter]]`: what stands about in a street, of its own making or from a file. It scatters and hides as
//! targets do, and stands still.

use crate::document::keys::bodies::{CLUTTER_MODEL, CLUTTER_POSITION, CLUTTER_YAW};
use crate::document::section::Section;
use crate::models::library::Models;
use artifact::scene::{Pose, Role, Target, TargetKind};

/// The scene's clutter; pieces that break a rule are noted and left out.
pub(crate) fn read_clutter(
    sections: &[Section<'_>],
    ids: &[Option<&str>],
    models: &mut Models,
) -> Vec<Target> {
    sections.iter().zip(ids).filter_map(|(section, id)| read_piece(section, *id, models)).collect()
}

fn read_piece(section: &Section<'_>, id: Option<&str>, models: &mut Models) -> Option<Target> {
    section.require(CLUTTER_MODEL.name);
    section.require(CLUTTER_POSITION.name);
    let position_m = section.read(&CLUTTER_POSITION);
    let yaw_deg = section.or_default(&CLUTTER_YAW);
    let chosen = models.choose_clutter(section, section.read(&CLUTTER_MODEL)?)?;
    let start = Pose {
        position_m: position_m?,
        yaw_rad: yaw_deg.to_radians(),
        yaw_radps: 0.0,
        velocity_mps: [0.0; 3],
        acceleration_mps2: [0.0; 3],
    };
    let kind = TargetKind::Mesh { class: None, model: chosen.name, mesh: chosen.mesh };
    Some(Target { id: id?.to_owned(), role: Role::Clutter, kind, start })
}
