//! Buses: city bus, coach, minibus.

mod form;
mod skin;
mod trim;

use crate::vehicles::dimensions::ParameterSampler;
use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::wheel::{ArchLiner, Drive, Rim, Wheel, arch_liner, axle};
use form::Form;
pub(crate) use form::size_range;

/// Makes a whole bus in its drawing's axes, in the given size.
pub(crate) fn draw(sampler: &ParameterSampler, size_m: [f64; 3]) -> Assembly {
    let form = Form::of(sampler, size_m);
    let mut bus = Assembly::default();
    bus.add(skin::cut_skin(&form));
    running_gear(&form, &mut bus);
    trim::add(&form, &mut bus);
    bus
}

fn running_gear(form: &Form, bus: &mut Assembly) {
    let outer_y = form.half_width_m - 0.04;
    for (axle_x, rim) in [(form.front_axle_x, Rim::SteelConvex), (form.rear_axle_x, Rim::SteelConcave)] {
        let wheel = Wheel {
            radius_m: form.wheel_radius_m,
            width_m: form.tyre_width_m,
            rim_radius_m: 0.58 * form.wheel_radius_m,
            rim,
            sectors: 22,
        };
        wheel.add_pair(bus, axle_x, outer_y);
        if matches!(rim, Rim::SteelConcave) {
            wheel.add_inner_pair(bus, axle_x, outer_y - form.tyre_width_m - 0.03);
        }
        bus.add_pair(arch_liner(&ArchLiner {
            axle: [axle_x, form.wheel_radius_m],
            radius_m: form.arch_radius_m() + 0.008,
            low_z: form.clearance_m + 0.01,
            inner_y: form.arch_inner_y() - 0.005,
            outer_y: form.half_width_m - 0.045,
        }));
        let half_track_m = outer_y - 0.7 * form.tyre_width_m;
        bus.add(axle(axle_x, form.wheel_radius_m, half_track_m, Drive::Driven { casing_radius_m: 0.2 }));
    }
}
