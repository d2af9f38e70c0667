//! Solids listed in a family's table: boxes, balls, drums, tubes and limbs in the metres of the nominal
//! drawing.
//!
//! Keys of a part: `solid` (box, ball, drum, tube, limb), `at` = [x, y, z], `size` = [length, width, height],
//! `round` (radius of a box's edges), `pitch_deg` (positive lowers the front), `yaw_deg`, `radius`, `length`
//! and `axis` of a drum, `path` of a tube (rows x, y, z) or a limb (rows x, y, z, half width, half height),
//! `material`, `pair` (with its mirror image), `chance`, `when` = "key=word" (only if the family's draw for
//! that key is the word), `repeat` and `step` = [x, y, z] (a row of them).

use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::solids::{
    bent, disc, ellipsoid, limb, pitched, rounded_box, section, smoothed, tube,
};
use crate::vehicles::drawing::surface::{Material, Surface};
use crate::vehicles::family::Parameters;
use glam::{DQuat, DVec3};

/// Adds the present parts, stretched from the nominal drawing to the drawn size.
pub(crate) fn add(family: &Parameters<'_>, stretch: DVec3, to: &mut Assembly) {
    for key in ["shared", "part"] {
        for part in family.tables(key).iter().filter(|part| is_there(family, part)) {
            add_part(part, stretch, to);
        }
    }
}

fn is_there(family: &Parameters<'_>, part: &Parameters<'_>) -> bool {
    let asked = part.word("when").split_once('=');
    asked.is_none_or(|(key, word)| family.word(key) == word || (word == "yes" && family.has(key)))
        && (!part.has_key("chance") || part.has("chance"))
}

fn add_part(part: &Parameters<'_>, stretch: DVec3, to: &mut Assembly) {
    let count = part.number_or("repeat", 1.0) as u32;
    let step = if part.has_key("step") { DVec3::from_array(part.numbers("step")) } else { DVec3::ZERO };
    let solid = solid(part);
    for k in 0..count {
        let placed = solid.clone().map(|p| (p + step * f64::from(k)) * stretch);
        if part.has("pair") { to.add_pair(placed) } else { to.add(placed) }
    }
}

fn solid(part: &Parameters<'_>) -> Surface {
    let material = material(part.word("material"));
    let sectors = part.number_or("sectors", 10.0) as usize;
    let solid = match part.word("solid") {
        "tube" => {
            let path = part.rows::<3>("path");
            let path =
                if part.has_key("bend") && path.len() > 2 { bent(&path, part.number("bend")) } else { path };
            return tube(&path, part.number("radius"), sectors.min(8), material);
        }
        "limb" => {
            let rows = part.rows::<5>("path");
            let sections: Vec<_> = rows.iter().map(|[x, y, z, w, h]| section([*x, *y, *z], *w, *h)).collect();
            return limb(
                &smoothed(&sections, part.number_or("between", 1.0) as usize),
                sectors.max(14),
                material,
            );
        }
        "ball" => ellipsoid(part.numbers::<3>("size").map(|full| 0.5 * full), sectors.max(12), material),
        "drum" => drum(part, sectors.max(14), material),
        _ => rounded_box(part.numbers("size"), part.number_or("round", 0.0), material),
    };
    let [pitch, yaw] = ["pitch_deg", "yaw_deg"].map(|key| part.number_or(key, 0.0).to_radians());
    let turn = DQuat::from_rotation_z(yaw);
    let [x, y, z] = part.numbers("at");
    pitched(solid, pitch).map(|p| turn * p).moved(x, y, z)
}

fn drum(part: &Parameters<'_>, sectors: usize, material: Material) -> Surface {
    let drum = disc(part.number("radius"), part.number("length"), sectors, material);
    match part.word("axis") {
        "x" => drum.map(|p| DVec3::new(p.y, -p.x, p.z)),
        "z" => drum.map(|p| DVec3::new(p.x, -p.z, p.y)),
        _ => drum,
    }
}

/// The material with that name; parts without one are painted.
pub(crate) fn material(name: &str) -> Material {
    Material::ALL.into_iter().find(|material| material.name() == name).unwrap_or(Material::Paint)
}
