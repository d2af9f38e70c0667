//! Passenger cars: sport utility, saloon, hatchback.

mod form;
mod skin;
mod trim;

use crate::vehicles::dimensions::ParameterSampler;
use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::wheel::{ArchLiner, Drive, Rim, Wheel, arch_liner, axle};
use form::Form;
pub(crate) use form::size_range;

/// Makes a whole car in its drawing's axes, in the given size.
pub(crate) fn draw(sampler: &ParameterSampler, size_m: [f64; 3]) -> Assembly {
    let form = Form::of(sampler, size_m);
    let mut car = Assembly::default();
    car.add(skin::cut_skin(&form));
    running_gear(&form, &mut car);
    trim::add(&form, &mut car);
    car
}

fn running_gear(form: &Form, car: &mut Assembly) {
    let wheel = Wheel {
        radius_m: form.wheel_radius_m,
        width_m: form.tyre_width_m,
        rim_radius_m: 0.66 * form.wheel_radius_m,
        rim: Rim::Spoked { spokes: form.spokes },
        sectors: 24,
    };
    let outer_y = form.half_width_m - 0.03;
    for axle_x in form.axles_x() {
        wheel.add_pair(car, axle_x, outer_y);
        car.add_pair(arch_liner(&ArchLiner {
            axle: [axle_x, form.wheel_radius_m],
            radius_m: form.arch_radius_m() + 0.008,
            low_z: form.clearance_m + 0.01,
            inner_y: form.arch_inner_y() - 0.005,
            outer_y: form.half_width_m - 0.045,
        }));
        let half_track_m = outer_y - 0.6 * form.tyre_width_m;
        car.add(axle(axle_x, form.wheel_radius_m, half_track_m, Drive::Driven { casing_radius_m: 0.11 }));
    }
}
