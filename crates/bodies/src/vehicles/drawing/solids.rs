//! Closed solids: boxes with rounded edges, solids of revolution, tubes and limbs along a path.

use crate::vehicles::drawing::curve::Curve;
use crate::vehicles::drawing::surface::{Material, Surface};
use glam::{DQuat, DVec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A box around the origin with edges of the given radius, in two steps of 45°.
pub(crate) fn rounded_box(size_m: [f64; 3], radius_m: f64, material: Material) -> Surface {
    let half = DVec3::from_array(size_m) * 0.5;
    let radius = radius_m.min(0.499 * size_m[0].min(size_m[1]).min(size_m[2]));
    let mut surface = Surface::default();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            surface.append(box_side(half, radius, axis, sign, material));
        }
    }
    surface.welded().outward()
}

/// A box with sharp edges, like those of sheet metal.
pub(crate) fn sharp_box(size_m: [f64; 3], material: Material) -> Surface {
    rounded_box(size_m, 0.0, material)
}

fn box_side(half: DVec3, radius: f64, axis: usize, sign: f64, material: Material) -> Surface {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let steps = |h: f64| if radius > 0.0 { vec![-h, radius - h, h - radius, h] } else { vec![-h, h] };
    let row = |a: &f64| {
        let point = |b: &f64| {
            let mut p = [0.0; 3];
            (p[axis], p[u], p[v]) = (sign * half[axis], *a, *b);
            round_corner(DVec3::from_array(p), half, radius)
        };
        steps(half[v]).iter().map(point).collect::<Vec<_>>()
    };
    let side = Surface::from_rows(&steps(half[u]).iter().map(row).collect::<Vec<_>>(), material);
    if sign > 0.0 { side } else { side.flipped() }
}

fn round_corner(p: DVec3, half: DVec3, radius: f64) -> DVec3 {
    let core = half - DVec3::splat(radius);
    let nearest = p.clamp(-core, core);
    nearest + radius * (p - nearest).try_normalize().unwrap_or(DVec3::ZERO)
}

/// A solid of revolution about the y axis. `profile` holds (radius, y) along the outline; if it does not
/// begin and end at radius 0, it should return to its first point.
pub(crate) fn lathe(profile: &[(f64, f64)], sectors: usize, material: Material) -> Surface {
    let row = |&(radius, y): &(f64, f64)| {
        let at = |k: usize| {
            // The last point repeats the first exactly, so that the seam closes.
            let angle = TAU * (k % sectors) as f64 / sectors as f64;
            DVec3::new(radius * angle.cos(), y, radius * angle.sin())
        };
        (0..=sectors).map(at).collect::<Vec<_>>()
    };
    Surface::from_rows(&profile.iter().map(row).collect::<Vec<_>>(), material).outward()
}

/// An ellipsoid with the given half axes.
pub(crate) fn ellipsoid(half_m: [f64; 3], sectors: usize, material: Material) -> Surface {
    let rings = sectors / 2;
    let at = |k: usize| {
        let angle = PI * k as f64 / rings as f64;
        if k == 0 || k == rings { (0.0, angle.cos()) } else { (angle.sin(), angle.cos()) }
    };
    let profile: Vec<_> = (0..=rings).map(at).collect();
    lathe(&profile, sectors, material).map(|p| p * DVec3::from_array(half_m))
}

/// A cylinder around the y axis with bevelled rims.
pub(crate) fn disc(radius_m: f64, width_m: f64, sectors: usize, material: Material) -> Surface {
    let (half, bevel) = (0.5 * width_m, 0.15 * width_m.min(radius_m));
    let rim = radius_m - bevel;
    lathe(
        &[
            (0.0, half),
            (rim, half),
            (radius_m, half - bevel),
            (radius_m, bevel - half),
            (rim, -half),
            (0.0, -half),
        ],
        sectors,
        material,
    )
}

/// One elliptical cross section of a limb: its centre, its half width (across, horizontal if possible) and
/// its half height.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Section {
    pub(crate) centre_m: DVec3,
    pub(crate) half_width_m: f64,
    pub(crate) half_height_m: f64,
}

/// A section from plain numbers.
pub(crate) fn section(centre_m: [f64; 3], half_width_m: f64, half_height_m: f64) -> Section {
    Section { centre_m: DVec3::from_array(centre_m), half_width_m, half_height_m }
}

/// The sections with `between` additional ones in every gap, on smooth curves through the given ones.
pub(crate) fn smoothed(sections: &[Section], between: usize) -> Vec<Section> {
    let mut along = vec![0.0];
    for pair in sections.windows(2) {
        along.push(along[along.len() - 1] + pair[0].centre_m.distance(pair[1].centre_m));
    }
    let curve = |value: &dyn Fn(&Section) -> f64| {
        let points: Vec<_> = along.iter().zip(sections).map(|(s, section)| (*s, value(section))).collect();
        Curve::through(&points)
    };
    let [x, y, z] = [0, 1, 2].map(|k| curve(&move |s: &Section| s.centre_m[k]));
    let (width, height) = (curve(&|s| s.half_width_m), curve(&|s| s.half_height_m));
    let at = |s: f64| section([x.at(s), y.at(s), z.at(s)], width.at(s), height.at(s));
    let gap = |pair: &[f64]| {
        let (from, step) = (pair[0], (pair[1] - pair[0]) / (between + 1) as f64);
        (0..=between).map(move |k| from + step * k as f64)
    };
    along.windows(2).flat_map(gap).chain(along.last().copied()).map(at).collect()
}

