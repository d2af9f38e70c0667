//! The road as a mirror, against bistatic physical optics of another code, path by path.

#![allow(clippy::unwrap_used, reason = "a test ends where it meets what it did not expect")]

use artifact::Accuracy;
use artifact::material::{Material, Road};
use artifact::paths::{Amplitude, Path, PathsFrame};
use artifact::radar::Polarization;
use artifact::scene::{Mesh, SceneFrame, SceneHeader};
use artifact::settings::{Edges, NodeRule, Sides};
use artifact::units::SPEED_OF_LIGHT_MPS;
use bart_rcs::{BartError, FrameContext, PathView, Standpoint, Tracer, scattering_of_paths};
use glam::DVec3;
use num_complex::Complex64;
use po_sbr::{Aspect, Bracket, po};
use std::f64::consts::TAU;

mod bodies;

const RADAR_M: DVec3 = DVec3::new(0.0, 0.0, 6.0);
/// Slant range 25 m, height 0.5 m.
const PLATE_M: DVec3 = DVec3::new(0.0, 24.387_496, 0.5);
const ASPHALT: Complex64 = Complex64::new(9.5, -0.3);

/// A plate of 3 cm that leans towards the radar; its body's origin is its middle.
fn plate() -> Mesh {
    let corner = |across: f64, up: f64| [0.003 * up, 0.015 * across, 0.015 * up];
    Mesh {
        name: "plate".into(),
        vertices_m: vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

/// Two upright walls between two heights that open at 90° towards the radar, each `side_m`·√2 wide.
fn corner(side_m: f64, [low, high]: [f64; 2]) -> Mesh {
    let wall = |y: f64| [[-side_m, 0.0, low], [0.0, y, low], [0.0, y, high], [-side_m, 0.0, high]];
    Mesh {
        name: "corner".into(),
        vertices_m: [wall(side_m), wall(-side_m)].concat(),
        triangles: vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]],
        ..Mesh::default()
    }
}

fn scene(road: Option<Road>) -> (SceneHeader, SceneFrame) {
    let yaw = -std::f64::consts::FRAC_PI_2;
    let (mut header, frame) = bodies::scenes::scene(&plate(), &[(PLATE_M.to_array(), yaw, [0.0; 3])]);
    header.road = road;
    // Weak paths are dropped as far as the accuracy allows: 3e-2 of it.
    header.fidelity.accuracy = Accuracy::from_db(-60.0);
    (header, frame)
}

fn traced(road: Option<Road>) -> PathsFrame {
    let (header, frame) = scene(road);
    Tracer::new(&header).unwrap().paths(&header, &frame, &FrameContext::ALONE).unwrap()
}

fn smooth(material: Material) -> Option<Road> {
    Some(Road { material, rms_height_m: 0.0 })
}

fn centre_hz() -> f64 {
    scene(None).0.radar.waveform.centre_frequency_hz()
}

/// S with R the distance of radar and plate.
fn sum<'a>(paths: impl IntoIterator<Item = &'a Path>) -> Amplitude {
    let view = PathView {
        transmitter_m: RADAR_M,
        receiver_m: RADAR_M,
        origin_m: PLATE_M,
        seconds: 0.0,
        centre_frequency_hz: centre_hz(),
    };
    scattering_of_paths(paths, &view, centre_hz())
}

/// S from `from` to `to` by sampling, the phase that of |x − to| less that of the plate's distance from the
/// radar.
fn sampled(from: DVec3, to: DVec3) -> Amplitude {
    // In the plate's axes: forward is −y of the world.
    let place = |p: DVec3| {
        let (x, y, z) = (-(p.y - PLATE_M.y), p.x - PLATE_M.x, p.z - PLATE_M.z);
        let range_m = DVec3::new(x, y, z).length();
        Standpoint { azimuth_rad: y.atan2(x), elevation_rad: (z / range_m).asin(), range_m }
    };
    let aspect = Aspect { transmitter: place(from), receiver: place(to) };
    let sampling = po::Sampling {
        per_wavelength: 4.0,
        shadow_levels: 0,
        sides: Sides::Two,
        bracket: Bracket::Symmetrised,
    };
    let s = po::amplitude(&plate(), &aspect, &[centre_hz()], &sampling).unwrap()[0];
    let radar_m = RADAR_M.distance(PLATE_M);
    let wavenumber = TAU * centre_hz() / SPEED_OF_LIGHT_MPS;
    let factor = |p: DVec3| {
        Complex64::from_polar(radar_m / p.distance(PLATE_M), -wavenumber * (p.distance(PLATE_M) - radar_m))
    };
    s.map(|row| row.map(|x| x * factor(from) * factor(to)))
}

