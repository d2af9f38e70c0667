//! Tests of both references against closed forms with increasing density.

use crate::aspect::AntennaPair;
use crate::po;
use crate::ray_cast::Body;
use crate::sbr;
use crate::{Aspect, Bracket, ReferenceError, iterative_po};
use artifact::paths::Amplitude;
use artifact::scene::Mesh;
use artifact::settings::Sides;
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use num_complex::Complex64;
use radar::standpoint::Standpoint;
use std::f64::consts::PI;

const FREQUENCY_HZ: f64 = 77e9;
const WAVELENGTH_M: f64 = SPEED_OF_LIGHT_MPS / FREQUENCY_HZ;

fn standpoint(az_deg: f64, el_deg: f64, range_m: f64) -> Standpoint {
    Standpoint { azimuth_rad: az_deg.to_radians(), elevation_rad: el_deg.to_radians(), range_m }
}

fn far(az_deg: f64, el_deg: f64) -> Aspect {
    Aspect::monostatic(standpoint(az_deg, el_deg, f64::INFINITY))
}

fn by_po(mesh: &Mesh, aspect: &Aspect, per_wavelength: f64, shadow_levels: u32) -> Amplitude {
    let sampling =
        po::Sampling { per_wavelength, shadow_levels, sides: Sides::Two, bracket: Bracket::Symmetrised };
    po::amplitude(mesh, aspect, &[FREQUENCY_HZ], &sampling).unwrap()[0]
}

fn by_sbr(mesh: &Mesh, aspect: &Aspect, per_wavelength: f64, bracket: Bracket) -> Vec<Amplitude> {
    let shooting = sbr::RaySettings { per_wavelength, bounces: 3, sides: Sides::Two, bracket };
    let by_order = sbr::amplitude(mesh, aspect, &[FREQUENCY_HZ], &shooting).unwrap();
    by_order.orders.iter().map(|frequencies| frequencies[0]).collect()
}

fn dbsm(s: Complex64) -> f64 {
    10.0 * s.norm_sqr().log10()
}

/// Convex polygons, given by corners in metres, as triangle fans.
fn mesh_of(polygons: &[Vec<[f64; 3]>]) -> Mesh {
    let mut mesh = Mesh::default();
    for polygon in polygons {
        let first = mesh.vertices_m.len() as u32;
        mesh.vertices_m.extend(polygon);
        let fan = 1..polygon.len() as u32 - 1;
        mesh.triangles.extend(fan.map(|i| [first, first + i, first + i + 1]));
    }
    mesh
}

/// A rectangle in the plane x = `x`, between `y` and `z` limits.
fn screen(x: f64, y: [f64; 2], z: [f64; 2]) -> Vec<[f64; 3]> {
    vec![[x, y[0], z[0]], [x, y[1], z[0]], [x, y[1], z[1]], [x, y[0], z[1]]]
}

fn square(side_m: f64) -> Mesh {
    let half = 0.5 * side_m;
    mesh_of(&[screen(0.0, [-half, half], [-half, half])])
}

/// Faces of width and height `side_m` that meet in the z axis and open towards +x.
fn dihedral(side_m: f64, opening_deg: f64) -> Mesh {
    let half = 0.5 * side_m;
    let (sin, cos) = (0.5 * opening_deg).to_radians().sin_cos();
    let face = |y: f64| {
        let end = [side_m * cos, side_m * sin * y];
        vec![[0.0, 0.0, -half], [end[0], end[1], -half], [end[0], end[1], half], [0.0, 0.0, half]]
    };
    mesh_of(&[face(1.0), face(-1.0)])
}

/// Three triangles in the coordinate planes, apex at the origin.
fn triangular_trihedral(side_m: f64) -> Mesh {
    let tip = |i: usize| std::array::from_fn(|j| if i == j { side_m } else { 0.0 });
    mesh_of(&[(0, 1), (1, 2), (2, 0)].map(|(i, j)| vec![[0.0; 3], tip(i), tip(j)]))
}

