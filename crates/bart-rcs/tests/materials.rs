//! Bodies that are no perfect conductors, against closed forms and laws.

#![allow(clippy::unwrap_used, reason = "a test ends where it meets what it did not expect")]

use artifact::Accuracy;
use artifact::material::{Backing, Layer, Material, MeshMaterials, Thickness, Transmission};
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use artifact::settings::NodeRule;
use artifact::units::SPEED_OF_LIGHT_MPS;
use bart_rcs::{RcsRequest, Standpoint, rcs};
use num_complex::Complex64;
use std::f64::consts::PI;

const FREQUENCY_HZ: f64 = 77e9;
const GLASS: Complex64 = Complex64::new(6.5, -0.15);
const POLARIZATIONS: [Polarization; 4] =
    [Polarization::Vv, Polarization::Vh, Polarization::Hv, Polarization::Hh];

fn half_space(permittivity: Complex64) -> Material {
    Material::HalfSpace { permittivity }
}

fn sheet(permittivity: Complex64, thickness_m: f64, thickness: Thickness) -> Material {
    Material::Layers { layers: vec![Layer { thickness_m, permittivity }], backing: Backing::Air, thickness }
}

/// Polygons, each with its own material.
fn mesh(polygons: &[(Vec<[f64; 3]>, Material)]) -> Mesh {
    let mut mesh = Mesh::default();
    for (slot, (polygon, material)) in (0..).zip(polygons) {
        let first = mesh.vertices_m.len() as u32;
        mesh.vertices_m.extend(polygon);
        let fan = 1..polygon.len() as u32 - 1;
        mesh.triangles.extend(fan.map(|i| [first, first + i, first + i + 1]));
        mesh.material_of_triangle.resize(mesh.triangles.len(), slot);
        mesh.materials.push(format!("m{slot}"));
        mesh.makeup.materials.push(material.clone());
    }
    mesh
}

fn in_metal(mesh: &Mesh) -> Mesh {
    Mesh { makeup: MeshMaterials::default(), ..mesh.clone() }
}

/// A rectangle across x at `x_m`, facing +x.
fn screen(x_m: f64, half_y_m: f64, half_z_m: f64) -> Vec<[f64; 3]> {
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
        .map(|[y, z]| [x_m, y * half_y_m, z * half_z_m])
        .to_vec()
}

/// Faces that meet in the z axis and open to +x, turned about x by `roll_deg`.
fn dihedral(opening_deg: f64, roll_deg: f64) -> [Vec<[f64; 3]>; 2] {
    const SIDE_M: f64 = 0.1;
    let (sin, cos) = (0.5 * opening_deg).to_radians().sin_cos();
    let (sin_roll, cos_roll) = roll_deg.to_radians().sin_cos();
    let rolled = |[x, y, z]: [f64; 3]| [x, y * cos_roll - z * sin_roll, y * sin_roll + z * cos_roll];
    [1.0, -1.0].map(|side| {
        let (x, y, half) = (SIDE_M * cos, SIDE_M * sin * side, 0.5 * SIDE_M);
        vec![[0.0, 0.0, -half], [x, y, -half], [x, y, half], [0.0, 0.0, half]]
            .into_iter()
            .map(rolled)
            .collect()
    })
}

fn request(azimuth_deg: f64, elevation_deg: f64) -> RcsRequest {
    RcsRequest {
        nodes: NodeRule::Middle,
        accuracy: Accuracy::from_db(-60.0),
        ..RcsRequest::over(
            vec![FREQUENCY_HZ],
            vec![elevation_deg.to_radians()],
            vec![azimuth_deg.to_radians()],
        )
    }
}

/// Amplitudes [vv, vh, hv, hh] of one order (from 1) at the first frequency.
fn matrix(mesh: &Mesh, request: &RcsRequest, order: usize) -> [Complex64; 4] {
    POLARIZATIONS.map(|polarization| {
        let asked = RcsRequest { polarization, ..request.clone() };
        rcs(mesh, &asked, &|_, _| {}).unwrap().by_order_m[order - 1][0]
    })
}

/// Coefficients r_TE and r_TM of a half-space, written down once more.
fn fresnel(permittivity: Complex64, angle_deg: f64) -> [Complex64; 2] {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    let s = (permittivity - sin * sin).sqrt();
    [(cos - s) / (cos + s), (permittivity * cos - s) / (permittivity * cos + s)]
}

