//! Invariants of beams on any mesh (docs/physics.md §2, G1, D4, D5): what is lit is what can be seen.

mod bodies;

use artifact::radar::{Pattern, PatternTable};
use artifact::settings::Sides;
use bart_rcs::{Antenna, Beam, BeamTree, TraceSettings, World};
use bodies::referee::silhouette;
use bodies::scenes::scene;
use bodies::sums::{difference, lit_section, section_of_sequences};
use bodies::{Random, TRACERS, Triangles, car, cuboid, directions, settings, sphere, tumbled};
use glam::{DMat3, DVec3};
use std::f64::consts::PI;

/// G1's and D4's tolerance, relative.
const G1: f64 = 1e-9;
/// D5's tolerance, relative.
const D5: f64 = 1e-7;
/// Place above the car's bonnet, within its bounding box.
const ON_THE_BONNET: DVec3 = DVec3::new(1.7, 0.11, 1.03);

fn bodies_to_look_at() -> [(&'static str, Triangles); 3] {
    [
        ("sphere", sphere(0.7, 2)),
        ("cube", cuboid(DVec3::splat(-0.4), DVec3::splat(0.6)).refined(1)),
        ("car", car(12)),
    ]
}

/// A closed room around body and antenna; its facets come first.
fn room() -> Triangles {
    cuboid(DVec3::new(-9.0, -8.0, -7.0), DVec3::new(10.0, 9.5, 8.0))
}

#[test]
fn lit_area_across_the_direction_is_the_silhouettes() {
    for (body, triangles) in bodies_to_look_at() {
        for r in directions() {
            let expected = silhouette(&triangles.0, Antenna::Direction(r));
            for (tracer, trace) in TRACERS {
                let tree = trace(&triangles.world(), Antenna::Direction(r), &settings(1)).unwrap();
                let error = lit_section(&tree, 1) / expected - 1.0;
                assert!(error.abs() < G1, "{body} {r} {tracer}: {error:e}");
            }
        }
    }
}

#[test]
fn lit_solid_angle_is_the_silhouettes() {
    for (body, triangles) in bodies_to_look_at() {
        for (r, range_m) in directions().into_iter().zip([10.0, 25.0, 3.0, 60.0, 8.0, 4.0, 1e4]) {
            let antenna = Antenna::Point(r * range_m);
            let expected = silhouette(&triangles.0, antenna);
            for (tracer, trace) in TRACERS {
                let tree = trace(&triangles.world(), antenna, &settings(1)).unwrap();
                let error = lit_section(&tree, 1) / expected - 1.0;
                assert!(error.abs() < G1, "{body} {r} {range_m} m {tracer}: {error:e}");
            }
        }
    }
}

#[test]
fn an_antenna_in_a_closed_room_lights_the_whole_sphere_and_no_reflection_escapes() {
    let world = room().and(car(8)).world();
    for place in [DVec3::new(7.0, 3.0, 4.0), ON_THE_BONNET] {
        for (tracer, trace) in TRACERS {
            let tree = trace(&world, Antenna::Point(place), &settings(2)).unwrap();
            let [first, second] = &tree.audit.orders[..] else { panic!("two orders") };
            assert!((lit_section(&tree, 1) / (4.0 * PI) - 1.0).abs() < G1, "{tracer} {place}");
            assert!((second.incident_section / first.lit_section - 1.0).abs() < G1, "{tracer} {place}");
            assert!(
                (second.escaped_section / second.incident_section).abs() < G1,
                "{tracer} {place}: {second:?}"
            );
        }
    }
}

#[test]
fn every_beam_in_a_closed_room_hands_its_solid_angle_to_its_children() {
    let tree =
        BeamTree::trace(&room().and(car(6)).world(), Antenna::Point(ON_THE_BONNET), &settings(3)).unwrap();
    let mut handed = vec![0.0; tree.beams.len()];
    for beam in &tree.beams {
        if let Some(parent) = beam.parent {
            handed[parent as usize] += beam.section;
        }
    }
    for (beam, handed) in tree.beams.iter().zip(handed).filter(|(beam, _)| beam.order < 3) {
        // A sliver's children may be thinner than rounding: those are dropped, and are less than 1e-12 of the
        // sphere.
        assert!((handed - beam.section).abs() < G1 * beam.section + 1e-12, "{beam:?}: {handed:e}");
    }
    assert!(tree.audit.orders.iter().all(|order| order.dropped_section < 1e-11), "{:?}", tree.audit);
}

#[test]
fn what_escapes_is_what_a_room_around_the_scene_would_catch() {
    for r in directions() {
        let antenna = Antenna::Point(r * 6.0);
        let open = BeamTree::trace(&car(8).world(), antenna, &settings(2)).unwrap();
        let closed = BeamTree::trace(&room().and(car(8)).world(), antenna, &settings(2)).unwrap();
        let walls = room().0.len() as u32;
        let on_wall = |facet: u32| facet < walls;
        let caught = closed.beams.iter().filter(|beam| on_wall(beam.facet));
        let caught: f64 = caught
            .filter(|beam| beam.parent.is_some_and(|parent| !on_wall(closed.beams[parent as usize].facet)))
            .map(|beam| beam.section)
            .sum();
        let escaped = open.audit.orders[1].escaped_section;
        assert!((escaped / caught - 1.0).abs() < G1, "{r}: {escaped:e} {caught:e}");
    }
}

#[test]
fn a_closed_body_is_never_lit_from_inside() {
    for (body, triangles) in bodies_to_look_at() {
        let world = triangles.world();
        for r in directions() {
            for antenna in [Antenna::Direction(r), Antenna::Point(r * 7.0)] {
                let tree = BeamTree::trace(&world, antenna, &settings(1)).unwrap();
                let inside =
                    tree.beams.iter().find(|beam| beam.lit_normal != world.facet(beam.facet).normal());
                assert_eq!(inside, None, "{body} {antenna:?}");
            }
        }
    }
}

#[test]
fn of_coincident_facets_exactly_one_is_lit() {
    let single = car(8);
    let n = single.0.len() as u32;
    let antenna = Antenna::Point(DVec3::new(9.0, 4.0, 3.0));
    for (tracer, trace) in TRACERS {
        let expected = trace(&single.world(), antenna, &settings(2)).unwrap();
        let expected = section_of_sequences(&expected, |facet| facet);
        for twin in [single.clone(), single.flipped()] {
            let doubled = trace(&single.clone().and(twin).world(), antenna, &settings(2)).unwrap();
            assert!(doubled.beams.iter().all(|beam| beam.facet < n), "{tracer}: the first of each pair");
            let got = section_of_sequences(&doubled, |facet| facet);
            assert!(difference(&expected, &got) < G1, "{tracer}: {:e}", difference(&expected, &got));
        }
    }
}

#[test]
fn coincident_facets_of_different_cut_are_lit_once() {
    // The twin is cut into four, so that no two facets are equal.
    let antenna = Antenna::Point(DVec3::new(9.0, 4.0, 3.0));
    let single = BeamTree::trace(&car(8).world(), antenna, &settings(2)).unwrap();
    for both in [car(8).and(car(8).refined(1)), car(8).refined(1).and(car(8))] {
        let tree = BeamTree::trace(&both.world(), antenna, &settings(2)).unwrap();
        for order in [1, 2] {
            let error = lit_section(&tree, order) / lit_section(&single, order) - 1.0;
            assert!(error.abs() < G1, "order {order}: {error:e}");
        }
    }
}

#[test]
fn d4_relabelling_and_turning_the_scene_change_no_section() {
    let car = car(8);
    let n = car.0.len();
    let mut random = Random(4);
    let mut from: Vec<usize> = (0..n).collect();
    (1..n).for_each(|i| from.swap(i, random.below(i + 1)));
    let turned = |v: DVec3| tumbled() * v;
    let permuted = Triangles(from.iter().map(|&i| car.0[i]).collect()).map(turned);
    let place = DVec3::new(9.0, 4.0, 3.0);
    for antenna in [Antenna::Point, |p: DVec3| Antenna::Direction(p.normalize_or_zero())] {
        let one = BeamTree::trace(&car.world(), antenna(place), &settings(2)).unwrap();
        let other = BeamTree::trace(&permuted.world(), antenna(turned(place)), &settings(2)).unwrap();
        // The car's parts coincide in places, and the first facet is lit there: sums by order, not by
        // sequence.
        for order in [1, 2] {
            let error = lit_section(&other, order) / lit_section(&one, order) - 1.0;
            assert!(error.abs() < G1, "order {order}: {error:e}");
        }
    }
}

#[test]
fn d4_splitting_facets_changes_no_section() {
    let place = DVec3::new(9.0, 4.0, 3.0);
    for antenna in [Antenna::Point(place), Antenna::Direction(place.normalize_or_zero())] {
        let whole = BeamTree::trace(&car(8).world(), antenna, &settings(2)).unwrap();
        let split = BeamTree::trace(&car(8).refined(1).world(), antenna, &settings(2)).unwrap();
        let error = difference(
            &section_of_sequences(&whole, |facet| facet),
            &section_of_sequences(&split, |facet| facet / 4),
        );
        assert!(error < G1, "{error:e}");
    }
}

#[test]
fn d5_a_kilometre_of_shift_changes_no_section() {
    let by = DVec3::new(600.0, -750.0, 280.0);
    let place = DVec3::new(9.0, 4.0, 3.0);
    for (here, there) in [
        (Antenna::Point(place), Antenna::Point(place + by)),
        (Antenna::Direction(place.normalize_or_zero()), Antenna::Direction(place.normalize_or_zero())),
    ] {
        let one = BeamTree::trace(&car(8).world(), here, &settings(2)).unwrap();
        let other = BeamTree::trace(&car(8).shifted(by).world(), there, &settings(2)).unwrap();
        for order in [1, 2] {
            let error = lit_section(&other, order) / lit_section(&one, order) - 1.0;
            assert!(error.abs() < D5, "order {order}: {error:e}");
        }
    }
}

#[test]
fn the_beam_tree_is_the_brute_force_tree() {
    let world = room().and(car(6)).world();
    for antenna in [Antenna::Point(ON_THE_BONNET), Antenna::Point(DVec3::new(7.0, 3.0, 4.0))] {
        let [fast, slow] = TRACERS.map(|(_, trace)| trace(&world, antenna, &settings(2)).unwrap());
        let [fast, slow] = [fast, slow].map(|tree| section_of_sequences(&tree, |facet| facet));
        assert!(difference(&fast, &slow) < G1, "{:e}", difference(&fast, &slow));
    }
}

#[test]
fn polygons_are_convex_lie_on_their_facets_and_turn_about_the_lit_normal() {
    let world = room().and(car(6)).world();
    let tree = BeamTree::trace(&world, Antenna::Point(ON_THE_BONNET), &settings(2)).unwrap();
    let tolerance_m = 4.0 * world.tolerance_m();
    for beam in &tree.beams {
        let (polygon, facet) = (tree.polygon(beam), world.facet(beam.facet));
        let next = |i: usize| polygon[(i + 1) % polygon.len()];
        for (i, &corner) in polygon.iter().enumerate() {
            assert!(facet.plane.distance_m(corner).abs() < tolerance_m);
            let edge = next(i) - corner;
            let inward = beam.lit_normal.cross(edge).normalize_or_zero();
            assert!(
                polygon.iter().all(|&other| inward.dot(other - corner) > -1e3 * tolerance_m),
                "{polygon:?}"
            );
        }
        let travel = beam.image.travel_direction_at(polygon[0]);
        assert!(travel.dot(beam.lit_normal) < 0.0, "the wave comes from the lit side");
    }
}

#[test]
fn one_sided_facets_hide_from_both_sides_and_are_lit_from_the_front() {
    let one_sided = |max_order| TraceSettings { sides: Sides::One, ..settings(max_order) };
    let car = car(8);
    let antenna = Antenna::Point(DVec3::new(9.0, 4.0, 3.0));
    let two = BeamTree::trace(&car.world(), antenna, &settings(2)).unwrap();
    let one = BeamTree::trace(&car.world(), antenna, &one_sided(2)).unwrap();
    assert_eq!(two.beams, one.beams, "of closed bodies only fronts are seen");
    let black = BeamTree::trace(&car.flipped().world(), antenna, &one_sided(2)).unwrap();
    assert!(black.beams.is_empty());
    // Panels that people model by two coincident facets, one each way: the front one is lit, whichever comes
    // first.
    for both in [car.clone().and(car.flipped()), car.flipped().and(car.clone())] {
        let tree = BeamTree::trace(&both.world(), antenna, &one_sided(2)).unwrap();
        let error = lit_section(&tree, 1) / lit_section(&one, 1) - 1.0;
        assert!(error.abs() < G1, "{error:e}");
    }
}

#[test]
fn what_is_dropped_is_in_the_books() {
    let triangles = car(16).refined(1);
    let antenna = Antenna::Point(DVec3::new(9.0, 4.0, 3.0));
    let coarse = TraceSettings { least_area_m2: 1e-3, least_mirror_area_m2: 4e-3, ..settings(2) };
    for (tracer, trace) in TRACERS {
        let tree = trace(&triangles.world(), antenna, &coarse).unwrap();
        let [first, second] = &tree.audit.orders[..] else { panic!("two orders") };
        assert!(
            first.dropped > 0 && first.unreflected > 0 && second.dropped > 0,
            "{tracer}: {:?}",
            tree.audit
        );
        let silhouette = silhouette(&triangles.0, antenna);
        let error = (first.lit_section + first.dropped_section) / silhouette - 1.0;
        assert!(error.abs() < G1, "{tracer}: {error:e}");
        assert!(tree.beams.iter().all(|beam| beam.across_m2 >= 1e-3));
        let mirrors = tree.beams.iter().filter(|beam| beam.order == 1 && beam.across_m2 >= 4e-3);
        let incident: f64 = mirrors.map(|beam| beam.section).sum();
        assert!((second.incident_section / incident - 1.0).abs() < G1);
    }
}

#[test]
fn what_stands_behind_antennas_that_hear_ahead_is_left_out() {
    let body = car(4);
    // Ahead; astride of the array's plane; behind it.
    let places = [40.0, 0.5, -30.0].map(|y_m| ([3.0, y_m, 0.0], 0.3, [0.0, -10.0, 0.0]));
    let facets_of = |pattern: Pattern, elevation_deg: f64| {
        let (mut header, frame) = scene(&body.mesh(), &places);
        header.radar.array.pattern = pattern;
        header.radar.boresight_el_rad = f64::to_radians(elevation_deg);
        let world = World::at(&header, &frame, 0.0).unwrap();
        [0, 1, 2].map(|body| world.facets().iter().filter(|facet| facet.id.body == body).count())
    };
    let all = facets_of(Pattern::Isotropic, 0.0);
    let [ahead, astride, _] = all;
    assert_eq!(facets_of(Pattern::Cosine { exponent: 1.0 }, 0.0), [ahead, astride, 0]);
    // Straight down, everything on the road is ahead.
    assert_eq!(facets_of(Pattern::Cosine { exponent: 1.0 }, -90.0), all);
    let table = |half_rad: f64| {
        let azimuth_rad = vec![-half_rad, 0.0, half_rad];
        Pattern::Table(PatternTable { azimuth_rad, elevation_rad: vec![0.0], amplitude: vec![0.1, 1.0, 0.1] })
    };
    assert_eq!(facets_of(table(1.5), 0.0), [ahead, astride, 0]);
    assert_eq!(facets_of(table(2.0), 0.0), all);
}

#[test]
fn the_same_tree_grows_on_any_number_of_threads() {
    let world = room().and(car(8)).world();
    let grow = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| BeamTree::trace(&world, Antenna::Point(ON_THE_BONNET), &settings(2)).unwrap())
    };
    let one = grow(1);
    assert!([2, 5].into_iter().all(|threads| grow(threads) == one));
}