/// Far-field S of a plate in the plane x = 0 (physics.md P1): j√(4π)/λ·cos·∬e^{2jk r̂·x} over `y` and `z`
/// limits.
fn screen_far(az_deg: f64, el_deg: f64, x: f64, y: [f64; 2], z: [f64; 2]) -> Complex64 {
    let k = 2.0 * PI / WAVELENGTH_M;
    let r = AntennaPair::of(&far(az_deg, el_deg)).transmitter.towards;
    let strip = |slope: f64, [a, b]: [f64; 2]| {
        let half_phase = 0.5 * slope * (b - a);
        let sinc = if half_phase.abs() < 1e-9 { 1.0 } else { half_phase.sin() / half_phase };
        Complex64::cis(0.5 * slope * (a + b)) * (b - a) * sinc
    };
    let scale = Complex64::new(0.0, (4.0 * PI).sqrt() / WAVELENGTH_M * r.x.abs());
    scale * Complex64::cis(2.0 * k * r.x * x) * strip(2.0 * k * r.y, y) * strip(2.0 * k * r.z, z)
}

#[test]
fn po_of_a_plate_converges_to_the_closed_form_at_any_angle() {
    let (side, half) = (0.03, [-0.015, 0.015]);
    let peak = screen_far(0.0, 0.0, 0.0, half, half).norm();
    for (az, el) in [(0.0, 0.0), (3.0, 0.0), (20.0, 10.0), (45.0, -30.0), (70.0, 5.0), (180.0, 20.0)] {
        let exact = screen_far(az, el, 0.0, half, half);
        let error =
            |density: f64| (by_po(&square(side), &far(az, el), density, 0)[0][0] - exact).norm() / peak;
        // Degree 5: twice the density reduces the error by 2⁶.
        let (coarse, fine) = (error(2.0), error(8.0));
        assert!(
            fine < 1e-7 && (fine < coarse / 64.0 || coarse < 1e-9),
            "az {az}, el {el}: {coarse:e}, {fine:e}"
        );
    }
}

#[test]
fn po_of_a_plate_at_finite_range_has_the_published_levels() {
    // P2 and the plate anchors: 0.3 m square, dBsm.
    for (range_m, level) in [(1e3, 38.2703), (100.0, 38.1685), (30.0, 37.1286), (5.0, 19.7382)] {
        let got = by_po(&square(0.3), &Aspect::monostatic(standpoint(0.0, 0.0, range_m)), 0.5, 0);
        // At 1 km the Fresnel term still contributes 1e-3 dB.
        assert!((dbsm(got[0][0]) - level).abs() < 1.1e-3, "{range_m} m: {}", dbsm(got[0][0]));
        assert!((got[0][0] - got[1][1]).norm() < 1e-12 * got[0][0].norm());
        assert!(got[0][1].norm() < 1e-12 * got[0][0].norm());
    }
}

/// A screen hides the middle of a larger one behind it; seen at normal incidence the shadow is the screen
/// itself.
fn hidden_middle() -> (Mesh, Complex64) {
    let (small, large) = ([-0.0071, 0.0083], [-0.02, 0.02]);
    let mesh = mesh_of(&[screen(0.0, small, small), screen(-0.1, large, large)]);
    let part = |x: f64, limits: [f64; 2]| screen_far(0.0, 0.0, x, limits, limits);
    (mesh, part(0.0, small) + part(-0.1, large) - part(-0.1, small))
}

#[test]
fn a_shadow_converges_with_density_and_faster_with_refined_borders() {
    let (mesh, exact) = hidden_middle();
    let error = |density: f64, levels: u32| {
        (by_po(&mesh, &far(0.0, 0.0), density, levels)[0][0] - exact).norm() / exact.norm()
    };
    // A border cell is wrong by at most its own area and there are 4·15.4 mm/edge of them: edge·61.6 mm over
    // the lit 1363 mm² in the worst case, a tenth of it with the cancellation that occurs.
    let edge_m = |density: f64, levels: u32| WAVELENGTH_M / density / (0.5 * f64::from(levels)).exp2();
    for (density, levels) in [(4.0, 0), (16.0, 0), (4.0, 6), (4.0, 10)] {
        let worst = edge_m(density, levels) * 0.0616 / 1.363e-3;
        assert!(
            error(density, levels) < worst,
            "{density}, {levels}: {:e} of {worst:e}",
            error(density, levels)
        );
    }
}

