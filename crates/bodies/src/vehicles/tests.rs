//! Promises of the vehicles.

use crate::vehicles::catalogue::{NAMES, class_of, drawing, mesh, size_range, vehicle};
use crate::vehicles::dimensions::ParameterSampler;
use crate::vehicles::drawing::mesh_builder;
use crate::vehicles::glb::glb;
use artifact::scene::Mesh;
use artifact::settings::Class;
use glam::DVec3;
use std::sync::LazyLock;

/// A few seeds besides the nominal one.
const SEEDS: [u64; 4] = [0, 1, 2, 3];

/// Every vehicle with every seed, drawn once for all tests.
static EVERY: LazyLock<Vec<(&str, u64, Mesh)>> = LazyLock::new(|| {
    let drawn = |(name, seed)| mesh(name, seed).map(|mesh| (name, seed, mesh));
    NAMES.into_iter().flat_map(|name| SEEDS.map(|seed| (name, seed))).filter_map(drawn).collect()
});

fn every() -> impl Iterator<Item = &'static (&'static str, u64, Mesh)> {
    EVERY.iter()
}

fn bounds_m(mesh: &Mesh) -> (DVec3, DVec3) {
    let points = mesh.vertices_m.iter().map(|v| DVec3::from_array(*v));
    points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
}

fn corners_m(mesh: &Mesh, triangle: [u32; 3]) -> [DVec3; 3] {
    triangle.map(|i| DVec3::from_array(mesh.vertices_m[i as usize]))
}

#[test]
fn twelve_names_and_no_others_give_a_mesh_and_a_class() {
    for name in NAMES {
        assert!(mesh(name, 0).is_some(), "{name}");
        assert!(class_of(name).is_some_and(|class| name.starts_with(class.name())), "{name}");
    }
    for name in ["", "car", "car-", "car-suv ", "CAR-SUV", "truck-bus", "tractor"] {
        assert_eq!((mesh(name, 0), class_of(name)), (None, None), "{name}");
    }
    for class in Class::ALL {
        assert_eq!(NAMES.into_iter().filter(|name| class_of(name) == Some(class)).count(), 3, "{class:?}");
    }
}

/// Dimensions that the interface and the paper name, and those that the models' comments give.
const NOMINAL_M: [(&str, [f64; 3]); 12] = [
    ("car-suv", [5.0, 2.0, 1.8]),
    ("car-sedan", [4.8, 2.05, 1.46]),
    ("car-hatchback", [4.2, 2.0, 1.48]),
    ("bus-city", [12.1, 2.95, 3.15]),
    ("bus-coach", [12.4, 2.95, 3.75]),
    ("bus-mini", [6.95, 2.4, 2.75]),
    ("truck-box", [8.5, 2.95, 3.6]),
    ("truck-tanker", [9.4, 2.95, 3.3]),
    ("truck-semi", [16.5, 2.95, 4.0]),
    ("motorcycle-street", [2.1, 0.8, 1.65]),
    ("motorcycle-scooter", [1.95, 0.75, 1.7]),
    ("motorcycle-touring", [2.35, 0.98, 1.75]),
];

#[test]
fn seed_zero_has_the_nominal_dimensions() {
    for (name, size_m) in NOMINAL_M {
        let (low, high) = bounds_m(&mesh(name, 0).unwrap());
        // Single precision at 10 m keeps half a micrometre.
        assert!((high - low).abs_diff_eq(DVec3::from_array(size_m), 2e-6), "{name}: {}", high - low);
    }
}

#[test]
fn the_origin_is_the_middle_of_the_bounding_box_on_the_ground() {
    for (name, seed, mesh) in every() {
        let (low, high) = bounds_m(mesh);
        let middle = 0.5 * (low + high);
        assert!(
            middle.x.abs() < 1e-6 && middle.y.abs() < 1e-6 && low.z.abs() < 1e-6,
            "{name} {seed}: {low} {high}"
        );
    }
}

