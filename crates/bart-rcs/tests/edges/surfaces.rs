//! Edges whose waves meet materials on their way: behind panes, and over mirrors that absorb.

use crate::{FAR, quads, request, standpoint};
use artifact::Accuracy;
use artifact::material::{Backing, Layer, Material, MeshMaterials, Thickness, Transmission};
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use artifact::settings::Edges;
use bart_rcs::{RcsRequest, rcs};
use num_complex::Complex64;

const FREQUENCY_HZ: f64 = 24e9;

/// Rectangles of one material each.
fn mesh(parts: &[([[f64; 3]; 4], Material)], transmission: Transmission) -> Mesh {
    let corners: Vec<_> = parts.iter().map(|(corners, _)| *corners).collect();
    let materials: Vec<Material> = parts.iter().map(|(_, material)| material.clone()).collect();
    Mesh {
        materials: (0..parts.len()).map(|slot| format!("m{slot}")).collect(),
        material_of_triangle: (0..2 * parts.len() as u16).map(|triangle| triangle / 2).collect(),
        makeup: MeshMaterials { materials, transmission },
        ..quads(&corners)
    }
}

/// A pane that absorbs much.
fn pane() -> Material {
    let layers = vec![Layer { thickness_m: 3e-3, permittivity: Complex64::new(2.0, -1.0) }];
    Material::Layers { layers, backing: Backing::Air, thickness: Thickness::Exact }
}

/// S at an aspect, edges off and on.
fn off_and_on(mesh: &Mesh, at_deg: [f64; 2], bounces: u8, polarization: Polarization) -> [Complex64; 2] {
    [Edges::Ignored, Edges::FirstOrder].map(|edges| {
        let request = RcsRequest {
            frequency_hz: vec![FREQUENCY_HZ],
            edges,
            bounces,
            accuracy: Accuracy::from_db(-60.0),
            ..request(standpoint(at_deg[0], at_deg[1], FAR), polarization)
        };
        rcs(mesh, &request, &|_, _| {}).unwrap().amplitude_m[0]
    })
}

/// Rectangle through a point, from `low` to `high` along a horizontal unit vector and along z.
fn upright([x, y]: [f64; 2], [u, v]: [f64; 2], low: [f64; 2], high: [f64; 2]) -> [[f64; 3]; 4] {
    let at = |along: f64, z: f64| [x + along * u, y + along * v, z];
    [at(low[0], low[1]), at(high[0], low[1]), at(high[0], high[1]), at(low[0], high[1])]
}

/// A plate of 0.2 m, seen 25° from its normal through a pane square to the sight that covers what lies below
/// `top_m`.
#[test]
fn edges_behind_a_pane_have_its_transmission_there_and_back() {
    let (sin, cos) = 25_f64.to_radians().sin_cos();
    let plate = (upright([0.0; 2], [0.0, 1.0], [-0.1; 2], [0.1; 2]), Material::Conductor);
    let before = [0.4 * cos, 0.4 * sin];
    for (top_m, covered) in [(0.6, 1.0), (0.0, 0.5)] {
        let pane = (upright(before, [-sin, cos], [-0.6; 2], [0.6, top_m]), pane());
        for polarization in [Polarization::Vv, Polarization::Hh] {
            let of =
                |parts: &[_]| off_and_on(&mesh(parts, Transmission::Followed), [25.0, 0.0], 1, polarization);
            let of_plate = of(std::slice::from_ref(&plate));
            let of_pane = of(std::slice::from_ref(&pane));
            let of_both = of(&[plate.clone(), pane.clone()]);
            let there_and_back = (of_both[0] - of_pane[0]) / of_plate[0];
            let fringe = of_plate[1] - of_plate[0];
            let behind = (of_both[1] - of_pane[1]) - (of_both[0] - of_pane[0]);
            let error = (behind / fringe - there_and_back).norm();
            println!("{covered} covered, {polarization:?}: t² {there_and_back:.4}, off by {error:.1e}");
            // The pane has t² = −9 dB; the upper half of the plate scatters as much as the lower half.
            assert!(there_and_back.norm() < 1.0 - 0.5 * covered && error < 1e-3, "{error:e}");
        }
    }
}

/// An upright plate over a floor of a permittivity near one: what the floor mirrors to its edges is next to
/// nothing. A floor of infinite permittivity mirrors as metal does.
#[test]
fn edges_seen_in_a_mirror_have_its_reflection() {
    let floor = [[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [2.0, 2.0, 0.0], [-2.0, 2.0, 0.0]];
    let plate = upright([0.0; 2], [0.28, 0.96], [-0.1, 0.2], [0.1, 0.4]);
    let order_two = |floor_of: Material, polarization: Polarization| {
        let body = mesh(&[(floor, floor_of), (plate, Material::Conductor)], Transmission::Ignored);
        let [one, two] = [1, 2].map(|bounces| off_and_on(&body, [20.0, 30.0], bounces, polarization));
        (two[1] - one[1]) - (two[0] - one[0])
    };
    let half_space = |permittivity: Complex64| Material::HalfSpace { permittivity };
    for polarization in [Polarization::Vv, Polarization::Hh, Polarization::Vh] {
        let of = |floor_of: Material| order_two(floor_of, polarization);
        let [faint, dense] = [Complex64::from(1.001), Complex64::new(1.0, -1e14)].map(half_space).map(of);
        let metal = of(Material::Conductor);
        let error = (dense - metal).norm() / metal.norm();
        println!(
            "{polarization:?}: metal {metal:.5}, as dense off by {error:.1e}, faint {:.1e}",
            faint.norm()
        );
        assert!(error < 1e-5 && faint.norm() < 3e-3 * metal.norm(), "{polarization:?}");
    }
}
