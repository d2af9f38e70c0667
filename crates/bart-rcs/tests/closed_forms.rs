//! Closed forms of docs/physics.md §11 at 77 GHz: each test prints what was asked and what was got.
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use artifact::Accuracy;
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use artifact::settings::NodeRule;
use bart_rcs::{RcsRequest, RcsResult, Standpoint, rcs};
use glam::{DQuat, DVec3, EulerRot};
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const FREQUENCY_HZ: f64 = 77e9;
const LIGHT_MPS: f64 = 299_792_458.0;
const WAVELENGTH_M: f64 = LIGHT_MPS / FREQUENCY_HZ;
const K: f64 = TAU / WAVELENGTH_M;

fn request() -> RcsRequest {
    RcsRequest {
        bounces: 1,
        nodes: NodeRule::Middle,
        accuracy: Accuracy::from_db(-60.0),
        ..RcsRequest::over(vec![FREQUENCY_HZ], vec![0.0], vec![0.0])
    }
}

fn at(azimuth_deg: f64, elevation_deg: f64) -> RcsRequest {
    RcsRequest {
        azimuth_rad: vec![azimuth_deg.to_radians()],
        elevation_rad: vec![elevation_deg.to_radians()],
        ..request()
    }
}

fn run(mesh: &Mesh, request: &RcsRequest) -> RcsResult {
    rcs(mesh, request, &|_, _| ()).unwrap()
}

fn s(mesh: &Mesh, request: &RcsRequest) -> Complex64 {
    run(mesh, request).amplitude_m[0]
}

fn dbsm(s: Complex64) -> f64 {
    10.0 * s.norm_sqr().log10()
}

fn mesh(vertices_m: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh { vertices_m, triangles, ..Mesh::default() }
}

