//! The skin: lofted, bent at both ends, with arches and panes cut in.

use crate::vehicles::drawing::curve::smooth_step;
use crate::vehicles::drawing::openings::{
    End, Flank, end_panel, flank_panel, inset, pane, panel, wheel_arch,
};
use crate::vehicles::drawing::shell::{Layout, Shell, even, spaced};
use crate::vehicles::drawing::stencil::{CutTreatment, cut, rounded_rectangle, soft_minimum};
use crate::vehicles::drawing::surface::{Material, Surface};
use crate::vehicles::family::Parameters;
use crate::vehicles::loft::face;
use crate::vehicles::loft::form::{Face, Form};
use glam::DVec3;

/// The whole skin.
pub(crate) fn cut_skin(parameters: &Parameters<'_>, form: &Form) -> Surface {
    let shell = form.shell();
    let skin = shell.skin(&layout(parameters, form, &shell)).map(|p| bent(form, p));
    let skin = cladding(parameters, form, skin);
    let skin = form.axles_x.iter().fold(skin, |skin, axle_x| {
        wheel_arch(skin, [*axle_x, form.wheel_radius_m], form.arch_radius_m(), form.arch_inner_y())
    });
    let skin = flaps(parameters, form, doors(parameters, form, side_panes(parameters, form, &shell, skin)));
    let skin = screens(parameters, form, &shell, skin);
    face::cut_rear(parameters, form, face::cut_front(parameters, form, bed(parameters, form, skin)))
}

/// Bows the ends in plan and shapes them in profile: the bumper projects, the panel above it leans back.
fn bent(form: &Form, p: DVec3) -> DVec3 {
    let [front, rear] = form.envelope.ends_x;
    let across = (p.y / form.half_width_m).powi(2);
    let reach = |face: &Face| if face.upright { 1.1 } else { 0.75 };
    let back = |face: &Face| {
        let (up, down) = ((p.z - form.bumper_z).max(0.0), (form.bumper_z - 0.10 - p.z).max(0.0));
        let over_bumper = face.bumper_m * smooth_step(form.bumper_z, form.bumper_z + 0.12, p.z);
        let back =
            face.bow_m * across + (face.lean + face.curve_per_m * up) * up + face.chin * down + over_bumper;
        // However far it leans, a section never passes the one behind it.
        back / (1.0 + back.max(0.0) / (1.3 * reach(face)))
    };
    let ahead = smooth_step(front - reach(&form.front), front, p.x) * back(&form.front);
    let behind = smooth_step(rear + reach(&form.rear), rear, p.x) * back(&form.rear);
    DVec3::new(p.x - ahead + behind, p.y, p.z)
}

/// Sections, close together where the silhouette bends, around the arches and at both ends, far apart
/// between; one at every pane's edge.
fn layout(parameters: &Parameters<'_>, form: &Form, shell: &Shell) -> Layout {
    let [front, rear] = form.envelope.ends_x;
    let (fine, coarse) = (parameters.number("step_m"), parameters.number("coarse_step_m"));
    let reach = form.arch_radius_m() + 0.05;
    let step_at = |x: f64| {
        let bends = (shell.top_z.slope(x + 0.1) - shell.top_z.slope(x - 0.1)).abs() > 0.02;
        let near_axle = form.axles_x.iter().any(|axle| (x - axle).abs() < reach);
        let near_end = x > front - 0.5 || x < rear + 0.4;
        if bends || near_axle || near_end { fine } else { coarse }
    };
    let (mut stations_x, mut walked) = (vec![rear], 0.0);
    for k in 0..((front - rear) / 0.01) as u32 {
        let x = rear + 0.01 * f64::from(k);
        walked += 0.01 * (1.0 + (0.6 * shell.top_z.slope(x)).powi(2)).sqrt() / step_at(x);
        if walked >= 1.0 {
            stations_x.push(x);
            walked = 0.0;
        }
    }
    let corners = |[behind, ahead]: [f64; 2]| [behind, behind + CORNER_M, ahead - CORNER_M, ahead];
    let edges_x: Vec<f64> = match parameters.has_key("pane_pitch_m") {
        true => pane_spans(parameters, form).into_iter().flat_map(corners).collect(),
        false => pane_spans(parameters, form).into_iter().flatten().collect(),
    };
    stations_x.retain(|x| edges_x.iter().all(|edge| (x - edge).abs() > 0.3 * fine));
    stations_x.extend(edges_x);
    Layout {
        stations_x,
        lower: even(rows(form.waist[0] - form.clearance_m)),
        upper: upper_rows(parameters, form),
        half_columns: 5,
    }
}

