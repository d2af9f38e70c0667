//! Edges of bodies, through the crate's front door: against exact strips, by reciprocity and under shadows.
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

mod bands;
mod left_out;
mod near_by;
mod seams;
mod surfaces;

use artifact::Accuracy;
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use artifact::settings::{Edges, NodeRule};
use bart_rcs::{RcsRequest, RcsResult, Standpoint, rcs};
use num_complex::Complex64;

const FREQUENCY_HZ: f64 = 77e9;
const WAVELENGTH_M: f64 = 299_792_458.0 / FREQUENCY_HZ;

fn quads(corners: &[[[f64; 3]; 4]]) -> Mesh {
    let vertices_m = corners.iter().flatten().copied().collect();
    let triangles = (0..corners.len() as u32)
        .flat_map(|i| [[4 * i, 4 * i + 1, 4 * i + 2], [4 * i, 4 * i + 2, 4 * i + 3]]);
    Mesh { vertices_m, triangles: triangles.collect(), ..Mesh::default() }
}

/// A strip in the plane x = 0: `width_m` along y about `middle_y_m`, `height_m` along z.
fn strip(width_m: f64, height_m: f64, middle_y_m: f64) -> Mesh {
    let (w, h) = (0.5 * width_m, 0.5 * height_m);
    let corner = |y: f64, z: f64| [0.0, middle_y_m + y, z];
    quads(&[[corner(-w, -h), corner(w, -h), corner(w, h), corner(-w, h)]])
}

fn standpoint(az_deg: f64, el_deg: f64, range_m: f64) -> Standpoint {
    Standpoint { azimuth_rad: az_deg.to_radians(), elevation_rad: el_deg.to_radians(), range_m }
}

fn amplitude(
    mesh: &Mesh,
    sent: Standpoint,
    received: Option<Standpoint>,
    pol: Polarization,
    edges: Edges,
) -> Complex64 {
    run(mesh, sent, received, pol, edges).amplitude_m[0]
}

fn run(
    mesh: &Mesh,
    sent: Standpoint,
    received: Option<Standpoint>,
    pol: Polarization,
    edges: Edges,
) -> RcsResult {
    rcs(mesh, &RcsRequest { receiver: received, edges, ..request(sent, pol) }, &|_, _| {}).unwrap()
}

fn request(sent: Standpoint, pol: Polarization) -> RcsRequest {
    RcsRequest {
        range_m: sent.range_m,
        polarization: pol,
        bounces: 1,
        nodes: NodeRule::Middle,
        edges: Edges::FirstOrder,
        accuracy: Accuracy::from_db(-80.0),
        ..RcsRequest::over(vec![FREQUENCY_HZ], vec![sent.elevation_rad], vec![sent.azimuth_rad])
    }
}

const FAR: f64 = f64::INFINITY;

/// Waves over a face fade in with their strength, place by place: when a whole run had the share of its
/// middle, S hung on where rounding cut the runs of near antennas.
#[test]
fn a_plate_and_a_near_antenna_that_turn_together_keep_their_amplitude() {
    let corners =
        [[0.00212, 0.001916, -0.079142], [-0.145639, 0.129967, -0.124252], [0.103478, -0.039636, 0.135307]];
    for range_m in [1.0, 3.0, 10.0] {
        let turned = |turn_deg: f64| {
            let (sin, cos) = turn_deg.to_radians().sin_cos();
            let vertices_m = corners.map(|[x, y, z]| [cos * x - sin * y, sin * x + cos * y, z]).to_vec();
            let mesh = Mesh { vertices_m, triangles: vec![[0, 1, 2]], ..Mesh::default() };
            let seen = standpoint(116.0 + turn_deg, 26.0, range_m);
            let request = RcsRequest { frequency_hz: vec![14e9], ..request(seen, Polarization::Hh) };
            let found = rcs(&mesh, &request, &|_, _| {}).unwrap();
            (found.amplitude_m[0], found.error.total().unwrap())
        };
        let (first, told) = turned(0.0);
        let differs = |turn_deg: f64| (turned(turn_deg).0 - first).norm() / first.norm();
        let most = [7.0, 33.0, 90.0, 123.0, 200.0, 301.0].map(differs).into_iter().fold(0.0, f64::max);
        println!("{range_m} m: told {told:.1e}, turned differs by {most:.1e}");
        assert!(most < told, "{range_m} m: {most:e} for {told:e}");
    }
}