/// A limb through elliptical cross sections, with domed ends.
pub(crate) fn limb(sections: &[Section], sectors: usize, material: Material) -> Surface {
    let frames = frames(sections);
    let last = sections.len() - 1;
    let mut rows: Vec<_> = dome(&sections[0], &frames[0], -1.0, sectors).into_iter().rev().collect();
    rows.extend(sections.iter().zip(&frames).map(|(s, frame)| ring(s, frame, sectors)));
    rows.extend(dome(&sections[last], &frames[last], 1.0, sectors));
    Surface::from_rows(&rows, material).outward()
}

/// A round tube along a path whose corners are bent in short steps.
pub(crate) fn tube(path_m: &[[f64; 3]], radius_m: f64, sectors: usize, material: Material) -> Surface {
    let sections: Vec<_> = path_m.iter().map(|p| section(*p, radius_m, radius_m)).collect();
    limb(&sections, sectors, material)
}

/// The path with each inner corner replaced by a curve through its neighbourhood (`share` of the shorter
/// leg).
pub(crate) fn bent(path_m: &[[f64; 3]], share: f64) -> Vec<[f64; 3]> {
    let at: Vec<DVec3> = path_m.iter().map(|p| DVec3::from_array(*p)).collect();
    let mut bent = vec![path_m[0]];
    for k in 1..at.len() - 1 {
        let reach = share * at[k].distance(at[k - 1]).min(at[k].distance(at[k + 1]));
        let towards = |other: DVec3| at[k] + reach * (other - at[k]).try_normalize().unwrap_or(DVec3::ZERO);
        let (from, to) = (towards(at[k - 1]), towards(at[k + 1]));
        let quadratic = |t: f64| from.lerp(at[k], t).lerp(at[k].lerp(to, t), t);
        bent.extend([0.0, 0.33, 0.67, 1.0].map(|t| quadratic(t).to_array()));
    }
    bent.push(path_m[path_m.len() - 1]);
    bent
}

/// Direction of a limb at a section, and that of the section's width.
struct Frame {
    tangent: DVec3,
    across: DVec3,
}

/// Frames that do not twist from one section to the next.
fn frames(sections: &[Section]) -> Vec<Frame> {
    let last = sections.len() - 1;
    let mut frames: Vec<Frame> = Vec::with_capacity(sections.len());
    for k in 0..=last {
        let (from, to) = (k.saturating_sub(1), (k + 1).min(last));
        let chord = sections[to].centre_m - sections[from].centre_m;
        let tangent = chord.try_normalize().unwrap_or(DVec3::X);
        let across = match frames.last() {
            None => level_across(tangent),
            Some(before) => continued_across(tangent, before.across),
        };
        frames.push(Frame { tangent, across });
    }
    frames
}

/// Direction across a limb that is horizontal, towards the left; of an upright limb straight to the
/// left.
fn level_across(tangent: DVec3) -> DVec3 {
    let upright = tangent.cross(DVec3::Z).length() < 0.2;
    let across = if upright { DVec3::Y } else { tangent.cross(DVec3::Z) };
    let across = (across - tangent * across.dot(tangent)).try_normalize().unwrap_or(DVec3::Y);
    if across.y < 0.0 { -across } else { across }
}

/// Horizontal direction across a limb on the same side as before; if the limb turns too far for that, the
/// previous direction without twist.
fn continued_across(tangent: DVec3, before: DVec3) -> DVec3 {
    let level = level_across(tangent);
    let level = if level.dot(before) < 0.0 { -level } else { level };
    let carried = (before - tangent * before.dot(tangent)).try_normalize().unwrap_or(level);
    if level.dot(carried) > 0.8 { level } else { carried }
}

/// Points of an ellipse across the frame's tangent.
fn ring(s: &Section, frame: &Frame, sectors: usize) -> Vec<DVec3> {
    let up = frame.tangent.cross(frame.across);
    let at = |k: usize| {
        let angle = TAU * (k % sectors) as f64 / sectors as f64;
        s.centre_m + s.half_width_m * angle.cos() * frame.across + s.half_height_m * angle.sin() * up
    };
    (0..=sectors).map(at).collect()
}

/// Rings from the end section outwards (`sign` along the tangent) to the tip, a quarter ellipse a little
/// flatter than round.
fn dome(s: &Section, frame: &Frame, sign: f64, sectors: usize) -> Vec<Vec<DVec3>> {
    let height = 0.7 * s.half_width_m.min(s.half_height_m);
    let smaller = |k: usize| {
        let angle = FRAC_PI_2 * k as f64 / 2.0;
        let share = if k == 2 { 0.0 } else { angle.cos() };
        Section {
            centre_m: s.centre_m + sign * height * angle.sin() * frame.tangent,
            half_width_m: share * s.half_width_m,
            half_height_m: share * s.half_height_m,
        }
    };
    (1..=2).map(|k| ring(&smaller(k), frame, sectors)).collect()
}

/// The surface rotated about the y axis through the origin; a positive angle lowers the front.
pub(crate) fn pitched(surface: Surface, angle_rad: f64) -> Surface {
    let turn = DQuat::from_rotation_y(angle_rad);
    surface.map(|p| turn * p)
}
