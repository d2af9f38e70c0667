//! Motorcycles with their riders: street, scooter, touring.

pub(crate) mod parts;
mod nominal;
mod scooter;
mod street;
mod touring;

use crate::vehicles::dimensions::{ParameterSampler, SizeRange};
use crate::vehicles::drawing::mesh_builder::Assembly;
use glam::DVec3;
use parts::CycleWheel;

/// Overall length, width over handlebar (mirrors, cases), height with the rider seated. Ranges: published
/// figures of machines sold in Europe, rounded to 5 cm. Street: 300 to 900 cm³ without fairing (Honda CB500F
/// 2.1 × 0.8, Yamaha MT-07 2.1 × 0.75); scooters of 110 to 350 cm³ (Honda SH125, PCX, Yamaha XMAX: 1.9 to 2.2
/// × 0.75); tourers (BMW R 1250 RT 2.2 × 1.0, Honda Gold Wing 2.5 × 0.95). The height over the helmet is that
/// of a seat 0.75 to 0.85 m high and a sitting height of 0.80 to 0.95 m (5th to 95th percentile of adults)
/// with the helmet, less the lean.
pub(crate) fn size_range(model: &str) -> SizeRange {
    match model {
        "motorcycle-street" => {
            SizeRange { nominal_m: [2.1, 0.8, 1.65], range_m: [[2.0, 2.2], [0.75, 0.85], [1.55, 1.75]] }
        }
        "motorcycle-scooter" => {
            SizeRange { nominal_m: [1.95, 0.75, 1.7], range_m: [[1.85, 2.15], [0.7, 0.8], [1.6, 1.8]] }
        }
        _ => SizeRange { nominal_m: [2.35, 0.98, 1.75], range_m: [[2.2, 2.55], [0.92, 1.02], [1.65, 1.85]] },
    }
}

/// Makes a whole motorcycle in its drawing's axes, in the given size.
pub(crate) fn draw(sampler: &ParameterSampler, size_m: [f64; 3]) -> Assembly {
    let nominal_m = size_range(sampler.model).nominal_m;
    let nominal = match sampler.model {
        "motorcycle-street" => street::nominal(sampler),
        "motorcycle-scooter" => scooter::nominal(sampler),
        _ => touring::nominal(sampler),
    };
    let stretch = DVec3::from_array(size_m) / DVec3::from_array(nominal_m);
    let mut motorcycle = Assembly::default();
    motorcycle.add_all(nominal.parts, |part| part.map(|p| p * stretch));
    for wheel in [nominal.front, nominal.rear] {
        // Wheels stay round when the axle moves.
        CycleWheel { axle_x: wheel.axle_x * stretch.x, ..wheel }.add(&mut motorcycle);
    }
    motorcycle
}