/// Edges are no mirrors: what they add is the same by any node of the facets. Trees that the middle rule
/// needs are shorter, and left out what comes to an edge over two mirrors of three bounces (5 % of this
/// corner).
#[test]
fn edges_of_a_corner_are_the_same_by_any_node_rule() {
    let vertices_m = vec![[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]];
    let corner = Mesh { vertices_m, triangles: vec![[0, 1, 2], [0, 2, 3], [0, 3, 1]], ..Mesh::default() };
    for bounces in [2, 3, 4] {
        let of = |nodes: NodeRule, edges: Edges| {
            let plain = request(standpoint(38.0, 27.0, FAR), Polarization::Vv);
            let request = RcsRequest { frequency_hz: vec![24e9], bounces, nodes, edges, ..plain };
            rcs(&corner, &request, &|_, _| {}).unwrap().amplitude_m[0]
        };
        let added = |nodes: NodeRule| of(nodes, Edges::FirstOrder) - of(nodes, Edges::Ignored);
        let whole = of(NodeRule::Exit, Edges::FirstOrder);
        let error = (added(NodeRule::Middle) - added(NodeRule::Exit)).norm() / whole.norm();
        println!("{bounces} bounces: {error:.1e}");
        assert!(error < 1e-12, "{bounces} bounces: {error:e}");
    }
}

#[test]
fn e2_a_strip_of_ten_wavelengths_has_its_exact_level_where_its_edges_stay_apart() {
    // 20·log₁₀|D| of the exact solution (moment method), angle from the plane; two strips of different height
    // share what their ends scatter, so their difference is that of a strip without ends: S = L/√π · D.
    let angles = [80.0, 70.0, 60.0, 50.0, 40.0, 30.0];
    let exact = [15.18, 4.38, 0.01, 1.05, 1.76, 0.92];
    let [short, long] = [40.0, 80.0].map(|h| strip(10.0 * WAVELENGTH_M, h * WAVELENGTH_M, 0.0));
    for (angle, known) in angles.into_iter().zip(exact) {
        let seen = standpoint(90.0 - angle, 0.0, FAR);
        let of = |mesh: &Mesh, edges| amplitude(mesh, seen, None, Polarization::Vv, edges);
        let level = |edges| {
            let d =
                (of(&long, edges) - of(&short, edges)) * std::f64::consts::PI.sqrt() / (40.0 * WAVELENGTH_M);
            20.0 * d.norm().log10()
        };
        let (with, without) = (level(Edges::FirstOrder), level(Edges::Ignored));
        println!("E2 {angle}°: exact {known}, with edges {with:.3}, physical optics {without:.3} dB");
        // The table is printed to 0.01 dB; first order is 0.00–0.04 dB off in the mean at E ∥
        // (docs/physics.md §4).
        assert!((with - known).abs() < 0.05, "{angle}: {with}");
    }
}

#[test]
fn exchanging_transmitter_and_receiver_transposes_the_amplitude() {
    let mesh = quads(&[
        [[0.0, 0.0, 0.0], [0.03, 0.0, 0.0], [0.03, 0.04, 0.01], [0.0, 0.04, 0.01]],
        [[0.0, 0.0, 0.0], [0.0, 0.04, 0.01], [0.0, 0.04, 0.04], [0.0, 0.0, 0.03]],
    ]);
    use Polarization::{Hh, Hv, Vh, Vv};
    for range_m in [FAR, 2.0] {
        let ends = [standpoint(-20.0, 50.0, range_m), standpoint(-55.0, 22.0, range_m)];
        for (pol, transposed) in [(Vv, Vv), (Hh, Hh), (Vh, Hv)] {
            let forth = amplitude(&mesh, ends[0], Some(ends[1]), pol, Edges::FirstOrder);
            let back = amplitude(&mesh, ends[1], Some(ends[0]), transposed, Edges::FirstOrder);
            let error = (forth - back).norm() / forth.norm();
            println!("{pol:?} at {range_m} m: {error:.1e}");
            // The same integrals are added, only their order differs.
            assert!(error < 1e-12, "{error:e}");
        }
    }
}

