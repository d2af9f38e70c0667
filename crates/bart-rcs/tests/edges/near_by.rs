//! Skins and seams nearer to each other than a wave tells.

use artifact::radar::Polarization;
use artifact::scene::Mesh;
use artifact::settings::Edges;
use bart_rcs::{RcsRequest, Standpoint, rcs};
use glam::{DQuat, DVec3};
use num_complex::Complex64;

use crate::{FAR, quads, request, standpoint};

/// Sheets of 0.3 by 0.2 m in the planes x = −gap.
fn sheets(gaps_m: &[f64]) -> Mesh {
    let sheet =
        |gap_m: &f64| [[-0.15, -0.1], [0.15, -0.1], [0.15, 0.1], [-0.15, 0.1]].map(|[y, z]| [-gap_m, y, z]);
    quads(&gaps_m.iter().map(sheet).collect::<Vec<_>>())
}

fn of_sheets(gaps_m: &[f64], ends: [Standpoint; 2], polarization: Polarization) -> Complex64 {
    let receiver = Some(ends[1]).filter(|receiver| *receiver != ends[0]);
    let plain = request(ends[0], polarization);
    let request = RcsRequest { frequency_hz: vec![17.3e9], receiver, bounces: 2, ..plain };
    rcs(&sheets(gaps_m), &request, &|_, _| {}).unwrap().amplitude_m[0]
}

/// Each of two sheets had the fringe of its rim: 3.6 dB too much, from 1 µm to a millimetre.
#[test]
fn the_rim_of_a_double_skin_diffracts_once() {
    for az_deg in [5.0, 35.0, 65.0, 145.0, -35.0] {
        for pol in [Polarization::Vv, Polarization::Hh, Polarization::Vh] {
            let seen = [standpoint(az_deg, 17.0, FAR); 2];
            let one = of_sheets(&[0.0], seen, pol);
            // The second sheet shows a strip of gap·tan at its rim, and may be the one in front: 0.1 mm is a
            // phase of 0.07 there and back.
            for (gaps_m, asked) in [
                (&[0.0, 1e-6][..], 0.01),
                (&[1e-6, 0.0], 0.01),
                (&[0.0, 1e-6, 2e-6], 0.02),
                (&[0.0, 1e-4], 0.1),
            ] {
                let error = (of_sheets(gaps_m, seen, pol) - one).norm() / one.norm();
                println!("az {az_deg} {pol:?} {gaps_m:?}: asked {asked}, got {error:.1e}");
                assert!(error < asked);
            }
        }
    }
}

#[test]
fn a_double_skin_between_both_ends_is_reciprocal_and_near_a_single_one() {
    // From both sides, and both in front.
    for receiver in [standpoint(160.0, 10.0, FAR), standpoint(-30.0, 4.0, FAR)] {
        let ends = [standpoint(25.0, 17.0, FAR), receiver];
        let forth = of_sheets(&[0.0, 1e-6], ends, Polarization::Vv);
        let back = of_sheets(&[0.0, 1e-6], [ends[1], ends[0]], Polarization::Vv);
        let one = of_sheets(&[0.0], ends, Polarization::Vv);
        println!("there and back {:.1e}, of one {:.1e}", (forth - back).norm(), (forth - one).norm());
        assert!((forth - back).norm() < 1e-9 * one.norm() && (forth - one).norm() < 0.02 * one.norm());
    }
}

/// A panel of 0.1 by 0.08 m aslant, one half of it of two quads, which meet in the middle of the seam.
fn panel(rounded_to_m: Option<f64>) -> Mesh {
    let turn =
        DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 0.5).try_normalize().unwrap(), 33_f64.to_radians());
    let places = [
        [-0.05, -0.04],
        [0.0, -0.04],
        [0.0, 0.04],
        [-0.05, 0.04],
        [0.05, -0.04],
        [0.05, 0.04],
        [0.0, 0.0071],
        [0.05, 0.0071],
    ];
    let rounded = |x: f64| rounded_to_m.map_or(x, |step_m| (x / step_m).round() * step_m);
    let place = |[y, z]: [f64; 2]| (turn * DVec3::new(0.0, y, z)).to_array().map(rounded);
    let triangles = vec![[0, 1, 2], [0, 2, 3], [1, 4, 7], [1, 7, 6], [6, 7, 5], [6, 5, 2]];
    Mesh { vertices_m: places.map(place).to_vec(), triangles, ..Mesh::default() }
}

/// The seam of a file that is rounded to a micrometre had edges of its own: errors of −1 and −3 dB.
#[test]
fn a_seam_of_rounded_coordinates_is_no_edge() {
    for pol in [Polarization::Vv, Polarization::Hh] {
        let of = |mesh: &Mesh, edges: Edges, az_deg: f64| {
            let request = RcsRequest { edges, ..request(standpoint(az_deg, 15.0, FAR), pol) };
            rcs(mesh, &request, &|_, _| {}).unwrap().amplitude_m[0]
        };
        for az_deg in [20.0, 30.0, 40.0, 50.0] {
            let known = of(&panel(None), Edges::FirstOrder, az_deg);
            let error = |edges: Edges| {
                let [exact, rounded] =
                    [None, Some(1e-6)].map(|rounded_to_m| of(&panel(rounded_to_m), edges, az_deg));
                (rounded - exact).norm() / known.norm()
            };
            let [with, without] = [Edges::FirstOrder, Edges::Ignored].map(error);
            println!("az {az_deg} {pol:?}: rounding moves S by {with:.1e}, without edges by {without:.1e}");
            assert!(with < 0.02, "az {az_deg} {pol:?}: {with}");
        }
    }
}
