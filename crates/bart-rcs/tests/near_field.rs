//! Antennas near a body: some are refused, work ends, and the error told there is true.
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use artifact::Accuracy;
use artifact::material::{Backing, Layer, Material, Thickness, Transmission};
use artifact::scene::Mesh;
use artifact::settings::Sides;
use artifact::units::SPEED_OF_LIGHT_MPS;
use bart_rcs::{BartError, RcsRequest, RcsResult, Standpoint, rcs};
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

const FREQUENCY_HZ: f64 = 10e9;
/// Wavelength of 3 cm.
const WAVELENGTH_M: f64 = SPEED_OF_LIGHT_MPS / FREQUENCY_HZ;

/// A cube of 1 m about the origin, all facets outward.
fn cube() -> Mesh {
    let corner = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 0.5 } else { -0.5 });
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Mesh { name: "cube".into(), vertices_m: (0..8).map(corner).collect(), triangles, ..Mesh::default() }
}

/// A square of 1 m across x.
fn plate() -> Mesh {
    let vertices_m = vec![[0.0, -0.5, -0.5], [0.0, 0.5, -0.5], [0.0, 0.5, 0.5], [0.0, -0.5, 0.5]];
    Mesh { name: "plate".into(), vertices_m, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() }
}

/// A sphere of 0.5 m, 16 rings of 24 facets.
fn sphere() -> Mesh {
    let (rings, sides) = (16_u32, 24_u32);
    let place = |ring: u32, side: u32| {
        let (polar, around) =
            (PI * f64::from(ring) / f64::from(rings), TAU * f64::from(side) / f64::from(sides));
        [0.5 * polar.sin() * around.cos(), 0.5 * polar.sin() * around.sin(), 0.5 * polar.cos()]
    };
    let vertices_m = (0..=rings).flat_map(|ring| (0..sides).map(move |side| place(ring, side))).collect();
    let index = |ring: u32, side: u32| ring * sides + side % sides;
    let mut triangles = Vec::new();
    for (ring, side) in (0..rings).flat_map(|ring| (0..sides).map(move |side| (ring, side))) {
        let [a, b, c, d] = [(ring, side), (ring + 1, side), (ring + 1, side + 1), (ring, side + 1)]
            .map(|(ring, side)| index(ring, side));
        triangles.extend((ring + 1 < rings).then_some([a, b, c]));
        triangles.extend((ring > 0).then_some([a, c, d]));
    }
    Mesh { name: "sphere".into(), vertices_m, triangles, ..Mesh::default() }
}

fn request(range_m: f64) -> RcsRequest {
    RcsRequest { range_m, ..RcsRequest::over(vec![FREQUENCY_HZ], vec![0.05], vec![0.1]) }
}

fn antenna_m(request: &RcsRequest) -> DVec3 {
    let ((sin_el, cos_el), (sin_az, cos_az)) =
        (request.elevation_rad[0].sin_cos(), request.azimuth_rad[0].sin_cos());
    request.range_m * DVec3::new(cos_el * cos_az, cos_el * sin_az, sin_el)
}

/// S = j√(4π)/λ · ∫ (n·r̂ₓ)(R/r)² e^{−2jk(r−R)} dA over the facets of a convex body that face the antenna,
/// point by point: a triangle as a square, (u, v) ↦ a + u(1−v)(b−a) + uv(c−a), in steps of a sixteenth of a
/// wavelength by 2 × 2 points of Gauss and Legendre, which miss (π/8)⁴/270 = 9e-5 of a step's phasor.
fn brute_force(mesh: &Mesh, request: &RcsRequest) -> Complex64 {
    let facets =
        mesh.triangles.iter().map(|t| t.map(|vertex| DVec3::from_array(mesh.vertices_m[vertex as usize])));
    let sum: Complex64 = facets
        .map(|facet| over_facet(facet, if mesh.name == "plate" { Sides::Two } else { Sides::One }, request))
        .sum();
    Complex64::I * (4.0 * PI).sqrt() / WAVELENGTH_M * sum
}