#[test]
fn a_screen_hides_edges_as_it_hides_facets() {
    let seen = standpoint(25.0, 0.0, FAR);
    let of = |mesh: &Mesh| amplitude(mesh, seen, None, Polarization::Hh, Edges::FirstOrder);
    let plate = strip(0.03, 0.03, 0.0);
    let behind = |screen: [[f64; 3]; 4]| {
        let corners = |m: &Mesh| [0, 1, 2, 3].map(|i| m.vertices_m[i]);
        quads(&[corners(&plate), screen])
    };
    let screen =
        |y: f64| [[0.1, y - 0.2, -0.2], [0.1, y + 0.2, -0.2], [0.1, y + 0.2, 0.2], [0.1, y - 0.2, 0.2]];
    // The screen's own level at 25° is told from a screen alone.
    let hidden = of(&behind(screen(0.05))) - of(&quads(&[screen(0.05)]));
    let free = of(&behind(screen(1.0))) - of(&quads(&[screen(1.0)]));
    println!(
        "plate alone {:.3e}, hidden {:.3e}, beside the screen {:.3e}",
        of(&plate).norm(),
        hidden.norm(),
        free.norm()
    );
    assert!(hidden.norm() < 1e-12);
    assert!((free - of(&plate)).norm() < 1e-9 * of(&plate).norm());
}

#[test]
fn a_distant_antenna_sees_the_edges_as_one_infinitely_far_away() {
    let mesh = strip(0.05, 0.03, 0.0);
    let of = |range_m| {
        amplitude(&mesh, standpoint(40.0, 15.0, range_m), None, Polarization::Vv, Edges::FirstOrder)
    };
    let error = (of(3e6) - of(FAR)).norm() / of(FAR).norm();
    // Curvature of the wavefront: k·D²/4R = 1614·0.0034/1.2e7 = 5e-7 of the main lobe, which is some 40 dB
    // higher.
    println!("at 3000 km: {error:.1e}");
    // Each is asked for at −80 dB of itself.
    assert!(error < 3e-4);
}

/// Waves over a plate leave it by other edges from some place of the first edge on; before an antenna near by
/// that place is not where parallel rays have it.
#[test]
fn near_by_a_turn_of_a_millionth_of_a_degree_changes_next_to_nothing() {
    // Width and height in wavelengths; azimuth, elevation, range.
    let looks = [
        (1.432, 2.689, -13.234, 46.143, 49.3, Polarization::Vv),
        (4.1, 2.2, 117.543, 52.233, 59.7, Polarization::Hh),
        (5.3, 6.1, 95.9, -31.94, 80.0, Polarization::Hh),
        (3.7, 2.9, 62.888, 8.468, 103.0, Polarization::Hh),
    ];
    for (width, height, az_deg, el_deg, range, pol) in looks {
        let mesh = strip(width * WAVELENGTH_M, height * WAVELENGTH_M, 0.0);
        let of = |turn_deg: f64| {
            let sent = standpoint(az_deg + turn_deg, el_deg, range * WAVELENGTH_M);
            amplitude(&mesh, sent, None, pol, Edges::FirstOrder)
        };
        let here = of(0.0);
        for turns in 1..=4 {
            let error = (of(1e-6 * f64::from(turns)) - here).norm() / here.norm();
            println!("{width} x {height}, turned by {turns}e-6: {error:.1e}");
            assert!(error < 1e-5, "{width} x {height}: {error:e}");
        }
    }
}

