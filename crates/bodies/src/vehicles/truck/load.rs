//! Loads of a truck: a box, a tank, a trailer's box.

use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::solids::{disc, limb, rounded_box, section, sharp_box, tube};
use crate::vehicles::drawing::surface::{Material, Surface};
use crate::vehicles::truck::form::{Form, Kind};
use glam::DVec3;

pub(crate) fn add(form: &Form, truck: &mut Assembly) {
    match form.kind {
        Kind::Box => {
            van_body(form, truck);
            cooler(form, truck);
        }
        Kind::Semi => van_body(form, truck),
        Kind::Tanker => tank(form, truck),
    }
}

/// A box with corner posts, floor edge and rear doors with locking bars.
fn van_body(form: &Form, truck: &mut Assembly) {
    let [front, rear] = form.load_x;
    let (low, high) = (form.load_floor_z, form.load_top_z);
    let (length, middle, height) = (front - rear, 0.5 * (front + rear), high - low);
    let width = 2.0 * form.half_width_m + 0.04;
    truck.add(rounded_box([length, width, height], 0.045, Material::Paint).moved(
        middle,
        0.0,
        0.5 * (low + high),
    ));
    truck.add_pair(sharp_box([length - 0.1, 0.03, 0.13], Material::Aluminium).moved(
        middle,
        0.5 * width - 0.005,
        low + 0.10,
    ));
    truck.add_pair(sharp_box([length - 0.1, 0.03, 0.10], Material::Aluminium).moved(
        middle,
        0.5 * width - 0.005,
        high - 0.10,
    ));
    for x in [front - 0.07, rear + 0.09] {
        truck.add_pair(sharp_box([0.10, 0.04, height - 0.12], Material::Aluminium).moved(
            x,
            0.5 * width - 0.005,
            0.5 * (low + high),
        ));
    }
    rear_doors(form, truck);
}

pub(crate) fn rear_doors(form: &Form, truck: &mut Assembly) {
    let rear = form.load_x[1];
    let (low, high) = (form.load_floor_z, form.load_top_z);
    for y in [0.28, 0.92] {
        let bar = [[rear - 0.022, y, low + 0.06], [rear - 0.022, y, high - 0.06]];
        truck.add_pair(tube(&bar, 0.017, 8, Material::Steel));
        truck.add_pair(sharp_box([0.03, 0.26, 0.03], Material::Steel).moved(
            rear - 0.02,
            y - 0.1,
            low + 0.55,
        ));
    }
    truck.add(sharp_box([0.02, 0.04, high - low - 0.12], Material::Rubber).moved(
        rear - 0.004,
        0.0,
        0.5 * (low + high),
    ));
    for z in [low + 0.3, 0.5 * (low + high), high - 0.3] {
        truck.add_pair(sharp_box([0.03, 0.16, 0.06], Material::Steel).moved(
            rear - 0.01,
            form.half_width_m - 0.09,
            z,
        ));
    }
}

/// Refrigeration unit on the front wall, above the cab.
fn cooler(form: &Form, truck: &mut Assembly) {
    let front = form.load_x[0];
    let room = front + 0.02 - form.cab_rear_x();
    let height = 0.5_f64.min(form.load_top_z - form.cab_roof_z - 0.05);
    if height > 0.25 && room < 0.0 {
        let unit = rounded_box([0.16, 1.5, height], 0.04, Material::Plastic);
        truck.add(unit.moved(front + 0.07, 0.0, form.load_top_z - 0.5 * height - 0.12));
    }
}

/// An elliptical tank with domed ends on saddles, with manholes, walkway, rail and ladder.
pub(crate) fn tank(form: &Form, truck: &mut Assembly) {
    let [front, rear] = form.load_x;
    let half_height = 0.5 * (form.load_top_z - form.load_floor_z) - 0.03;
    let z = form.load_top_z - half_height;
    truck.add(vessel([front - 0.12, rear + 0.42], z, form.half_width_m - 0.02, half_height));
    saddles(form, z - half_height, truck);
    top_fittings(form, truck);
    ladder(form, truck);
    cabinets(form, truck);
}