/// Coefficients r on E of h and r on H of v at the plate's middle.
fn fresnel() -> [Complex64; 2] {
    let way = PLATE_M - RADAR_M.with_z(-RADAR_M.z);
    let cos = way.z / way.length();
    let s = (ASPHALT - (1.0 - cos * cos)).sqrt();
    [(ASPHALT * cos - s) / (ASPHALT * cos + s), (cos - s) / (cos + s)]
}

#[test]
fn g2_a_way_by_the_road_is_0_239_m_longer() {
    let lengths: Vec<[f64; 2]> = traced(smooth(Material::Conductor))
        .paths
        .iter()
        .map(|path| [path.apparent_tx_m, path.apparent_rx_m].map(|x| DVec3::from_array(x).distance(RADAR_M)))
        .collect();
    let excess = |of: fn(&[f64; 2]) -> f64| lengths.iter().map(of).fold(0.0, f64::max) - 25.0;
    let (there, back) = (excess(|l| l[0]), excess(|l| l[1]));
    println!("G2: asked 0.239 m, got {there:.4} m there, {back:.4} m back");
    // Cells stand for parts of the plate: within 0.2 mm of its middle's length; printed to the millimetre.
    assert!((there - 0.239).abs() < 1e-3 && (back - 0.239).abs() < 1e-3);
    let ways = [(false, false), (false, true), (true, false), (true, true)];
    for (tx, rx) in ways {
        let is = |l: &&[f64; 2]| (l[0] > 25.1) == tx && (l[1] > 25.1) == rx;
        assert!(lengths.iter().any(|l| is(&l)), "road on the way there {tx}, back {rx}");
    }
}

#[test]
fn direct_vehicle_road_road_vehicle_and_both_add_up_as_bistatic_physical_optics_says() {
    let below = RADAR_M.with_z(-RADAR_M.z);
    let [direct, once, twice] = [sampled(RADAR_M, RADAR_M), sampled(RADAR_M, below), sampled(below, below)];
    for (material, [tm, te]) in [
        (Material::Conductor, [Complex64::ONE, -Complex64::ONE]),
        (Material::HalfSpace { permittivity: ASPHALT }, fresnel()),
    ] {
        let got = sum(&traced(smooth(material.clone())).paths);
        for (i, r) in [(0, tm), (1, te)] {
            let asked = direct[i][i] + 2.0 * r * once[i][i] + r * r * twice[i][i];
            let error = (got[i][i] - asked).norm() / asked.norm().max(direct[i][i].norm());
            println!("{material:?}, element {i}: asked {asked:.5}, got {:.5}, error {error:.1e}", got[i][i]);
            // r of v changes by 1.8 per radian near Brewster's angle, and the plate's rim is 0.6 mrad off its
            // middle: 2·1e-3 of the share by the road, which is 1.5 times the sum.
            assert!(error < 3.2e-3, "{material:?} {i}: {error:e}");
        }
    }
}

#[test]
fn the_two_ways_by_the_road_come_in_pairs_that_add() {
    let paths = traced(smooth(Material::HalfSpace { permittivity: ASPHALT })).paths;
    let by_road = |x: [f64; 3]| DVec3::from_array(x).distance(RADAR_M) > 25.1;
    let of = |tx: bool, rx: bool| {
        sum(paths.iter().filter(|p| by_road(p.apparent_tx_m) == tx && by_road(p.apparent_rx_m) == rx))
    };
    let (there, back) = (of(true, false), of(false, true));
    for i in [0, 1] {
        let error = (there[i][i] - back[i][i]).norm() / there[i][i].norm();
        println!("element {i}: |S| there {:.3e}, difference {error:.1e}", there[i][i].norm());
        assert!(error < 1e-9, "one is the other's reverse");
    }
    // 2|r| against the direct 1 (physics.md §5), as the plate scatters alike towards both.
    let pair = there[1][1] + back[1][1];
    println!(
        "h: pair over direct {:.3}, 2|r| {:.3}",
        pair.norm() / of(false, false)[1][1].norm(),
        2.0 * fresnel()[1].norm()
    );
}

