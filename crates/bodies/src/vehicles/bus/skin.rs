//! A bus's skin: the shell, its leaning front, arches, panes, doors, lamps.

use crate::vehicles::bus::form::{Form, Kind};
use crate::vehicles::drawing::curve::{Curve, smooth_step};
use crate::vehicles::drawing::openings::{
    End, Flank, PANE, end_panel, end_panel_pair, flank_panel, panel, wheel_arch,
};
use crate::vehicles::drawing::shell::{Layout, Shell, even, spaced};
use crate::vehicles::drawing::stencil::{CutTreatment, cut, soft_minimum};
use crate::vehicles::drawing::surface::{Material, Surface};
use glam::DVec3;

/// The whole skin.
pub(crate) fn cut_skin(form: &Form) -> Surface {
    let shell = shell(form);
    let skin = shell.skin(&layout(form)).map(|p| leaning(form, p));
    let skin = skirt(form, skin);
    let skin = [form.front_axle_x, form.rear_axle_x].into_iter().fold(skin, |skin, axle_x| {
        wheel_arch(skin, [axle_x, form.wheel_radius_m], form.arch_radius_m(), form.arch_inner_y())
    });
    let skin = panes(form, doors(form, glazing_band(form, skin)));
    let skin =
        if form.kind == Kind::Mini { van_windscreen(form, &shell, skin) } else { windscreen(form, skin) };
    rear_face(form, front_lamps(form, skin))
}

pub(crate) fn shell(form: &Form) -> Shell {
    let [front, rear] = form.ends_x;
    let top_z = form.top_z();
    let half = form.half_width_m;
    let below = |drop: f64| {
        let samples: Vec<_> =
            spaced(rear, front, 0.12).into_iter().map(|x| (x, top_z.at(x) - drop)).collect();
        Curve::through(&samples)
    };
    let waist = form.panes_z[0] - WAIST_BELOW_PANES_M;
    let waist_samples: Vec<_> =
        spaced(rear, front, 0.12).into_iter().map(|x| (x, waist.min(top_z.at(x) - 0.24))).collect();
    let lean_in: f64 = if form.kind == Kind::City { 0.05 } else { 0.12 };
    let narrow = if form.kind == Kind::Mini { 0.12 } else { 0.0 };
    let plan = |inset: f64| {
        Curve::through(&[(front, half - inset - narrow), (front - 1.2, half - inset), (rear, half - inset)])
    };
    let lift = if form.kind == Kind::Mini { 0.05 } else { 0.08 };
    let clearance = form.clearance_m;
    let end_radius_m = if form.kind == Kind::Mini { [0.12, 0.10] } else { [0.20, 0.14] };
    Shell {
        bottom_z: Curve::through(&[
            (rear, clearance + lift),
            (rear + 2.0, clearance),
            (front - 1.5, clearance),
            (front, clearance + lift),
        ]),
        waist_z: Curve::through(&waist_samples),
        rail_z: below(RAIL_BELOW_ROOF_M),
        sill_y: plan(0.03),
        belly_y: plan(0.0),
        waist_y: plan(0.01),
        // Over a van's bonnet the rail stays above the flank.
        rail_y: Curve::through(&[
            (front, half - narrow - lean_in.min(0.05)),
            (front - 1.2, half - lean_in),
            (rear, half - lean_in),
        ]),
        upper_bow_m: 0.012,
        roof_exponent: 3.2,
        sill_radius_m: 0.06,
        end_radius_m,
        ends_x: form.ends_x,
        top_z,
    }
}

/// Sections at the ends of panes and doors, close together around the arches and a van's nose, far apart
/// along the flat flanks between.
fn layout(form: &Form) -> Layout {
    let [front, rear] = form.ends_x;
    let mut stations_x = spaced(rear, front, 0.8);
    for axle_x in [form.front_axle_x, form.rear_axle_x] {
        let reach = form.arch_radius_m() + 0.06;
        stations_x.retain(|x| (x - axle_x).abs() > reach);
        stations_x.extend(spaced(axle_x - reach, axle_x + reach, 0.13));
    }
    let (nose_x, step) = if form.kind == Kind::Mini { (front - 2.3, 0.12) } else { (front - 0.9, 0.18) };
    stations_x.retain(|x| *x < nose_x);
    stations_x.extend(spaced(nose_x, front, step));
    stations_x.extend(spaced(rear, rear + 0.6, 0.2));
    let mut edges_x: Vec<f64> = pane_spans(form)
        .into_iter()
        .chain(form.doors_x.iter().copied())
        .flat_map(|[behind, ahead]| [behind, behind + corner_m(form), ahead - corner_m(form), ahead])
        .filter(|x| *x < nose_x)
        .collect();
    edges_x.sort_by(f64::total_cmp);
    edges_x.dedup_by(|b, a| *b - *a < 0.02);
    // An edge of a pane takes precedence over one that only divides the flank.
    stations_x.retain(|x| edges_x.iter().all(|edge| (x - edge).abs() > 0.06));
    stations_x.extend(edges_x);
    Layout { stations_x, lower: even(7), upper: upper_rows(form), half_columns: 5 }
}

