//! Order of two materials in one place: the one that is lit, and hides the other.
//!
//! A mesh draws a plate on a bumper, a decal or a sheet on metal with facets that coincide. Which lies on top
//! is unknown; metal below something thin reflects as much as metal, so the better reflector is lit. Size and
//! order of the facets have no part in it, so S does not depend on how a mesh is cut or listed.

use crate::bodies::world::World;
use crate::materials::surface_response::{layers_of, reflection};
use artifact::material::Material;
use artifact::units::SPEED_OF_LIGHT_MPS;
use std::cmp::Ordering;
use std::f64::consts::TAU;

/// Order of the materials of two coincident facets, the lit one first: opaque ones before sheets that waves
/// pass through, conductors before all others, then the one that reflects more.
pub(crate) fn material_order(world: &World, one: u32, other: u32) -> Ordering {
    let [a, b] = [one, other].map(|facet| world.lossy_material(facet).map(|material| &**material));
    if a == b {
        return Ordering::Equal;
    }
    let by_reflection = || by_reflection(a, b);
    world.is_transparent(one).cmp(&world.is_transparent(other)).then_with(by_reflection)
}

/// Conductors, which are `None`, first; then by reflection at normal incidence, and where it is equal by all
/// numbers of the material.
fn by_reflection(a: Option<&Material>, b: Option<&Material>) -> Ordering {
    let numbers = |material: Option<&Material>| material.map(numbers_of);
    numbers(a).partial_cmp(&numbers(b)).unwrap_or(Ordering::Equal)
}

/// Frequency at which reflections are compared: that of the permittivities.
const COMPARED_HZ: f64 = 77e9;

/// Reflection at normal incidence, negative, then permittivities and thicknesses.
fn numbers_of(material: &Material) -> Vec<f64> {
    let reflected = reflection(material, 1.0, TAU * COMPARED_HZ / SPEED_OF_LIGHT_MPS).te.norm();
    let permittivities = material.permittivities().into_iter().flat_map(|e| [e.re, e.im]);
    let thicknesses_m = layers_of(material).iter().map(|layer| layer.thickness_m);
    [-reflected].into_iter().chain(permittivities).chain(thicknesses_m).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::material::{Backing, Layer, Thickness};
    use num_complex::Complex64;

    fn layers(permittivity: f64, backing: Backing) -> Material {
        let layer = |thickness_m| Layer { thickness_m, permittivity: Complex64::from(permittivity) };
        Material::Layers { layers: vec![layer(1e-4)], backing, thickness: Thickness::Averaged }
    }

    #[test]
    fn conductors_come_first_then_what_reflects_more() {
        let half_space = |real: f64| Material::HalfSpace { permittivity: Complex64::new(real, -0.1) };
        let descending =
            [layers(2.0, Backing::Metal), half_space(9.0), half_space(3.0), layers(2.0, Backing::Air)];
        assert_eq!(by_reflection(None, Some(&descending[0])), Ordering::Less);
        for pair in descending.windows(2) {
            let [a, b] = [&pair[0], &pair[1]];
            assert_eq!(by_reflection(Some(a), Some(b)), Ordering::Less, "{a:?} {b:?}");
            assert_eq!(by_reflection(Some(b), Some(a)), Ordering::Greater);
        }
    }
}
