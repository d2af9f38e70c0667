//! Chassis of a truck: ladder frame, axles, wheels, tanks, guards.

use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::solids::{disc, rounded_box, sharp_box, tube};
use crate::vehicles::drawing::surface::{Material, Surface};
use crate::vehicles::drawing::wheel::{Drive, Rim, Wheel, axle};
use crate::vehicles::truck::form::{Form, Kind};
use glam::DVec3;

pub(crate) fn add(form: &Form, truck: &mut Assembly) {
    wheels(form, truck);
    ladder(form.frame_x, form.frame_z, truck);
    tanks(form, truck);
    for axle_x in &form.twin_axles_x {
        mudguard(form, *axle_x, truck);
    }
    if form.kind == Kind::Semi {
        let [front, rear] = form.load_x;
        ladder([front - 0.6, rear + 0.1], form.load_floor_z - 0.02, truck);
        landing_legs(form, truck);
    }
    rear_guard(form, truck);
    side_guards(form, truck);
}

/// Two rails with their cross members, open between.
fn ladder([front, rear]: [f64; 2], top_z: f64, truck: &mut Assembly) {
    let (length, middle, height) = (front - rear, 0.5 * (front + rear), 0.24);
    let z = top_z - 0.5 * height;
    truck.add_pair(sharp_box([length, 0.07, height], Material::Steel).moved(middle, 0.42, z));
    let members = (length / 1.3).round() as usize;
    for k in 0..=members {
        let x = rear + 0.1 + (length - 0.2) * k as f64 / members as f64;
        truck.add(sharp_box([0.08, 0.78, 0.14], Material::Steel).moved(x, 0.0, z));
    }
}

fn wheels(form: &Form, truck: &mut Assembly) {
    let outer_y = form.half_width_m - 0.02;
    let wheel = |rim: Rim, width_m: f64| Wheel {
        radius_m: form.wheel_radius_m,
        width_m,
        rim_radius_m: 0.58 * form.wheel_radius_m,
        rim,
        sectors: form.wheel_sectors,
    };
    wheel(Rim::SteelConvex, 0.31).add_pair(truck, form.front_axle_x, outer_y);
    truck.add(axle(form.front_axle_x, form.wheel_radius_m, 0.95, Drive::Plain { radius_m: 0.06 }));
    for axle_x in &form.twin_axles_x {
        let twin = wheel(Rim::SteelConcave, 0.29);
        twin.add_pair(truck, *axle_x, outer_y);
        twin.add_inner_pair(truck, *axle_x, outer_y - 0.33);
        truck.add(axle(*axle_x, form.wheel_radius_m, 0.95, Drive::Driven { casing_radius_m: 0.22 }));
    }
    for axle_x in &form.single_axles_x {
        wheel(Rim::SteelConvex, 0.385).add_pair(truck, *axle_x, outer_y);
        truck.add(axle(*axle_x, form.wheel_radius_m, 0.9, Drive::Plain { radius_m: 0.07 }));
    }
}

/// A tank along x: a drum between its end plates.
fn drum(radius_m: f64, length_m: f64, material: Material) -> Surface {
    disc(radius_m, length_m, 16, material).map(|p| DVec3::new(p.y, -p.x, p.z)).outward()
}

/// Tanks for fuel and air, and battery, on either rail behind the cab.
fn tanks(form: &Form, truck: &mut Assembly) {
    let x = form.front_axle_x - form.wheel_radius_m - 0.85;
    let z = form.frame_z - 0.30;
    truck.add(drum(0.30, 1.05, Material::Aluminium).moved(x, 0.83, z));
    truck.add(rounded_box([0.62, 0.52, 0.42], 0.03, Material::Plastic).moved(x + 0.2, -0.83, z));
    truck.add(drum(0.14, 0.8, Material::Steel).moved(x - 0.55, -0.70, z + 0.05));
    truck.add(drum(0.13, 0.9, Material::Steel).moved(form.front_axle_x - 0.3, 0.1, z));
    let exhaust = [[x + 0.9, -0.35, z], [x - 0.3, -0.45, z - 0.12], [x - 0.5, -1.05, z - 0.12]];
    truck.add(tube(&exhaust, 0.055, 8, Material::Steel));
}

