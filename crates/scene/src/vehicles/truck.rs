//! Trucks: box body, tanker, tractor with semitrailer.

mod cab;
mod chassis;
mod form;
mod load;

use super::dimensions::Draw;
use super::mesh_builder::Assembly;
use form::Form;

/// A whole truck in its drawing's axes and the size it is to be fitted to.
pub(super) fn draw(draw: &Draw) -> (Assembly, [f64; 3]) {
    let form = Form::of(draw);
    let mut truck = Assembly::default();
    cab::add(&form, &mut truck);
    chassis::add(&form, &mut truck);
    load::add(&form, &mut truck);
    (truck, form.size_m)
}
