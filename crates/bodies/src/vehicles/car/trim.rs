//! Trim on a car's skin: mirrors, handles, plates, rails, exhaust, seats behind the glass.

use crate::vehicles::car::form::{BodyStyle, Form};
use crate::vehicles::car::skin::shell;
use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::shell::Shell;
use crate::vehicles::drawing::solids::{bent, disc, ellipsoid, rounded_box, sharp_box, tube};
use crate::vehicles::drawing::surface::{Material, Surface};

pub(crate) fn add(form: &Form, car: &mut Assembly) {
    let shell = shell(form);
    mirrors(form, &shell, car);
    handles(form, &shell, car);
    plates(form, car);
    underbody(form, car);
    if form.body == BodyStyle::SportUtility {
        roof_rails(form, &shell, car);
    }
}

fn mirrors(form: &Form, shell: &Shell, car: &mut Assembly) {
    let x = form.cowl.0 - 0.30;
    let z = shell.waist_z.at(x) + 0.10;
    let outer = 0.5 * form.size_m[1];
    let pod = ellipsoid([0.075, 0.11, 0.075], 14, Material::Paint).moved(x, outer - 0.11, z);
    let glass = disc(0.062, 0.012, 12, Material::Glass);
    let faced = glass.map(|p| glam::DVec3::new(-p.y, 1.35 * p.x, p.z)).outward();
    car.add_pair(pod);
    car.add_pair(faced.moved(x - 0.068, outer - 0.11, z));
    let root = shell.side_y(x, z - 0.06) - 0.03;
    car.add_pair(tube(&[[x, root, z - 0.06], [x, outer - 0.10, z - 0.03]], 0.022, 8, Material::Plastic));
}

fn handles(form: &Form, shell: &Shell, car: &mut Assembly) {
    for x in [form.door_post_x() + 0.15, form.rear_axle_x + 0.42] {
        let z = shell.waist_z.at(x) - 0.12;
        let y = shell.side_y(x, z) + 0.012;
        car.add_pair(tube(&[[x - 0.09, y, z], [x + 0.09, y, z]], 0.016, 6, Material::Chrome));
    }
}

fn plates(form: &Form, car: &mut Assembly) {
    let [front, rear] = form.ends_x();
    let low = form.clearance_m;
    // 520 × 110 mm: the European plate (Council Regulation (EC) 2411/98 leaves the size to the member states'
    // common one).
    let plate = || sharp_box([0.012, 0.52, 0.11], Material::Plate);
    car.add(plate().moved(front + 0.004, 0.0, low + 0.33));
    car.add(plate().moved(rear + 0.026, 0.0, low + 0.435));
}

fn underbody(form: &Form, car: &mut Assembly) {
    let [_, rear] = form.ends_x();
    let z = form.clearance_m + 0.01;
    let path = [
        [form.front_axle_x - 0.2, 0.12, z],
        [form.rear_axle_x + 0.5, 0.12, z],
        [form.rear_axle_x - 0.2, 0.5, z + 0.04],
        [rear + 0.06, 0.5, z + 0.07],
    ];
    car.add(tube(&bent(&path, 0.3), 0.032, 8, Material::Steel));
    car.add(rounded_box([0.55, 0.24, 0.12], 0.05, Material::Steel).moved(rear + 0.42, 0.45, z + 0.05));
    let tank = rounded_box([0.60, 0.9, 0.14], 0.05, Material::Plastic);
    car.add(tank.moved(form.rear_axle_x + 0.62, -0.05, form.clearance_m + 0.01));
    let sump = rounded_box([0.55, 0.45, 0.16], 0.05, Material::Aluminium);
    car.add(sump.moved(form.front_axle_x + 0.05, 0.0, form.clearance_m + 0.02));
}

fn roof_rails(form: &Form, shell: &Shell, car: &mut Assembly) {
    let (front, rear) = (form.header.0 - 0.15, form.roof_end.0 + 0.12);
    let at = |x: f64, lift: f64| [x, form.roof_y - 0.055, shell.rail_z.at(x) + 0.045 + lift];
    let steps = 6;
    let mut path = vec![at(front, -0.01)];
    path.extend(
        (0..=steps)
            .map(|k| at(front - 0.12 + (rear - front + 0.24) * f64::from(k) / f64::from(steps), 0.045)),
    );
    path.push(at(rear, -0.01));
    let rail: Surface = tube(&path, 0.018, 8, Material::Aluminium);
    car.add_pair(rail);
}