fn over_facet([a, b, c]: [DVec3; 3], sides: Sides, request: &RcsRequest) -> Complex64 {
    let (p, k) = (antenna_m(request), TAU / WAVELENGTH_M);
    let outward = 0.5 * (b - a).cross(c - a);
    let side = match sides {
        Sides::Two => outward.dot(p - a).signum(),
        Sides::One => 1.0,
    };
    if side * outward.dot(p - a) <= 0.0 {
        return Complex64::ZERO;
    }
    let longest_m = (b - a).length().max((c - a).length()).max((c - b).length());
    let steps = (16.0 * longest_m / WAVELENGTH_M).ceil();
    let of_step = |i: usize| [-1.0, 1.0].map(|half| (i as f64 + 0.5 + half / 12.0_f64.sqrt()) / steps);
    let points: Vec<f64> = (0..steps as usize).flat_map(of_step).collect();
    let at = |u: f64, v: f64| {
        let x = a + u * (1.0 - v) * (b - a) + u * v * (c - a);
        let r = p.distance(x);
        let weight = 2.0 * u * side * outward.dot(p - x) / r * (request.range_m / r).powi(2);
        Complex64::from_polar(weight, -2.0 * k * (r - request.range_m))
    };
    let sum: Complex64 =
        points.iter().flat_map(|u| points.iter().map(move |v| (*u, *v))).map(|(u, v)| at(u, v)).sum();
    sum / (points.len() * points.len()) as f64
}

#[test]
fn over_five_decades_of_distance_it_ends_with_a_true_error_or_is_refused_with_figures() {
    for (mesh, surface_m) in [(cube(), 0.5), (plate(), 0.0), (sphere(), 0.5)] {
        for distance_m in [100.0, 10.0, 1.0, 0.1, 0.035, 0.01, 0.001] {
            let request = request(surface_m + distance_m);
            let found = rcs(&mesh, &request, &|_, _| ());
            if distance_m < 0.9 * WAVELENGTH_M {
                let Err(BartError::AntennaTooNear { distance_m: told_m, least_m, .. }) = found else {
                    panic!("{} at {distance_m} m is not refused: {found:?}", mesh.name)
                };
                assert!(told_m < least_m && (least_m - WAVELENGTH_M).abs() < 1e-12);
                continue;
            }
            let found = found.unwrap();
            let exact = brute_force(&mesh, &request);
            let error = (found.amplitude_m[0] - exact).norm() / exact.norm();
            let told = found.error.total().unwrap();
            println!(
                "{} at {distance_m} m: {:.2} dBsm, told {told:.1e}, true {error:.1e}",
                mesh.name,
                20.0 * exact.norm().log10()
            );
            // The quadrature misses up to 9e-5 of its own.
            assert!(told <= 1e-2 && error <= told + 1e-4);
        }
    }
}

#[test]
fn a_receiver_or_a_transmitter_inside_a_closed_body_is_refused() {
    let receiver = |range_m| Some(Standpoint { azimuth_rad: 0.4, elevation_rad: 0.2, range_m });
    for mesh in [cube(), sphere()] {
        let inside = |found: Result<_, BartError>| {
            let Err(BartError::AntennaEnclosed { bodies, share }) = found else { return false };
            share > 0.999 && bodies == [mesh.name.clone()]
        };
        let quiet = |request: &RcsRequest| rcs(&mesh, request, &|_, _| ());
        assert!(inside(quiet(&request(0.1))), "{}", mesh.name);
        for transmitter_m in [30.0, f64::INFINITY] {
            let bistatic = RcsRequest { receiver: receiver(0.1), ..request(transmitter_m) };
            assert!(inside(quiet(&bistatic)), "{} {transmitter_m}", mesh.name);
            let table = RcsRequest { azimuth_rad: vec![0.0, 1.0, 2.0], ..bistatic };
            assert!(inside(quiet(&table)), "{} {transmitter_m}", mesh.name);
        }
        // Facets wound either way round shut it in as well.
        let mut turned = mesh.clone();
        turned.triangles.iter_mut().step_by(2).for_each(|triangle| triangle.swap(0, 1));
        assert!(inside(rcs(&turned, &request(0.1), &|_, _| ())), "{}", mesh.name);
        let one_sided = RcsRequest { sides: Sides::One, ..request(0.1) };
        assert!(inside(quiet(&one_sided)), "{}", mesh.name);
    }
}

