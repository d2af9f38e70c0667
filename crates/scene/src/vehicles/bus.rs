//! Buses: city bus, coach, minibus.

mod form;
mod skin;
mod trim;

use super::dimensions::Draw;
use super::mesh_builder::Assembly;
use super::wheel::{Drive, Rim, Wheel, arch_liner, axle};
use form::Form;

/// A whole bus in its drawing's axes and the size it is to be fitted to.
pub(super) fn draw(draw: &Draw) -> (Assembly, [f64; 3]) {
    let form = Form::of(draw);
    let mut bus = Assembly::default();
    bus.add(skin::cut_skin(&form));
    running_gear(&form, &mut bus);
    trim::add(&form, &mut bus);
    (bus, form.size_m)
}

fn running_gear(form: &Form, bus: &mut Assembly) {
    let outer_y = form.half_width_m - 0.04;
    for (axle_x, rim) in [(form.front_axle_x, Rim::SteelConvex), (form.rear_axle_x, Rim::SteelConcave)] {
        let wheel = Wheel {
            radius_m: form.wheel_radius_m,
            width_m: form.tyre_width_m,
            rim_radius_m: 0.58 * form.wheel_radius_m,
            rim,
            sectors: 24,
        };
        wheel.add_pair(bus, axle_x, outer_y);
        let mut depth = form.tyre_width_m + 0.08;
        if matches!(rim, Rim::SteelConcave) {
            wheel.add_inner_pair(bus, axle_x, outer_y - form.tyre_width_m - 0.03);
            depth += form.tyre_width_m + 0.03;
        }
        let arch = form.arch_radius_m() + 0.008;
        bus.add_pair(arch_liner(axle_x, form.wheel_radius_m, arch, outer_y - depth, form.half_width_m - 0.045));
        let half_track_m = outer_y - 0.7 * form.tyre_width_m;
        bus.add(axle(axle_x, form.wheel_radius_m, half_track_m, Drive::Driven { casing_radius_m: 0.2 }));
    }
}