/// Nothing below a road is seen; without one it is as free as any other body.
#[test]
fn a_body_below_the_road_is_refused_by_its_name() {
    for (z_m, road, is_refused) in [
        (-0.1, smooth(Material::Conductor), true),
        (-0.1, None, false),
        (0.0, smooth(Material::Conductor), false),
    ] {
        let (header, mut frame) = scene(road);
        frame.poses[0].position_m[2] = z_m;
        let found = Tracer::new(&header).unwrap().paths(&header, &frame, &FrameContext::ALONE);
        match found {
            Err(BartError::BodyBelowRoad { body, highest_m }) => {
                assert!(is_refused && body == "car-0" && (highest_m + 0.085).abs() < 1e-9, "{highest_m}");
            }
            Ok(_) => assert!(!is_refused, "{z_m} m"),
            Err(other) => panic!("{other}"),
        }
    }
}

#[test]
fn a_rough_road_reflects_less_by_ament_s_factor() {
    let road =
        |rms_height_m| Some(Road { material: Material::HalfSpace { permittivity: ASPHALT }, rms_height_m });
    let by_road = |x: [f64; 3]| DVec3::from_array(x).distance(RADAR_M) > 25.1;
    let level = |road| {
        let paths = traced(road).paths;
        sum(paths.iter().filter(|p| by_road(p.apparent_tx_m) && !by_road(p.apparent_rx_m)))[1][1].norm()
    };
    let way = PLATE_M - RADAR_M.with_z(-RADAR_M.z);
    let g = 2.0 * TAU * centre_hz() / SPEED_OF_LIGHT_MPS * 1e-3 * way.z / way.length();
    let (asked, got) = ((-0.5 * g * g).exp(), level(road(1e-3)) / level(road(0.0)));
    println!("1 mm: asked {:.3} dB, got {:.3} dB", 20.0 * asked.log10(), 20.0 * got.log10());
    // The grazing angle changes by 1e-3 over the plate.
    assert!((got / asked - 1.0).abs() < 2e-3);
    // physics.md §5: 1 mm costs 0.5 to 3.4 dB.
    assert!((-3.5..-0.5).contains(&(20.0 * got.log10())));
}

#[test]
fn without_a_road_its_cost_is_added_up_and_with_one_it_is_not() {
    let printed = traced(None).model_error.road.unwrap();
    let road = Road { material: Material::HalfSpace { permittivity: ASPHALT }, rms_height_m: 5e-4 };
    let (direct, all) = (sum(&traced(None).paths)[0][0], sum(&traced(Some(road.clone())).paths)[0][0]);
    let true_error = (all - direct).norm() / direct.norm();
    println!("road left out: printed {printed:.3}, true {true_error:.3}");
    assert_eq!(traced(Some(road)).model_error.road, None);
    // Above by the margin 1.85 of the measurement, 5.3 dB; a quarter of every integral may miss.
    assert!(printed > true_error && printed < 1.85 * 1.25 * true_error);
}

/// A corner of three bounces that opens towards the radar and upwards: two walls and a square floor.
fn trihedral(side_m: f64) -> Mesh {
    let mut mesh = corner(side_m, [0.3, 0.3 + side_m]);
    let floor = [[-side_m, 0.0], [0.0, -side_m], [side_m, 0.0], [0.0, side_m]];
    mesh.vertices_m.extend(floor.map(|[x, y]| [x, y, 0.3]));
    mesh.triangles.extend([[8, 9, 10], [8, 10, 11]]);
    mesh
}

