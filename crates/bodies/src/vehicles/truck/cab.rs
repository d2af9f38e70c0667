//! Forward-control cab: shell, arches, panes, lamps, bumper, steps, mirrors.

use crate::vehicles::drawing::curve::{Curve, smooth_step};
use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::openings::{
    End, Flank, PANE, end_panel, end_panel_pair, flank_panel, panel, wheel_arch,
};
use crate::vehicles::drawing::shell::{Layout, Shell, even, spaced};
use crate::vehicles::drawing::solids::{bent, rounded_box, sharp_box, tube};
use crate::vehicles::drawing::stencil::{CutTreatment, cut};
use crate::vehicles::drawing::surface::{Material, Surface};
use crate::vehicles::drawing::wheel::{ArchLiner, arch_liner};
use crate::vehicles::truck::form::{Form, Kind};
use glam::DVec3;

pub(crate) fn add(form: &Form, truck: &mut Assembly) {
    truck.add(skin(form));
    truck.add_pair(arch_liner(&ArchLiner {
        axle: [form.front_axle_x, form.wheel_radius_m],
        radius_m: arch_radius_m(form) + 0.008,
        low_z: BOTTOM_Z + 0.02,
        inner_y: ARCH_INNER_Y - 0.005,
        outer_y: form.half_width_m - 0.045,
    }));
    mirrors(form, truck);
    steps(form, truck);
    visor_and_plate(form, truck);
    if form.kind != Kind::Tanker {
        deflector(form, truck);
    }
}

const BOTTOM_Z: f64 = 0.36;
const ARCH_INNER_Y: f64 = 0.72;

fn arch_radius_m(form: &Form) -> f64 {
    form.wheel_radius_m + 0.08
}

/// Lower and upper edge of windscreen and side panes.
fn panes_z(form: &Form) -> [f64; 2] {
    let low = if form.kind == Kind::Semi { 1.95 } else { form.cab_roof_z - 1.20 };
    [low, low + 0.82]
}

fn skin(form: &Form) -> Surface {
    let [front, rear] = [form.ends_x[0], form.cab_rear_x()];
    let skin = shell(form).skin(&layout(form)).map(|p| leaning(form, p));
    let skin = cut(skin, |p| 0.62 - p.z, CutTreatment::Recoloured(Material::Plastic));
    let skin = wheel_arch(skin, [form.front_axle_x, form.wheel_radius_m], arch_radius_m(form), ARCH_INNER_Y);
    let [low, high] = panes_z(form);
    let window = panel([front - 1.22, front - 0.30], [low - 0.06, high - 0.05], 0.10);
    let skin = flank_panel(skin, Flank::Both, window, PANE);
    let reach = End::Front { beyond_x: front - 0.6 };
    let skin = end_panel(skin, reach, panel([-1.12, 1.12], [low, high], 0.12), PANE);
    let lamp = CutTreatment::Inset { material: Material::Lamp, rim: Material::Plastic, depth_m: 0.012 };
    let skin = end_panel_pair(skin, reach, panel([0.76, 1.16], [0.68, 0.86], 0.06), lamp);
    let slots = CutTreatment::Inset { material: Material::Plastic, rim: Material::Chrome, depth_m: 0.03 };
    let skin = end_panel(skin, reach, panel([-0.80, 0.80], [1.02, low - 0.30], 0.06), slots);
    let rear_window = End::Rear { beyond_x: rear + 0.2 };
    end_panel(skin, rear_window, panel([-0.5, 0.5], [low + 0.15, high - 0.1], 0.08), PANE)
}

fn shell(form: &Form) -> Shell {
    let [front, rear] = [form.ends_x[0], form.cab_rear_x()];
    let (half, roof) = (form.half_width_m, form.cab_roof_z);
    let lift = 0.25; // the rear of the cab ends higher, above the fittings of the frame
    let roof_slope = if form.kind == Kind::Semi { 0.30 } else { 0.12 };
    Shell {
        bottom_z: Curve::through(&[
            (rear, BOTTOM_Z + lift),
            (form.front_axle_x - 0.35, BOTTOM_Z + lift),
            (form.front_axle_x + 0.35, BOTTOM_Z),
            (front, BOTTOM_Z),
        ]),
        waist_z: Curve::flat(panes_z(form)[0] - WAIST_BELOW_PANES_M),
        rail_z: Curve::through(&[
            (rear, roof - 0.17),
            (front - 0.9, roof - 0.18),
            (front, roof - 0.17 - roof_slope),
        ]),
        top_z: Curve::through(&[
            (rear, roof - 0.02),
            (front - 1.0, roof),
            (front - 0.3, roof - 0.4 * roof_slope),
            (front, roof - roof_slope),
        ]),
        sill_y: Curve::flat(half - 0.02),
        belly_y: Curve::flat(half),
        waist_y: Curve::flat(half - 0.01),
        rail_y: Curve::flat(half - 0.10),
        upper_bow_m: 0.015,
        roof_exponent: 3.0,
        sill_radius_m: 0.05,
        end_radius_m: [0.18, 0.06],
        ends_x: [front, rear],
    }
}