/// Radius of the panes' corners; a row and a section of the skin lie at that distance inside every pane's
/// edge. Behind a dark band corners are square.
fn corner_m(form: &Form) -> f64 {
    if form.kind == Kind::Mini { 0.07 } else { 0.0 }
}

/// Rows at the panes' edges, as shares of the height from waist to rail.
fn upper_rows(form: &Form) -> Vec<f64> {
    let [low, high] = form.panes_z;
    let (waist, rail) = (low - WAIST_BELOW_PANES_M, form.roof_z - RAIL_BELOW_ROOF_M);
    let inner = spaced(low + 0.07, high - 0.07, 0.5);
    let rows = [waist, low].into_iter().chain(inner).chain([high, rail]);
    rows.map(|z| (z - waist) / (rail - waist)).collect()
}

const WAIST_BELOW_PANES_M: f64 = 0.06;
const RAIL_BELOW_ROOF_M: f64 = 0.17;

/// Leans the front back above the bumper and bows it in plan; the rear a little.
fn leaning(form: &Form, p: DVec3) -> DVec3 {
    let [front, rear] = form.ends_x;
    let across = (p.y / form.half_width_m).powi(2);
    let bumper_z = form.clearance_m + 0.45;
    let up = (p.z - bumper_z).max(0.0);
    let lean = form.lean * up * (0.4 + 0.6 * up / (form.roof_z - bumper_z));
    let chin = 0.25 * (bumper_z - 0.15 - p.z).max(0.0);
    let ahead = smooth_step(front - 1.2, front, p.x);
    let behind = smooth_step(rear + 0.9, rear, p.x);
    DVec3::new(p.x - ahead * (0.13 * across + lean + chin) + behind * (0.06 * across + 0.03 * up), p.y, p.z)
}

fn skirt(form: &Form, skin: Surface) -> Surface {
    cut(skin, |p| form.clearance_m + 0.10 - p.z, CutTreatment::Recoloured(Material::Plastic))
}

/// Side panes from the front to the rear, the same on both flanks; doors interrupt them on the right.
fn pane_spans(form: &Form) -> Vec<[f64; 2]> {
    let [front, rear] = form.ends_x;
    let (first, last) = match form.kind {
        Kind::City => (front - 0.42, rear + 0.55),
        Kind::Coach => (front - 0.75, rear + 0.35),
        Kind::Mini => (front - 1.98, rear + 0.30),
    };
    let count = ((first - last) / form.pane_width_m).round().max(1.0);
    let pitch = (first - last) / count;
    let pillar = 0.07;
    let span = |k: i32| {
        let ahead = first - f64::from(k) * pitch;
        [ahead - pitch + pillar, ahead]
    };
    (0..count as i32).map(span).collect()
}

/// Hides the posts between the panes of city buses and coaches behind dark trim.
fn glazing_band(form: &Form, skin: Surface) -> Surface {
    let spans = pane_spans(form);
    let ends = spans.first().zip(spans.last()).map(|(first, last)| [last[0] - 0.05, first[1] + 0.05]);
    match (form.kind, ends) {
        (Kind::Mini, _) | (_, None) => skin,
        (_, Some(along)) => {
            let [low, high] = form.panes_z;
            let band = panel(along, [low - 0.03, high + 0.04], 0.0);
            flank_panel(skin, Flank::Both, band, CutTreatment::Recoloured(Material::Plastic))
        }
    }
}

fn panes(form: &Form, skin: Surface) -> Surface {
    let door_free = |span: &[f64; 2]| {
        form.doors_x.iter().all(|door| span[1] < door[0] - 0.02 || span[0] > door[1] + 0.02)
    };
    pane_spans(form).into_iter().fold(skin, |skin, span| {
        let skin = flank_panel(skin, Flank::Left, panel(span, form.panes_z, corner_m(form)), PANE);
        // The coach's doors end below its panes.
        if form.kind == Kind::Coach || door_free(&span) {
            return flank_panel(skin, Flank::Right, panel(span, form.panes_z, corner_m(form)), PANE);
        }
        clipped_by_doors(form, span).into_iter().fold(skin, |skin, rest| {
            flank_panel(skin, Flank::Right, panel(rest, form.panes_z, corner_m(form)), PANE)
        })
    })
}

/// Parts of a pane beside the doors, if they are wide enough for one.
fn clipped_by_doors(form: &Form, span: [f64; 2]) -> Vec<[f64; 2]> {
    let mut rest = vec![span];
    for door in &form.doors_x {
        let cut = |[behind, ahead]: [f64; 2]| {
            [[behind, ahead.min(door[0] - 0.07)], [behind.max(door[1] + 0.07), ahead]]
        };
        rest = rest.into_iter().flat_map(cut).filter(|[behind, ahead]| ahead - behind > 0.3).collect();
    }
    rest
}