/// A curved sheet over the twin wheels.
fn mudguard(form: &Form, axle_x: f64, truck: &mut Assembly) {
    let radius = form.wheel_radius_m + 0.07;
    let at = |k: usize, radius: f64| {
        let angle = std::f64::consts::PI * (0.12 + 0.76 * k as f64 / 8.0);
        let (x, z) = (axle_x + radius * angle.cos(), form.wheel_radius_m + radius * angle.sin());
        [0.01, 0.64].map(|inset| DVec3::new(x, form.half_width_m - inset, z))
    };
    let (outer, inner) = (|k: usize| at(k, radius + 0.012), |k: usize| at(k, radius));
    let row = |k: usize| {
        let ([a, b], [c, d]) = (outer(k), inner(k));
        vec![a, b, d, c, a]
    };
    let mut guard = Surface::from_rows(&(0..=8).map(row).collect::<Vec<_>>(), Material::Plastic);
    for (k, turned) in [(0, true), (8, false)] {
        let ([a, b], [c, d]) = (outer(k), inner(k));
        let mut end = Surface::default();
        end.push_quad(if turned { [a, c, d, b] } else { [a, b, d, c] }, Material::Plastic);
        guard.append(end);
    }
    truck.add_pair(guard.welded().outward());
}

/// Underrun guard below the rear end (UN Regulation 58: at most 0.55 m above the ground), with lamps and
/// plate.
fn rear_guard(form: &Form, truck: &mut Assembly) {
    let rear = form.ends_x[1];
    let z = 0.50;
    let bar = sharp_box([0.10, 2.36, 0.12], Material::Steel);
    truck.add(bar.moved(rear + 0.12, 0.0, z));
    let frame_z = if form.kind == Kind::Semi { form.load_floor_z } else { form.frame_z } - 0.2;
    truck.add_pair(sharp_box([0.08, 0.06, frame_z - z], Material::Steel).moved(
        rear + 0.14,
        0.42,
        0.5 * (frame_z + z),
    ));
    let lamp_z = 0.5 * (z + 0.06 + frame_z) + 0.06;
    truck.add_pair(sharp_box([0.07, 0.44, 0.15], Material::TailLamp).moved(rear + 0.10, 0.95, lamp_z));
    truck.add(sharp_box([0.03, 2.3, 0.05], Material::Steel).moved(rear + 0.14, 0.0, lamp_z));
    truck.add(sharp_box([0.014, 0.52, 0.11], Material::Plate).moved(rear + 0.10, 0.0, lamp_z));
}

/// Rails between the axles that protect cyclists (UN Regulation 73).
fn side_guards(form: &Form, truck: &mut Assembly) {
    let [front, rear] = match form.kind {
        Kind::Semi => [form.load_x[0] - 3.4, form.single_axles_x[0] + 0.7],
        _ => {
            [form.front_axle_x - form.wheel_radius_m - 1.6, form.twin_axles_x[0] + form.wheel_radius_m + 0.25]
        }
    };
    if front - rear < 0.5 {
        return;
    }
    let (length, middle, y) = (front - rear, 0.5 * (front + rear), form.half_width_m - 0.05);
    for z in [0.50, 0.80] {
        truck.add_pair(sharp_box([length, 0.035, 0.11], Material::Aluminium).moved(middle, y, z));
    }
    for x in [front - 0.2, rear + 0.2] {
        truck.add_pair(sharp_box([0.05, 0.03, 0.68], Material::Steel).moved(x, y - 0.035, 0.78));
    }
}

/// Supports of a parked trailer.
fn landing_legs(form: &Form, truck: &mut Assembly) {
    let x = form.load_x[0] - 2.9;
    let (foot, top) = (0.38, form.load_floor_z - 0.05);
    truck.add_pair(sharp_box([0.12, 0.12, top - foot], Material::Steel).moved(x, 0.62, 0.5 * (top + foot)));
    truck.add_pair(sharp_box([0.26, 0.24, 0.03], Material::Steel).moved(x, 0.62, foot));
    truck.add(tube(&[[x, -0.62, 0.75], [x, 0.62, 0.75]], 0.025, 6, Material::Steel));
}