/// Distance of a section and a row of the skin inside every pane's edge, so that no cell cuts off its corner.
const CORNER_M: f64 = 0.06;

/// Rows 12 cm apart, at least five.
fn rows(height_m: f64) -> usize {
    ((height_m / 0.12) as usize).clamp(5, 9)
}

/// Rows at the lower and upper edge of the panes; an open body has none.
fn upper_rows(parameters: &Parameters<'_>, form: &Form) -> Vec<f64> {
    if pane_spans(parameters, form).is_empty() {
        return even(2);
    }
    let height = form.envelope.roof_z - form.rail_drop_m - 0.5 * (form.waist[0] + form.waist[1]);
    let (low, high) = (0.03 / height, 1.0 - parameters.number("pane_top_m") / height);
    let corner = CORNER_M / height;
    let inner = spaced(low + corner, high - corner, 0.4);
    [0.0, low].into_iter().chain(inner).chain([high, 1.0]).collect()
}

/// Ends of the side panes along x: those given as shares of the length, or as many as fit.
pub(crate) fn pane_spans(parameters: &Parameters<'_>, form: &Form) -> Vec<[f64; 2]> {
    let [front, rear] = form.envelope.ends_x;
    let at = |share: f64| front - share * (front - rear);
    if !parameters.has_key("pane_pitch_m") {
        return parameters
            .rows::<2>("panes")
            .into_iter()
            .map(|[ahead, behind]| [at(behind), at(ahead)])
            .collect();
    }
    let [first, last] = parameters.numbers::<2>("pane_row").map(at);
    let count = ((first - last) / parameters.number("pane_pitch_m")).round().max(1.0);
    let pitch = (first - last) / count;
    let span = |k: u32| {
        [first - f64::from(k + 1) * pitch + parameters.number("pillar_m"), first - f64::from(k) * pitch]
    };
    (0..count as u32).map(span).collect()
}

fn side_panes(parameters: &Parameters<'_>, form: &Form, shell: &Shell, skin: Surface) -> Surface {
    let (top, corner) = (parameters.number("pane_top_m"), parameters.number("pane_corner_m"));
    let (doors, pane) = (door_spans(parameters, form), pane(parameters.number("pane_depth_m")));
    pane_spans(parameters, form).into_iter().fold(skin, |skin, [behind, ahead]| {
        let blocked = doors.iter().any(|door| behind < door[1] + 0.03 && ahead > door[0] - 0.03);
        let outline = |p: DVec3| {
            let rail = (shell.rail_z.at(p.x) - p.z) / (1.0 + shell.rail_z.slope(p.x).powi(2)).sqrt();
            let side = if blocked { p.y } else { p.y.abs() };
            let edges =
                [rail - top, p.z - shell.waist_z.at(p.x) - 0.03, p.x - behind, ahead - p.x, side - 0.3];
            soft_minimum(&edges, corner)
        };
        cut(skin, outline, pane)
    })
}

/// Cuts hatches below the panes, where there is neither an arch nor a door.
fn flaps(parameters: &Parameters<'_>, form: &Form, skin: Surface) -> Surface {
    if !parameters.has("flaps") {
        return skin;
    }
    let height = [form.clearance_m + 0.22, form.waist[0] - 0.14];
    let inside = inset(Material::Paint, Material::Paint, parameters.number("flap_depth_m"));
    let taken = |[behind, ahead]: [f64; 2]| {
        let arch = form.arch_radius_m() + 0.08;
        let near = |[low, high]: [f64; 2]| behind < high && ahead > low;
        let arches = form.axles_x.iter().map(|x| [x - arch, x + arch]);
        arches.chain(door_spans(parameters, form).into_iter().map(|[a, b]| [a - 0.05, b + 0.05])).any(near)
    };
    let spans = pane_spans(parameters, form).into_iter().filter(|span| !taken(*span));
    spans.fold(skin, |skin, span| flank_panel(skin, Flank::Both, panel(span, height, 0.02), inside))
}