#[test]
fn the_road_s_cost_beside_a_corner_of_three_bounces_is_that_of_all_its_orders() {
    let of = |road: Option<Road>| {
        let at = ([0.0, 25.0, 0.0], -std::f64::consts::FRAC_PI_2 + 0.1, [0.0; 3]);
        let (mut header, frame) = bodies::scenes::scene(&trihedral(0.3), &[at]);
        (header.road, header.fidelity.bounces) = (road, 3);
        header.fidelity.accuracy = Accuracy::from_db(-50.0);
        Tracer::new(&header).unwrap().paths(&header, &frame, &FrameContext::ALONE).unwrap()
    };
    let road = Road { material: Material::HalfSpace { permittivity: ASPHALT }, rms_height_m: 5e-4 };
    let alone = of(None);
    let (direct, all) = (sum(&alone.paths)[0][0], sum(&of(Some(road)).paths)[0][0]);
    let power = |order: u8| sum(alone.paths.iter().filter(|path| path.order == order))[0][0].norm_sqr();
    assert!(power(3) > 10.0 * (power(1) + power(2)), "a corner of three bounces");
    let (printed, true_error) = (alone.model_error.road.unwrap(), (all - direct).norm() / direct.norm());
    println!("road left out of a trihedral: printed {printed:.4}, true {true_error:.4}");
    assert!(printed > true_error && printed < 1.85 * 1.5 * true_error.max(0.02));
}

#[test]
fn edges_over_a_road_are_those_of_the_ways_that_do_not_meet_it() {
    // Walls off their specular, so that own edges take over from polygons.
    let mesh = corner(0.3, [0.2, 0.7]);
    let of = |nodes: NodeRule, polarization: Polarization, edges: Edges, road: Option<Road>| {
        let yaw = -std::f64::consts::FRAC_PI_2 + 0.1;
        let (mut header, frame) = bodies::scenes::scene(&mesh, &[([0.0, 25.0, 0.0], yaw, [0.0; 3])]);
        (header.fidelity.edges, header.fidelity.bounces) = (edges, 3);
        header.radar.array.polarization = polarization;
        (header.road, header.fidelity.nodes, header.fidelity.accuracy) =
            (road, nodes, Accuracy::from_db(-50.0));
        let traced = Tracer::new(&header).unwrap().paths(&header, &frame, &FrameContext::ALONE);
        let (p, q) = polarization.indices();
        sum(&traced.unwrap().paths)[p][q]
    };
    for (nodes, polarization) in [(NodeRule::Middle, Polarization::Hh), (NodeRule::OwnEdge, Polarization::Vv)]
    {
        let asphalt = || smooth(Material::HalfSpace { permittivity: ASPHALT });
        let [with, without] = [Edges::FirstOrder, Edges::Ignored]
            .map(|edges| [None, asphalt()].map(|road| of(nodes, polarization, edges, road)));
        let [alone, over] = [0, 1].map(|road| with[road] - without[road]);
        println!("{nodes:?}, {polarization:?}: edges alone {alone:.5}, over the road {over:.5}");
        // Each of four frames errs by its accuracy of its own level.
        let allowed = Accuracy::from_db(-50.0).amplitude()
            * (with.iter().chain(&without)).map(|s| s.norm()).sum::<f64>();
        assert!((alone - over).norm() < allowed, "{nodes:?}, {polarization:?}: {allowed}");
        assert!(alone.norm() > 5.0 * allowed, "edges are told from nothing");
    }
}

#[test]
fn corners_over_a_road_have_one_level_by_every_node_rule() {
    // The planes of walls of 10 cm are exact, so that any node serves.
    let mesh = corner(0.07, [0.4, 0.6]);
    let of = |nodes: NodeRule, road: Option<Road>| {
        let yaw = -std::f64::consts::FRAC_PI_2;
        let (mut header, frame) = bodies::scenes::scene(&mesh, &[([0.0, 25.0, 0.0], yaw, [0.0; 3])]);
        (header.road, header.fidelity.nodes, header.fidelity.accuracy) =
            (road, nodes, Accuracy::from_db(-40.0));
        let paths = Tracer::new(&header).unwrap().paths(&header, &frame, &FrameContext::ALONE).unwrap().paths;
        assert!(paths.iter().any(|path| path.order == 2));
        sum(&paths)[1][1]
    };
    let asphalt = || smooth(Material::HalfSpace { permittivity: ASPHALT });
    let (middle, own) = (of(NodeRule::Middle, asphalt()), of(NodeRule::OwnEdge, asphalt()));
    let direct = of(NodeRule::Middle, None);
    println!("middle {middle:.4}, own edges {own:.4}, without the road {direct:.4}");
    // Spherical waves leave −50 dB between nodes at 30 m (physics.md §2); the road's paths are a degree from
    // the fold's normal.
    assert!((middle - own).norm() < 0.05 * middle.norm() && (middle - direct).norm() > 0.1 * direct.norm());
}
