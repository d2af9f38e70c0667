//! Meshes of cars that are too coarse to scatter as a car does.

use crate::remarks::vehicles::vehicles;
use artifact::scene::{Mesh, SceneHeader};
use artifact::settings::{Class, SmallParts};
use std::collections::BTreeMap;

/// Number of triangles below which a car is coarse: real cars with fewer are on average 13 dB below the
/// published level at 10° elevation, those with over 20,000 2 dB (docs/validation/published-levels.md).
const COARSE: usize = 4_000;
/// Length below which a mesh is not a car, m.
const SHORTEST_M: f64 = 2.5;

/// Remark on each coarse mesh of a car that is not one of the project's own, unless small parts are drawn.
pub(super) fn remarks(header: &SceneHeader) -> Vec<String> {
    let draws_small_parts = header.fidelity.small_parts == SmallParts::Statistical;
    let coarse: BTreeMap<&String, usize> = vehicles(header)
        .filter(|_| !draws_small_parts)
        .filter(|(class, model, mesh)| *class == Class::Car && is_coarse(model, mesh))
        .map(|(_, model, mesh)| (model, mesh.triangles.len()))
        .collect();
    let remark = |(model, triangles): (&String, usize)| {
        format!(
            "note: {model}: {triangles} triangles: seen from 10° above, cars of fewer than {COARSE} lie 13 dB \
             below the published level in the mean, 11 dB below those of over 20,000; [model] detail = \
             \"statistical\" draws the parts that they lack (docs/validation/published-levels.md)"
        )
    };
    coarse.into_iter().map(remark).collect()
}

fn is_coarse(model: &str, mesh: &Mesh) -> bool {
    let [length_m, ..] = mesh.size_m();
    mesh.triangles.len() < COARSE && length_m >= SHORTEST_M && scene::vehicles::class_of(model).is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bar(length_m: f64, triangles: usize) -> Mesh {
        let vertices_m = vec![[0.0; 3], [length_m, 0.0, 0.0], [0.0, 1.0, 0.0]];
        Mesh { vertices_m, triangles: vec![[0, 1, 2]; triangles], ..Mesh::default() }
    }

    #[test]
    fn a_car_of_few_triangles_is_coarse_and_a_corner_an_own_vehicle_and_a_fine_mesh_are_not() {
        assert!(is_coarse("prius.glb", &bar(4.6, 2176)));
        assert!(!is_coarse("corner.obj", &bar(0.5, 3)));
        assert!(!is_coarse("car-suv", &bar(4.6, 2176)));
        assert!(!is_coarse("sedan.glb", &bar(4.6, 4000)));
    }
}