#[test]
fn m1_a_plate_of_glass_seen_square_has_minus_r_times_the_conductors_amplitude() {
    let plate = mesh(&[(screen(0.0, 0.05, 0.05), half_space(GLASS))]);
    let [vv, vh, hv, hh] = matrix(&plate, &request(0.0, 0.0), 1);
    let area_over_wavelength_m = 0.01 * FREQUENCY_HZ / SPEED_OF_LIGHT_MPS;
    let [te, _] = fresnel(GLASS, 0.0);
    let asked = -te * Complex64::I * (4.0 * PI).sqrt() * area_over_wavelength_m;
    println!("M1 plate: asked {asked:.6}, got vv {vv:.6}, hh {hh:.6}");
    // Rounding of the closed form of polygons.
    assert!((vv - asked).norm() < 1e-9 * asked.norm() && (hh - asked).norm() < 1e-9 * asked.norm());
    assert!(vh.norm() < 1e-12 * asked.norm() && hv.norm() < 1e-12 * asked.norm());
}

#[test]
fn what_layers_err_by_over_a_band_is_no_more_than_a_table_tells() {
    let [a, b] = dihedral(90.0, 10.0);
    let pane = sheet(GLASS, 4e-3, Thickness::Exact);
    let body = mesh(&[(a, pane.clone()), (b, pane)]);
    let frequency_hz: Vec<f64> = (0..65).map(|i| 76e9 + 2e9 * f64::from(i) / 64.0).collect();
    let asked = RcsRequest { frequency_hz: frequency_hz.clone(), ..request(20.0, 10.0) };
    let band = rcs(&body, &asked, &|_, _| {}).unwrap();
    let of_one = |hz: &f64| {
        let alone = RcsRequest { frequency_hz: vec![*hz], ..asked.clone() };
        rcs(&body, &alone, &|_, _| {}).unwrap().amplitude_m[0]
    };
    let each: Vec<Complex64> = frequency_hz.iter().map(of_one).collect();
    let missed: f64 = band.amplitude_m.iter().zip(&each).map(|(got, asked)| (got - asked).norm_sqr()).sum();
    let error = (missed / each.iter().map(|s| s.norm_sqr()).sum::<f64>()).sqrt();
    let told = band.error.integration.unwrap();
    println!("told {told:.1e}, missed {error:.1e}");
    assert!(error > 1e-11 && error < told && told < 0.03 * asked.accuracy.amplitude());
    let in_metal = rcs(&in_metal(&body), &asked, &|_, _| {}).unwrap();
    assert_eq!(in_metal.error.integration, Some(1e-12), "conductors know no frequency");
}

#[test]
fn an_infinite_permittivity_is_a_conductor_at_every_order_and_element() {
    let [a, b] = dihedral(88.0, 20.0);
    let dense = half_space(Complex64::new(1.0, -1e14));
    let body = mesh(&[(a, dense.clone()), (b, dense)]);
    for order in 1..=3 {
        let aspect = request(7.0, 4.0);
        let (got, asked) = (matrix(&body, &aspect, order), matrix(&in_metal(&body), &aspect, order));
        let scale = asked.iter().map(|s| s.norm()).fold(0.0, f64::max);
        let error = got.iter().zip(asked).map(|(g, a)| (g - a).norm()).fold(0.0, f64::max) / scale;
        println!("order {order}: {error:.1e}");
        // Each reflection is off by 2/√|ε| = 2e-7, at grazing faces more by 1/cosθ.
        assert!(scale > 1e-6 && error < 1e-5, "order {order}: {error:e}");
    }
}

#[test]
fn a_dihedral_of_glass_reflects_twice_at_45_degrees_te_in_vv_and_tm_in_hh() {
    let [a, b] = dihedral(90.0, 0.0);
    let rubber = Complex64::new(4.0, -0.4);
    let body = mesh(&[(a, half_space(GLASS)), (b, half_space(rubber))]);
    let aspect = request(0.0, 0.0);
    let (got, metal) = (matrix(&body, &aspect, 2), matrix(&in_metal(&body), &aspect, 2));
    let product = |i: usize| fresnel(GLASS, 45.0)[i] * fresnel(rubber, 45.0)[i];
    for (i, element) in [(0, 0), (1, 3)] {
        let asked = metal[element] * product(i);
        println!("element {element}: asked {asked:.6}, got {:.6}", got[element]);
        assert!((got[element] - asked).norm() < 1e-9 * metal[element].norm());
    }
}

