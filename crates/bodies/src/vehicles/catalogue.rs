//! Catalogue of all vehicles by name: the twelve models and the families, made by their classes.

use crate::vehicles::dimensions::{ParameterSampler, SizeRange};
use crate::vehicles::drawing::mesh_builder::{Assembly, Vehicle};
use crate::vehicles::family::{self, Family};
use crate::vehicles::{bus, car, cycle, heavy, loft, motorcycle, truck};
use artifact::scene::Mesh;
use artifact::settings::Class;

/// Names of the twelve models, three of each class.
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

/// Names of all vehicles: [`NAMES`], then the families, class by class.
pub fn names() -> Vec<&'static str> {
    NAMES.into_iter().chain(family::all().iter().map(|family| family.name.as_str())).collect()
}

/// Names of all crosses of a class, as `car-kei+pickup`: built like the first family, in proportions half way
/// to those of another one of its class and build.
pub fn crosses_of(class: Class) -> Vec<String> {
    family::crosses_of(class)
}

/// The two families in the name of a cross; `None` for any other name.
pub fn families_of(cross: &str) -> Option<[&'static str; 2]> {
    family::of_cross(cross).map(|families| families.map(|family| family.name.as_str()))
}

/// Class of one of [`names`] or [`crosses_of`]; `None` for any other name.
pub fn class_of(name: &str) -> Option<Class> {
    if let Some(family) = family::find(name) {
        return Some(family.class);
    }
    let kind = NAMES.contains(&name).then(|| name.split('-').next())?;
    Class::ALL.into_iter().find(|class| Some(class.name()) == kind)
}

/// Mesh of one of [`names`] or [`crosses_of`] in body axes, with a bounding box (mirrors, handlebar and rider
/// included) of the nominal dimensions for seed 0 and of dimensions drawn from [`ranges_m`] for any other
/// seed; `None` for any other name.
pub fn mesh(name: &str, seed: u64) -> Option<Mesh> {
    vehicle(name, seed).map(|vehicle| vehicle.mesh)
}

/// [`mesh`] with a mark for its triangles of road wheels.
pub fn vehicle(name: &str, seed: u64) -> Option<Vehicle> {
    let (parts, size_m) = drawing(name, seed)?;
    Some(parts.finish(name, size_m))
}

/// Least and largest length, width and height that seeds draw, in metres; `None` for a name not in [`names`].
pub fn ranges_m(name: &str) -> Option<[[f64; 2]; 3]> {
    size_range(name).map(|size| size.range_m)
}

pub(crate) fn size_range(name: &str) -> Option<SizeRange> {
    if let Some(family) = family::find(name) {
        return Some(family.size_range());
    }
    match class_of(name)? {
        Class::Car => Some(car::size_range(name)),
        Class::Bus => Some(bus::size_range(name)),
        Class::Truck => Some(truck::size_range(name)),
        Class::Motorcycle => Some(motorcycle::size_range(name)),
    }
}

/// Parts, and the size to scale them to.
pub(crate) fn drawing(name: &str, seed: u64) -> Option<(Assembly, [f64; 3])> {
    match family::find(name) {
        Some(family) => Some(family_drawing(&family, seed)),
        None => model_drawing(&ParameterSampler { model: name, seed }),
    }
}

fn family_drawing(family: &Family, seed: u64) -> (Assembly, [f64; 3]) {
    let parameters = family.parameters(seed);
    let [nominal_m, size_m] = parameters.sizes_m();
    let parts = match family.class {
        Class::Car | Class::Bus => loft::draw(&parameters, nominal_m, size_m),
        Class::Truck => heavy::draw(&parameters, nominal_m, size_m),
        Class::Motorcycle => cycle::draw(&parameters, nominal_m, size_m),
    };
    (parts, size_m)
}

fn model_drawing(sampler: &ParameterSampler) -> Option<(Assembly, [f64; 3])> {
    let size_m = sampler.size_m(&size_range(sampler.model)?);
    let parts = match class_of(sampler.model)? {
        Class::Car => car::draw(sampler, size_m),
        Class::Bus => bus::draw(sampler, size_m),
        Class::Truck => truck::draw(sampler, size_m),
        Class::Motorcycle => motorcycle::draw(sampler, size_m),
    };
    Some((parts, size_m))
}
