//! Passenger cars: sport utility, saloon, hatchback.

mod form;
mod skin;
mod trim;

use super::dimensions::Draw;
use super::mesh_builder::Assembly;
use super::wheel::{Drive, Rim, Wheel, arch_liner, axle};
pub(super) use form::{Body, Form};

/// A whole car in its drawing's axes and the size it is to be fitted to.
pub(super) fn draw(draw: &Draw) -> (Assembly, [f64; 3]) {
    let form = Form::of(draw);
    let mut car = Assembly::default();
    car.add(skin::cut_skin(&form));
    running_gear(&form, &mut car);
    trim::add(&form, &mut car);
    (car, form.size_m)
}

fn running_gear(form: &Form, car: &mut Assembly) {
    let wheel = Wheel {
        radius_m: form.wheel_radius_m,
        width_m: form.tyre_width_m,
        rim_radius_m: 0.66 * form.wheel_radius_m,
        rim: Rim::Spoked { spokes: form.spokes },
        sectors: 26,
    };
    let outer_y = form.half_width_m - 0.03;
    for axle_x in form.axles_x() {
        wheel.add_pair(car, axle_x, outer_y);
        let inner_y = outer_y - form.tyre_width_m - 0.06;
        car.add_pair(arch_liner(
            axle_x,
            form.wheel_radius_m,
            form.arch_radius_m() + 0.008,
            inner_y,
            form.half_width_m - 0.045,
        ));
        let half_track_m = outer_y - 0.6 * form.tyre_width_m;
        car.add(axle(axle_x, form.wheel_radius_m, half_track_m, Drive::Driven { casing_radius_m: 0.11 }));
    }
}
