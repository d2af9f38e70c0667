//! Meshes as they come: open, non-manifold, with T-junctions, overlaps, slivers, doubled and turned faces,
//! faces that cross each other, faces in the antenna's plane, far from the origin. What is lit and what is
//! hidden add to the whole, facet by facet: the hidden part is a union of polygons that shares nothing with
//! the tracer.

mod bodies;

use artifact::Accuracy;
use bart_rcs::{Antenna, BeamTree, RcsRequest, rcs};
use bodies::referee::silhouette;
use bodies::sums::lit_section;
use bodies::{Random, TRACERS, Triangles, car, cuboid, settings};
use glam::DVec3;

/// G1's tolerance, relative to everything that is seen.
const G1: f64 = 1e-9;

type Facet = [DVec3; 3];

fn at(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

fn square(origin: DVec3, u: DVec3, v: DVec3) -> Triangles {
    Triangles(vec![[origin, origin + u, origin + u + v], [origin, origin + u + v, origin + v]])
}

/// Four sheets folded along parallel edges, open at both ends.
fn open_sheet() -> Triangles {
    let fold =
        |i: f64| square(at(0.3 * (i % 2.0), 0.4 * i, 0.0), at(0.3 - 0.6 * (i % 2.0), 0.4, 0.0), DVec3::Z);
    fold(0.0).and(fold(1.0)).and(fold(2.0)).and(fold(3.0))
}

/// Five leaves on one edge.
fn book() -> Triangles {
    let leaf = |angle: f64| square(DVec3::ZERO, at(angle.cos(), angle.sin(), 0.0), DVec3::Z);
    [0.5, 1.1, 2.9, 4.0].into_iter().fold(leaf(0.0), |book, angle| book.and(leaf(angle)))
}

/// Halves of different cut along one edge: corners of one within edges of the other.
fn t_junctions() -> Triangles {
    let upper = square(at(0.0, 0.0, 0.5), DVec3::Y, 0.5 * DVec3::Z);
    let thirds = [0.0, 0.3, 0.7].map(|y| {
        square(at(0.0, y, 0.0), at(0.0, [0.3, 0.4, 0.3][(y * 3.0) as usize], 0.0), at(0.1, 0.0, 0.5))
    });
    thirds.into_iter().fold(upper, |all, third| all.and(third.map(|v| v - at(0.1 * v.z / 0.5, 0.0, 0.0))))
}

fn coplanar_overlap() -> Triangles {
    let first = square(DVec3::ZERO, DVec3::Y, DVec3::Z);
    first.and(square(at(0.0, 0.4, 0.3), 0.9 * DVec3::Y, 0.8 * DVec3::Z)).and(square(
        at(0.0, -0.2, 0.1),
        DVec3::Y,
        0.2 * DVec3::Z,
    ))
}

fn slivers() -> Triangles {
    let mut random = Random(11);
    let needle = |i: i32, random: &mut Random| {
        let (a, b) = (random.point(), random.point());
        [a, b, 0.5 * (a + b) + 10.0_f64.powi(-i) * random.point()]
    };
    Triangles((0..18).map(|i| needle(i % 9, &mut random)).collect()).and(square(
        at(-0.4, -0.7, -0.6),
        at(0.2, 1.3, 0.0),
        at(0.1, 0.0, 1.2),
    ))
}

fn doubled_and_turned() -> Triangles {
    let body = cuboid(DVec3::splat(-0.5), DVec3::splat(0.5));
    let turned = Triangles(body.0.iter().step_by(2).map(|&[a, b, c]| [c, b, a]).collect());
    body.clone().and(turned).and(Triangles(body.0[..5].to_vec()))
}

fn crossing_boxes() -> Triangles {
    cuboid(DVec3::splat(-0.5), DVec3::splat(0.5)).and(cuboid(at(-0.2, -0.8, -0.3), at(0.9, 0.3, 0.7)))
}

/// Triangles with faces whose planes hold the antenna at (6, 2, 3) or run along the direction to it.
fn edge_on() -> Triangles {
    let towards = at(6.0, 2.0, 3.0);
    let fin = |across: DVec3| square(0.02 * towards, 0.1 * towards, across);
    fin(at(0.0, 0.8, 0.1)).and(fin(at(0.1, -0.2, 0.9))).and(square(
        at(-0.2, -1.0, -1.0),
        at(0.1, 2.0, 0.0),
        at(0.0, 0.1, 2.0),
    ))
}

fn meshes() -> Vec<(&'static str, Triangles)> {
    vec![
        ("open sheet", open_sheet()),
        ("five leaves on one edge", book()),
        ("T-junctions", t_junctions()),
        ("coplanar overlap", coplanar_overlap()),
        ("slivers", slivers()),
        ("doubled and turned faces", doubled_and_turned()),
        ("boxes through each other", crossing_boxes()),
        ("faces in the antenna's plane", edge_on()),
        ("a car", car(4)),
    ]
}

/// The part of a facet that is nearer to the antenna than another facet's plane, as triangles; of coincident
/// facets the one that comes first in `order` is lit.
fn before(front: &Facet, order: std::cmp::Ordering, facet: &Facet, antenna: Antenna) -> Vec<Facet> {
    let [a, b, c] = *facet;
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let side = match antenna {
        Antenna::Point(p) => normal.dot(p - a),
        Antenna::Direction(r) => normal.dot(r),
    };
    let height = |v: DVec3| side.signum() * normal.dot(v - a);
    let heights = front.map(height);
    let rounding = 1e-12 * front.iter().chain(facet).map(|v| v.abs().max_element()).fold(0.0, f64::max);
    if heights.iter().all(|h| h.abs() <= rounding) {
        return if order.is_lt() { vec![*front] } else { vec![] };
    }
    let mut part = Vec::new();
    for i in 0..3 {
        let (here, next) = (i, (i + 1) % 3);
        if heights[here] >= 0.0 {
            part.push(front[here]);
        }
        if heights[here] * heights[next] < 0.0 {
            part.push(front[here].lerp(front[next], heights[here] / (heights[here] - heights[next])));
        }
    }
    if part.len() < 3 {
        vec![]
    } else {
        (1..part.len() - 1).map(|i| [part[0], part[i], part[i + 1]]).collect()
    }
}

/// Area that others hide of a facet: A(facet) + A(others in front) − A(both together), each a union.
fn hidden(triangles: &[Facet], index: usize, antenna: Antenna) -> f64 {
    let facet = &triangles[index];
    let area_m2 = |[a, b, c]: Facet| (0.5 * (b - a).cross(c - a).length()) as f32;
    let order = |other: usize| {
        area_m2(*facet).total_cmp(&area_m2(triangles[other])).then(other.cmp(&index)) // the larger first
    };
    let others: Vec<Facet> = (0..triangles.len())
        .filter(|&other| other != index)
        .flat_map(|other| before(&triangles[other], order(other), facet, antenna))
        .collect();
    if others.is_empty() {
        return 0.0;
    }
    let together: Vec<Facet> = others.iter().chain([facet]).copied().collect();
    silhouette(&[*facet], antenna) + silhouette(&others, antenna) - silhouette(&together, antenna)
}

fn lit_of(tree: &BeamTree, facet: usize) -> f64 {
    tree.beams.iter().filter(|beam| beam.facet as usize == facet).map(|beam| beam.section).sum()
}

#[test]
fn lit_and_hidden_add_to_every_facet_of_every_mesh() {
    for (name, triangles) in meshes() {
        let world = triangles.world();
        let r = at(6.0, 2.0, 3.0);
        for antenna in
            [Antenna::Point(r), Antenna::Direction(r.normalize_or_zero()), Antenna::Direction(-DVec3::X)]
        {
            let total: f64 = triangles.0.iter().map(|t| silhouette(&[*t], antenna)).sum();
            for (tracer, trace) in TRACERS {
                let tree = trace(&world, antenna, &settings(1)).unwrap();
                let mut worst = 0.0_f64;
                for facet in 0..triangles.0.len() {
                    let whole = silhouette(&[triangles.0[facet]], antenna);
                    let error = lit_of(&tree, facet) + hidden(&triangles.0, facet, antenna) - whole;
                    worst = worst.max(error.abs() / total);
                }
                let union = (lit_section(&tree, 1) - silhouette(&triangles.0, antenna)).abs() / total;
                println!(
                    "{name}, {antenna:?}, {tracer}: asked {G1:e}, facets {worst:.1e}, union {union:.1e}"
                );
                assert!(worst < G1 && union < G1, "{name} {antenna:?} {tracer}: {worst:e} {union:e}");
            }
        }
    }
}

#[test]
fn every_mesh_ten_kilometres_away_is_lit_alike() {
    let far = at(6e3, -8e3, 5.0);
    for (name, triangles) in meshes() {
        let section = |shift: DVec3| {
            let world = triangles.clone().map(|v| v + shift).world();
            lit_section(
                &BeamTree::trace(&world, Antenna::Point(shift + at(6.0, 2.0, 3.0)), &settings(2)).unwrap(),
                1,
            )
        };
        let (here, there) = (section(DVec3::ZERO), section(far));
        // Coordinates of 10 km are rounded to 1e-12 m; needles of a nanometre turn by a thousandth of their
        // own area.
        println!("{name}: asked 1e-7, got {:.1e}", (there / here - 1.0).abs());
        assert!((there / here - 1.0).abs() < 1e-7, "{name}: {here:e} {there:e}");
    }
}

#[test]
fn no_reflection_of_any_mesh_in_a_room_is_lost_or_doubled() {
    let room = cuboid(DVec3::splat(-7.0), at(8.0, 7.5, 7.2));
    for (name, triangles) in meshes() {
        let world = room.clone().and(triangles).world();
        // Within the bounding box of the bodies, too.
        for place in [at(0.31, 0.27, 0.23), at(5.0, 2.0, 3.0)] {
            let tree = BeamTree::trace(&world, Antenna::Point(place), &settings(3)).unwrap();
            for (k, order) in tree.audit.orders.iter().enumerate() {
                let all = if k == 0 { 4.0 * std::f64::consts::PI } else { order.incident_section };
                let error = ((order.lit_section + order.dropped_section) / all - 1.0).abs();
                assert!(error < G1, "{name} from {place}, order {}: {error:e}", k + 1);
            }
        }
    }
}

/// A frustum that stands on a plate, its foot closed by a cap that lies on the plate.
fn capped_frustum_on_a_plate() -> [Triangles; 3] {
    let ring = |radius_m: f64, z_m: f64| {
        [0, 1, 2, 3, 4, 5].map(|i| {
            let (sin, cos) = (f64::from(i) * std::f64::consts::FRAC_PI_3).sin_cos();
            at(radius_m * cos, radius_m * sin, z_m)
        })
    };
    let (foot, top) = (ring(0.0909, 0.0), ring(0.04, 0.1089));
    let wall = |i: usize| {
        let j = (i + 1) % 6;
        [[foot[i], foot[j], top[j]], [foot[i], top[j], top[i]]]
    };
    let walls = Triangles((0..6).flat_map(wall).collect());
    let cap = Triangles((1..5).map(|i| [foot[0], foot[i + 1], foot[i]]).collect());
    [walls, cap, square(at(-0.175, -0.15, 0.0), 0.35 * DVec3::X, 0.3 * DVec3::Y)]
}

#[test]
fn coincident_facets_scatter_alike_in_whatever_order_they_stand() {
    let [walls, cap, plate] = capped_frustum_on_a_plate();
    let orders = [
        walls.clone().and(cap.clone()).and(plate.clone()),
        plate.clone().and(cap.clone()).and(walls.clone()),
        cap.and(plate).and(walls),
    ];
    let over = RcsRequest::over(vec![5e9], vec![66_f64.to_radians()], vec![220_f64.to_radians()]);
    let request = RcsRequest { bounces: 2, accuracy: Accuracy::from_db(-60.0), ..over };
    let amplitudes_m =
        orders.map(|triangles| rcs(&triangles.mesh(), &request, &|_, _| ()).unwrap().amplitude_m[0]);
    for other_m in &amplitudes_m[1..] {
        let error = (other_m - amplitudes_m[0]).norm() / amplitudes_m[0].norm();
        assert!(error < 1e-9, "{error:e}: {amplitudes_m:?}");
    }
}