/// S of a corner turned about the line of sight by α is R S Rᵀ: what one polarization loses the other gets.
#[test]
fn a_rolled_dihedral_of_glass_mixes_polarizations_as_the_rotation_of_its_axes_does() {
    let of = |roll_deg: f64| {
        let [a, b] = dihedral(90.0, roll_deg);
        matrix(&mesh(&[(a, half_space(GLASS)), (b, half_space(GLASS))]), &request(0.0, 0.0), 2)
    };
    let [te, _, _, tm] = of(0.0);
    for roll_deg in [22.5, 45.0, 70.0_f64] {
        let (sin, cos) = roll_deg.to_radians().sin_cos();
        let asked = [
            te * cos * cos + tm * sin * sin,
            (tm - te) * sin * cos,
            (tm - te) * sin * cos,
            te * sin * sin + tm * cos * cos,
        ];
        let got = of(roll_deg);
        let error =
            got.iter().zip(asked).map(|(g, a)| (g.norm() - a.norm()).abs()).fold(0.0, f64::max) / te.norm();
        println!("roll {roll_deg}: {error:.1e}");
        assert!(error < 1e-9, "{roll_deg}: {got:?} {asked:?}");
        assert!((got[1] - got[2]).norm() < 1e-12 * te.norm());
        assert!((got[0] + got[3] - te - tm).norm() < 1e-9 * te.norm(), "the trace stays");
    }
}

#[test]
fn a_pane_reflects_as_its_thickness_says_and_averaged_as_the_mean_power() {
    let wavenumber_per_m = 2.0 * PI * FREQUENCY_HZ / SPEED_OF_LIGHT_MPS;
    let level =
        |material: Material| matrix(&mesh(&[(screen(0.0, 0.05, 0.05), material)]), &request(0.0, 0.0), 1)[0];
    let metal = level(Material::Conductor);
    let r = fresnel(GLASS, 0.0)[0];
    let mut powers = Vec::new();
    let period_m = PI / (wavenumber_per_m * GLASS.re.sqrt());
    for i in 0..16 {
        let thickness_m = 5e-3 + period_m * f64::from(i) / 16.0;
        let p = (Complex64::new(0.0, -2.0 * wavenumber_per_m * thickness_m) * GLASS.sqrt()).exp();
        let asked = -metal * r * (1.0 - p) / (1.0 - r * r * p);
        let got = level(sheet(GLASS, thickness_m, Thickness::Exact));
        assert!((got - asked).norm() < 1e-9 * metal.norm());
        powers.push(got.norm_sqr());
    }
    let mean = powers.iter().sum::<f64>() / 16.0;
    let averaged = level(sheet(GLASS, 5e-3 + 0.5 * period_m, Thickness::Averaged)).norm_sqr();
    println!(
        "mean power over a period {:.3} dB, averaged {:.3} dB",
        10.0 * mean.log10(),
        10.0 * averaged.log10()
    );
    // Absorption changes by 4 % over the period about its middle, and with the square of that in the mean.
    assert!((averaged / mean - 1.0).abs() < 2e-3);
}

/// Three plates of glass, coated metal and bare metal that see one another.
fn mixed_corner() -> Mesh {
    let [a, b] = dihedral(95.0, 15.0);
    let floor = vec![[0.0, -0.07, -0.05], [0.1, -0.07, -0.06], [0.1, 0.07, -0.05], [0.0, 0.07, -0.05]];
    let coat = Material::Layers {
        layers: vec![Layer { thickness_m: 1.1e-3, permittivity: Complex64::new(3.0, -0.1) }],
        backing: Backing::Metal,
        thickness: Thickness::Exact,
    };
    mesh(&[(a, sheet(GLASS, 4.7e-3, Thickness::Exact)), (b, coat), (floor, Material::Conductor)])
}