#[test]
fn an_edge_cut_into_pieces_scatters_as_one() {
    let whole = strip(0.03, 0.02, 0.0);
    let halves = {
        let (l, r) = (strip(0.01, 0.02, -0.01), strip(0.02, 0.02, 0.005));
        let corners = |m: &Mesh| [0, 1, 2, 3].map(|i| m.vertices_m[i]);
        quads(&[corners(&l), corners(&r)])
    };
    let doubled = {
        let corners = [0, 1, 2, 3].map(|i| whole.vertices_m[i]);
        quads(&[corners, [corners[3], corners[2], corners[1], corners[0]]])
    };
    for pol in [Polarization::Vv, Polarization::Hh, Polarization::Vh] {
        let of = |mesh: &Mesh| amplitude(mesh, standpoint(33.0, 21.0, FAR), None, pol, Edges::FirstOrder);
        let known = of(&whole);
        for (name, other) in [("cut", &halves), ("doubled", &doubled)] {
            let error = (of(other) - known).norm() / known.norm();
            println!("{pol:?}, {name}: {error:.1e}");
            // Both are asked for at −80 dB: currents that end on the plate are integrated in other pieces.
            assert!(error < 2e-4, "{name}: {error:e}");
        }
    }
}

/// A plate 35° off its normal: what the run says that its edges would add is what they add.
#[test]
fn a_run_without_edges_says_how_much_they_would_add() {
    let mesh = strip(0.02, 0.015, 0.0);
    let seen = standpoint(35.0, 12.0, FAR);
    let of = |edges| amplitude(&mesh, seen, None, Polarization::Hh, edges);
    let added = (of(Edges::FirstOrder) - of(Edges::Ignored)).norm() / of(Edges::Ignored).norm();
    let said = run(&mesh, seen, None, Polarization::Hh, Edges::Ignored).model_error.edges.unwrap();
    println!("edges add {added:.3}, said {said:.3}");
    // Told to 10 % of an edge seen square; these are as large as that.
    assert!((said / added - 1.0).abs() < 0.1);
    assert_eq!(run(&mesh, seen, None, Polarization::Hh, Edges::FirstOrder).model_error.edges, None);
}

/// Plates of many sizes seen from anywhere: integrals of few edges that are compared with ones ten times
/// finer may share all of their parts with these, and differ by nothing.
#[test]
fn few_edges_err_by_no_more_than_is_told() {
    for plate in 0..40 {
        // Low-discrepancy places: fractions of multiples of irrational numbers.
        let at = |root: f64| (f64::from(plate + 1) * root.sqrt()).fract();
        let [width_m, height_m] = [0.05 + 0.25 * at(2.0), 0.05 + 0.25 * at(3.0)];
        let seen = standpoint(360.0 * at(5.0), 140.0 * at(7.0) - 70.0, FAR);
        let of = |accuracy_db: f64| {
            let accuracy = Accuracy::from_db(accuracy_db);
            let request =
                RcsRequest { frequency_hz: vec![24e9], accuracy, ..request(seen, Polarization::Vv) };
            rcs(&strip(width_m, height_m, 0.0), &request, &|_, _| {}).unwrap()
        };
        let (asked, reference) = (of(-30.0), of(-80.0));
        let norm_m = reference.amplitude_m[0].norm();
        let error = (asked.amplitude_m[0] - reference.amplitude_m[0]).norm() / norm_m;
        let told = asked.error.total().unwrap();
        assert!(error <= told, "plate {plate}: {error:.1e}, {told:.1e} told");
    }
}

/// Triangles on a coarse grid: shared, doubled, folded and crossing ones, needles and T-junctions come by
/// themselves.
#[test]
fn random_soups_have_finite_edges() {
    const CASES: u32 = 60;
    let mut state = 12345_u64;
    let mut random = |below: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % below
    };
    let mut scatter = 0;
    for case in 0..CASES {
        let count = 1 + random(10);
        let vertices_m = (0..3 * count).map(|_| [0, 1, 2].map(|_| 0.01 * random(4) as f64)).collect();
        let triangles = (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = Mesh { vertices_m, triangles, ..Mesh::default() };
        let range_m = if case % 3 == 0 { 1.5 } else { FAR };
        let seen = standpoint(random(360) as f64, random(170) as f64 - 85.0, range_m);
        let [with, without] = [Edges::FirstOrder, Edges::Ignored]
            .map(|edges| amplitude(&mesh, seen, None, Polarization::Hh, edges));
        assert!(with.is_finite(), "case {case}: {with}");
        // Ten triangles have at most 30 sides of 5 cm; an edge without end scatters 1.2 of its length/√π at
        // most, and as much again where its face ends.
        assert!((with - without).norm() < 30.0 * 0.052 * 2.4 / 1.77, "case {case}: {with} {without}");
        scatter += u32::from(with != without);
    }
    println!("edges of {scatter} of {CASES} soups scatter");
    assert!(scatter > CASES * 8 / 10);
}

