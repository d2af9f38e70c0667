//! A car's skin: the shell, bowed at both ends, with arches, panes, lamps and grille cut in.

use crate::vehicles::car::form::{BodyStyle, Form};
use crate::vehicles::drawing::curve::{Curve, smooth_step};
use crate::vehicles::drawing::openings::PANE;
use crate::vehicles::drawing::shell::{Layout, Shell, even};
use crate::vehicles::drawing::stencil::{CutTreatment, cut, rounded_rectangle, soft_minimum};
use crate::vehicles::drawing::surface::{Material, Surface};
use glam::DVec3;

/// The whole skin.
pub(crate) fn cut_skin(form: &Form) -> Surface {
    let shell = shell(form);
    let skin = shell.skin(&layout(form, &shell)).map(|p| bowed(form, p));
    let skin = cladding(form, skin);
    let skin = arches(form, skin);
    let skin = side_windows(form, &shell, skin);
    let skin = windscreens(form, &shell, skin);
    rear_face(form, front_face(form, skin))
}

/// Lines over x, sampled where the drawing has points.
fn over_x(form: &Form, y: impl Fn(f64) -> f64) -> Curve {
    let [front, rear] = form.ends_x();
    let samples: Vec<(f64, f64)> =
        (0..=60).map(|k| rear + (front - rear) * f64::from(k) / 60.0).map(|x| (x, y(x))).collect();
    Curve::through(&samples)
}

pub(crate) fn shell(form: &Form) -> Shell {
    let [front, rear] = form.ends_x();
    let half = form.half_width_m;
    let top_z = form.top_z();
    let top = top_z.clone();
    let drop = |x: f64| 0.055 + 0.03 * form.cabin(x);
    let waist_line = Curve::through(&[(rear, form.waist_rear_z), (front, form.waist_front_z)]);
    let waist = move |x: f64| waist_line.at(x).min(top.at(x) - 0.13);
    // In plan the body narrows a little towards both ends.
    let plan = Curve::through(&[
        (rear, half - 0.06),
        (rear + 0.6, half - 0.01),
        (0.0, half),
        (front - 0.9, half - 0.005),
        (front, half - 0.08),
    ]);
    let lift = |x: f64| 0.10 * smooth_step(front - 0.75, front, x) + 0.13 * smooth_step(rear + 0.9, rear, x);
    let rail = |x: f64| {
        let bonnet = plan.at(x) - 0.09;
        bonnet + (form.roof_y - bonnet) * form.cabin(x)
    };
    Shell {
        bottom_z: over_x(form, |x| form.clearance_m + lift(x)),
        waist_z: over_x(form, waist),
        rail_z: over_x(form, |x| top_z.at(x) - drop(x)),
        sill_y: over_x(form, |x| plan.at(x) - 0.03),
        belly_y: over_x(form, |x| plan.at(x)),
        waist_y: over_x(form, |x| plan.at(x) - 0.035),
        rail_y: over_x(form, rail),
        top_z: top_z.clone(),
        upper_bow_m: 0.018,
        roof_exponent: 2.7,
        sill_radius_m: 0.07,
        end_radius_m: [0.10, 0.09],
        ends_x: [front, rear],
    }
}

/// Sections a hand's width apart along the silhouette, so that screens have sections in proportion to their
/// length.
fn layout(form: &Form, shell: &Shell) -> Layout {
    let [front, rear] = form.ends_x();
    let mut stations_x = vec![rear];
    let (mut x, mut walked) = (rear, 0.0);
    while x < front {
        x += 0.005;
        walked += 0.005 * (1.0 + (0.6 * shell.top_z.slope(x)).powi(2)).sqrt();
        if walked > 0.105 {
            stations_x.push(x);
            walked = 0.0;
        }
    }
    let pane_edges =
        pane_spans(form).into_iter().flat_map(|[behind, ahead]| [behind, behind + 0.06, ahead - 0.06, ahead]);
    let edges_x: Vec<f64> = pane_edges.filter(|x| *x < form.header.0).collect();
    stations_x.retain(|x| edges_x.iter().all(|edge| (x - edge).abs() > 0.04));
    stations_x.extend(edges_x);
    // Rows at the edges of the side panes, 2.5 cm above the waist and 5 cm below the rail for a side half a
    // metre high.
    let upper = vec![0.0, 0.05, 0.17, 0.5, 0.78, 0.90, 1.0];
    Layout { stations_x, lower: even(7), upper, half_columns: 5 }
}