#[test]
fn sbr_of_first_order_converges_to_po() {
    let (mesh, exact) = hidden_middle();
    let errors = [2.0, 8.0, 32.0].map(|density| {
        (by_sbr(&mesh, &far(0.0, 0.0), density, Bracket::Plain)[0][0][0] - exact).norm() / exact.norm()
    });
    // (spacing)^1.5 from borders at random positions; the constant is of order one of
    // borders·spacing^1.5/√area.
    assert!(errors[2] < 2e-3 && errors[2] < errors[0] / 8.0, "{errors:?}");
    let near = Aspect::monostatic(standpoint(10.0, 5.0, 2.0));
    let po = by_po(&mesh, &near, 8.0, 8)[0][0];
    let sbr = by_sbr(&mesh, &near, 32.0, Bracket::Plain)[0][0][0];
    assert!((po - sbr).norm() < 4e-3 * exact.norm(), "{po} {sbr}");
}

#[test]
fn d1_a_dihedral_has_its_level_and_its_signs() {
    let mesh = dihedral(0.15, 90.0);
    for (az, level, tolerance) in [(0.0, 29.2394, 0.02), (5.0, 28.411, 0.05), (20.0, 24.769, 0.05)] {
        let s = by_sbr(&mesh, &far(az, 0.0), 4.0, Bracket::Plain)[1];
        assert!((dbsm(s[0][0]) - level).abs() < tolerance, "az {az}: {}", dbsm(s[0][0]));
        assert!((s[0][0] + s[1][1]).norm() < 1e-9 * s[0][0].norm(), "S_vv = −S_hh");
        assert!(s[0][0].im < 0.0 && s[0][0].re.abs() < 0.01 * s[0][0].norm(), "S_vv = −j|S|: {}", s[0][0]);
    }
    let near = by_sbr(&mesh, &Aspect::monostatic(standpoint(7.0, 0.0, 30.0)), 4.0, Bracket::Plain)[1];
    assert!((dbsm(near[0][0]) - 27.94).abs() < 0.03, "{}", dbsm(near[0][0]));
}

#[test]
fn d1_exit_nodes_of_an_88_degree_dihedral_differ_between_vv_and_hh_until_symmetrised() {
    let mesh = dihedral(0.15, 88.0);
    let s = by_sbr(&mesh, &far(0.0, 0.0), 6.0, Bracket::Plain)[1];
    assert!((dbsm(s[0][0]) - 9.07).abs() < 0.02 && (dbsm(s[1][1]) - 8.48).abs() < 0.02, "{s:?}");
    let s = by_sbr(&mesh, &far(0.0, 0.0), 6.0, Bracket::Symmetrised)[1];
    assert!((dbsm(s[0][0]) - 8.78).abs() < 0.02 && (dbsm(s[1][1]) - 8.78).abs() < 0.02, "{s:?}");
}

#[test]
fn d2_a_trihedral_has_its_level_and_its_sign() {
    let mesh = triangular_trihedral(0.1);
    let axis = 35.264_389_682_754_654;
    for (az, el, level) in [(45.0, axis, 14.414), (40.0, 30.0, 14.11)] {
        let s = by_sbr(&mesh, &far(az, el), 8.0, Bracket::Plain)[2];
        assert!((dbsm(s[0][0]) - level).abs() < 0.05, "{}", dbsm(s[0][0]));
        // −j|S| in both (closed_form/README.md).
        assert!(s[0][0].im < 0.0 && (s[0][0] - s[1][1]).norm() < 1e-2 * s[0][0].norm(), "{s:?}");
    }
}

#[test]
fn both_amplitudes_survive_doubled_facets() {
    let single = triangular_trihedral(0.03);
    let mut doubled = single.clone();
    doubled.triangles.extend(single.triangles.iter().map(|[a, b, c]| [*b, *a, *c]));
    let aspect = Aspect::monostatic(standpoint(40.0, 30.0, 3.0));
    let po = [&single, &doubled].map(|m| by_po(m, &aspect, 4.0, 2)[0][0]);
    assert!((po[0] - po[1]).norm() < 1e-9 * po[0].norm(), "{po:?}");
    let [one, two] = [&single, &doubled].map(|m| by_sbr(m, &aspect, 4.0, Bracket::Plain));
    for (a, b) in one.iter().zip(&two) {
        assert!((a[0][0] - b[0][0]).norm() < 1e-9 * a[0][0].norm(), "{a:?} {b:?}");
    }
}