/// Doors on the right, [rear, front] along x.
fn door_spans(parameters: &Parameters<'_>, form: &Form) -> Vec<[f64; 2]> {
    let [front, rear] = form.envelope.ends_x;
    parameters
        .rows::<2>("doors")
        .into_iter()
        .map(|[a, b]| [a, b].map(|share| front - share * (front - rear)))
        .map(|[a, b]| [b, a])
        .collect()
}

/// Glazed doors of two leaves.
fn doors(parameters: &Parameters<'_>, form: &Form, skin: Surface) -> Surface {
    let high = form.envelope.roof_z - form.rail_drop_m - parameters.number("pane_top_m");
    let height = [form.clearance_m + 0.2, high];
    door_spans(parameters, form).into_iter().fold(skin, |skin, [behind, ahead]| {
        let middle = 0.5 * (behind + ahead);
        let glazed = pane(parameters.number("pane_depth_m"));
        let leaf = |skin, along| flank_panel(skin, Flank::Right, panel(along, height, 0.03), glazed);
        leaf(leaf(skin, [behind, middle - 0.035]), [middle + 0.035, ahead])
    })
}

/// Windscreen and rear window: on the roof's side of the rail if the end is raked, in the face if it is
/// upright.
fn screens(parameters: &Parameters<'_>, form: &Form, shell: &Shell, skin: Surface) -> Surface {
    let [front, rear] = form.envelope.ends_x;
    let screen = pane(parameters.number("screen_depth_m"));
    let raked = |p: DVec3, [low, high]: [f64; 2]| {
        let pillar = shell.rail_y.at(p.x) - 0.05 - p.y.abs();
        soft_minimum(&[pillar, p.z - low, high - p.z], 0.08).min(p.z - shell.waist_z.at(p.x))
    };
    let upright = |key: &str| {
        let [half, low, high] = parameters.numbers::<3>(key);
        let half = half * form.half_width_m;
        panel([-half, half], [low * form.envelope.roof_z, high * form.envelope.roof_z], 0.1)
    };
    let skin = if form.front.upright {
        end_panel(skin, End::Front { beyond_x: front - 1.0 }, upright("windscreen"), screen)
    } else {
        cut(skin, |p| raked(p, [form.cowl.1, form.header.1 - 0.03]).min(p.x - form.header.0 + 0.1), screen)
    };
    if parameters.has("no_rear_window") {
        return skin;
    }
    if form.rear.upright {
        return end_panel(skin, End::Rear { beyond_x: rear + 0.5 }, upright("rear_window"), screen);
    }
    cut(
        skin,
        |p| raked(p, [form.deck.1 + 0.05, form.roof_end.1 - 0.05]).min(form.roof_end.0 + 0.1 - p.x),
        screen,
    )
}

/// Cuts openings at the top: the bed of a pick-up, the seats of a roadster.
fn bed(parameters: &Parameters<'_>, form: &Form, skin: Surface) -> Surface {
    if !parameters.has_key("bed") {
        return skin;
    }
    let [front, rear] = form.envelope.ends_x;
    let [from, to, half, depth_m] = parameters.numbers("bed");
    let [ahead, behind] = [from, to].map(|share| front - share * (front - rear));
    let half = half * form.half_width_m;
    let floor = form.envelope.roof_z * parameters.number("bed_above");
    let outline =
        |p: DVec3| rounded_rectangle(p.x, p.y, [behind, ahead], [-half, half], 0.1).min(p.z - floor);
    let material = if parameters.has("leather") { Material::Leather } else { Material::Paint };
    cut(skin, outline, CutTreatment::Sunk { material, rim: Material::Paint, depth_m })
}

/// Unpainted sills and bumpers.
fn cladding(parameters: &Parameters<'_>, form: &Form, skin: Surface) -> Surface {
    let [front, rear] = form.envelope.ends_x;
    let sill_z = form.clearance_m + parameters.number("sill_m");
    let bumper_z = if parameters.word("bumper") == "plastic" { form.bumper_z + 0.1 } else { sill_z };
    let outline = |p: DVec3| {
        let near_end =
            smooth_step(front - 0.6, front - 0.4, p.x).max(smooth_step(rear + 0.6, rear + 0.4, p.x));
        sill_z + (bumper_z - sill_z) * near_end - p.z
    };
    cut(skin, outline, CutTreatment::Recoloured(Material::Plastic))
}
