//! Trim on a skin: mirrors, plates, slats, round lamps, bumper bars, handles, underfloor machinery.

use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::solids::{
    bent, disc, ellipsoid, lathe, limb, pitched, rounded_box, section, sharp_box, smoothed, tube,
};
use crate::vehicles::drawing::surface::{Material, Surface};
use crate::vehicles::family::Parameters;
use crate::vehicles::loft::face::{front_top_z, rear_top_z};
use crate::vehicles::loft::form::Form;
use crate::vehicles::parts::material;
use glam::DVec3;

pub(crate) fn add(parameters: &Parameters<'_>, form: &Form, skin: &Surface, to: &mut Assembly) {
    mirrors(parameters, form, to);
    plates(parameters, form, skin, to);
    slats(parameters, form, skin, to);
    if parameters.has("round_lamps") {
        round_lamps(parameters, form, skin, to);
    }
    for (end, sign) in [("front_bar", 1.0), ("rear_bar", -1.0)] {
        if parameters.has(end) {
            bumper_bar(parameters, form, skin, sign, to);
        }
    }
    handles(parameters, form, to);
    running_boards(parameters, form, to);
    underbody(parameters, form, to);
}

/// Outermost point of the skin towards the front (+1) or the rear (−1) at a position of the face.
fn on_face(skin: &Surface, sign: f64, y: f64, z: f64) -> Option<f64> {
    let hits = skin.triangles.iter().filter_map(|t| {
        let [a, b, c] = skin.corners_m(t);
        let side = |p: DVec3, q: DVec3| (p.y - y) * (q.z - z) - (p.z - z) * (q.y - y);
        let weights = [side(b, c), side(c, a), side(a, b)];
        let area: f64 = weights.iter().sum();
        let inside = area != 0.0 && weights.iter().all(|w| w * area >= 0.0);
        inside.then(|| (weights[0] * a.x + weights[1] * b.x + weights[2] * c.x) / area)
    });
    hits.reduce(|p, q| if p * sign > q * sign { p } else { q })
}

/// Places a part on the face, pitched like the skin from 6 cm below to 6 cm above, and by a further
/// `tilt_rad`.
fn on_skin(part: Surface, skin: &Surface, sign: f64, [y, z, tilt_rad]: [f64; 3]) -> Surface {
    let at = |z: f64| on_face(skin, sign, y, z);
    let middle = at(z).unwrap_or(0.0);
    let lean = at(z + 0.06)
        .zip(at(z - 0.06))
        .map_or(0.0, |(high, low)| (sign * (low - high) / 0.12).clamp(-0.6, 0.6).atan());
    pitched(part, -sign * (lean + tilt_rad)).moved(middle + 0.012 * sign, y, z)
}

fn mirrors(parameters: &Parameters<'_>, form: &Form, to: &mut Assembly) {
    let shell = form.shell();
    let [length, width, height] = parameters.numbers("mirror");
    let [along, up] = parameters.numbers("mirror_at");
    let (x, z) = (form.envelope.ends_x[0] - along, up * form.envelope.roof_z);
    let y = form.envelope.outer_y - 0.5 * width;
    let pod = match parameters.word("mirror_form") {
        "box" => rounded_box([length, width, height], 0.04, Material::Plastic),
        _ => ellipsoid([0.5 * length, 0.5 * width, 0.5 * height], 12, Material::Paint),
    };
    to.add_pair(pod.moved(x, y, z));
    let glass = sharp_box([0.006, 0.75 * width, 0.75 * height], Material::Glass);
    to.add_pair(pitched(glass, parameters.number("mirror_tilt_deg").to_radians()).moved(
        x - 0.5 * length,
        y,
        z,
    ));
    let root_x = x.min(form.envelope.ends_x[0] - 0.35);
    let root_y = shell.side_y(root_x, z).min(form.half_width_m) - 0.06;
    let arm = [[root_x, root_y, z - 0.2 * height], [0.5 * (root_x + x), 0.5 * (root_y + y), z], [x, y, z]];
    to.add_pair(tube(&bent(&arm, 0.4), 0.02, 6, Material::Plastic));
}

/// European plates, flat on any skin.
fn plates(parameters: &Parameters<'_>, form: &Form, skin: &Surface, to: &mut Assembly) {
    for (end, sign, top_z) in
        [("front", 1.0, front_top_z(parameters, form)), ("rear", -1.0, rear_top_z(form))]
    {
        let key = format!("{end}_plate");
        if parameters.has_key(&key) && !parameters.has(&format!("no_{end}_plate")) {
            let z = form.clearance_m + parameters.number(&key) * (top_z - form.clearance_m);
            let tilt = parameters.number("plate_tilt_deg").to_radians();
            let width = parameters.number_or("plate_width_m", 0.52);
            let plate = sharp_box([0.008, width, 0.11], Material::Plate);
            to.add(on_skin(plate, skin, sign, [0.0, z, tilt]));
        }
    }
}

