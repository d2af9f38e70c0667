//! Promises of the families.

use crate::vehicles::catalogue::{NAMES, class_of, drawing, mesh, names, ranges_m, vehicle};
use crate::vehicles::drawing::mesh_builder;
use crate::vehicles::family::{self, Family};
use crate::vehicles::glb::glb;
use artifact::scene::Mesh;
use artifact::settings::Class;
use glam::DVec3;
use std::collections::BTreeSet;
use std::sync::LazyLock;

const SEEDS: [u64; 4] = [0, 1, 7, 77];

/// Every family with every seed, drawn once for all tests.
static EVERY: LazyLock<Vec<(&str, u64, Mesh)>> = LazyLock::new(|| {
    let drawn = |(family, seed): (&'static Family, u64)| {
        Some((family.name.as_str(), seed, mesh(&family.name, seed)?))
    };
    family::all().iter().flat_map(|family| SEEDS.map(|seed| (family, seed))).filter_map(drawn).collect()
});

#[test]
fn every_class_has_at_least_twelve_families_whose_names_tell_it() {
    for class in Class::ALL {
        let of_class = family::all().iter().filter(|family| family.class == class);
        assert!(of_class.clone().count() >= 12, "{class:?}: {}", of_class.count());
    }
    for family in family::all() {
        assert_eq!(class_of(&family.name), Some(family.class), "{}", family.name);
        assert!(family.name.starts_with(&format!("{}-", family.class.name())), "{}", family.name);
    }
}

#[test]
fn no_two_vehicles_have_one_name() {
    let names = names();
    assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len());
    assert_eq!(names[..12], NAMES);
}

#[test]
fn every_family_gives_a_finite_mesh_of_some_thousand_triangles_for_every_seed() {
    assert_eq!(EVERY.len(), SEEDS.len() * family::all().len());
    for (name, seed, mesh) in EVERY.iter() {
        assert!(mesh.vertices_m.iter().flatten().all(|v| v.is_finite()), "{name} {seed}");
        assert!((1_500..=17_000).contains(&mesh.triangles.len()), "{name} {seed}: {}", mesh.triangles.len());
        assert!(
            mesh.triangles.iter().flatten().all(|i| (*i as usize) < mesh.vertices_m.len()),
            "{name} {seed}"
        );
        assert_eq!(mesh.normals.len(), mesh.vertices_m.len());
    }
}

#[test]
fn dimensions_are_drawn_within_the_ranges_of_the_tables() {
    for (name, seed, mesh) in EVERY.iter() {
        let (size_m, ranges_m) = (mesh.size_m(), ranges_m(name).unwrap());
        for k in 0..3 {
            let [low, high] = ranges_m[k];
            assert!(
                (low - 2e-6..=high + 2e-6).contains(&size_m[k]),
                "{name} {seed}: {size_m:?} of {ranges_m:?}"
            );
        }
    }
}

#[test]
fn the_last_fit_only_trims_what_the_tables_draw() {
    let stretched = |(name, seed, _): &(&'static str, u64, Mesh)| {
        let (parts, size_m) = drawing(name, *seed)?;
        let (low, high) = mesh_builder::bounds_m(parts.parts());
        let scale = DVec3::from_array(size_m) / (high - low);
        ((scale - DVec3::ONE).abs().max_element() > 0.15).then(|| format!("{name} {seed}: {scale}"))
    };
    let far: Vec<String> = EVERY.iter().filter_map(stretched).collect();
    assert!(far.is_empty(), "{far:#?}");
}

#[test]
fn no_triangle_is_degenerate_and_every_normal_is_a_unit_vector_on_the_outer_side() {
    for (name, seed, mesh) in EVERY.iter() {
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| DVec3::from_array(mesh.vertices_m[i as usize]));
            let facet = (b - a).cross(c - a);
            assert!(0.5 * facet.length() > 1e-9, "{name} {seed}: {a} {b} {c}");
            for i in t {
                let normal = DVec3::from_array(mesh.normals[*i as usize].map(f64::from));
                assert!((normal.length() - 1.0).abs() < 1e-5, "{name} {seed}: {normal}");
                assert!(normal.dot(facet) > 0.0, "{name} {seed}: {normal} at {a} {b} {c}");
            }
        }
    }
}