#[test]
fn other_seeds_spread_every_dimension_within_its_range() {
    for name in NAMES {
        let size = size_range(name).unwrap();
        let sizes_m: Vec<[f64; 3]> =
            (1..=8).map(|seed| ParameterSampler { model: name, seed }.size_m(&size)).collect();
        for k in 0..3 {
            let [low, high] = size.range_m[k];
            let (least, most) =
                sizes_m.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), s| (a.min(s[k]), b.max(s[k])));
            assert!(least >= low && most <= high, "{name}: {least}..{most} outside {low}..{high}");
            // Eight uniform draws cover less than a quarter of their range once in 2600 (8·¼⁷ − 7·¼⁸); the
            // seeds are fixed.
            assert!(most - least > 0.25 * (high - low), "{name}: {least}..{most} of {low}..{high}");
        }
    }
}

#[test]
fn a_mesh_has_the_dimensions_its_seed_draws() {
    for (name, seed, mesh) in every() {
        let asked_m = ParameterSampler { model: name, seed: *seed }.size_m(&size_range(name).unwrap());
        let (low, high) = bounds_m(mesh);
        assert!((high - low).abs_diff_eq(DVec3::from_array(asked_m), 2e-6), "{name} {seed}: {}", high - low);
    }
}

#[test]
fn drawings_are_made_to_size_and_only_trimmed_by_the_last_fit() {
    for name in NAMES {
        for seed in SEEDS {
            let (parts, size_m) = drawing(name, seed).unwrap();
            let (low, high) = mesh_builder::bounds_m(parts.parts());
            let scale = DVec3::from_array(size_m) / (high - low);
            assert!((scale - DVec3::ONE).abs().max_element() < 0.05, "{name} {seed}: stretched by {scale}");
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_bytes_and_another_seed_others() {
    for (name, seed, drawn_before) in every().filter(|(_, seed, _)| *seed == 1) {
        let again = vehicle(name, *seed).unwrap();
        assert_eq!(again.mesh, *drawn_before, "{name}");
        assert_eq!(glb(&again), glb(&vehicle(name, *seed).unwrap()), "{name}");
        assert_ne!(glb(&again), glb(&vehicle(name, *seed + 1).unwrap()), "{name}");
    }
    for pair in EVERY.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        let [one, other] = [&pair[0].2, &pair[1].2].map(|mesh| &mesh.vertices_m);
        assert_ne!(one, other, "{} {} and {}", pair[0].0, pair[0].1, pair[1].1);
    }
}

#[test]
fn everything_is_finite_and_every_index_is_in_range() {
    for (name, seed, mesh) in every() {
        assert!(mesh.vertices_m.iter().flatten().all(|v| v.is_finite()), "{name} {seed}");
        assert!(mesh.normals.iter().flatten().all(|v| v.is_finite()), "{name} {seed}");
        assert_eq!(mesh.normals.len(), mesh.vertices_m.len());
        assert_eq!(mesh.material_of_triangle.len(), mesh.triangles.len());
        assert!(
            mesh.triangles.iter().flatten().all(|i| (*i as usize) < mesh.vertices_m.len()),
            "{name} {seed}"
        );
        assert!(
            mesh.material_of_triangle.iter().all(|m| (*m as usize) < mesh.materials.len()),
            "{name} {seed}"
        );
    }
}

#[test]
fn no_triangle_is_degenerate() {
    for (name, seed, mesh) in every() {
        for triangle in &mesh.triangles {
            let [a, b, c] = corners_m(mesh, *triangle);
            let area_m2 = 0.5 * (b - a).cross(c - a).length();
            assert!(area_m2 > 1e-8, "{name} {seed}: {area_m2} m² at {a}");
        }
    }
}

#[test]
fn normals_are_unit_vectors_on_the_outer_side_of_their_facets() {
    for (name, seed, mesh) in every() {
        for triangle in &mesh.triangles {
            let [a, b, c] = corners_m(mesh, *triangle);
            for i in triangle {
                let normal = DVec3::from_array(mesh.normals[*i as usize].map(f64::from));
                // Three components of half an ulp each.
                assert!((normal.length() - 1.0).abs() < 2e-7, "{name} {seed}");
                assert!((b - a).cross(c - a).dot(normal) > 0.0, "{name} {seed}: {normal} at {a}");
            }
        }
    }
}

#[test]
fn parts_are_wound_outwards() {
    // A body hides its inside: seen from ahead, behind, aside, above and below the nearest facet faces the
    // viewer.
    for (name, seed, mesh) in every().filter(|(_, seed, _)| *seed == 0) {
        for axis in 0..3 {
            let (turned, total) = facing_away(mesh, axis);
            // Where outlines cross a rounded corner slivers may fold: of 1000 rays one at most may meet such
            // a one.
            assert!(
                turned * 1000 <= total,
                "{name} {seed} axis {axis}: {turned} of {total} rays meet a facet from behind"
            );
        }
    }
}

/// Rays along `axis`, both ways, on a grid of 24 × 24: how many meet a facet's inner side first, how many
/// meet any.
fn facing_away(mesh: &Mesh, axis: usize) -> (usize, usize) {
    let (low, high) = bounds_m(mesh);
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let (mut turned, mut total) = (0, 0);
    for k in 0..576 {
        let share = |n: usize| (n as f64 + 0.4817) / 24.0;
        let (at_u, at_v) =
            (low[u] + (high[u] - low[u]) * share(k % 24), low[v] + (high[v] - low[v]) * share(k / 24));
        let crossed = |t: &[u32; 3]| crossing(corners_m(mesh, *t), [axis, u, v], [at_u, at_v]);
        let mut hits: Vec<(f64, f64)> = mesh.triangles.iter().filter_map(crossed).collect();
        hits.sort_by(|a, b| a.0.total_cmp(&b.0));
        if let (Some(lowest), Some(highest)) = (hits.first(), hits.last()) {
            total += 2;
            turned += usize::from(highest.1 < 0.0) + usize::from(lowest.1 > 0.0);
        }
    }
    (turned, total)
}

/// Place where a line along the first of `axes` through the two coordinates given meets the triangle,
/// and the triangle's signed area seen along that axis.
fn crossing(corners: [DVec3; 3], [axis, u, v]: [usize; 3], at: [f64; 2]) -> Option<(f64, f64)> {
    let side = |a: DVec3, b: DVec3| (a[u] - at[0]) * (b[v] - at[1]) - (a[v] - at[1]) * (b[u] - at[0]);
    let [a, b, c] = corners;
    let weights = [side(b, c), side(c, a), side(a, b)];
    let area: f64 = weights.iter().sum();
    let inside = weights.iter().all(|w| w * area >= 0.0) && area != 0.0;
    inside.then(|| ((weights[0] * a[axis] + weights[1] * b[axis] + weights[2] * c[axis]) / area, area))
}

#[test]
fn meshes_have_three_to_sixteen_thousand_triangles() {
    for (name, seed, mesh) in every() {
        assert!((3_000..=16_000).contains(&mesh.triangles.len()), "{name} {seed}: {}", mesh.triangles.len());
    }
}

#[test]
fn materials_are_named_once_and_used() {
    for (name, seed, mesh) in every() {
        for (slot, material) in mesh.materials.iter().enumerate() {
            assert!(
                mesh.material_of_triangle.iter().any(|m| *m as usize == slot),
                "{name} {seed}: {material}"
            );
            assert!(!mesh.materials[..slot].contains(material), "{name} {seed}: {material}");
        }
        for needed in ["paint", "glass", "rubber", "steel", "lamp", "tail_lamp", "plate"] {
            assert!(mesh.materials.iter().any(|m| m == needed), "{name} {seed}: no {needed}");
        }
    }
}

#[test]
fn both_sides_of_a_vehicle_weigh_the_same_but_for_doors_exhausts_and_tanks() {
    for (name, seed, mesh) in every() {
        let side = |sign: f64| -> f64 {
            let area = |t: &[u32; 3]| {
                let [a, b, c] = corners_m(mesh, *t);
                if (a + b + c).y * sign > 0.0 { 0.5 * (b - a).cross(c - a).length() } else { 0.0 }
            };
            mesh.triangles.iter().map(area).sum()
        };
        let (left, right) = (side(1.0), side(-1.0));
        assert!(
            (left - right).abs() < 0.05 * (left + right),
            "{name} {seed}: {left} m² left, {right} m² right"
        );
    }
}