#[test]
fn bistatic_amplitudes_are_reciprocal_in_first_order() {
    let (mesh, _) = hidden_middle();
    let [a, b] = [standpoint(8.0, 3.0, 4.0), standpoint(-14.0, 20.0, 7.0)];
    let there = by_po(&mesh, &Aspect { transmitter: a, receiver: b }, 8.0, 4);
    let back = by_po(&mesh, &Aspect { transmitter: b, receiver: a }, 8.0, 4);
    let scale = there[0][0].norm();
    for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        assert!((there[p][q] - back[q][p]).norm() < 1e-9 * scale, "{there:?} {back:?}");
    }
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let mesh = triangular_trihedral(0.05);
    let aspect = Aspect::monostatic(standpoint(40.0, 30.0, 3.0));
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| (by_po(&mesh, &aspect, 4.0, 2), by_sbr(&mesh, &aspect, 4.0, Bracket::Plain)))
    };
    assert_eq!(run(1), run(3));
}

/// A unit sphere from an octahedron subdivided `levels` times: closed, with shared corners equal to the bit.
fn ball(levels: u32) -> Mesh {
    let tip = |axis: usize, sign: f64| std::array::from_fn(|j| if j == axis { sign } else { 0.0 });
    let mut faces = Vec::new();
    for [a, b, c] in [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]] {
        faces.push(vec![tip(0, a), tip(1, b), tip(2, c)]);
        faces.push(vec![tip(0, -a), tip(2, -c), tip(1, -b)]);
    }
    for _ in 0..levels {
        faces = faces.iter().flat_map(|face| quarters(face)).collect();
    }
    mesh_of(&faces)
}

fn quarters(face: &[[f64; 3]]) -> [Vec<[f64; 3]>; 4] {
    let middle = |i: usize, j: usize| {
        let sum: [f64; 3] = std::array::from_fn(|c| face[i][c] + face[j][c]);
        let length = sum.iter().map(|c| c * c).sum::<f64>().sqrt();
        sum.map(|c| c / length)
    };
    let [ab, bc, ca] = [middle(0, 1), middle(1, 2), middle(2, 0)];
    [vec![face[0], ab, ca], vec![ab, face[1], bc], vec![ca, bc, face[2]], vec![ab, bc, ca]]
}

#[test]
fn no_ray_aimed_at_an_edge_or_a_corner_of_a_closed_mesh_passes_it() {
    let mesh = ball(4);
    let body = Body::of_mesh(&mesh).unwrap();
    let origin = DVec3::new(7.3, -4.1, 2.9);
    for facet in &body.facets {
        let [a, b, c] = facet.corners_m;
        for aim in [a, 0.5 * (a + b), 0.3 * b + 0.7 * c, 0.99 * c + 0.01 * a] {
            let direction = (aim - origin).try_normalize().unwrap();
            // Points on the outline may be missed by rounding: only those well inside it are required.
            if aim.cross(direction).length() < 0.99 {
                let hit = body.nearest(origin, direction, None);
                let met = hit.is_some_and(|h| h.distance_m < aim.distance(origin) + 1e-9);
                assert!(met, "{aim}: {hit:?}");
            }
        }
    }
}

#[test]
fn a_ball_meets_a_grid_of_rays_over_its_cross_section() {
    // First-order S in the limit of zero frequency: long waves leave ∬dA cosine = the silhouette, half of the
    // ball is lit.
    let mesh = ball(5);
    let low_hz = 1.0;
    let aspect = far(33.0, 21.0);
    let sampling = po::Sampling {
        per_wavelength: 3e9,
        shadow_levels: 6,
        sides: Sides::Two,
        bracket: Bracket::Symmetrised,
    };
    let po = po::amplitude(&mesh, &aspect, &[low_hz], &sampling).unwrap()[0][0][0];
    let scale = (4.0 * PI).sqrt() * low_hz / SPEED_OF_LIGHT_MPS;
    let shooting = sbr::RaySettings {
        per_wavelength: 3e10,
        bounces: 1,
        sides: Sides::Two,
        bracket: Bracket::Symmetrised,
    };
    let sbr = sbr::amplitude(&mesh, &aspect, &[low_hz], &shooting).unwrap().orders[0][0][0][0];
    // Chords of 2⁻⁵·π/2 leave a polygon whose area is too small by ⅔·sagitta ≈ 1e-3; the grid's border adds
    // 2e-4.
    for (name, silhouette) in [("po", po.norm() / scale), ("sbr", sbr.norm() / scale)] {
        assert!((silhouette / PI - 1.0).abs() < 1.5e-3, "{name}: {}", silhouette / PI);
    }
    assert!((po - sbr).norm() < 5e-4 * po.norm(), "{po} {sbr}");
}