/// Bars across the grille.
fn slats(parameters: &Parameters<'_>, form: &Form, skin: &Surface, to: &mut Assembly) {
    let count = parameters.number_or("slats", 0.0) as u32;
    if count == 0 || !parameters.has_key("grille") {
        return;
    }
    let [half, low, high] = parameters.numbers::<3>("grille");
    let (half, tall) = (half * form.half_width_m, front_top_z(parameters, form) - form.clearance_m);
    for k in 0..count {
        let share = (f64::from(k) + 0.5) / f64::from(count);
        let z = form.clearance_m + (low + (high - low) * share) * tall;
        let at = |y: f64| section([on_face(skin, 1.0, y, z).unwrap_or(0.0) + 0.01, y, z], 0.012, 0.014);
        let path = [-0.92, -0.5, 0.0, 0.5, 0.92].map(|share| at(share * half));
        to.add(limb(&path, 6, material(parameters.word("grille_rim"))));
    }
}

/// Dished reflectors behind a round rim.
fn round_lamps(parameters: &Parameters<'_>, form: &Form, skin: &Surface, to: &mut Assembly) {
    let [y_share, z_share, radius] = parameters.numbers("round_lamp");
    let z = form.clearance_m + z_share * (front_top_z(parameters, form) - form.clearance_m);
    let dish =
        [(0.0, 0.01), (0.5 * radius, 0.016), (0.85 * radius, 0.03), (radius, 0.045), (1.1 * radius, 0.04)];
    let rear = [(1.1 * radius, -0.06), (0.0, -0.06)];
    let profile: Vec<_> = dish.into_iter().chain(rear).collect();
    let lamp = lathe(&profile, 16, Material::Lamp).map(|p| DVec3::new(p.y, -p.x, p.z));
    to.add_pair(on_skin(lamp.outward(), skin, 1.0, [y_share * form.half_width_m, z, 0.0]));
}

/// A bar of metal or plastic in front of the face, bowed like it.
fn bumper_bar(parameters: &Parameters<'_>, form: &Form, skin: &Surface, sign: f64, to: &mut Assembly) {
    let z = form.clearance_m + parameters.number("bar_above_m");
    let out = parameters.number("bar_out_m");
    let half = form.half_width_m - 0.05;
    let at = |share: f64| {
        let x = on_face(skin, sign, 0.9 * share * half, z).unwrap_or(0.0);
        section(
            [x + sign * out * (1.0 - 0.6 * share.powi(4)), share * half, z],
            0.035,
            0.5 * parameters.number("bar_height_m"),
        )
    };
    let path = [-1.0, -0.8, -0.4, 0.0, 0.4, 0.8, 1.0].map(at);
    to.add(limb(&smoothed(&path, 1), 10, material(parameters.word("bar_of"))));
}

fn handles(parameters: &Parameters<'_>, form: &Form, to: &mut Assembly) {
    let shell = form.shell();
    let [front, rear] = form.envelope.ends_x;
    for [share] in parameters.rows::<1>("handles") {
        let x = front - share * (front - rear);
        let z = shell.waist_z.at(x) - 0.10;
        let y = shell.side_y(x, z) + 0.012;
        to.add_pair(tube(
            &[[x - 0.09, y, z], [x + 0.09, y, z]],
            0.016,
            6,
            material(parameters.word("handle_of")),
        ));
    }
}

/// Sump, silencer, tank and pipe below the floor.
fn underbody(parameters: &Parameters<'_>, form: &Form, to: &mut Assembly) {
    let [front, rear] = form.envelope.ends_x;
    if !parameters.has_key("sump") {
        return;
    }
    let (z, length) = (form.clearance_m, front - rear);
    let [share, deep] = parameters.numbers("sump");
    let sump = rounded_box([0.14 * length.min(6.0), 0.5 * form.half_width_m, 0.2], 0.06, Material::Aluminium);
    to.add(sump.moved(front - share * length, 0.0, z + 0.1 - deep));
    let [share, deep] = parameters.numbers("tank");
    let tank = rounded_box([0.14 * length.min(6.0), form.half_width_m, 0.18], 0.05, Material::Plastic);
    to.add(tank.moved(front - share * length, -0.05, z + 0.09 - deep));
    let silencer =
        disc(0.09, 0.5, 10, Material::Steel).moved(rear + 0.45, 0.35 * form.half_width_m, z + 0.12);
    to.add(silencer);
    let y = 0.55 * form.half_width_m;
    to.add(tube(&[[rear + 0.6, y, z + 0.08], [rear + 0.06, y, z + 0.12]], 0.03, 8, Material::Steel));
}

/// Steps below the doors, from one arch to the next.
fn running_boards(parameters: &Parameters<'_>, form: &Form, to: &mut Assembly) {
    let arch = form.arch_radius_m() + 0.05;
    let [Some(ahead), Some(behind)] = [0, 1].map(|k| form.axles_x.get(k).copied()) else { return };
    let (length, out_m) = (ahead - behind - 2.0 * arch, parameters.number("board_out_m"));
    if parameters.has("running_boards") && length > 0.3 {
        let board = rounded_box([length, out_m + 0.06, 0.05], 0.01, Material::Aluminium);
        let y = form.half_width_m - form.belly_m + 0.5 * out_m - 0.05;
        to.add_pair(board.moved(0.5 * (ahead + behind), y, form.clearance_m + 0.06));
    }
}
