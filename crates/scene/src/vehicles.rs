//! The project's own vehicles of four classes, drawn as a coachbuilder would, from lines: twelve parametric models, and
//! families whose proportions, parts and spreads stand in tables (`crates/scene/vehicles/CLASS.toml`).
//!
//! A name and a seed go in, a closed-looking body of some 10⁴ facets comes out: a [`Mesh`] in body axes (x forward, y left,
//! z up, metres, origin in the middle of the bounding box on the ground) with a unit normal per vertex and named
//! materials. Seed 0 has the nominal dimensions, any other seed draws them from the ranges of real vehicles, so that a
//! data set does not hold one shape a hundred times. Equal names and seeds give equal bytes.
//!
//! Reading order: `curve` draws lines, `shell` lofts them to a skin, `stencil` cuts panes, arches and lamps into it along
//! exact outlines, `solids` adds what is bolted on, `mesh_builder` fits, smooths and rounds the whole, `glb` writes it.
//! `family` draws from the tables; `loft` (cars, buses, cabs), `heavy` (trucks) and `cycle` (two-wheelers) make a mesh of it.
//! Facets are small where the skin is curved (5 to 10 cm on bodies, 2 to 5 cm on roundings) and as large as they like
//! where it is flat; at 77 GHz that is a faceted vehicle, not a smooth one (chord over √(ρλ) is above 0.7 below ρ ≈ 5 m):
//! the stored normals are there for whoever rebuilds the curved skin first.
//!
//! ```
//! let suv = scene::vehicles::mesh("car-suv", 0).ok_or("unknown name")?;
//! let front = suv.vertices_m.iter().map(|v| v[0]).fold(0.0, f64::max);
//! assert!((front - 2.5).abs() < 1e-6);
//! let bytes = scene::vehicles::glb(&suv);
//! assert_eq!(&bytes[..4], b"glTF");
//! # Ok::<(), &str>(())
//! ```

mod dimensions;
mod family;
mod curve;
mod surface;
mod stencil;
mod openings;
mod shell;
mod solids;
mod wheel;
mod car;
mod bus;
mod truck;
mod rider;
mod motorcycle;
mod parts;
mod loft;
mod heavy;
mod cycle;
mod mesh_builder;
mod glb;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod family_tests;

pub use glb::glb;

use artifact::scene::Mesh;
use artifact::settings::Class;
use dimensions::{Draw, SizeRange};
use family::Family;
use mesh_builder::Assembly;

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

/// Class of one of [`names`]; `None` for any other name.
pub fn class_of(name: &str) -> Option<Class> {
    if let Some(family) = family::find(name) {
        return Some(family.class);
    }
    let kind = NAMES.contains(&name).then(|| name.split('-').next())?;
    Class::ALL.into_iter().find(|class| Some(class.name()) == kind)
}

/// One of [`names`] in body axes, its bounding box (mirrors, handlebar and rider included) of the nominal dimensions for
/// seed 0 and of dimensions drawn from [`ranges_m`] for any other; `None` for any other name.
pub fn mesh(name: &str, seed: u64) -> Option<Mesh> {
    let (parts, size_m) = drawing(name, seed)?;
    Some(parts.finish(name, size_m))
}

/// Least and largest length, width and height that seeds draw, in metres; `None` for a name not in [`names`].
pub fn ranges_m(name: &str) -> Option<[[f64; 2]; 3]> {
    size_range(name).map(|size| size.range_m)
}

fn size_range(name: &str) -> Option<SizeRange> {
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

/// Parts and the size they are to be fitted to.
fn drawing(name: &str, seed: u64) -> Option<(Assembly, [f64; 3])> {
    match family::find(name) {
        Some(family) => Some(family_drawing(family, seed)),
        None => model_drawing(&Draw { model: name, seed }),
    }
}

fn family_drawing(family: &Family, seed: u64) -> (Assembly, [f64; 3]) {
    let drawn = family.drawn(seed);
    let [nominal_m, size_m] = drawn.sizes_m();
    let parts = match family.class {
        Class::Car | Class::Bus => loft::draw(&drawn, nominal_m, size_m),
        Class::Truck => heavy::draw(&drawn, nominal_m, size_m),
        Class::Motorcycle => cycle::draw(&drawn, nominal_m, size_m),
    };
    (parts, size_m)
}

fn model_drawing(draw: &Draw) -> Option<(Assembly, [f64; 3])> {
    let size_m = draw.size_m(&size_range(draw.model)?);
    let parts = match class_of(draw.model)? {
        Class::Car => car::draw(draw, size_m),
        Class::Bus => bus::draw(draw, size_m),
        Class::Truck => truck::draw(draw, size_m),
        Class::Motorcycle => motorcycle::draw(draw, size_m),
    };
    Some((parts, size_m))
}