/// The largest element of S of one order between two directions, and what it differs from that of the way
/// back, transposed.
fn scale_and_reciprocity_db(body: &Mesh, bounces: u8, order: usize) -> (f64, f64) {
    // Far away, where integrals are closed: near by, polygons begin at other corners from the other end and
    // are cut another way.
    let place = |azimuth_deg: f64, elevation_deg: f64| Standpoint {
        azimuth_rad: azimuth_deg.to_radians(),
        elevation_rad: elevation_deg.to_radians(),
        range_m: f64::INFINITY,
    };
    let (here, there) = (place(10.0, 20.0), place(-15.0, 12.0));
    let of = |from: Standpoint, to: Standpoint| {
        let asked = RcsRequest {
            azimuth_rad: vec![from.azimuth_rad],
            elevation_rad: vec![from.elevation_rad],
            receiver: Some(to),
            bounces,
            ..request(0.0, 0.0)
        };
        matrix(body, &asked, order)
    };
    let (forth, back) = (of(here, there), of(there, here));
    let scale = forth.iter().map(|s| s.norm()).fold(0.0, f64::max);
    let differences = [(0, 0), (1, 2), (2, 1), (3, 3)].map(|(i, j)| (forth[i] - back[j]).norm());
    (scale, 20.0 * (differences.into_iter().fold(0.0, f64::max) / scale).log10())
}

#[test]
fn swapping_transmitter_and_receiver_transposes_s_with_materials_at_every_order() {
    let body = mixed_corner();
    for order in 1..=4 {
        let (scale, error_db) = scale_and_reciprocity_db(&body, 4, order);
        println!("reciprocity of order {order}: asked −100 dB, got {error_db:.0} dB");
        assert!(scale > 1e-7 && error_db < -100.0, "order {order}: {error_db}");
    }
}

#[test]
fn seen_from_one_place_cross_polarizations_are_equal_with_materials() {
    let body = mixed_corner();
    for order in 1..=3 {
        let [vv, vh, hv, hh] = matrix(&body, &RcsRequest { range_m: 6.0, ..request(5.0, 18.0) }, order);
        let scale = vv.norm().max(hh.norm());
        let error_db = 20.0 * ((vh - hv).norm() / scale).log10();
        println!("S_vh − S_hv of order {order}: asked −100 dB, got {error_db:.0} dB");
        assert!(scale > 1e-7 && error_db < -100.0, "order {order}: {error_db}");
    }
}

#[test]
fn many_frequencies_at_once_are_each_frequency_alone() {
    let body = mixed_corner();
    let frequency_hz: Vec<f64> = (0..64).map(|i| 77e9 + 5e8 * f64::from(i) / 63.0).collect();
    let asked = RcsRequest {
        frequency_hz: frequency_hz.clone(),
        // The size of dropped slivers goes with the shortest wavelength asked for.
        accuracy: Accuracy::from_db(-160.0),
        ..request(5.0, 18.0)
    };
    let together = rcs(&body, &asked, &|_, _| {}).unwrap().amplitude_m;
    for i in [0, 20, 41, 63] {
        let alone = RcsRequest { frequency_hz: vec![frequency_hz[i]], ..asked.clone() };
        let alone = rcs(&body, &alone, &|_, _| {}).unwrap().amplitude_m[0];
        let error = (together[i] - alone).norm() / alone.norm();
        println!("{:.2} GHz: {error:.1e}", 1e-9 * frequency_hz[i]);
        // The polynomial over the band is carried to 1e-9 of weights that cancel to a tenth here.
        assert!(error < 1e-8, "{error:e}");
    }
}

