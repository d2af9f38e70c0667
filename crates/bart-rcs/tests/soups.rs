//! Any set of triangles is fine: strewn, on a grid (touching, coincident, crossing, with T-junctions),
//! slivers, huge and tiny.

mod bodies;

use bart_rcs::{Antenna, BeamTree, World};
use bodies::referee::silhouette;
use bodies::sums::lit_section;
use bodies::{Random, TRACERS, Triangles, cuboid, settings};
use glam::DVec3;
use std::f64::consts::PI;

/// G1's tolerance, relative to everything that is seen.
const G1: f64 = 1e-9;
const SOUPS: u64 = 2400;

/// A soup of 2 to 13 triangles within a few metres of the origin.
fn soup(seed: u64) -> Triangles {
    let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
    let kind = random.below(6);
    let n = 2 + random.below(12);
    let mut triangles: Vec<[DVec3; 3]> = (0..n).map(|_| triangle(kind, &mut random)).collect();
    if random.below(3) == 0 {
        // Copies of some, the other way round.
        let [a, b, c] = triangles[random.below(n)];
        triangles.push([b, a, c]);
    }
    Triangles(triangles)
}

fn triangle(kind: usize, random: &mut Random) -> [DVec3; 3] {
    let strewn = |random: &mut Random| [random.point(), random.point(), random.point()];
    let grid = |random: &mut Random, cells: f64| strewn(random).map(|v| (v * cells).round() / cells);
    match kind {
        0 => strewn(random),
        1 => grid(random, 2.0),
        // In few planes: coincident in parts, edges within faces.
        2 => grid(random, 3.0).map(|v| DVec3::new(v.x, v.y, (v.z * 1.2).round() * 0.5)),
        // Needles of a micrometre and less.
        3 => {
            let [a, b, c] = strewn(random);
            let height_m = 10.0_f64.powi(-(3 + random.below(9) as i32));
            [a, b, 0.5 * (a + b) + height_m * c]
        }
        // From specks to sails.
        4 => {
            let size_m = 10.0_f64.powi(random.below(7) as i32 - 6);
            let at = random.point();
            strewn(random).map(|v| at + v * size_m)
        }
        // A grid that was stored in single precision: nearly coincident.
        _ => grid(random, 2.0).map(|v| v + random.point().as_vec3().as_dvec3() * 1e-8),
    }
}

fn is_finite(tree: &BeamTree) -> bool {
    let sound = |beam| tree.polygon(beam).iter().all(|v| v.is_finite()) && beam.lit_normal.is_finite();
    let books = tree.audit.orders.iter().all(|o| o.lit_section.is_finite() && o.dropped_section.is_finite());
    books && tree.beams.iter().all(sound)
}

#[test]
fn lit_and_hidden_add_to_the_union_for_any_soup() {
    let mut worst = 0.0_f64;
    for seed in 0..soups() {
        let triangles = soup(seed);
        let world = triangles.world();
        let r = Random(seed).point().normalize_or(DVec3::X);
        let antennas = [Antenna::Direction(r), Antenna::Point(r * 5.0), Antenna::Direction(DVec3::Z)];
        for antenna in &antennas[..if seed % 2 == 0 { 2 } else { 3 }] {
            let expected = silhouette(&triangles.0, *antenna);
            let total: f64 = triangles.0.iter().map(|t| silhouette(&[*t], *antenna)).sum();
            for (tracer, trace) in TRACERS {
                let tree = trace(&world, *antenna, &settings(1)).unwrap();
                // Strips as wide as rounding along every edge may go either way; the scene is 2 m and more
                // away.
                let allowed = G1 * total + 4.0 * world.tolerance_m() * outline_m(&triangles);
                let error = (lit_section(&tree, 1) - expected).abs();
                worst = worst.max(error / allowed);
                assert!(error < allowed, "soup {seed} {antenna:?} {tracer}: {error:e} of {total:e}");
                assert!(is_finite(&tree), "soup {seed}");
            }
        }
    }
    println!("worst {worst:e}");
}

#[test]
fn a_closed_room_full_of_soup_is_lit_all_round_and_loses_no_reflection() {
    let room = cuboid(DVec3::splat(-3.1), DVec3::new(3.3, 3.2, 3.4));
    let mut worst = [0.0_f64; 3];
    for seed in 0..soups() / 6 {
        let world: World = room.clone().and(soup(seed)).world();
        // Often within the soup's bounding box.
        let antenna = Antenna::Point(Random(seed + 77).point() * 1.5);
        let order = if seed % 10 == 0 { 3 } else { 2 };
        let tree = BeamTree::trace(&world, antenna, &settings(order)).unwrap();
        assert!(is_finite(&tree), "soup {seed}");
        for (k, order) in tree.audit.orders.iter().enumerate() {
            let all = if k == 0 { 4.0 * PI } else { order.incident_section };
            let error = ((order.lit_section + order.dropped_section) / all - 1.0).abs();
            worst[k] = worst[k].max(error);
            assert!(error < G1, "soup {seed} order {}: {error:e}", k + 1);
            assert!(order.dropped_section < G1, "soup {seed}: {order:?}");
        }
    }
    println!("worst {worst:?}");
}

#[test]
fn both_tracers_reflect_any_soup_alike() {
    for seed in 0..soups() / 6 {
        let world = soup(seed).world();
        let antenna = Antenna::Point(Random(seed + 5).point() * 2.0);
        let [fast, slow] = TRACERS.map(|(_, trace)| trace(&world, antenna, &settings(3)).unwrap());
        for order in [1, 2, 3] {
            let (a, b) = (lit_section(&fast, order), lit_section(&slow, order));
            assert!((a - b).abs() <= G1 * 4.0 * PI, "soup {seed} order {order}: {a:e} {b:e}");
        }
    }
}

#[test]
fn coordinates_at_the_ends_of_single_precision_are_traced_or_refused() {
    for scale in [1e-30, 1e-12, 1e12, 1e30, 1e37] {
        for seed in 0..40 {
            let mesh = soup(seed).map(|v| v * scale).mesh();
            let world = World::of_mesh(&mesh).unwrap();
            let tree =
                BeamTree::trace(&world, Antenna::Point(DVec3::new(5.0, 4.0, 3.0) * scale), &settings(2))
                    .unwrap();
            assert!(is_finite(&tree), "{scale:e} {seed}");
        }
    }
    let infinite = soup(0).map(|v| v * 1e300).mesh();
    assert!(World::of_mesh(&infinite).is_err());
}

#[test]
fn nothing_and_what_has_no_area_give_empty_trees() {
    let line = Triangles(vec![[DVec3::ZERO, DVec3::X, DVec3::X * 3.0], [DVec3::Y; 3]]);
    for triangles in [Triangles::default(), line] {
        for (tracer, trace) in TRACERS {
            let tree = trace(&triangles.world(), Antenna::Direction(DVec3::Z), &settings(3)).unwrap();
            assert!(tree.beams.is_empty(), "{tracer}");
        }
    }
}

fn outline_m(triangles: &Triangles) -> f64 {
    triangles.0.iter().map(|[a, b, c]| a.distance(*b) + b.distance(*c) + c.distance(*a)).sum()
}

/// Number of soups: more by hand, `SOUPS=100000 cargo test --release -p bart-rcs --test soups --
/// --nocapture`.
fn soups() -> u64 {
    std::env::var("SOUPS").ok().and_then(|n| n.parse().ok()).unwrap_or(SOUPS)
}