/// Glazed doors of two leaves on the right.
fn doors(form: &Form, skin: Surface) -> Surface {
    let top = match form.kind {
        Kind::City => form.panes_z[1],
        Kind::Coach => form.panes_z[0] - 0.15,
        Kind::Mini => form.panes_z[1],
    };
    let low = form.clearance_m + if form.kind == Kind::Mini { 0.75 } else { 0.16 };
    form.doors_x.iter().fold(skin, |skin, [behind, ahead]| {
        let middle = 0.5 * (behind + ahead);
        let leaves = if form.kind == Kind::City {
            vec![[*behind, middle - 0.035], [middle + 0.035, *ahead]]
        } else {
            vec![[*behind, *ahead]]
        };
        leaves.into_iter().fold(skin, |skin, leaf| {
            flank_panel(skin, Flank::Right, panel(leaf, [low, top], corner_m(form)), PANE)
        })
    })
}

fn windscreen(form: &Form, skin: Surface) -> Surface {
    let [front, _] = form.ends_x;
    let half = form.half_width_m - 0.10;
    let reach = End::Front { beyond_x: front - 0.95 };
    let skin = end_panel(skin, reach, panel([-half, half], form.windscreen_z, 0.12), PANE);
    if form.kind == Kind::Coach {
        return skin;
    }
    let sign = [form.windscreen_z[1] + 0.08, form.windscreen_z[1] + 0.33];
    end_panel(skin, reach, panel([-0.85, 0.85], sign, 0.05), PANE)
}

fn van_windscreen(form: &Form, shell: &Shell, skin: Surface) -> Surface {
    let [cowl_z, header_z] = form.windscreen_z;
    let outline = |p: DVec3| {
        let pillar = shell.rail_y.at(p.x) - 0.04 - p.y.abs();
        soft_minimum(&[pillar, p.z - cowl_z, header_z - p.z], 0.1).min(p.x - form.header_x() + 0.1)
    };
    let skin = cut(skin, outline, PANE);
    let front_door = |p: DVec3| {
        let slope = shell.rail_z.slope(p.x);
        let rail = (shell.rail_z.at(p.x) - p.z) / (1.0 + slope * slope).sqrt();
        let [low, high] = form.panes_z;
        soft_minimum(&[rail - 0.07, p.z - low + 0.02, high - p.z, p.x - form.header_x() + 0.35], 0.08)
            .min(p.y.abs() - 0.5)
    };
    cut(skin, front_door, PANE)
}

fn front_lamps(form: &Form, skin: Surface) -> Surface {
    let [front, _] = form.ends_x;
    let reach = End::Front { beyond_x: front - 0.45 };
    let half = form.half_width_m;
    let (lamp_z, grille) = match form.kind {
        Kind::Mini => ([0.78, 0.98], panel([-0.42, 0.42], [0.72, 0.96], 0.06)),
        Kind::City => ([0.58, 0.78], panel([-0.55, 0.55], [0.46, 0.60], 0.05)),
        Kind::Coach => ([0.62, 0.84], panel([-0.60, 0.60], [0.48, 0.66], 0.05)),
    };
    // Lamps follow the skin around its corners: lowered lamps would fold there.
    let lamp = CutTreatment::Recoloured(Material::Lamp);
    let skin = end_panel_pair(skin, reach, panel([0.62 * half, 0.95 * half], lamp_z, 0.06), lamp);
    let slots = CutTreatment::Inset { material: Material::Plastic, rim: Material::Plastic, depth_m: 0.03 };
    end_panel(skin, reach, grille, slots)
}

fn rear_face(form: &Form, skin: Surface) -> Surface {
    let [_, rear] = form.ends_x;
    let half = form.half_width_m;
    let reach = End::Rear { beyond_x: rear + 0.4 };
    let lamp = CutTreatment::Inset { material: Material::TailLamp, rim: Material::Plastic, depth_m: 0.01 };
    let window_top = form.panes_z[1] - 0.02;
    let window_low = window_top - if form.kind == Kind::City { 0.75 } else { 0.85 };
    let skin = end_panel_pair(skin, reach, panel([0.80 * half, 0.95 * half], [0.75, 1.30], 0.05), lamp);
    let skin =
        end_panel(skin, reach, panel([-0.78 * half, 0.78 * half], [window_low, window_top], 0.1), PANE);
    if form.kind == Kind::Mini {
        return skin;
    }
    let louvres = CutTreatment::Inset { material: Material::Plastic, rim: Material::Plastic, depth_m: 0.04 };
    end_panel(skin, reach, panel([-0.70 * half, 0.70 * half], [0.85, 1.45], 0.04), louvres)
}