/// A coat of high permittivity on metal resonates: nearly all of a wave that is inside stays there, and S
/// over frequency has peaks that two echoes do not tell of. Asked −60 dB, these erred by −34 and −29 dB.
#[test]
fn many_frequencies_of_a_resonant_coat_are_each_frequency_alone() {
    for (permittivity, thickness_m) in [(24.0, 1.87e-3), (80.0, 1.6e-3)] {
        let layers = vec![Layer { thickness_m, permittivity: Complex64::from(permittivity) }];
        let coat = Material::Layers { layers, backing: Backing::Metal, thickness: Thickness::Exact };
        let body = mesh(&[(screen(0.0, 0.03, 0.03), coat)]);
        let frequency_hz: Vec<f64> = (0..256).map(|i| 72e9 + 1e10 * f64::from(i) / 255.0).collect();
        let asked = RcsRequest { frequency_hz: frequency_hz.clone(), bounces: 1, ..request(0.0, 0.0) };
        let together = rcs(&body, &asked, &|_, _| {}).unwrap().amplitude_m;
        let alone = |frequency_hz: &f64| {
            let asked = RcsRequest { frequency_hz: vec![*frequency_hz], ..asked.clone() };
            rcs(&body, &asked, &|_, _| {}).unwrap().amplitude_m[0]
        };
        let alone: Vec<Complex64> = frequency_hz.iter().map(alone).collect();
        let power = |values: &mut dyn Iterator<Item = Complex64>| values.map(|s| s.norm_sqr()).sum::<f64>();
        let error = power(&mut together.iter().zip(&alone).map(|(a, b)| a - b));
        let error_db = 10.0 * (error / power(&mut alone.iter().copied())).log10();
        println!("ε = {permittivity}: asked −60 dB, got {error_db:.0} dB");
        assert!(error_db < -60.0, "{permittivity}: {error_db}");
    }
}

#[test]
fn a_skin_that_names_only_conductors_changes_no_bit() {
    let mut body = mixed_corner();
    body.makeup =
        MeshMaterials { materials: vec![Material::Conductor; 3], transmission: Transmission::Ignored };
    let asked = RcsRequest { range_m: 6.0, ..request(5.0, 18.0) };
    let [named, bare] =
        [body.clone(), in_metal(&body)].map(|b| rcs(&b, &asked, &|_, _| {}).unwrap().amplitude_m);
    assert_eq!(named, bare);
}

fn through_sheets(mesh: Mesh) -> Mesh {
    Mesh { makeup: MeshMaterials { transmission: Transmission::Followed, ..mesh.makeup.clone() }, ..mesh }
}

/// Coefficients r and t·e^{jkd} of a sheet at 0°, written down once more.
fn slab(permittivity: Complex64, thickness_m: f64) -> [Complex64; 2] {
    let k = 2.0 * PI * FREQUENCY_HZ / SPEED_OF_LIGHT_MPS;
    let r = fresnel(permittivity, 0.0)[0];
    let way = (Complex64::new(0.0, -k * thickness_m) * permittivity.sqrt()).exp();
    let echoes = 1.0 - r * r * way * way;
    [r * (1.0 - way * way) / echoes, (1.0 - r * r) * way / echoes * Complex64::cis(k * thickness_m)]
}

#[test]
fn metal_behind_a_bumper_is_seen_through_it_twice_weakened() {
    const PLASTIC: Complex64 = Complex64::new(2.3, -0.01);
    let k = 2.0 * PI * FREQUENCY_HZ / SPEED_OF_LIGHT_MPS;
    let bumper = || sheet(PLASTIC, 3e-3, Thickness::Exact);
    let [r, t] = slab(PLASTIC, 3e-3);
    let metal = matrix(&mesh(&[(screen(0.0, 0.02, 0.02), Material::Conductor)]), &request(0.0, 0.0), 1)[0];
    // A bumper four times the plate; half of one; two in line.
    let left = |x_m: f64| vec![[x_m, -0.04, -0.04], [x_m, 0.0, -0.04], [x_m, 0.0, 0.04], [x_m, -0.04, 0.04]];
    let ahead = |x_m: f64, share: f64| share * -r * Complex64::cis(2.0 * k * x_m);
    let cases = [
        ("whole", vec![screen(0.05, 0.04, 0.04)], ahead(0.05, 4.0) + t * t),
        ("half", vec![left(0.05)], ahead(0.05, 2.0) + 0.5 * (1.0 + t * t)),
        (
            "two",
            vec![screen(0.05, 0.04, 0.04), screen(0.09, 0.04, 0.04)],
            ahead(0.09, 4.0) + t * t * ahead(0.05, 4.0) + t.powi(4),
        ),
    ];
    for (name, bumpers, asked) in cases {
        let mut polygons = vec![(screen(0.0, 0.02, 0.02), Material::Conductor)];
        polygons.extend(bumpers.into_iter().map(|polygon| (polygon, bumper())));
        let body = mesh(&polygons);
        let got = matrix(&through_sheets(body.clone()), &request(0.0, 0.0), 1)[0] / metal;
        println!("{name}: asked {asked:.6}, got {got:.6}");
        // Phases of 2k·0.09 m, 290 rad, from lengths of 1e-17 m.
        assert!((got - asked).norm() < 1e-8, "{name}");
        let hidden = matrix(&body, &request(0.0, 0.0), 1)[0] / metal;
        assert!((hidden - got).norm() > 0.1, "{name}: a sheet that is not followed hides what is behind");
    }
}