fn vessel([front, rear]: [f64; 2], z: f64, half_width: f64, half_height: f64) -> Surface {
    let dome = 0.30;
    let (first, last) = (rear + dome, front - dome);
    let rings = ((last - first) / 0.9).ceil() as u32;
    let at = |x: f64, share: f64| section([x, 0.0, z], half_width * share, half_height * share);
    // Half ellipsoids at the ends: projection of a section that is the given share of the full one.
    let ends = [0.06_f64, 0.36, 0.62, 0.82, 0.95].map(|share| (share, dome * (1.0 - share * share).sqrt()));
    let mut sections: Vec<_> = ends.iter().map(|(share, out)| at(first - out, *share)).collect();
    sections.extend((0..=rings).map(|k| at(first + (last - first) * f64::from(k) / f64::from(rings), 1.0)));
    sections.extend(ends.iter().rev().map(|(share, out)| at(last + out, *share)));
    limb(&sections, 44, Material::Aluminium)
}

fn saddles(form: &Form, low_z: f64, truck: &mut Assembly) {
    let [front, rear] = form.load_x;
    for k in 0..4 {
        let x = rear + 0.9 + (front - rear - 1.8) * f64::from(k) / 3.0;
        truck.add(sharp_box([0.14, 1.5, 0.34], Material::Steel).moved(x, 0.0, low_z + 0.10));
        truck.add_pair(sharp_box([0.10, 0.10, 0.30], Material::Steel).moved(x, 0.42, form.frame_z + 0.05));
    }
}

fn top_fittings(form: &Form, truck: &mut Assembly) {
    let [front, rear] = form.load_x;
    let top = form.load_top_z;
    let (length, middle) = (front - rear - 1.6, 0.5 * (front + rear));
    truck.add_pair(sharp_box([length, 0.07, 0.16], Material::Aluminium).moved(middle, 0.42, top + 0.01));
    for k in 0..4 {
        let x = middle + length * (f64::from(k) / 3.0 - 0.5) * 0.78;
        let cover = disc(0.27, 0.12, 18, Material::Steel).map(|p| DVec3::new(p.x, -p.z, p.y)).outward();
        truck.add(cover.moved(x, 0.0, top + 0.04));
    }
    let rail_z = form.size_m[2] - 0.02;
    let (ahead, behind) = (middle + 0.5 * length, middle - 0.5 * length);
    let rail = [
        [ahead, 0.44, top + 0.05],
        [ahead - 0.05, 0.44, rail_z],
        [behind + 0.05, 0.44, rail_z],
        [behind, 0.44, top + 0.05],
    ];
    truck.add(tube(&rail, 0.02, 8, Material::Aluminium));
}

fn ladder(form: &Form, truck: &mut Assembly) {
    let x = form.load_x[1] + 0.06;
    let (low, high) = (0.75, form.load_top_z - 0.02);
    for y in [0.24, 0.60] {
        let stile = [[x, y, low], [x, y, high - 0.25], [x + 0.45, y, high + 0.02]];
        truck.add(tube(&stile, 0.02, 6, Material::Aluminium));
    }
    for k in 0..7 {
        let z = low + 0.1 + 0.27 * f64::from(k);
        if z < high - 0.25 {
            truck.add(tube(&[[x, 0.24, z], [x, 0.60, z]], 0.014, 6, Material::Aluminium));
        }
    }
}

/// Hose and meter cabinets on the flanks.
fn cabinets(form: &Form, truck: &mut Assembly) {
    let x = form.twin_axles_x[0] + form.wheel_radius_m + 0.95;
    truck.add_pair(rounded_box([1.1, 0.55, 0.5], 0.03, Material::Paint).moved(x, 0.93, form.frame_z + 0.05));
    let rear = form.load_x[1];
    truck.add(rounded_box([0.5, 2.2, 0.12], 0.03, Material::Plastic).moved(
        rear + 0.35,
        0.0,
        form.frame_z - 0.02,
    ));
}