/// Corner, and two edges.
fn parallelograms(list: &[[[f64; 3]; 3]]) -> Mesh {
    let mut all = mesh(vec![], vec![]);
    for [o, u, v] in list {
        let first = all.vertices_m.len() as u32;
        let add = |a: &[f64; 3], b: &[f64; 3]| [0, 1, 2].map(|i| a[i] + b[i]);
        all.vertices_m.extend([*o, add(o, u), add(&add(o, u), v), add(o, v)]);
        all.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    all
}

/// A square plate that faces +x, centred on the origin.
fn plate(side_m: f64) -> Mesh {
    let h = 0.5 * side_m;
    parallelograms(&[[[0.0, -h, -h], [0.0, side_m, 0.0], [0.0, 0.0, side_m]]])
}

/// Two plates 0.15 m × 0.15 m that open towards +x with this angle between them, the fold along z through the
/// origin.
fn dihedral(angle_deg: f64) -> Mesh {
    let (a, half) = (0.15, 0.5 * angle_deg.to_radians());
    let wall = |side: f64| [a * half.cos(), side * a * half.sin(), 0.0];
    parallelograms(&[
        [[0.0, 0.0, -0.5 * a], [0.0, 0.0, a], wall(1.0)],
        [[0.0, 0.0, -0.5 * a], wall(-1.0), [0.0, 0.0, a]],
    ])
}

fn check(id: &str, asked: f64, got: f64, tolerance: f64) {
    println!("{id}: asked {asked:.4}, got {got:.4}, tolerance {tolerance}");
    assert!((asked - got).abs() <= tolerance, "{id}: asked {asked}, got {got}, tolerance {tolerance}");
}

/// Claim P1.
#[test]
fn a_square_plate_follows_its_sinc_and_its_phase_is_plus_ninety_degrees() {
    let plate = plate(0.3);
    let broadside = s(&plate, &at(0.0, 0.0));
    let exact = (4.0 * PI).sqrt() * 0.09 / WAVELENGTH_M;
    check("P1 0°", 20.0 * exact.log10(), dbsm(broadside), 1e-6);
    assert!((broadside / Complex64::new(0.0, exact) - 1.0).norm() < 1e-9);
    for (azimuth_deg, printed) in [(3.0_f64, -3.6345), (20.0, -8.6450)] {
        let sine = azimuth_deg.to_radians().sin();
        let x = K * 0.3 * sine;
        let exact = 20.0 * (exact * azimuth_deg.to_radians().cos() * x.sin() / x).abs().log10();
        check(&format!("P1 {azimuth_deg}°"), exact, dbsm(s(&plate, &at(azimuth_deg, 0.0))), 1e-6);
        assert!((exact - printed).abs() < 6e-5);
    }
}

/// Across the wave a triangle of it has 9e-11 m², less than is dropped at −60 dB over any larger body; given
/// up whole, S would be 0 and nothing to compare what is left out with.
#[test]
fn a_plate_seen_along_itself_is_not_given_up_as_a_whole() {
    let result = run(&plate(0.1), &at(90.0 - 1e-6, 0.0));
    let grazing = 1e-6_f64.to_radians();
    let x = K * 0.1 * grazing.cos();
    let asked = (4.0 * PI).sqrt() * 0.01 / WAVELENGTH_M * grazing.sin() * (x.sin() / x).abs();
    let (got, told) = (result.amplitude_m[0].norm(), result.error.total().unwrap());
    println!("asked {asked:.4e}, got {got:.4e}, told {told:.1e}");
    assert!((got / asked - 1.0).abs() <= told.max(1e-6) && told <= 1e-3);
}

/// Claim P2, by the Fresnel integral squared and by brute force.
#[test]
fn a_plate_at_finite_range_loses_what_its_wavefront_curvature_takes() {
    for (range_m, exact) in [(100.0, 38.1685), (30.0, 37.1288)] {
        let near = RcsRequest { range_m, ..request() };
        check(&format!("P2 {range_m} m"), exact, dbsm(s(&plate(0.3), &near)), 1e-3);
    }
}

/// Claim P3.
#[test]
fn a_disc_has_the_main_lobe_of_its_bessel_function() {
    let (a, sides) = (0.1, 256_u32);
    // Radius of the polygon with the disc's area.
    let radius = a * (PI / (0.5 * f64::from(sides) * (TAU / f64::from(sides)).sin())).sqrt();
    let mut vertices = vec![[0.0; 3]];
    vertices.extend((0..sides).map(|i| {
        let angle = TAU * f64::from(i) / f64::from(sides);
        [0.0, radius * angle.cos(), radius * angle.sin()]
    }));
    let disc = mesh(vertices, (0..sides).map(|i| [0, 1 + i, 1 + (i + 1) % sides]).collect());
    // First null at 2ka sinθ = 3.83: 0.68°.
    for azimuth_deg in [0.0_f64, 0.2, 0.4] {
        let theta = azimuth_deg.to_radians();
        let u = 2.0 * K * a * theta.sin();
        let lobe = if u == 0.0 { 1.0 } else { 2.0 * bessel_j1(u) / u };
        let exact = 10.0 * (PI * K * K * a.powi(4) * (theta.cos() * lobe).powi(2)).log10();
        check(&format!("P3 {azimuth_deg}°"), exact, dbsm(s(&disc, &at(azimuth_deg, 0.0))), 0.01);
    }
}

/// J₁(x) = 1/π ∫₀^π cos(θ − x sinθ) dθ by the trapezoidal rule, which converges exponentially here.
fn bessel_j1(x: f64) -> f64 {
    let n = 64;
    let of = |i: i32| {
        let theta = PI * f64::from(i) / f64::from(n);
        (theta - x * theta.sin()).cos()
    };
    ((1..n).map(of).sum::<f64>() + 0.5 * (of(0) + of(n))) / f64::from(n)
}

/// A sphere from the faces of a cube, each cut into `cells`² squares of equal angle and these into two
/// triangles, its corners pushed out so that the facets' mean lies on the sphere.
fn sphere(radius_m: f64, cells: u32) -> Mesh {
    let coordinate = |i: u32| (0.5 * FRAC_PI_2 * (2.0 * f64::from(i) / f64::from(cells) - 1.0)).tan();
    // A right triangle with legs e lies e²/12 of a radius below its sphere in the mean: ⟨x² + y²⟩ about the
    // circumcentre is e²/3 less than the corners' e²/2, halved.
    let edge = FRAC_PI_2 / f64::from(cells);
    let raised = radius_m * (1.0 + edge * edge / 12.0);
    let mut all = mesh(vec![], vec![]);
    for face in 0..6 {
        let first = all.vertices_m.len() as u32;
        let (axis, side) = (face % 3, if face < 3 { 1.0 } else { -1.0 });
        for (i, j) in (0..=cells).flat_map(|i| (0..=cells).map(move |j| (i, j))) {
            let mut x = [0.0; 3];
            x[axis] = side;
            x[(axis + 1) % 3] = side * coordinate(i);
            x[(axis + 2) % 3] = coordinate(j);
            let length = x.iter().map(|c| c * c).sum::<f64>().sqrt();
            all.vertices_m.push(x.map(|c| raised * c / length));
        }
        for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
            let corner = |i: u32, j: u32| first + i * (cells + 1) + j;
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            all.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    all
}

/// S = j√(4π)/λ·2πρ²[e^{ju}(1/(ju) + 1/u²) − 1/u²], u = 2kρ.
fn sphere_physical_optics(radius_m: f64) -> Complex64 {
    let u = 2.0 * K * radius_m;
    let j = Complex64::I;
    let bracket = Complex64::cis(u) * (1.0 / (j * u) + 1.0 / (u * u)) - 1.0 / (u * u);
    j * (4.0 * PI).sqrt() / WAVELENGTH_M * TAU * radius_m * radius_m * bracket
}

/// An aspect off the cube's symmetries: at az 0 the rim's staircase would add up in phase, 0.7 dB with these
/// facets.
fn sphere_request(range_m: f64) -> RcsRequest {
    RcsRequest { range_m, accuracy: Accuracy::from_db(-30.0), ..at(10.0, 20.0) }
}

/// Claims P4 and P5: 0.1 m with facets of 1.7 mm; a sphere nearby grows by (R/(R − ρ))², the divergence
/// of its wave.
#[test]
fn a_fine_sphere_has_the_amplitude_of_physical_optics_and_grows_nearby() {
    let sphere = sphere(0.1, 90);
    let exact = dbsm(sphere_physical_optics(0.1));
    assert!((exact + 15.0482).abs() < 1e-4);
    let far = dbsm(s(&sphere, &sphere_request(f64::INFINITY)));
    check("P4", exact, far, 0.05);
    for (range_m, asked) in [(2.0, 0.446), (1.0, 0.915)] {
        check(&format!("P5 {range_m} m"), asked, dbsm(s(&sphere, &sphere_request(range_m))) - far, 0.05);
    }
}

/// Claim P6: kρL², kρ = 161.
#[test]
fn a_cylinder_at_broadside_has_its_level() {
    let (radius, length, sides) = (0.1, 0.2, 512_u32);
    let edge = PI / f64::from(sides);
    let raised = radius * (1.0 + edge * edge / 6.0);
    let mut vertices = Vec::new();
    for j in 0..=sides {
        let phi = PI * (f64::from(j) / f64::from(sides) - 0.5);
        for z in [-0.5 * length, 0.5 * length] {
            vertices.push([raised * phi.cos(), raised * phi.sin(), z]);
        }
    }
    let triangles =
        (0..sides).flat_map(|j| [[2 * j, 2 * j + 2, 2 * j + 3], [2 * j, 2 * j + 3, 2 * j + 1]]).collect();
    let exact = 10.0 * (K * radius * length * length).log10();
    check("P6", exact, dbsm(s(&mesh(vertices, triangles), &at(0.0, 0.0))), 0.1);
}

/// P7: σ → πR², the ripple of the edges ±3 dB.
#[test]
fn a_large_plate_nearby_acts_as_a_mirror() {
    for side_m in [1.0, 1.5, 2.0] {
        let near = RcsRequest { range_m: 25.0, accuracy: Accuracy::from_db(-40.0), ..request() };
        let got = dbsm(s(&plate(side_m), &near));
        check(&format!("P7 {side_m} m"), 10.0 * (PI * 625.0).log10(), got, 3.0);
        if side_m == 1.5 {
            check("P7 1.5 m, brute force of physics.md §0", 31.59, got, 0.01);
        }
    }
}

/// Claim D1.
#[test]
fn a_right_dihedral_has_its_closed_form_off_axis_and_its_signs() {
    RULES.into_iter().for_each(right_dihedral);
}

/// Rules that leave closed forms as they are and are reciprocal.
const RULES: [NodeRule; 2] = [NodeRule::Middle, NodeRule::OwnEdge];

fn right_dihedral(nodes: NodeRule) {
    let body = dihedral(90.0);
    let double = |azimuth_deg: f64, elevation_deg: f64, polarization| {
        let request = RcsRequest { bounces: 2, polarization, nodes, ..at(azimuth_deg, elevation_deg) };
        run(&body, &request).by_order_m[1][0]
    };
    let area = 0.15_f64.powi(2);
    for azimuth_deg in [0.0_f64, 5.0, 20.0] {
        let sine = (45.0 - azimuth_deg).to_radians().sin();
        let exact = 10.0 * (16.0 * PI * (area * sine / WAVELENGTH_M).powi(2)).log10();
        let vv = double(azimuth_deg, 0.0, Polarization::Vv);
        check(&format!("D1 az {azimuth_deg}"), exact, dbsm(vv), 0.05);
        assert!((vv + double(azimuth_deg, 0.0, Polarization::Hh)).norm() < 1e-3 * vv.norm(), "S_vv = −S_hh");
        assert!((vv / Complex64::new(0.0, -vv.norm()) - 1.0).norm() < 1e-3, "S_vv = −j|S|: {vv}");
    }
    check("D1 az 7 el 2", 8.65, dbsm(double(7.0, 2.0, Polarization::Vv)), 0.05);
    let near = RcsRequest { bounces: 2, range_m: 30.0, nodes, ..at(7.0, 0.0) };
    check("D1 30 m", 27.94, dbsm(run(&body, &near).by_order_m[1][0]), 0.03);
}

/// Claim D1: where the planes are not at right angles the node matters, and the symmetrised mean has no
/// preference.
#[test]
fn a_dihedral_off_ninety_degrees_has_the_level_of_the_symmetrised_node() {
    for (angle_deg, asked) in [(88.0, 8.78), (95.0, 5.67)] {
        for polarization in [Polarization::Vv, Polarization::Hh] {
            let request = RcsRequest { bounces: 2, polarization, ..at(0.0, 0.0) };
            let got = run(&dihedral(angle_deg), &request).by_order_m[1][0];
            check(&format!("D1 {angle_deg}° {polarization:?}"), asked, dbsm(got), 0.02);
        }
    }
    for (polarization, asked) in [(Polarization::Vv, 9.07), (Polarization::Hh, 8.48)] {
        let request = RcsRequest { bounces: 2, polarization, nodes: NodeRule::Exit, ..at(0.0, 0.0) };
        let got = run(&dihedral(88.0), &request);
        check(&format!("D1 88° exit {polarization:?}"), asked, dbsm(got.by_order_m[1][0]), 0.02);
        assert!(got.node_spread[1] > 0.02, "the spread between the rules is told");
    }
}

const TRIHEDRAL_SIDE_M: f64 = 0.1;

fn triangular_trihedral() -> Mesh {
    let a = TRIHEDRAL_SIDE_M;
    mesh(vec![[0.0; 3], [a, 0.0, 0.0], [0.0, a, 0.0], [0.0, 0.0, a]], vec![[0, 1, 2], [0, 2, 3], [0, 3, 1]])
}

fn square_trihedral() -> Mesh {
    let a = TRIHEDRAL_SIDE_M;
    let axes = [[a, 0.0, 0.0], [0.0, a, 0.0], [0.0, 0.0, a]];
    parallelograms(&[
        [[0.0; 3], axes[0], axes[1]],
        [[0.0; 3], axes[1], axes[2]],
        [[0.0; 3], axes[2], axes[0]],
    ])
}

/// Claim D2.
#[test]
fn a_trihedral_of_order_three_has_its_closed_forms_on_and_off_axis() {
    RULES.into_iter().for_each(trihedral);
}

fn trihedral(nodes: NodeRule) {
    let triple = |mesh: &Mesh, azimuth_deg: f64, elevation_deg: f64| {
        let request = RcsRequest { bounces: 3, nodes, ..at(azimuth_deg, elevation_deg) };
        dbsm(run(mesh, &request).by_order_m[2][0])
    };
    let axis = (0.5_f64.sqrt()).atan().to_degrees();
    let (triangular, square) = (triangular_trihedral(), square_trihedral());
    let a4 = 1e-4 / (WAVELENGTH_M * WAVELENGTH_M);
    check("D2 triangular", 10.0 * (4.0 * PI / 3.0 * a4).log10(), triple(&triangular, 45.0, axis), 0.01);
    check("D2 square", 10.0 * (12.0 * PI * a4).log10(), triple(&square, 45.0, axis), 0.01);
    check("D2 triangular off axis", 14.11, triple(&triangular, 40.0, 30.0), 0.05);
    check("D2 square off axis", 22.13, triple(&square, 40.0, 30.0), 0.05);
    check("D2 square far off axis", 16.99, triple(&square, 30.0, 20.0), 0.05);
}

/// A cylinder about z that stands on a square plate, with a lid: strips of one chord, corners on the surface.
fn top_hat(radius_m: f64, height_m: f64, strips: u32, half_plate_m: f64) -> Mesh {
    let step = TAU / f64::from(strips);
    let ring = |z: f64| (0..strips).map(move |i| (step * (f64::from(i) + 0.5), z));
    let on_ring = |(angle, z): (f64, f64)| [radius_m * angle.cos(), radius_m * angle.sin(), z];
    let mut body = parallelograms(&[[
        [-half_plate_m, -half_plate_m, 0.0],
        [2.0 * half_plate_m, 0.0, 0.0],
        [0.0, 2.0 * half_plate_m, 0.0],
    ]]);
    body.vertices_m.extend(ring(0.0).chain(ring(height_m)).map(on_ring));
    body.vertices_m.push([0.0, 0.0, height_m]);
    let (low, high, tip) = (4, 4 + strips, 4 + 2 * strips);
    for i in 0..strips {
        let next = (i + 1) % strips;
        body.triangles.extend([[low + i, low + next, high + next], [low + i, high + next, high + i]]);
        body.triangles.push([high + i, high + next, tip]);
    }
    body
}

/// D3: 8πρh²cos(el)/λ. A node on the plate misses the divergence behind the cylinder: facets reflect parallel
/// strips.
#[test]
fn d3_a_top_hat_has_its_node_on_the_curved_facet() {
    // Facets of q = a/√(ρλ) = 0.18; the plate reaches beyond what the lower rim's ray meets, h/tan(el) = 0.17
    // m.
    for (radius_m, strips, half_plate_m) in [(0.5, 396, 0.75), (2.0, 792, 2.25)] {
        let (height_m, elevation_deg) = (0.1, 30.0_f64);
        let exact =
            8.0 * PI * radius_m * height_m * height_m * elevation_deg.to_radians().cos() / WAVELENGTH_M;
        let body = top_hat(radius_m, height_m, strips, half_plate_m);
        let of = |nodes| {
            let request = RcsRequest {
                bounces: 2,
                nodes,
                accuracy: Accuracy::from_db(-40.0),
                ..at(0.0, elevation_deg)
            };
            dbsm(run(&body, &request).by_order_m[1][0])
        };
        check(&format!("D3 radius {radius_m} m"), 10.0 * exact.log10(), of(NodeRule::OwnEdge), 0.1);
        println!(
            "D3 radius {radius_m} m: middle {:.2}, exit {:.2}",
            of(NodeRule::Middle),
            of(NodeRule::Exit)
        );
    }
}

/// D4, doubled mesh, additivity and reciprocity share a body with several orders: an open box of odd shape.
fn odd_corner() -> Mesh {
    parallelograms(&[
        [[0.0, 0.0, 0.0], [0.11, 0.02, 0.0], [0.0, 0.09, 0.01]],
        [[0.0, 0.0, 0.0], [0.01, 0.1, 0.0], [0.0, -0.02, 0.12]],
        [[0.0, 0.0, 0.0], [0.0, 0.01, 0.1], [0.12, 0.0, 0.02]],
    ])
}

fn relative(a: Complex64, b: Complex64) -> f64 {
    (a - b).norm() / b.norm()
}

/// Claim D4.
#[test]
fn relabelled_split_and_doubled_facets_leave_the_amplitude_unchanged() {
    let body = odd_corner();
    let mut relabelled = body.clone();
    relabelled.triangles.reverse();
    relabelled.triangles.iter_mut().for_each(|t| t.rotate_left(1));
    let mut split = mesh(body.vertices_m.clone(), vec![]);
    for &[a, b, c] in &body.triangles {
        let middle =
            [0, 1, 2].map(|i| 0.5 * (body.vertices_m[b as usize][i] + body.vertices_m[c as usize][i]));
        let new = split.vertices_m.len() as u32;
        split.vertices_m.push(middle);
        split.triangles.extend([[a, b, new], [a, new, c]]);
    }
    let mut doubled = body.clone();
    doubled.triangles.extend(body.triangles.clone());
    for (name, other) in [("relabelled", relabelled), ("split", split), ("doubled", doubled)] {
        for nodes in RULES {
            let request = RcsRequest { bounces: 3, nodes, ..at(40.0, 30.0) };
            let error = relative(s(&other, &request), s(&body, &request));
            println!("D4 {name}, {nodes:?}: asked 1e-9, got {error:.1e}");
            assert!(error < 1e-9, "{name}: {error:e}");
        }
    }
}

/// A box of 36 triangles with three others: a plate, a wall on it, and a block that shades both.
fn plate_wall_and_block() -> Mesh {
    let turned = |degrees: [f64; 3], v: DVec3| {
        let [x, y, z] = degrees.map(f64::to_radians);
        DQuat::from_euler(EulerRot::ZYX, z, y, x) * v
    };
    let boxes = [
        ([0.0, 0.0, 0.0], [0.3, 0.2, 0.02], [5.0, 3.0, 2.0]),
        ([0.02, 0.01, 0.12], [0.04, 0.15, 0.2], [5.0, 3.0, 2.0]),
        ([0.12, -0.05, 0.08], [0.06, 0.05, 0.1], [25.0, -4.0, 7.0]),
    ];
    let mut all = mesh(vec![], vec![]);
    for (middle, size, degrees) in boxes {
        let first = all.vertices_m.len() as u32;
        for i in 0..8 {
            let sign = [4, 2, 1].map(|bit| if i & bit == 0 { -0.5 } else { 0.5 });
            let corner = DVec3::from_array(size) * DVec3::from_array(sign);
            all.vertices_m.push((DVec3::from_array(middle) + turned(degrees, corner)).to_array());
        }
        for [a, b, c, d] in
            [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
        {
            let [a, b, c, d] = [a, b, c, d].map(|corner| first + corner);
            all.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    all
}

/// D4 with an occluder before both mirrors of a double reflection: its edges cut both along one plane through
/// the antenna, and these are two lines.
#[test]
fn corners_of_an_occluder_may_come_in_any_order() {
    let body = plate_wall_and_block();
    let request = RcsRequest {
        bounces: 2,
        nodes: NodeRule::OwnEdge,
        frequency_hz: vec![24e9],
        accuracy: Accuracy::from_db(-60.0),
        ..at(10.0, 12.0)
    };
    let first = s(&body, &request);
    for turned in 0..body.triangles.len() {
        let mut other = body.clone();
        other.triangles[turned].rotate_left(1);
        let error = relative(s(&other, &request), first);
        assert!(error < 1e-4, "triangle {turned}: {error:e}");
    }
}

/// D4: the mesh turned about z with the antenna.
#[test]
fn turning_mesh_and_antenna_together_leaves_the_amplitude_unchanged() {
    let body = odd_corner();
    let (sin, cos) = 33.0_f64.to_radians().sin_cos();
    let mut turned = body.clone();
    turned.vertices_m.iter_mut().for_each(|[x, y, _]| (*x, *y) = (cos * *x - sin * *y, sin * *x + cos * *y));
    let of = |mesh: &Mesh, azimuth| s(mesh, &RcsRequest { bounces: 3, ..at(azimuth, 30.0) });
    let error = relative(of(&turned, 73.0), of(&body, 40.0));
    println!("D4 turned: asked 1e-9, got {error:.1e}");
    assert!(error < 1e-9);
}

/// A wrong node rule fails here and nowhere else: transmitter and receiver 22° apart on an 88° dihedral, and
/// at two places before a corner of odd shape for the higher orders.
#[test]
fn swapping_transmitter_and_receiver_transposes_the_amplitude() {
    for nodes in RULES {
        for (range_m, bounces) in [(f64::INFINITY, 2), (f64::INFINITY, 3), (30.0, 2)] {
            reciprocal(&dihedral(88.0), [(-11.0, 3.0), (11.0, -2.0)], range_m, bounces, nodes);
        }
        for (range_m, bounces) in [(f64::INFINITY, 4), (f64::INFINITY, 5), (3.0, 3), (3.0, 5)] {
            reciprocal(&odd_corner(), [(40.0, 30.0), (55.0, 21.0)], range_m, bounces, nodes);
        }
    }
}

/// S(0, 1) = S(1, 0)ᵀ to −100 dB of the co-polarized amplitude; (azimuth, elevation) in degrees.
fn reciprocal(body: &Mesh, stations_deg: [(f64, f64); 2], range_m: f64, bounces: u8, nodes: NodeRule) {
    let stations = stations_deg.map(|(az, el)| (az.to_radians(), el.to_radians()));
    let of = |from: usize, to: usize, polarization| {
        let (azimuth_rad, elevation_rad) = stations[to];
        let receiver = Standpoint { azimuth_rad, elevation_rad, range_m };
        let request = RcsRequest {
            azimuth_rad: vec![stations[from].0],
            elevation_rad: vec![stations[from].1],
            receiver: Some(receiver),
            range_m,
            polarization,
            bounces,
            nodes,
            accuracy: Accuracy::from_db(-80.0),
            ..request()
        };
        s(body, &request)
    };
    let pairs = [
        (Polarization::Vv, Polarization::Vv),
        (Polarization::Vh, Polarization::Hv),
        (Polarization::Hh, Polarization::Hh),
    ];
    let scale = of(0, 1, Polarization::Vv).norm();
    for (there, back) in pairs {
        let error = (of(0, 1, there) - of(1, 0, back)).norm() / scale;
        let level_db = 20.0 * error.log10();
        println!(
            "reciprocity, {nodes:?}, {range_m} m, {bounces} bounces, {there:?}: asked -100 dB, got {level_db:.0}"
        );
        assert!(scale > 0.0 && error < 1e-5);
    }
}

/// Monostatic reciprocity, to rounding, on a body that depolarises.
#[test]
fn cross_polarizations_of_one_antenna_are_equal() {
    for (nodes, bounces) in RULES.into_iter().flat_map(|nodes| [(nodes, 3), (nodes, 5)]) {
        for range_m in [f64::INFINITY, 2.0] {
            let accuracy = Accuracy::from_db(-40.0);
            let request = |polarization| RcsRequest {
                bounces,
                polarization,
                nodes,
                range_m,
                accuracy,
                ..at(40.0, 30.0)
            };
            let of = |polarization| s(&odd_corner(), &request(polarization));
            let (vh, hv) = (of(Polarization::Vh), of(Polarization::Hv));
            let error = (vh - hv).norm() / of(Polarization::Vv).norm();
            println!("{nodes:?}, {bounces} bounces, {range_m} m: asked 1e-10, got {error:.1e}");
            assert!(error <= 1e-10 && vh.norm() > 0.0);
        }
    }
}

/// The two-tree form of the same place is the one-tree form: nothing is doubled or lost by the symmetries.
#[test]
fn a_receiver_beside_the_transmitter_gives_the_monostatic_amplitude() {
    for bounces in 1..=5 {
        for nodes in [NodeRule::Middle, NodeRule::Exit, NodeRule::OwnEdge] {
            let one = RcsRequest { bounces, nodes, ..at(40.0, 30.0) };
            let (azimuth_rad, elevation_rad) = (one.azimuth_rad[0], one.elevation_rad[0]);
            let receiver = Some(Standpoint { azimuth_rad, elevation_rad, range_m: f64::INFINITY });
            let two = RcsRequest { receiver, ..one.clone() };
            let error = relative(s(&odd_corner(), &two), s(&odd_corner(), &one));
            assert!(error < 1e-9, "{bounces} bounces, {nodes:?}: {error:e}");
        }
    }
}

/// Bodies too far apart to see each other: S is the sum.
#[test]
fn amplitudes_of_bodies_that_do_not_see_each_other_add() {
    let shifted = |x: f64| [[x, -0.1, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]];
    let of = |list: &[[[f64; 3]; 3]]| {
        s(&parallelograms(list), &RcsRequest { range_m: 20.0, bounces: 2, ..at(10.0, 5.0) })
    };
    let (a, b) = (shifted(0.0), [[0.3, 0.1, 0.2], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]]);
    let error = (of(&[a, b]) - of(&[a]) - of(&[b])).norm() / of(&[a]).norm();
    println!("additivity: {error:.1e}");
    assert!(error < 1e-6);
}

/// Slivers are dropped by area; at 1 GHz and −40 dB, λ²/100·accuracy is 9 mm², larger than every facet of
/// this mesh.
#[test]
fn a_mesh_much_finer_than_the_wavelength_is_not_dropped() {
    let (side_m, cells) = (0.3, 128);
    let step = side_m / f64::from(cells);
    let corner = |n: u32| f64::from(n) * step - 0.5 * side_m;
    let cell = |n: u32| [[0.0, corner(n % cells), corner(n / cells)], [0.0, step, 0.0], [0.0, 0.0, step]];
    let fine = parallelograms(&(0..cells * cells).map(cell).collect::<Vec<_>>());
    let request = RcsRequest { frequency_hz: vec![1e9], accuracy: Accuracy::from_db(-40.0), ..at(20.0, 0.0) };
    let (coarse, fine) = (s(&plate(side_m), &request), s(&fine, &request));
    check("fine mesh, dB", dbsm(coarse), dbsm(fine), 1e-6);
}
