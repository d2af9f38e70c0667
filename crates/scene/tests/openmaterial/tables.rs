//! Tables of electromagnetic properties: what is read off them.

use crate::fixture::{ASKED_HZ, Fixture, row, row_at};
use artifact::material::Material;
use artifact::units::SPEED_OF_LIGHT_MPS;
use num_complex::Complex64;
use serde_json::{Value, json};

fn complex(re: f64, im: f64) -> Complex64 {
    Complex64::new(re, im)
}

#[test]
fn between_two_wavelengths_the_permittivity_is_on_the_line_over_frequency() {
    let car = Fixture::car();
    let line = |frequency_hz: f64| [7.0 - 1e-11 * frequency_hz, 0.1 + 2e-12 * frequency_hz];
    let rows: Vec<Value> = [90e9, 70e9, 80e9].map(|hz| row(Some(hz), line(hz))).to_vec();
    for hz in [70e9, 74.3e9, 77e9, 80e9, 89.9e9] {
        let [real, loss] = line(hz);
        let found = car.glass(&rows, hz);
        // A few roundings of the wavelength there and back, of the share and of the two products.
        assert!((found - complex(real, -loss)).norm() < 32.0 * f64::EPSILON * real, "{hz}: {found}");
    }
}

#[test]
fn a_debye_relaxation_is_met_within_the_bound_of_a_line_between_two_points() {
    let car = Fixture::car();
    // Water, one term: ε = ε∞ + Δε/(1 + jωτ).
    let (infinite, step, relaxation_s) = (5.2, 73.0, 8.3e-12);
    let closed = |hz: f64| infinite + step / complex(1.0, std::f64::consts::TAU * hz * relaxation_s);
    let grid_hz = 1e9;
    let rows: Vec<Value> = (70..=84)
        .map(|i| {
            let hz = grid_hz * f64::from(i);
            row(Some(hz), [closed(hz).re, -closed(hz).im])
        })
        .collect();
    // |d²ε/df²| = 2Δε(2πτ)²/|1 + jωτ|³, largest at the lowest frequency; a line misses by h²/8 of it.
    let slope_s = std::f64::consts::TAU * relaxation_s;
    let bend = 2.0 * step * slope_s.powi(2) / complex(1.0, slope_s * 70e9).norm().powi(3);
    let bound = grid_hz.powi(2) / 8.0 * bend;
    for i in 0..140 {
        let hz = 70e9 + 0.1e9 * f64::from(i);
        let missed = (car_glass(&car, &rows, hz) - closed(hz)).norm();
        assert!(missed <= bound, "{hz}: {missed} of {bound}");
    }
    assert!(bound < 0.01);
}

fn car_glass(car: &Fixture, rows: &[Value], frequency_hz: f64) -> Complex64 {
    car.glass(rows, frequency_hz)
}

#[test]
fn of_several_conditions_the_nearest_to_20_degrees_and_half_humidity_is_taken() {
    let car = Fixture::car();
    let rows = [
        row_at(Some(70e9), [273.0, 50.0], [2.0, 0.0]),
        row_at(Some(70e9), [293.0, 10.0], [3.0, 0.0]),
        row_at(Some(70e9), [293.0, 60.0], [4.0, 0.0]),
        row_at(Some(70e9), [300.0, 50.0], [5.0, 0.0]),
        row_at(Some(84e9), [300.0, 50.0], [6.0, 0.0]),
    ];
    assert_eq!(car.glass(&rows, 70e9).re, 4.0);
    assert_eq!(car.glass(&rows, 77e9).re, 5.0, "half way to the only row of the other frequency");
}

#[test]
fn what_a_row_leaves_open_holds_everywhere() {
    let car = Fixture::car();
    let open = json!([null, null, null, null, null, 4.5, 0.25]);
    assert_eq!(car.glass(&[open], 1e9), complex(4.5, -0.25));
    let unknown = json!([null, 290.0, 50.0, 1.0, 0.0, 9.0, null]);
    assert_eq!(car.glass(&[unknown, row(None, [2.5, 0.0])], ASKED_HZ), complex(2.5, 0.0));
}

#[test]
fn a_table_of_one_frequency_holds_a_tenth_about_it_and_no_further() {
    let car = Fixture::car();
    let rows = [row(Some(77e9), [6.25, 0.5])];
    for hz in [70.1e9, 77e9, 81e9, 85.5e9] {
        assert_eq!(car.glass(&rows, hz), complex(6.25, -0.5), "{hz}");
    }
    for hz in [69.9e9, 85.6e9, 24e9] {
        let told = car.told(&car.glass_at(hz).unwrap_err());
        assert!(told.starts_with("m/glass_emp.xompt: electromagneticProperties: knows 77 to 77 GHz, and "));
        assert!(told.ends_with("GHz are asked for, which is 10 % beyond or more: name it in [materials]"));
    }
}