/// A square sheet of 5 λ seen from `az_deg`, 90° in its plane.
fn along_a_sheet(az_deg: f64, pol: Polarization) -> f64 {
    let sheet = strip(5.0 * WAVELENGTH_M, 5.0 * WAVELENGTH_M, 0.0);
    amplitude(&sheet, standpoint(az_deg, 0.0, f64::INFINITY), None, pol, Edges::FirstOrder).norm()
}

#[test]
fn a_sheet_seen_along_its_plane_vanishes_as_the_square_of_the_angle_where_e_is_square_to_it() {
    let db = |ratio: f64| 20.0 * ratio.log10();
    // An angle of 0.4 and of 1.6° from the plane: 16 times as much if by the square.
    let [near, far] = [89.6, 88.4].map(|az_deg| along_a_sheet(az_deg, Polarization::Hh));
    println!("0.4° {:.1} dBsm, 1.6° {:.1} dBsm", db(near), db(far));
    // Without the waves from edge to edge both are −40 dBsm.
    assert!((db(far / near) - db(16.0)).abs() < 3.0 && db(far) < -70.0);
}

#[test]
fn a_sheet_seen_exactly_along_its_plane_is_what_it_is_beside() {
    let beside = along_a_sheet(89.999, Polarization::Vv);
    for az_deg in [90.0, -90.0] {
        let at = along_a_sheet(az_deg, Polarization::Vv);
        println!("{az_deg}°: {at:.6} m, beside {beside:.6} m");
        assert!((at / beside - 1.0).abs() < 1e-3);
    }
    // In a table with other aspects, which are stronger by far.
    let sheet = strip(5.0 * WAVELENGTH_M, 5.0 * WAVELENGTH_M, 0.0);
    let azimuth_rad = [0.0, 89.999, 90.0].map(f64::to_radians).to_vec();
    let request = RcsRequest {
        azimuth_rad,
        accuracy: Accuracy::from_db(-20.0),
        ..request(standpoint(0.0, 0.0, FAR), Polarization::Vv)
    };
    let table = rcs(&sheet, &request, &|_, _| {}).unwrap().amplitude_m;
    assert!((table[2].norm() / table[1].norm() - 1.0).abs() < 1e-3, "{table:?}");
}

/// A wall that is seen edge-on has no polygon, and its far edges were silent there alone: S was 1 % off, and
/// cross-polarized from above by 4 dB.
#[test]
fn a_box_seen_along_its_walls_is_what_it_is_beside() {
    let [x, y, z] = [0.15, 0.125, 0.1];
    let at = |i: u32| {
        [if i & 1 == 0 { -x } else { x }, if i & 2 == 0 { -y } else { y }, if i & 4 == 0 { -z } else { z }]
    };
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mesh = quads(&faces.map(|face| face.map(at)));
    let looks = [
        (0.0, 20.0, Polarization::Hh),
        (90.0, 20.0, Polarization::Hh),
        (180.0, 0.0, Polarization::Vv),
        (40.0, 90.0, Polarization::Vh),
    ];
    for (az_deg, el_deg, pol) in looks {
        let of = |az_deg: f64, el_deg: f64| {
            let request =
                RcsRequest { frequency_hz: vec![21.3e9], ..request(standpoint(az_deg, el_deg, FAR), pol) };
            rcs(&mesh, &request, &|_, _| {}).unwrap().amplitude_m[0]
        };
        let beside = [-1e-7, 1e-7].map(|turn_deg| {
            if el_deg == 90.0 { of(az_deg, 90.0 - 1e-7) } else { of(az_deg + turn_deg, el_deg) }
        });
        let here = of(az_deg, el_deg);
        let error = beside.map(|s| (s - here).norm() / here.norm()).into_iter().fold(f64::INFINITY, f64::min);
        println!("az {az_deg}, el {el_deg}, {pol:?}: {:.4} m, beside it {error:.1e} less", here.norm());
        assert!(error < 0.02, "az {az_deg}, el {el_deg}, {pol:?}: {error}");
    }
}