#[test]
fn bad_input_is_refused_with_its_place() {
    let mut mesh = square(0.1);
    mesh.triangles[1][2] = 7;
    let sampling =
        po::Sampling { per_wavelength: 1.0, shadow_levels: 0, sides: Sides::Two, bracket: Bracket::Plain };
    let run = |mesh: &Mesh, hz: f64| po::amplitude(mesh, &far(0.0, 0.0), &[hz], &sampling);
    let expected = ReferenceError::IndexOutOfRange { triangle: 1, vertex: 7, vertices: 4 };
    assert_eq!(run(&mesh, 77e9), Err(expected));
    assert!(matches!(run(&square(0.1), -1.0), Err(ReferenceError::NotPositive { .. })));
    mesh.vertices_m[2][1] = f64::NAN;
    assert_eq!(run(&mesh, 77e9), Err(ReferenceError::NotFinite { vertex: 2 }));
    let inside = Aspect::monostatic(standpoint(0.0, 0.0, 0.05));
    let shooting =
        sbr::RaySettings { per_wavelength: 1.0, bounces: 1, sides: Sides::Two, bracket: Bracket::Plain };
    let refused = sbr::amplitude(&square(0.1), &inside, &[77e9], &shooting);
    assert!(matches!(refused, Err(ReferenceError::AntennaInside { .. })));
    assert_eq!(run(&Mesh::default(), 77e9), Ok(vec![Amplitude::default()]));
}

/// Two squares of `side` wavelengths at right angles on a common edge along z, opening towards +x.
fn corner(side: f64) -> Mesh {
    let (a, h) = (side * WAVELENGTH_M * 0.5_f64.sqrt(), 0.5 * side * WAVELENGTH_M);
    let leaf = |sign: f64| vec![[0.0, 0.0, -h], [a, sign * a, -h], [a, sign * a, h], [0.0, 0.0, h]];
    mesh_of(&[leaf(1.0), leaf(-1.0)])
}

#[test]
fn iterated_currents_converge_with_their_density() {
    let mesh = corner(2.0);
    let aspect = far(10.0, 15.0);
    let of = |density: f64| iterative_po::double_bounce(&mesh, &aspect, FREQUENCY_HZ, density).unwrap();
    let finest = of(16.0);
    let error = |density: f64| (of(density)[0][0] - finest[0][0]).norm() / finest[0][0].norm();
    let errors = [4.0, 8.0].map(error);
    println!("against 16 samples a wavelength: {errors:.4?}");
    assert!(errors[0] < 0.05 && errors[1] < 0.01);
}

#[test]
fn iterated_currents_of_a_corner_on_its_specular_come_to_the_closed_form() {
    // σ = 8πa⁴/λ²·cos²: S_hh = +j√(4π)·√2·a²/λ (docs/physics.md §2), without edges of the mirror.
    let error = |side: f64| {
        let got = iterative_po::double_bounce(&corner(side), &far(0.0, 0.0), FREQUENCY_HZ, 4.0).unwrap();
        let side_m = side * WAVELENGTH_M;
        let asked = (4.0 * PI).sqrt() * 2.0_f64.sqrt() * side_m * side_m / WAVELENGTH_M;
        (got[1][1] - Complex64::new(0.0, asked)).norm() / asked
    };
    let errors = [1.5, 3.0, 6.0].map(error);
    println!("corners of 1.5, 3, 6 wavelengths: {errors:.3?}");
    // Edge waves are about 1/√(side in wavelengths) of it.
    assert!(errors[2] < errors[1] && errors[1] < errors[0] && errors[2] < 0.2);
}
