//! Trucks: box body, tanker, tractor with semitrailer.

mod cab;
pub(super) mod chassis;
pub(super) mod form;
pub(super) mod load;

use super::dimensions::Draw;
use super::mesh_builder::Assembly;
use form::Form;
pub(super) use form::size_range;

/// A whole truck in its drawing's axes, made to the size given.
pub(super) fn draw(draw: &Draw, size_m: [f64; 3]) -> Assembly {
    let form = Form::of(draw, size_m);
    let mut truck = Assembly::default();
    cab::add(&form, &mut truck);
    chassis::add(&form, &mut truck);
    load::add(&form, &mut truck);
    truck
}