#[test]
fn an_antenna_in_the_plane_of_a_facet_neither_lights_nor_loses_it() {
    // The bonnet's mirrors stand between; the plate is seen edge-on from the antenna and hides nothing.
    let plate =
        Triangles(vec![[DVec3::new(-1.0, 0.0, 0.0), DVec3::new(1.0, 0.0, 0.0), DVec3::new(0.0, 0.0, 1.0)]]);
    let wall = cuboid(DVec3::new(-5.0, -1.0, -5.0), DVec3::new(-4.0, 1.0, 5.0));
    let antenna = Antenna::Point(DVec3::new(8.0, 0.0, 0.3));
    for (tracer, trace) in TRACERS {
        let alone = trace(&wall.world(), antenna, &settings(2)).unwrap();
        let both = trace(&wall.clone().and(plate.clone()).world(), antenna, &settings(2)).unwrap();
        assert!((lit_section(&both, 1) / lit_section(&alone, 1) - 1.0).abs() < G1, "{tracer}");
    }
}

#[test]
fn a_mirror_sends_the_wave_to_where_the_image_sees_through_it() {
    // A square mirror of 1 m in z = 0 and a plate above it: what the image sees of the plate through the
    // mirror.
    let mirror = cuboid(DVec3::new(-0.5, -0.5, -0.1), DVec3::new(0.5, 0.5, 0.0));
    let plate =
        Triangles(vec![[DVec3::new(-3.0, -2.0, 1.0), DVec3::new(3.0, 2.5, 1.0), DVec3::new(-3.0, 2.5, 1.2)]]);
    let antenna = DVec3::new(2.0, -0.4, 0.9);
    let image = DVec3::new(2.0, -0.4, -0.9);
    for (tracer, trace) in TRACERS {
        let tree =
            trace(&mirror.clone().and(plate.clone()).world(), Antenna::Point(antenna), &settings(2)).unwrap();
        let on_top = |facet: u32| mirror.0.get(facet as usize).is_some_and(|t| t.iter().all(|v| v.z == 0.0));
        let plate_index = mirror.0.len() as u32;
        let seen: f64 = tree
            .beams
            .iter()
            .filter(|beam| beam.facet == plate_index && beam.order == 2)
            .filter(|beam| on_top(tree.sequence(beam)[0]))
            .inspect(|beam| assert!(matches!(beam.image, Antenna::Point(p) if p.distance(image) < 1e-14)))
            .map(|beam| beam.section)
            .sum();
        // Union of hole and plate, by A + B − A∪B, both as the image sees them.
        let hole: Vec<[DVec3; 3]> =
            mirror.0.iter().filter(|t| t.iter().all(|v| v.z == 0.0)).copied().collect();
        let from_image = |triangles: &[[DVec3; 3]]| silhouette(triangles, Antenna::Point(image));
        let both: Vec<[DVec3; 3]> = hole.iter().chain(&plate.0).copied().collect();
        let expected = from_image(&hole) + from_image(&plate.0) - from_image(&both);
        assert!((seen / expected - 1.0).abs() < G1, "{tracer}: {seen} {expected}");
    }
}

