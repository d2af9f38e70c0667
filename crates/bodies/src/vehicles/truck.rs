//! Trucks: box body, tanker, tractor with semitrailer.

pub(crate) mod form;
mod cab;
pub(crate) mod chassis;
pub(crate) mod load;

use crate::vehicles::dimensions::ParameterSampler;
use crate::vehicles::drawing::mesh_builder::Assembly;
use form::Form;
pub(crate) use form::size_range;

/// Makes a whole truck in its drawing's axes, in the given size.
pub(crate) fn draw(sampler: &ParameterSampler, size_m: [f64; 3]) -> Assembly {
    let form = Form::of(sampler, size_m);
    let mut truck = Assembly::default();
    cab::add(&form, &mut truck);
    chassis::add(&form, &mut truck);
    load::add(&form, &mut truck);
    truck
}
