//! The project's own vehicles: twelve parametric models of four classes.

mod curve;
mod dimensions;
mod surface;
mod stencil;
mod solids;
mod shell;
mod mesh_builder;
mod openings;
mod wheel;
mod car;
mod bus;
mod truck;
mod rider;
mod motorcycle;
mod glb;

pub use glb::glb;

use artifact::scene::Mesh;
use artifact::settings::Class;
use dimensions::Draw;

/// Names, by class.
pub const NAMES: [&str; 12] = [
    "car-suv",
    "car-sedan",
    "car-hatchback",
    "bus-city",
    "bus-coach",
    "bus-mini",
    "truck-box",
    "truck-tanker",
    "truck-semi",
    "motorcycle-street",
    "motorcycle-scooter",
    "motorcycle-touring",
];

/// Class of one of [`NAMES`]; `None` for any other name.
pub fn class_of(name: &str) -> Option<Class> {
    let kind = NAMES.contains(&name).then(|| name.split('-').next())?;
    Class::ALL.into_iter().find(|class| Some(class.name()) == kind)
}

/// One of [`NAMES`]; `None` for any other name.
pub fn mesh(name: &str, seed: u64) -> Option<Mesh> {
    let name = NAMES.into_iter().find(|known| *known == name)?;
    let draw = Draw { model: name, seed };
    let (parts, size_m) = match name {
        "car-suv" | "car-sedan" | "car-hatchback" => car::draw(&draw),
        "bus-city" | "bus-coach" | "bus-mini" => bus::draw(&draw),
        "truck-box" | "truck-tanker" | "truck-semi" => truck::draw(&draw),
        _ => motorcycle::draw(&draw),
    };
    Some(parts.finish(name, size_m))
}