#[test]
fn a_sheet_elsewhere_opens_no_closed_body_and_one_in_its_wall_does() {
    let layers = vec![Layer { thickness_m: 0.003, permittivity: Complex64::from(2.3) }];
    let sheet = Material::Layers { layers, backing: Backing::Air, thickness: Thickness::Exact };
    let with_sheet = |triangle: usize| {
        let mut mesh = cube();
        mesh.vertices_m.extend([[5.0, 0.0, 0.0], [5.0, 0.05, 0.0], [5.0, 0.0, 0.05]]);
        mesh.triangles.push([8, 9, 10]);
        // Wound either way round, so that the lit facets decide.
        mesh.triangles.iter_mut().step_by(2).for_each(|triangle| triangle.swap(0, 1));
        mesh.material_of_triangle = (0..13).map(|index| u16::from(index == triangle)).collect();
        mesh.makeup.materials = vec![Material::Conductor, sheet.clone()];
        mesh.makeup.transmission = Transmission::Followed;
        rcs(&mesh, &RcsRequest { bounces: 1, ..request(0.1) }, &|_, _| ())
    };
    assert!(matches!(with_sheet(12), Err(BartError::AntennaEnclosed { .. })));
    assert!(with_sheet(3).is_ok());
}

#[test]
fn a_box_without_a_lid_is_no_closed_body() {
    let mut open = cube();
    open.triangles.drain(2..4);
    let found = rcs(&open, &RcsRequest { bounces: 1, ..request(0.1) }, &|_, _| ()).unwrap();
    assert!(found.amplitude_m[0].is_finite() && found.error.total().is_some_and(f64::is_finite));
}

/// The error that a table tells, and what it errs by against a finer one.
fn told_and_true(coarse: &RcsResult, fine: &RcsResult) -> (f64, f64) {
    let norm = |values: &[Complex64]| values.iter().map(Complex64::norm_sqr).sum::<f64>().sqrt();
    let pairs = coarse.amplitude_m.iter().zip(&fine.amplitude_m);
    let missed: Vec<Complex64> = pairs.map(|(coarse, fine)| coarse - fine).collect();
    (coarse.error.total().unwrap(), norm(&missed) / norm(&fine.amplitude_m))
}

/// Half a tube of a few sides with an end wall, as a wheel arch is, on a plate; all facets from their corner
/// `first` on.
fn arch_on_plate(first: usize) -> Mesh {
    const SIDES: u32 = 7;
    let place = |i: u32, x: f64| {
        let (z, y) = (PI * f64::from(i) / f64::from(SIDES)).sin_cos();
        [0.1 - x, 0.12 * y, 0.12 * z]
    };
    let mut vertices_m: Vec<[f64; 3]> =
        [0.0, 0.15].iter().flat_map(|x| (0..=SIDES).map(|i| place(i, *x))).collect();
    let middle = vertices_m.len() as u32;
    vertices_m.push([-0.05, 0.0, 0.0]);
    vertices_m.extend([[-0.2, -0.2, 0.0], [0.2, -0.2, 0.0], [0.2, 0.2, 0.0], [-0.2, 0.2, 0.0]]);
    let far = SIDES + 1;
    let side = |i: u32| [[i, i + 1, far + i + 1], [i, far + i + 1, far + i], [far + i, far + i + 1, middle]];
    let plate = [[1, 2, 3], [1, 3, 4]].map(|corners| corners.map(|corner| middle + corner));
    let mut triangles: Vec<[u32; 3]> = (0..SIDES).flat_map(side).chain(plate).collect();
    triangles.iter_mut().for_each(|corners| corners.rotate_left(first));
    Mesh { name: "arch".into(), vertices_m, triangles, ..Mesh::default() }
}

/// A tube of ten sides that stands on a plate; all facets from their corner `first` on.
fn tube_on_plate(first: usize) -> Mesh {
    let place = |i: u32, z: f64| {
        let (y, x) = (TAU * f64::from(i) / 10.0).sin_cos();
        [0.072 * x, 0.072 * y, z]
    };
    let mut vertices_m: Vec<[f64; 3]> =
        [0.0, 0.07].iter().flat_map(|z| (0..10).map(|i| place(i, *z))).collect();
    vertices_m.extend(
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| [0.158 * x, 0.158 * y, 0.0]),
    );
    let side = |i: u32| {
        let next = (i + 1) % 10;
        [[i, next, 10 + next], [i, 10 + next, 10 + i]]
    };
    let mut triangles: Vec<[u32; 3]> = (0..10).flat_map(side).chain([[20, 21, 22], [20, 22, 23]]).collect();
    triangles.iter_mut().for_each(|corners| corners.rotate_left(first));
    Mesh { name: "tube".into(), vertices_m, triangles, ..Mesh::default() }
}

