//! Lofted bodies: cars, vans, buses and the cabs of trucks, each a single skin over drawn lines.

mod form;
mod face;
mod skin;
mod trim;

use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::wheel::{ArchLiner, Drive, Rim, Wheel, arch_liner, axle};
use crate::vehicles::family::Parameters;
use crate::vehicles::parts;
pub(crate) use form::{Envelope, Form};
use glam::DVec3;

/// Makes a whole passenger vehicle in its drawing's axes, in the given size.
pub(crate) fn draw(parameters: &Parameters<'_>, nominal_m: [f64; 3], size_m: [f64; 3]) -> Assembly {
    let form = Form::of(parameters, &Envelope::of_size(parameters, size_m));
    let mut vehicle = Assembly::default();
    add_body(parameters, &form, &mut vehicle);
    for axle in 0..form.axles_x.len() {
        add_wheels(parameters, &form, axle, &mut vehicle);
    }
    parts::add(parameters, DVec3::from_array(size_m) / DVec3::from_array(nominal_m), &mut vehicle);
    vehicle
}

/// Adds the skin with its panes and lamps, the linings of its arches, and its attached parts.
pub(crate) fn add_body(parameters: &Parameters<'_>, form: &Form, to: &mut Assembly) {
    let skin = skin::cut_skin(parameters, form);
    for axle_x in &form.axles_x {
        to.add_pair(arch_liner(&ArchLiner {
            axle: [*axle_x, form.wheel_radius_m],
            radius_m: form.arch_radius_m() + 0.008,
            low_z: form.clearance_m + 0.01,
            inner_y: form.arch_inner_y() - 0.005,
            outer_y: form.half_width_m - 0.06,
        }));
    }
    trim::add(parameters, form, &skin, to);
    to.add(skin);
}

fn add_wheels(parameters: &Parameters<'_>, form: &Form, number: usize, to: &mut Assembly) {
    let (axle_x, twin) = (form.axles_x[number], number > 0 && form.twin);
    let outer_y = form.half_width_m + parameters.number("wheel_out_m");
    let rim = match (parameters.word("rims"), twin) {
        ("steel", false) => Rim::SteelConvex,
        (_, true) => Rim::SteelConcave,
        _ => Rim::Spoked { spokes: parameters.number("spokes") as u32 },
    };
    let wheel = Wheel {
        radius_m: form.wheel_radius_m,
        width_m: form.tyre_width_m,
        rim_radius_m: parameters.number("rim") * form.wheel_radius_m,
        rim,
        sectors: parameters.number("wheel_sectors") as usize,
    };
    wheel.add_pair(to, axle_x, outer_y);
    if twin {
        wheel.add_inner_pair(to, axle_x, outer_y - form.tyre_width_m - 0.03);
    }
    let casing_radius_m = parameters.number("axle_casing_m");
    to.add(axle(
        axle_x,
        form.wheel_radius_m,
        outer_y - 0.6 * form.tyre_width_m,
        Drive::Driven { casing_radius_m },
    ));
}
