//! Nearly equal aspects, bistatic antennas, rolled bodies, and many frequencies.

use crate::study::atlas::CaseRow;
use crate::study::atlas::methods;
use crate::study::atlas::verdict::printed;
use crate::study::bodies;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use artifact::units::SPEED_OF_LIGHT_MPS;
use bart_rcs::{RcsRequest, Standpoint};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};
use wayside::host::failure::Failure;

/// Steps of a millionth of a degree: S is smooth there, so that second differences relative to S are (2kDΔ)²,
/// below 1e-9 for these bodies; larger ones are jumps.
pub(in crate::study::atlas) fn hair_steps(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("aspects a millionth of a degree apart, largest jump", "body");
    let row = |(name, body, azimuth_deg): (&str, Mesh, f64)| {
        let azimuth_rad = (0..21).map(|i| (azimuth_deg + 1e-6 * f64::from(i)).to_radians()).collect();
        let request = RcsRequest { azimuth_rad, ..rcs_solvers::request_with_bounces(azimuth_deg, 30.0, 3) };
        let result = rcs_solvers::trace_rcs(&body, &request)?;
        let mean = result.amplitude_m.iter().map(|s| s.norm()).sum::<f64>() / 21.0;
        let bend = |w: &[Complex64]| (w[0] - 2.0 * w[1] + w[2]).norm() / mean;
        let most = result.amplitude_m.windows(3).map(bend).fold(0.0, f64::max);
        Ok(trial.answered(name, most, printed(&result.error)))
    };
    [
        ("plate at its specular", bodies::plate(0.3), -1e-5),
        ("top hat", bodies::top_hat(0.05, 0.02, 60, 0.3), 5.0),
        ("square trihedral", bodies::square_trihedral(0.1), 45.0),
        ("dihedral of 88°", bodies::dihedral(88.0), 46.0),
    ]
    .into_iter()
    .map(row)
    .collect()
}

/// Transmitter and receiver exchanged: S(tx, rx) = S(rx, tx)ᵀ.
pub(in crate::study::atlas) fn exchanged(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("transmitter and receiver exchanged", "body, polarization");
    let at = |azimuth_deg: f64, elevation_deg: f64| Standpoint {
        azimuth_rad: azimuth_deg.to_radians(),
        elevation_rad: elevation_deg.to_radians(),
        range_m: 30.0,
    };
    let ask = |body: &Mesh, from: Standpoint, to: Standpoint, polarization: Polarization| {
        let request = RcsRequest {
            azimuth_rad: vec![from.azimuth_rad],
            elevation_rad: vec![from.elevation_rad],
            range_m: from.range_m,
            receiver: Some(to),
            polarization,
            ..rcs_solvers::request_with_bounces(0.0, 0.0, 3)
        };
        rcs_solvers::trace_rcs(body, &request)
    };
    let (here, there) = (at(10.0, 20.0), at(32.0, 5.0));
    let row = |(name, body, ways): (&str, Mesh, [Polarization; 2])| {
        let (forth, back) = (ask(&body, here, there, ways[0])?, ask(&body, there, here, ways[1])?);
        Ok(trial.answered(
            name,
            rcs_solvers::relative_error(&forth.amplitude_m, &back.amplitude_m),
            printed(&forth.error),
        ))
    };
    [
        ("top hat, vv", bodies::top_hat(0.05, 0.02, 60, 0.3), [Polarization::Vv; 2]),
        ("top hat, vh", bodies::top_hat(0.05, 0.02, 60, 0.3), [Polarization::Vh, Polarization::Hv]),
        ("dihedral of 88°, hh", bodies::dihedral(88.0), [Polarization::Hh; 2]),
        ("trihedral, vh", bodies::square_trihedral(0.1), [Polarization::Vh, Polarization::Hv]),
    ]
    .into_iter()
    .map(row)
    .collect()
}

/// The body rotated about +x.
fn rolled(mut body: Mesh, by_deg: f64) -> Mesh {
    let (sin, cos) = by_deg.to_radians().sin_cos();
    body.vertices_m.iter_mut().for_each(|v| *v = [v[0], cos * v[1] - sin * v[2], sin * v[1] + cos * v[2]]);
    body
}

/// A dihedral rolled by α about the line of sight has |S_vv| = |S||cos 2α| and |S_vh| = |S||sin 2α|.
pub(in crate::study::atlas) fn rolled_dihedral(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART
        .trial("dihedral rolled about the line of sight, order 2 alone", "polarization, roll_deg");
    let whole = 0.15_f64.powi(2) * (8.0 * PI).sqrt() / rcs_solvers::WAVELENGTH_M;
    let row = |(name, polarization, roll_deg): (&str, Polarization, f64)| {
        let request = RcsRequest { polarization, ..rcs_solvers::request_with_bounces(0.0, 0.0, 2) };
        let result = rcs_solvers::trace_rcs(&rolled(bodies::dihedral(90.0), roll_deg), &request)?;
        let (sin, cos) = (2.0 * roll_deg).to_radians().sin_cos();
        let share = if polarization == Polarization::Vv { cos } else { sin };
        let error = (result.by_order_m[1][0].norm() / whole - share.abs()).abs();
        Ok(trial.answered(format!("{name}, {roll_deg}"), error, printed(&result.error)))
    };
    [
        ("vv", Polarization::Vv, 22.5),
        ("vh", Polarization::Vh, 22.5),
        ("vv", Polarization::Vv, 45.0),
        ("vh", Polarization::Vh, 45.0),
        ("vh", Polarization::Vh, 0.0),
    ]
    .into_iter()
    .map(row)
    .collect()
}

/// Two plates far apart, whose relative phase changes by thousands of radians over the band.
pub(in crate::study::atlas) fn wide_band(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("two plates apart, 401 frequencies over 5 GHz", "apart_m");
    let azimuth_rad = 2_f64.to_radians();
    let frequency_hz: Vec<f64> = (0..=400).map(|i| 76e9 + 12.5e6 * f64::from(i)).collect();
    let row = |apart_m: f64| {
        let behind = bodies::shifted(bodies::plate(0.1), [-apart_m, 0.3 + apart_m, 0.0]);
        let body = bodies::joined(bodies::plate(0.1), &behind);
        let request =
            RcsRequest { frequency_hz: frequency_hz.clone(), ..rcs_solvers::first_order_request(2.0, 0.0) };
        let result = rcs_solvers::trace_rcs(&body, &request)?;
        let towards_m = -apart_m * azimuth_rad.cos() + (0.3 + apart_m) * azimuth_rad.sin();
        let exact: Vec<Complex64> =
            frequency_hz.iter().map(|f| two_plates(*f, azimuth_rad, towards_m)).collect();
        Ok(trial.answered(
            apart_m,
            rcs_solvers::relative_error(&result.amplitude_m, &exact),
            printed(&result.error),
        ))
    };
    [0.5, 10.0, 300.0].into_iter().map(row).collect()
}

fn two_plates(frequency_hz: f64, azimuth_rad: f64, towards_m: f64) -> Complex64 {
    let (side_m, k) = (0.1, TAU * frequency_hz / SPEED_OF_LIGHT_MPS);
    let x = k * side_m * azimuth_rad.sin();
    let one = k / PI.sqrt() * side_m * side_m * azimuth_rad.cos() * x.sin() / x;
    Complex64::new(0.0, one) * (1.0 + Complex64::cis(2.0 * k * towards_m))
}