#[test]
fn a_scene_turned_about_the_vertical_is_the_same_as_its_poses_say() {
    // Facets by pose against facets turned by hand.
    let yaw = 0.7_f64;
    let hand = car(6).map(|v| DVec3::new(20.0, 3.0, 0.0) + DMat3::from_rotation_z(yaw) * v).world();
    let (header, frame) = scene(&car(6).mesh(), &[([18.0, 3.0, 0.0], yaw, [4.0, 0.0, 0.0])]);
    let posed = World::at(&header, &frame, 0.5).unwrap();
    let antenna = Antenna::Point(DVec3::new(0.0, 0.0, 6.0));
    let [a, b] = [hand, posed].map(|world| BeamTree::trace(&world, antenna, &settings(2)).unwrap());
    let [a, b] = [a, b].map(|tree| section_of_sequences(&tree, |facet| facet));
    assert!(difference(&a, &b) < G1);
}

#[test]
fn bodies_hide_one_another_and_waves_bounce_between_them() {
    let places = [([20.0, 0.0, 0.0], 0.4, [0.0; 3]), ([24.0, 2.0, 0.0], -1.2, [0.0; 3])];
    let (header, frame) = scene(&car(6).mesh(), &places);
    let world = World::at(&header, &frame, 0.0).unwrap();
    let antenna = Antenna::Point(DVec3::new(0.0, -1.0, 3.0));
    let triangles: Vec<[DVec3; 3]> = world.facets().iter().map(|facet| facet.corners_m).collect();
    let tree = BeamTree::trace(&world, antenna, &settings(2)).unwrap();
    let error = lit_section(&tree, 1) / silhouette(&triangles, antenna) - 1.0;
    assert!(error.abs() < G1, "{error:e}");
    let body = |facet: u32| world.facet(facet).id.body;
    let between = |beam: &&Beam| {
        let sequence = tree.sequence(beam);
        sequence.len() == 2 && body(sequence[0]) != body(sequence[1])
    };
    assert!(tree.beams.iter().filter(between).count() > 10);
}