/// `body` from 3 m away, by three bounces.
fn from_3_m(body: &Mesh, azimuth_deg: f64, elevation_deg: f64, db: f64) -> RcsResult {
    let asked = RcsRequest {
        azimuth_rad: vec![azimuth_deg.to_radians()],
        elevation_rad: vec![elevation_deg.to_radians()],
        accuracy: Accuracy::from_db(db),
        ..request(3.0)
    };
    rcs(body, &asked, &|_, _| ()).unwrap()
}

/// Shadows part what is lit into pieces, and slivers among them are dropped: by which corner a facet begins
/// decides which. A line that had cut one off counted negatively for the piece on its other side, −44 dB of S
/// where −47 were told.
#[test]
fn slivers_dropped_beside_a_shadow_change_no_weight() {
    for first in 0..3 {
        let of = |db| from_3_m(&tube_on_plate(first), 163.9, 55.08, db);
        let (told, error) = told_and_true(&of(-40.0), &of(-90.0));
        println!("from corner {first}: told {told:.1e}, true {error:.1e}");
        assert!(error <= told, "{first}: {error}, {told} told");
    }
}

/// What an arch hides behind lines that its facets have in common is hidden whichever corner they begin with:
/// S differed by −17 dB.
#[test]
fn an_occluder_that_ends_along_a_seam_leaves_a_border() {
    let [from_first, from_second] = [0, 1].map(|first| from_3_m(&arch_on_plate(first), -40.0, 25.0, -90.0));
    let (_, difference) = told_and_true(&from_second, &from_first);
    println!("difference {difference:.1e}");
    assert!(difference < 1e-5);
}

/// A plate that is one tile of integrals as fine as asked and of ones ten times finer differs by nothing
/// between them, and in its sidelobes errs by as much as it sends.
#[test]
fn the_error_told_of_small_plates_in_their_sidelobes_is_true() {
    let (mut covered, mut count) = (0, 0);
    for (side_m, range_m) in [(0.1, 2.0), (0.1, 5.0), (0.2, 5.0), (0.2, 12.0), (0.4, 12.0)] {
        let mut small = plate();
        small.vertices_m.iter_mut().for_each(|corner| *corner = corner.map(|x| side_m * x));
        for azimuth_rad in [0.3, 0.55, 0.8, 1.05, 1.3] {
            for azimuths in [1, 12] {
                let of = |db| {
                    let azimuth_rad = (0..azimuths).map(|i| azimuth_rad + 1e-3 * f64::from(i)).collect();
                    let accuracy = Accuracy::from_db(db);
                    let asked = RcsRequest { azimuth_rad, accuracy, bounces: 1, ..request(range_m) };
                    rcs(&small, &asked, &|_, _| ()).unwrap()
                };
                let (told, error) = told_and_true(&of(-20.0), &of(-100.0));
                println!("{side_m} m at {range_m} m, {azimuth_rad} rad: told {told:.1e}, true {error:.1e}");
                covered += u32::from(error <= told);
                count += 1;
            }
        }
    }
    assert!(100 * covered >= 95 * count, "{covered} of {count}");
}

#[test]
fn the_error_told_of_a_table_is_that_of_its_flash_wherever_it_stands() {
    for count in [4_usize, 12] {
        // The plate's flash at one azimuth, by turns; its sidelobes at the others.
        for flash in [0, 1, count - 2] {
            let turned_rad = |k: usize| (k as f64 - flash as f64) * 0.11;
            let azimuth_rad: Vec<f64> = (0..count).map(turned_rad).collect();
            let of = |db| {
                let accuracy = Accuracy::from_db(db);
                let table = RcsRequest { azimuth_rad: azimuth_rad.clone(), accuracy, ..request(7.0) };
                rcs(&plate(), &table, &|_, _| ()).unwrap()
            };
            let (told, error) = told_and_true(&of(-15.0), &of(-70.0));
            println!("{count}, flash at {flash}: told {told:.2e}, true {error:.2e}");
            // Of twelve aspects three are measured: with what the other sidelobes err by it is 2 dB more.
            // What is less than a hundredth of the −15 dB asked for is bounded, not measured.
            let most = f64::max(3.0 * error, 0.01 * Accuracy::from_db(-15.0).amplitude());
            assert!(error <= 1.4 * told && told < most, "{count}, {flash}: {told} for {error}");
        }
    }
}