/// Bows the ends in plan and shapes them in profile: the bumper projects, the nose above it leans back.
fn bowed(form: &Form, p: DVec3) -> DVec3 {
    let [front, rear] = form.ends_x();
    let across = (p.y / form.half_width_m).powi(2);
    let ahead = smooth_step(front - 0.8, front, p.x);
    let behind = smooth_step(rear + 0.6, rear, p.x);
    let bumper_z = form.clearance_m + 0.32;
    let nose = 0.16 * (p.z - bumper_z).max(0.0) + 0.35 * (bumper_z - 0.08 - p.z).max(0.0);
    let tail = 0.12 * (p.z - bumper_z).max(0.0) + 0.30 * (bumper_z - 0.08 - p.z).max(0.0);
    DVec3::new(p.x - ahead * (0.17 * across + nose) + behind * (0.10 * across + tail), p.y, p.z)
}

/// Unpainted sills, and on a sport utility the lips around the arches.
fn cladding(form: &Form, skin: Surface) -> Surface {
    let sill_z = form.clearance_m + if form.body == BodyStyle::SportUtility { 0.16 } else { 0.07 };
    let lip = if form.body == BodyStyle::SportUtility { 0.065 } else { 0.0 };
    let [front, rear] = form.ends_x();
    let bumper = if form.body == BodyStyle::SportUtility { 0.14 } else { 0.0 };
    let outline = |p: DVec3| {
        let near_end =
            smooth_step(front - 0.75, front - 0.45, p.x) + smooth_step(rear + 0.75, rear + 0.45, p.x);
        let sill_z = sill_z + bumper * near_end;
        let around =
            form.axles_x().map(|x| form.arch_radius_m() + lip - (p.x - x).hypot(p.z - form.wheel_radius_m));
        (sill_z - p.z).max(around[0]).max(around[1])
    };
    cut(skin, outline, CutTreatment::Recoloured(Material::Plastic))
}

fn arches(form: &Form, skin: Surface) -> Surface {
    form.axles_x().into_iter().fold(skin, |skin, axle_x| {
        let outline = |p: DVec3| {
            let circle = form.arch_radius_m() - (p.x - axle_x).hypot(p.z - form.wheel_radius_m);
            circle.min(p.y.abs() - form.arch_inner_y())
        };
        cut(skin, outline, CutTreatment::Opened { flange_m: 0.05 })
    })
}

/// Ends of the side panes along x, front to rear, with the pillars between them.
fn pane_spans(form: &Form) -> Vec<[f64; 2]> {
    let front = form.cowl.0;
    let pillar_b = form.door_post_x();
    let pillar_c = form.rear_axle_x + 0.36;
    match form.body {
        BodyStyle::SportUtility => {
            let rear = form.roof_end.0 + 0.02;
            vec![[pillar_b + 0.05, front], [pillar_c + 0.05, pillar_b - 0.05], [rear, pillar_c - 0.06]]
        }
        BodyStyle::Saloon => vec![[pillar_b + 0.05, front], [form.roof_end.0 - 0.22, pillar_b - 0.05]],
        BodyStyle::Hatchback => vec![[pillar_b + 0.05, front], [form.rear_axle_x + 0.02, pillar_b - 0.05]],
    }
}

fn side_windows(form: &Form, shell: &Shell, skin: Surface) -> Surface {
    pane_spans(form).into_iter().fold(skin, |skin, [behind, ahead]| {
        let outline = |p: DVec3| {
            let rail = (shell.rail_z.at(p.x) - p.z) / (1.0 + shell.rail_z.slope(p.x).powi(2)).sqrt();
            let waist = p.z - shell.waist_z.at(p.x);
            soft_minimum(&[rail - 0.05, waist - 0.025, p.x - behind, ahead - p.x, p.y.abs() - 0.3], 0.06)
        };
        cut(skin, outline, PANE)
    })
}

