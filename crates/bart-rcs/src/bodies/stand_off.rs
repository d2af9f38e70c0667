//! Permitted positions of an antenna among bodies: a wavelength away from every facet, and not enclosed by
//! them.
//!
//! Waves are taken as spherical and transverse. The field of a dipole has further terms of 1/kr and 1/(kr)²:
//! they are 0.16 (−16 dB) of the wave at r = λ and grow below that, and a body that near changes the antenna
//! itself. From inside a closed body no wave escapes, so that no order of bounces is the last and nothing
//! returns from a distance R: S, its (R/r)² and its phase are meaningless there.

use crate::bodies::world::World;
use crate::geometry::antenna::Antenna;
use crate::geometry::facet_geometry::FacetGeometry;
use crate::geometry::section::triangle_sr;
use crate::run_control::error::BartError;
use glam::DVec3;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Refuses an antenna nearer to a facet than a wavelength, or inside a closed body with consistently wound
/// facets; sheets that waves pass through close no body.
pub(crate) fn check_antenna_position(
    world: &World,
    antenna: Antenna,
    wavelength_m: f64,
) -> Result<(), BartError> {
    let Antenna::Point(at_m) = antenna else { return Ok(()) };
    let Some(reach) = world.facets().iter().map(bounds).reduce(joined) else { return Ok(()) };
    if distance_to_box_m(at_m, reach) >= wavelength_m {
        return Ok(());
    }
    check_distance(world, at_m, wavelength_m)?;
    let opaque = (0..).zip(world.facets()).filter(|&(index, _)| !world.is_transparent(index));
    let parts = opaque.map(|(index, facet)| (index, seen_from(at_m, facet)));
    let taken_sr = parts.clone().map(|(_, sr)| sr).sum::<f64>().abs();
    // Walls within walls take more than 4π though each may have an opening that a sheet fills; closed ones
    // take a whole multiple.
    let spheres = taken_sr / (4.0 * PI);
    if world.has_sheets() && 4.0 * PI * (spheres - spheres.round()).abs() > GAP_SR {
        return Ok(());
    }
    check_enclosed(world, taken_sr, parts)
}

/// Solid angle below which a gap counts as closed: rounding of a solid angle is below 1e-9 of it, and a
/// millionth of all directions is 4 mm wide at 1 m.
const GAP_SR: f64 = 4.0 * PI * 1e-6;

/// Refuses an antenna surrounded by facets, judged by their total solid angle, sr; `parts` are the solid
/// angles of single facets, by which the bodies are named.
pub(crate) fn check_enclosed(
    world: &World,
    taken_sr: f64,
    parts: impl Iterator<Item = (u32, f64)>,
) -> Result<(), BartError> {
    if taken_sr < 4.0 * PI - GAP_SR {
        return Ok(());
    }
    let mut by_body: BTreeMap<&str, f64> = BTreeMap::new();
    parts.for_each(|(facet, sr)| *by_body.entry(world.id_of_body(facet)).or_default() += sr);
    let mut walls: Vec<(&str, f64)> = by_body.into_iter().map(|(body, sr)| (body, sr.abs())).collect();
    walls.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    // As many bodies as leave no more than the gap: a closed body elsewhere takes as much with its front as
    // with its back.
    let mut left_sr = 4.0 * PI;
    let is_needed = |&(_, sr): &(&str, f64)| {
        let is_needed = left_sr > GAP_SR;
        left_sr -= sr;
        is_needed
    };
    let bodies = walls.into_iter().take_while(is_needed).map(|(body, _)| body.to_owned()).collect();
    Err(BartError::AntennaEnclosed { bodies, share: (taken_sr / (4.0 * PI)).min(1.0) })
}

/// Distance of an antenna from the box around all facets, and the box's diagonal, m.
pub(crate) fn distance_and_diagonal_m(world: &World, antenna: Antenna) -> (f64, f64) {
    let Some([low, high]) = world.facets().iter().map(bounds).reduce(joined) else {
        return (f64::INFINITY, 0.0);
    };
    match antenna {
        Antenna::Point(at_m) => (distance_to_box_m(at_m, [low, high]), low.distance(high)),
        Antenna::Direction(_) => (f64::INFINITY, low.distance(high)),
    }
}

fn check_distance(world: &World, at_m: DVec3, least_m: f64) -> Result<(), BartError> {
    let of = |(index, facet): (u32, &FacetGeometry)| (distance_to_triangle_m(at_m, &facet.corners_m), index);
    let nearer = |a: (f64, u32), b: (f64, u32)| if b.0 < a.0 { b } else { a };
    match (0..).zip(world.facets()).map(of).reduce(nearer) {
        Some((distance_m, facet)) if distance_m < least_m => {
            Err(BartError::AntennaTooNear { body: world.id_of_body(facet).to_owned(), distance_m, least_m })
        }
        _ => Ok(()),
    }
}

fn seen_from(at_m: DVec3, facet: &FacetGeometry) -> f64 {
    let [a, b, c] = facet.corners_m.map(|corner| corner - at_m);
    triangle_sr(a, b, c)
}

fn bounds(facet: &FacetGeometry) -> [DVec3; 2] {
    let [a, b, c] = facet.corners_m;
    [a.min(b).min(c), a.max(b).max(c)]
}

