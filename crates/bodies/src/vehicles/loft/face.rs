//! Grille, lamps, intakes and plates of a front or rear face.

use crate::vehicles::drawing::openings::{End, Panel, end_panel, end_panel_pair, inset, panel};
use crate::vehicles::drawing::surface::{Material, Surface};
use crate::vehicles::family::Parameters;
use crate::vehicles::loft::form::Form;
use crate::vehicles::parts::material;

/// Heights on a face, given as shares of the height from the underside to the top of the panel.
fn heights(form: &Form, top_z: f64, shares: [f64; 2]) -> [f64; 2] {
    shares.map(|share| form.clearance_m + share * (top_z - form.clearance_m))
}

/// A panel in the middle: `[half width as a share, low, high]`.
fn middle_panel(parameters: &Parameters<'_>, form: &Form, top_z: f64, key: &str) -> Panel {
    let [half, low, high] = parameters.numbers(key);
    let half = half * form.half_width_m;
    panel([-half, half], heights(form, top_z, [low, high]), 0.05)
}

/// A panel on either side: `[inner, outer edge as shares of the half width, low, high]`.
fn side_panel(parameters: &Parameters<'_>, form: &Form, top_z: f64, key: &str) -> Panel {
    let [inner, outer, low, high] = parameters.numbers(key);
    panel([inner, outer].map(|share| share * form.half_width_m), heights(form, top_z, [low, high]), 0.04)
}

/// Height of the front panel's upper end.
pub(crate) fn front_top_z(parameters: &Parameters<'_>, form: &Form) -> f64 {
    if form.front.upright {
        parameters.numbers::<3>("windscreen")[1] * form.envelope.roof_z - 0.05
    } else {
        form.nose_z
    }
}

/// Height of the rear panel's upper end.
pub(crate) fn rear_top_z(form: &Form) -> f64 {
    if form.rear.upright { 0.5 * form.envelope.roof_z } else { form.tail_z.min(form.deck.1) }
}

pub(crate) fn cut_front(parameters: &Parameters<'_>, form: &Form, skin: Surface) -> Surface {
    let reach =
        End::Front { beyond_x: form.envelope.ends_x[0] - if form.front.upright { 0.7 } else { 0.45 } };
    let top_z = front_top_z(parameters, form);
    let slots = inset(
        Material::Plastic,
        material(parameters.word("grille_rim")),
        parameters.number("grille_depth_m"),
    );
    let mut skin = skin;
    for key in ["grille", "intake"].into_iter().filter(|key| parameters.has_key(key)) {
        skin = end_panel(skin, reach, middle_panel(parameters, form, top_z, key), slots);
    }
    if parameters.has("round_lamps") {
        return skin;
    }
    let lamps = side_panel(parameters, form, top_z, "lamps");
    end_panel_pair(
        skin,
        reach,
        lamps,
        inset(Material::Lamp, Material::Plastic, parameters.number("lamp_depth_m")),
    )
}

pub(crate) fn cut_rear(parameters: &Parameters<'_>, form: &Form, skin: Surface) -> Surface {
    let top_z = rear_top_z(form);
    let reach = End::Rear { beyond_x: form.envelope.ends_x[1] + if form.rear.upright { 0.5 } else { 0.3 } };
    let lamps = side_panel(parameters, form, top_z, "tail_lamps");
    let skin = end_panel_pair(
        skin,
        reach,
        lamps,
        inset(Material::TailLamp, Material::Plastic, parameters.number("tail_lamp_depth_m")),
    );
    if !parameters.has_key("tail_panel") {
        return skin;
    }
    let recess = inset(
        material(parameters.word("tail_panel_of")),
        Material::Paint,
        parameters.number("tail_panel_depth_m"),
    );
    end_panel(skin, reach, middle_panel(parameters, form, top_z, "tail_panel"), recess)
}