fn layout(form: &Form) -> Layout {
    let [front, rear] = [form.ends_x[0], form.cab_rear_x()];
    Layout { stations_x: spaced(rear, front, 0.13), lower: lower_rows(form), upper: even(6), half_columns: 5 }
}

/// Rows at the edges of bumper and lamps, as shares of the height from the underside to the waist.
fn lower_rows(form: &Form) -> Vec<f64> {
    let waist = panes_z(form)[0] - WAIST_BELOW_PANES_M;
    let rows = [BOTTOM_Z, 0.50, 0.62, 0.68, 0.86, 1.02].into_iter().chain(spaced(1.16, waist, 0.2));
    rows.map(|z| (z - BOTTOM_Z) / (waist - BOTTOM_Z)).collect()
}

const WAIST_BELOW_PANES_M: f64 = 0.10;

/// Shapes the flat nose, bowed in plan and leaning back above the grille.
fn leaning(form: &Form, p: DVec3) -> DVec3 {
    let front = form.ends_x[0];
    let across = (p.y / form.half_width_m).powi(2);
    let lean = 0.10 * (p.z - 1.1).max(0.0) + 0.02 * (p.z - 1.1).max(0.0).powi(2);
    let ahead = smooth_step(front - 0.9, front, p.x);
    DVec3::new(p.x - ahead * (0.10 * across + lean), p.y, p.z)
}

fn mirrors(form: &Form, truck: &mut Assembly) {
    let outer = 0.5 * form.size_m[1] - 0.105;
    let [low, high] = panes_z(form);
    let (x, z) = (form.ends_x[0] - 0.12, 0.5 * (low + high) + 0.05);
    truck.add_pair(rounded_box([0.13, 0.21, 0.62], 0.05, Material::Plastic).moved(x, outer, z));
    truck.add_pair(sharp_box([0.006, 0.17, 0.36], Material::Glass).moved(x - 0.067, outer, z + 0.09));
    truck.add_pair(sharp_box([0.006, 0.17, 0.14], Material::Glass).moved(x - 0.067, outer, z - 0.20));
    for dz in [-0.24, 0.24] {
        let arm = [
            [x - 0.28, form.half_width_m - 0.08, z + dz],
            [x - 0.1, outer - 0.05, z + dz],
            [x, outer, z + dz],
        ];
        truck.add_pair(tube(&bent(&arm, 0.3), 0.018, 8, Material::Plastic));
    }
}

fn steps(form: &Form, truck: &mut Assembly) {
    let front = form.ends_x[0];
    for z in [0.50, 0.80] {
        truck.add_pair(sharp_box([0.46, 0.05, 0.05], Material::Aluminium).moved(
            front - 0.45,
            form.half_width_m - 0.01,
            z,
        ));
    }
    let (x, side) = (front - 1.32, form.half_width_m);
    let handle =
        [[x, side - 0.03, 1.3], [x, side + 0.03, 1.35], [x, side + 0.02, 2.0], [x, side - 0.05, 2.05]];
    truck.add_pair(tube(&handle, 0.014, 6, Material::Chrome));
}

fn visor_and_plate(form: &Form, truck: &mut Assembly) {
    let front = form.ends_x[0];
    let [_, high] = panes_z(form);
    let lean = 0.10 * (high - 1.1) + 0.02 * (high - 1.1_f64).powi(2);
    truck.add(sharp_box([0.22, 2.0, 0.04], Material::Plastic).moved(front - lean - 0.02, 0.0, high + 0.07));
    truck.add(sharp_box([0.014, 0.52, 0.11], Material::Plate).moved(front + 0.004, 0.0, 0.50));
}

/// Wind deflector up to the load.
fn deflector(form: &Form, truck: &mut Assembly) {
    let (rear, roof) = (form.cab_rear_x(), form.cab_roof_z);
    let rise = form.load_top_z - 0.06 - roof;
    let front = rear + 1.5;
    let shell = Shell {
        bottom_z: Curve::flat(roof - 0.08),
        waist_z: Curve::through(&[(rear, roof + 0.45 * rise), (front, roof)]),
        rail_z: Curve::through(&[
            (rear, roof + 0.85 * rise),
            (rear + 0.5, roof + 0.72 * rise),
            (front, roof + 0.03),
        ]),
        top_z: Curve::through(&[
            (rear, roof + rise),
            (rear + 0.5, roof + 0.88 * rise),
            (front - 0.2, roof + 0.2 * rise),
            (front, roof + 0.06),
        ]),
        sill_y: Curve::flat(1.08),
        belly_y: Curve::flat(1.09),
        waist_y: Curve::flat(1.08),
        rail_y: Curve::flat(0.98),
        upper_bow_m: 0.02,
        roof_exponent: 2.8,
        sill_radius_m: 0.02,
        end_radius_m: [0.03, 0.03],
        ends_x: [front, rear],
    };
    let layout =
        Layout { stations_x: spaced(rear, front, 0.2), lower: even(1), upper: even(3), half_columns: 5 };
    truck.add(shell.skin(&layout));
}