#[test]
fn a_table_for_light_says_nothing_to_a_radar() {
    let car = Fixture::car();
    let light = |wavelength_m: f64| SPEED_OF_LIGHT_MPS / wavelength_m;
    let rows = [row(Some(light(500e-9)), [-56.0, 24.0]), row(Some(light(905e-9)), [-182.7, 51.4])];
    let told = car.refused_glass(&rows);
    assert!(told.contains("knows 331262.385 to 599584.916 GHz, and 77 GHz are asked for"), "{told}");
}

#[test]
fn a_conductivity_of_a_megasiemens_makes_a_conductor() {
    let car = Fixture::car();
    let loss = |s_per_m: f64| s_per_m / (std::f64::consts::TAU * ASKED_HZ * 8.854_187_812_8e-12);
    car.material("m/glass", &[row(Some(ASKED_HZ), [1.0, loss(1.001e6)])]);
    assert_eq!(car.glass_at(ASKED_HZ).unwrap(), Material::Conductor);
    // Aluminium by Drude's formula, ε′ below zero, and iron, which is magnetic too.
    car.material("m/glass", &[row(Some(ASKED_HZ), [-3.2e4, loss(3.5e7)])]);
    assert_eq!(car.glass_at(ASKED_HZ).unwrap(), Material::Conductor);
    car.material("m/glass", &[json!([null, null, null, 80.0, 20.0, 1.0, loss(1e7)])]);
    assert_eq!(car.glass_at(ASKED_HZ).unwrap(), Material::Conductor);
    // Carbon fibres are not.
    let found = car.glass(&[row(Some(ASKED_HZ), [10.0, loss(2e4)])], ASKED_HZ);
    assert_eq!(found, complex(10.0, -loss(2e4)));
}

#[test]
fn what_is_neither_conductor_nor_dielectric_is_refused() {
    let car = Fixture::car();
    let table = "m/glass_emp.xompt: electromagneticProperties: ";
    let told = car.refused_glass(&[row(None, [0.9, 0.1])]);
    assert_eq!(told, format!("{table}ε′ there must be from 1 to 1000000, is 0.9"));
    let told = car.refused_glass(&[row(None, [-30.0, 2.0])]);
    assert_eq!(told, format!("{table}ε′ there must be from 1 to 1000000, is -30"));
    let told = car.refused_glass(&[json!([null, null, null, 1.5, 0.25, 4.0, 0.1])]);
    let magnetic = "has a relative permeability of 1.5 − 0.25j, and that of dielectrics is taken to be 1";
    assert_eq!(told, format!("{table}{magnetic}"));
    let nearly = json!([null, null, null, 1.005, 0.005, 4.0, 0.1]);
    assert_eq!(car.glass(&[nearly], ASKED_HZ), complex(4.0, -0.1));
}

#[test]
fn rows_out_of_range_are_refused_with_their_place() {
    let car = Fixture::car();
    for (row, told) in [
        (
            json!([0.0, 290, 50, 1, 0, 4, 0.1]),
            "[0][0]: the wavelength in m must be from 1e-9 to 100000, is 0",
        ),
        (
            json!([0.004, -1, 50, 1, 0, 4, 0.1]),
            "[0][1]: the temperature in K must be from 0 to 100000, is -1",
        ),
        (json!([0.004, 290, 101, 1, 0, 4, 0.1]), "[0][2]: the humidity in % must be from 0 to 100, is 101"),
        (json!([0.004, 290, 50, 1, -1, 4, 0.1]), "[0][4]: μ″ of μ′ − jμ″ must be from 0 to 1e30, is -1"),
        (json!([0.004, 290, 50, 1, 0, 4, -0.1]), "[0][6]: ε″ of ε′ − jε″ must be from 0 to 1e30, is -0.1"),
        (json!([0.004, 290, 50, 1, 0, "4", 0.1]), "[0][5]: must be a number, is the text `4`"),
        (json!([0.004, 290, 50, 1, 0, 4]), "[0]: must be a list of seven numbers"),
        (json!([0.004, 290, 50, 1, 0, 4, 0, 0]), "[0]: must be a list of seven numbers"),
        (json!(7), "[0]: must be a list, is 7"),
        (json!([0.004, null, null, null, null, null, null]), ": has no row with a permittivity"),
    ] {
        let found = car.refused_glass(&[row]);
        assert!(found.starts_with(&format!("m/glass_emp.xompt: electromagneticProperties{told}")), "{found}");
    }
    let mixed = [row(None, [4.0, 0.1]), row(Some(77e9), [4.0, 0.1])];
    assert!(car.refused_glass(&mixed).ends_with("some rows have a wavelength and others have none"));
    assert!(car.refused_glass(&[]).ends_with("has no row with a permittivity"));
}