/// A screen of four triangles around its centre, half as large as those of a screen of two.
fn in_quarters(screen: &[[f64; 3]]) -> Vec<Vec<[f64; 3]>> {
    (0..4).map(|i| vec![[screen[0][0], 0.0, 0.0], screen[i], screen[(i + 1) % 4]]).collect()
}

#[test]
fn of_materials_in_one_place_the_better_reflector_is_lit_in_any_order_and_cut() {
    // |r| is 0.28 of so thin a sheet and 0.34 of rubber.
    let plastic = || sheet(Complex64::new(2.3, -0.01), 0.3e-3, Thickness::Exact);
    let rubber = || half_space(Complex64::new(4.0, -0.4));
    let whole = || vec![screen(0.0, 0.02, 0.02)];
    let parts = || in_quarters(&screen(0.0, 0.02, 0.02));
    for (better, worse) in
        [(Material::Conductor, rubber()), (rubber(), plastic()), (Material::Conductor, plastic())]
    {
        let alone = matrix(&mesh(&[(screen(0.0, 0.02, 0.02), better.clone())]), &request(0.0, 0.0), 1)[0];
        for [below, above] in [[whole(), whole()], [parts(), whole()], [whole(), parts()]] {
            let of = |polygons: Vec<Vec<[f64; 3]>>, material: &Material| -> Vec<_> {
                polygons.into_iter().map(|polygon| (polygon, material.clone())).collect()
            };
            let (first, second) = (of(below, &better), of(above, &worse));
            for body in [[first.clone(), second.clone()].concat(), [second, first].concat()] {
                for body in [mesh(&body), through_sheets(mesh(&body))] {
                    let got = matrix(&body, &request(0.0, 0.0), 1)[0];
                    // Sums of other polygons: rounding of a thousand terms at most.
                    assert!(
                        (got - alone).norm() < 1e-12 * alone.norm(),
                        "{better:?} {worse:?}: {got} {alone}"
                    );
                }
            }
        }
    }
}

#[test]
fn swapping_transmitter_and_receiver_transposes_s_through_sheets_too() {
    let [a, b] = dihedral(95.0, 15.0);
    let pane = vec![[0.12, -0.02, -0.06], [0.13, 0.05, -0.06], [0.12, 0.05, 0.06], [0.11, -0.02, 0.06]];
    let body = through_sheets(mesh(&[
        (a, half_space(GLASS)),
        (b, Material::Conductor),
        (pane, sheet(GLASS, 4.7e-3, Thickness::Exact)),
    ]));
    for order in 1..=3 {
        let (scale, error_db) = scale_and_reciprocity_db(&body, 3, order);
        println!("reciprocity of order {order} through a pane: asked −100 dB, got {error_db:.0} dB");
        assert!(scale > 1e-7 && error_db < -100.0, "order {order}: {error_db}");
    }
}

#[test]
fn what_is_left_out_behind_sheets_is_measured() {
    let body = mesh(&[
        (screen(0.0, 0.02, 0.02), Material::Conductor),
        (screen(0.05, 0.04, 0.04), sheet(Complex64::new(2.3, -0.01), 3e-3, Thickness::Exact)),
    ]);
    let asked = RcsRequest { bounces: 1, ..request(0.0, 0.0) };
    let printed = rcs(&body, &asked, &|_, _| {}).unwrap().model_error.transmission.unwrap();
    let through = rcs(&through_sheets(body.clone()), &asked, &|_, _| {}).unwrap();
    let without = rcs(&body, &asked, &|_, _| {}).unwrap();
    let error = (through.amplitude_m[0] - without.amplitude_m[0]).norm() / through.amplitude_m[0].norm();
    println!("transmission left out: printed {printed:.4}, true {error:.4}");
    assert!((printed - error).abs() < 1e-12 && through.model_error.transmission.is_none());
    assert_eq!(rcs(&in_metal(&body), &asked, &|_, _| {}).unwrap().model_error.transmission, None);
}