/// Windscreen and rear window, on the roof's side of the rail.
fn windscreens(form: &Form, shell: &Shell, skin: Surface) -> Surface {
    let between = |p: DVec3, [low, high]: [f64; 2], margin: f64| {
        let pillar = shell.rail_y.at(p.x) - margin - p.y.abs();
        soft_minimum(&[pillar, p.z - low, high - p.z], 0.08).min(p.z - shell.waist_z.at(p.x))
    };
    let front = |p: DVec3| {
        between(p, [form.cowl.1 + 0.0, form.header.1 - 0.03], 0.045).min(p.x - form.header.0 + 0.1)
    };
    let skin = cut(skin, front, PANE);
    let rear = |p: DVec3| {
        between(p, [form.deck.1 + 0.05, form.roof_end.1 - 0.05], 0.07).min(form.roof_end.0 + 0.1 - p.x)
    };
    cut(skin, rear, PANE)
}

fn front_face(form: &Form, skin: Surface) -> Surface {
    let ahead = form.ends_x()[0] - 0.45;
    let (half, nose, low) = (form.half_width_m, form.nose_z, form.clearance_m);
    let grille_top = nose - 0.03;
    let grille_low = if form.body == BodyStyle::SportUtility { nose - 0.30 } else { nose - 0.19 };
    let grille = |p: DVec3| {
        rounded_rectangle(p.y, p.z, [-0.40 * half, 0.40 * half], [grille_low, grille_top - 0.05], 0.05)
            .min(p.x - ahead)
    };
    let lamps = |p: DVec3| {
        let span = [0.52 * half, 0.97 * half];
        let rise = 0.10 * (p.y.abs() - 0.52 * half);
        rounded_rectangle(p.y.abs(), p.z - rise, span, [nose - 0.165, nose - 0.04], 0.05).min(p.x - ahead)
    };
    let intake = |p: DVec3| {
        rounded_rectangle(p.y, p.z, [-0.62 * half, 0.62 * half], [low + 0.13, low + 0.25], 0.05)
            .min(p.x - ahead)
    };
    let skin = cut(
        skin,
        grille,
        CutTreatment::Inset { material: Material::Plastic, rim: Material::Chrome, depth_m: 0.025 },
    );
    let skin = cut(skin, lamps, CutTreatment::Recoloured(Material::Lamp));
    let (trim, depth_m) = if form.body == BodyStyle::SportUtility {
        (Material::Aluminium, 0.012)
    } else {
        (Material::Plastic, 0.03)
    };
    cut(skin, intake, CutTreatment::Inset { material: trim, rim: Material::Plastic, depth_m })
}

fn rear_face(form: &Form, skin: Surface) -> Surface {
    let behind = form.ends_x()[1] + 0.42;
    let (half, tail, low) = (form.half_width_m, form.tail_z, form.clearance_m);
    let lamps = |p: DVec3| {
        let (span, heights) = match form.body {
            BodyStyle::SportUtility => ([0.66 * half, 1.1 * half], [tail - 0.26, tail - 0.02]),
            _ => ([0.50 * half, 1.1 * half], [tail - 0.20, tail - 0.05]),
        };
        rounded_rectangle(p.y.abs(), p.z, span, heights, 0.04).min(behind - 0.18 - p.x)
    };
    let skin = cut(skin, lamps, CutTreatment::Recoloured(Material::TailLamp));
    let recess = |p: DVec3| {
        rounded_rectangle(p.y, p.z, [-0.33, 0.33], [low + 0.36, low + 0.51], 0.03).min(behind - p.x)
    };
    cut(skin, recess, CutTreatment::Inset { material: Material::Paint, rim: Material::Paint, depth_m: 0.02 })
}