fn joined([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> [DVec3; 2] {
    [a.min(c), b.max(d)]
}

fn distance_to_box_m(at_m: DVec3, [low, high]: [DVec3; 2]) -> f64 {
    at_m.distance(at_m.clamp(low, high))
}

/// Distance to the perpendicular foot if it lies inside, else to the nearest side.
fn distance_to_triangle_m(at_m: DVec3, corners_m: &[DVec3; 3]) -> f64 {
    let [a, b, c] = *corners_m;
    let normal = (b - a).cross(c - a);
    let sides = [(a, b), (b, c), (c, a)];
    let is_inside = sides.iter().all(|(from, to)| (to - from).cross(at_m - from).dot(normal) >= 0.0);
    if is_inside && normal != DVec3::ZERO {
        (at_m - a).dot(normal).abs() / normal.length()
    } else {
        sides.map(|(from, to)| distance_to_side_m(at_m, from, to)).into_iter().fold(f64::INFINITY, f64::min)
    }
}

fn distance_to_side_m(at_m: DVec3, from_m: DVec3, to_m: DVec3) -> f64 {
    let along = to_m - from_m;
    let share = (at_m - from_m).dot(along) / along.length_squared();
    at_m.distance(from_m + if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 } * along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::material::{Backing, Layer, Material, MeshMaterials, Thickness, Transmission};
    use artifact::scene::Mesh;
    use num_complex::Complex64;

    /// A cube of 1 m around the origin, with all facets facing outwards.
    fn cube_mesh() -> Mesh {
        let corner = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 0.5 } else { -0.5 });
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Mesh { vertices_m: (0..8).map(corner).collect(), triangles, ..Mesh::default() }
    }

    fn cube() -> World {
        World::of_mesh(&cube_mesh()).unwrap()
    }

    fn sheet() -> Material {
        let layers = vec![Layer { thickness_m: 0.003, permittivity: Complex64::from(2.3) }];
        Material::Layers { layers, backing: Backing::Air, thickness: Thickness::Exact }
    }

    fn standing(at_m: [f64; 3]) -> Result<(), BartError> {
        check_antenna_position(&cube(), Antenna::Point(DVec3::from_array(at_m)), 0.004)
    }

    #[test]
    fn an_antenna_may_stand_a_wavelength_off_and_no_nearer() {
        for (at_m, distance_m) in [
            ([0.503, 0.2, 0.1], 0.003),
            ([0.502, 0.502, 0.0], 0.002_f64.hypot(0.002)),
            ([0.4999, 0.0, 0.0], 0.0001),
            ([0.5, 0.1, 0.3], 0.0),
        ] {
            let Err(BartError::AntennaTooNear { distance_m: told, least_m, .. }) = standing(at_m) else {
                panic!("{at_m:?} is not refused")
            };
            assert!((told - distance_m).abs() < 1e-12 && least_m == 0.004, "{at_m:?}: {told}");
        }
        assert_eq!(standing([0.5041, 0.2, 0.1]), Ok(()));
        assert_eq!(standing([30.0, 0.2, 0.1]), Ok(()));
    }

    #[test]
    fn inside_a_closed_body_it_is_shut_in_and_beside_a_diagonal_it_is_not() {
        for at_m in [[0.0; 3], [0.1, 0.0, 0.0], [0.49, 0.49, -0.49]] {
            assert!(matches!(standing(at_m), Err(BartError::AntennaEnclosed { .. })), "{at_m:?}");
        }
        let of_share = |share: f64| check_enclosed(&cube(), 4.0 * PI * share, std::iter::empty());
        assert!(of_share(0.99).is_ok() && of_share(1.0 - 1e-9).is_err());
    }

    /// Result for an antenna inside a cube within a cube twice as large, with sheets in place of the metal
    /// of some triangles.
    fn inside_with_sheets(is_sheet: fn(usize) -> bool) -> Result<(), BartError> {
        let mut mesh = cube_mesh();
        let outer: Vec<[f64; 3]> = mesh.vertices_m.iter().map(|v| v.map(|x| 2.0 * x)).collect();
        mesh.vertices_m.extend(outer);
        mesh.triangles.extend(mesh.triangles.clone().iter().map(|corners| corners.map(|i| i + 8)));
        mesh.material_of_triangle = (0..24).map(|index| u16::from(is_sheet(index))).collect();
        let materials = vec![Material::Conductor, sheet()];
        mesh.makeup = MeshMaterials { materials, transmission: Transmission::Followed };
        let world = World::of_mesh(&mesh).unwrap();
        check_antenna_position(&world, Antenna::Point(DVec3::new(0.1, 0.0, 0.2)), 0.004)
    }

    #[test]
    fn sheets_open_the_metal_body_whose_sides_they_are_and_no_other() {
        let is_refused =
            |is_sheet| matches!(inside_with_sheets(is_sheet), Err(BartError::AntennaEnclosed { .. }));
        assert!(is_refused(|index| index >= 12), "the outer body is of sheets, the inner one is closed");
        assert!(is_refused(|index| index < 12));
        // Together their metal takes 5/3 of all directions.
        assert!(!is_refused(|index| index % 12 < 2), "one side of both bodies is a sheet");
    }
}
