//! Decisions about edges: by the band of a frequency alone, and for fields of any polarization.

use crate::{FAR, quads, request, standpoint};
use artifact::Accuracy;
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use bart_rcs::{RcsRequest, rcs};
use glam::{DMat3, DVec3};
use num_complex::Complex64;

/// A closed box of these sides about the origin.
pub(crate) fn closed_box([x, y, z]: [f64; 3]) -> Mesh {
    let at = |i: usize| {
        let side = |bit: usize, side: f64| if i >> bit & 1 == 1 { 0.5 * side } else { -0.5 * side };
        [side(0, x), side(1, y), side(2, z)]
    };
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    quads(&faces.map(|face| face.map(at)))
}

/// A panel of 3 mm: waves of 10 GHz do not resolve its sides, those of 38 GHz do.
#[test]
fn a_frequency_of_a_wide_table_is_that_frequency_alone() {
    let panel = closed_box([3e-3, 0.15, 0.1]);
    let frequency_hz = vec![38e9, 10e9, 24e9, 10.2e9];
    let asked = RcsRequest {
        frequency_hz: frequency_hz.clone(),
        accuracy: Accuracy::from_db(-60.0),
        ..request(standpoint(33.0, 12.0, FAR), Polarization::Hh)
    };
    let together = rcs(&panel, &asked, &|_, _| {}).unwrap();
    assert_eq!(together.by_order_m[0], together.amplitude_m);
    for (i, hz) in frequency_hz.into_iter().enumerate() {
        let alone = RcsRequest { frequency_hz: vec![hz], ..asked.clone() };
        let alone = rcs(&panel, &alone, &|_, _| {}).unwrap().amplitude_m[0];
        let error = (together.amplitude_m[i] - alone).norm() / alone.norm();
        println!("{:.1} GHz: {error:.1e}", 1e-9 * hz);
        assert!(error < 1e-3, "{hz}: {error:e}");
    }
}

/// S of a plate, receiver first, with the reported errors as parts of the largest element.
fn matrix(corners: [DVec3; 4]) -> ([[Complex64; 2]; 2], f64) {
    let of = |polarization: Polarization| {
        let asked = RcsRequest {
            frequency_hz: vec![20e9],
            accuracy: Accuracy::from_db(-60.0),
            ..request(standpoint(0.0, 0.0, FAR), polarization)
        };
        let found = rcs(&quads(&[corners.map(|x| x.to_array())]), &asked, &|_, _| {}).unwrap();
        (found.amplitude_m[0], found.error.total().unwrap() * found.amplitude_m[0].norm())
    };
    let [vv, vh, hh] = [Polarization::Vv, Polarization::Vh, Polarization::Hh].map(of);
    ([[vv.0, vh.0], [vh.0, hh.0]], vv.1 + vh.1 + hh.1)
}

/// Waves over a face are followed whatever the directions of v and h.
#[test]
fn a_plate_turned_about_the_sight_has_its_matrix_turned() {
    const WAVELENGTH_M: f64 = 299_792_458.0 / 20e9;
    let (y, z) = (0.5 * 6.15 * WAVELENGTH_M, 0.5 * 4.49 * WAVELENGTH_M);
    let lean = DMat3::from_rotation_y(78.19_f64.to_radians()) * DMat3::from_rotation_x(65_f64.to_radians());
    let plate = [[-y, -z], [y, -z], [y, z], [-y, z]].map(|[y, z]| lean * DVec3::new(0.0, y, z));
    let (first, first_error) = matrix(plate);
    for turn_deg in [31.0_f64, 64.0] {
        let turn = DMat3::from_rotation_x(turn_deg.to_radians());
        let (turned, error) = matrix(plate.map(|x| turn * x));
        // Components along v = z and h = y of the turned unit vectors.
        let (sin, cos) = turn_deg.to_radians().sin_cos();
        let unit = [[cos, -sin], [sin, cos]];
        let expected = |p: usize, q: usize| -> Complex64 {
            let terms = [(0, 0), (0, 1), (1, 0), (1, 1)];
            terms.iter().map(|&(a, b)| unit[a][p] * first[a][b] * unit[b][q]).sum()
        };
        let differences = [(0, 0), (0, 1), (1, 1)].map(|(p, q)| (turned[p][q] - expected(p, q)).norm());
        let most = differences.into_iter().fold(0.0, f64::max);
        println!("{turn_deg}: differs by {most:.1e} m, told {:.1e} m", first_error + error);
        assert!(most < first_error + error, "{turn_deg}: {most:e}");
    }
}
