//! Trim on a bus's skin: mirrors on arms, pods on the roof, plates, underfloor machinery.

use crate::vehicles::bus::form::{Form, Kind};
use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::solids::{bent, disc, rounded_box, sharp_box, tube};
use crate::vehicles::drawing::surface::Material;

pub(crate) fn add(form: &Form, bus: &mut Assembly) {
    match form.kind {
        Kind::City => city_mirrors(form, bus),
        Kind::Coach => coach_mirrors(form, bus),
        Kind::Mini => mini_mirrors(form, bus),
    }
    roof(form, bus);
    plates(form, bus);
    underbody(form, bus);
}

/// Mirrors on arms that reach forward and out from the corners above the windscreen.
fn city_mirrors(form: &Form, bus: &mut Assembly) {
    let [front, _] = form.ends_x;
    let (outer, z) = (0.5 * form.size_m[1] - 0.11, form.windscreen_z[1] - 0.1);
    let arm = [
        [front - 0.35, 1.15, z + 0.2],
        [front - 0.05, outer - 0.05, z + 0.18],
        [front - 0.02, outer, z - 0.05],
    ];
    bus.add_pair(tube(&bent(&arm, 0.4), 0.018, 8, Material::Plastic));
    bus.add_pair(rounded_box([0.10, 0.21, 0.42], 0.04, Material::Plastic).moved(
        front - 0.02,
        outer,
        z - 0.25,
    ));
    bus.add_pair(sharp_box([0.006, 0.16, 0.36], Material::Glass).moved(front - 0.073, outer, z - 0.25));
}

/// A coach's mirrors hang from long arms ahead of the windscreen.
fn coach_mirrors(form: &Form, bus: &mut Assembly) {
    let [front, _] = form.ends_x;
    let (outer, z, ahead) = (0.5 * form.size_m[1] - 0.12, form.windscreen_z[1], 0.5 * form.size_m[0] - 0.07);
    let arm = [[front - 0.75, 1.12, z + 0.25], [ahead - 0.1, outer - 0.05, z + 0.2], [ahead, outer, z - 0.2]];
    bus.add_pair(tube(&bent(&arm, 0.4), 0.03, 8, Material::Plastic));
    bus.add_pair(rounded_box([0.13, 0.24, 0.50], 0.05, Material::Paint).moved(ahead, outer, z - 0.40));
    bus.add_pair(sharp_box([0.006, 0.18, 0.42], Material::Glass).moved(ahead - 0.068, outer, z - 0.40));
}

fn mini_mirrors(form: &Form, bus: &mut Assembly) {
    let (x, outer) = (form.cowl_x() - 0.30, 0.5 * form.size_m[1] - 0.10);
    bus.add_pair(rounded_box([0.12, 0.20, 0.32], 0.05, Material::Plastic).moved(x, outer, 1.48));
    bus.add_pair(sharp_box([0.006, 0.15, 0.26], Material::Glass).moved(x - 0.062, outer, 1.48));
    bus.add_pair(tube(&[[x, form.half_width_m - 0.10, 1.34], [x, outer, 1.34]], 0.025, 8, Material::Plastic));
}

/// Air conditioning, and on the city bus a cover over tanks or batteries.
fn roof(form: &Form, bus: &mut Assembly) {
    let [front, rear] = form.ends_x;
    let pod = |length: f64, width: f64, height: f64, x: f64| {
        let centre_z = form.size_m[2] - 0.5 * height;
        rounded_box([length, width, height], 0.09, Material::Paint).moved(x, 0.0, centre_z)
    };
    match form.kind {
        Kind::City => {
            bus.add(pod(2.3, 1.9, 0.30, form.rear_axle_x + 0.2));
            bus.add(pod(2.6, 1.8, 0.28, form.front_axle_x - 1.2));
        }
        Kind::Coach => bus.add(pod(2.9, 1.8, 0.24, 0.5 * (front + rear))),
        Kind::Mini => bus.add(rounded_box([1.1, 1.1, 0.16], 0.05, Material::Paint).moved(
            rear + 2.1,
            0.0,
            form.roof_z - 0.03,
        )),
    }
}

fn plates(form: &Form, bus: &mut Assembly) {
    let [front, rear] = form.ends_x;
    let plate = || sharp_box([0.014, 0.52, 0.11], Material::Plate);
    let z = form.clearance_m + 0.38;
    bus.add(plate().moved(front + 0.004, 0.0, z));
    bus.add(plate().moved(rear - 0.004, 0.0, z + 0.2));
}

/// Engine sump, exhaust silencer and tanks below the floor.
fn underbody(form: &Form, bus: &mut Assembly) {
    let z = form.clearance_m;
    let [_, rear] = form.ends_x;
    let sump = rounded_box([0.9, 0.6, 0.18], 0.05, Material::Steel);
    let engine_x = if form.kind == Kind::Mini { form.front_axle_x + 0.1 } else { rear + 1.5 };
    bus.add(sump.moved(engine_x, 0.0, z + 0.02));
    bus.add(rounded_box([1.0, 0.5, 0.16], 0.05, Material::Plastic).moved(0.3, -0.35, z + 0.02));
    let silencer = disc(0.11, 0.7, 12, Material::Steel).moved(rear + 1.1, 0.4, z + 0.04);
    bus.add(silencer);
    bus.add(tube(&[[rear + 1.1, 0.5, z + 0.03], [rear + 0.1, 0.6, z + 0.06]], 0.04, 8, Material::Steel));
}