#[test]
fn equal_seeds_give_equal_bytes_and_other_seeds_others() {
    for pair in EVERY.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        assert_ne!(
            pair[0].2.vertices_m, pair[1].2.vertices_m,
            "{}: {} and {}",
            pair[0].0, pair[0].1, pair[1].1
        );
    }
    for (name, seed, drawn_before) in EVERY.iter().filter(|(_, seed, _)| *seed == 1) {
        let again = vehicle(name, *seed).unwrap();
        assert_eq!(again.mesh, *drawn_before, "{name}");
        assert_eq!(glb(&again), glb(&vehicle(name, *seed).unwrap()), "{name}");
    }
}

#[test]
fn two_wheelers_come_with_and_without_riders() {
    for family in family::all().iter().filter(|family| family.class == Class::Motorcycle) {
        let ridden = (1..=24).filter(|seed| family.parameters(*seed).has("rider")).count();
        // At 0.5 each, all or none of 24 are one in eight million; the seeds are fixed.
        assert!((1..24).contains(&ridden), "{}: {ridden} of 24", family.name);
    }
}

#[test]
fn every_drawn_value_is_keyed_by_the_family() {
    let lengths: BTreeSet<u64> =
        family::all().iter().map(|f| f.parameters(5).number("tyre_width_m").to_bits()).collect();
    assert!(lengths.len() > 30, "{}", lengths.len());
}

/// Every eleventh cross of each class.
fn crosses() -> Vec<String> {
    Class::ALL.into_iter().flat_map(|class| family::crosses_of(class).into_iter().step_by(11)).collect()
}

#[test]
fn crosses_are_finite_meshes_within_the_ranges_of_both() {
    for name in crosses() {
        for seed in [0, 7] {
            let mesh = mesh(&name, seed).unwrap();
            assert!(mesh.vertices_m.iter().flatten().all(|v| v.is_finite()), "{name} {seed}");
            let (size_m, ranges_m) = (mesh.size_m(), ranges_m(&name).unwrap());
            let within = |k: usize| (ranges_m[k][0] - 2e-6..=ranges_m[k][1] + 2e-6).contains(&size_m[k]);
            assert!((0..3).all(within), "{name} {seed}: {size_m:?} of {ranges_m:?}");
        }
    }
}

#[test]
fn a_cross_whose_second_family_alone_has_flaps_is_a_finite_mesh_with_them() {
    for seed in [813, 28] {
        let mesh = mesh("truck-ambulance+courier", seed).unwrap();
        assert!(mesh.vertices_m.iter().flatten().all(|v| v.is_finite()), "{seed}");
    }
}

#[test]
fn a_cross_has_its_class_and_one_with_itself_or_with_one_of_another_build_is_none() {
    assert_eq!(class_of("car-kei+pickup"), Some(Class::Car));
    assert!(crosses().len() > 25, "{}", crosses().len());
    for none in [
        "bus-doubledeck+midi",
        "car-kei+kei",
        "car-kei+",
        "car-kei+tanker",
        "truck-bulk+van",
        "car-suv+kei",
        "+kei",
    ] {
        assert_eq!(class_of(none), None, "{none}");
    }
}

#[test]
fn the_fit_of_a_cross_stretches_it_little() {
    let stretched = |name: &String| {
        let (parts, size_m) = drawing(name, 7)?;
        let (low, high) = mesh_builder::bounds_m(parts.parts());
        let scale = DVec3::from_array(size_m) / (high - low);
        ((scale - DVec3::ONE).abs().max_element() > 0.25).then(|| format!("{name}: {scale}"))
    };
    let far: Vec<String> = crosses().iter().filter_map(stretched).collect();
    assert!(far.is_empty(), "{far:#?}");
}
