//! The three methods on the same question: S in vv at some frequencies, by bounce order with exit nodes.
#![allow(clippy::unwrap_used, reason = "what cannot be measured ends the test or the study")]
#![allow(dead_code, reason = "each uses its own part")]

use super::processor_time::processor_seconds;
use artifact::Accuracy;
use artifact::paths::Amplitude;
use artifact::scene::Mesh;
use artifact::settings::{NodeRule, Sides};
use bart_rcs::{RcsRequest, Standpoint, rcs};
use num_complex::Complex64;
use po_sbr::{Aspect, Bracket};

/// Results of one method: S and the time that it took.
pub(crate) struct Run {
    pub(crate) name: String,
    /// Processor time, s; not a number where the system does not tell.
    pub(crate) seconds: f64,
    /// `[order − 1][frequency]`.
    pub(crate) orders: Vec<Vec<Complex64>>,
}

pub(crate) fn request(
    place: Standpoint,
    frequencies_hz: &[f64],
    bounces: u8,
    nodes: NodeRule,
    db: f64,
) -> RcsRequest {
    RcsRequest {
        range_m: place.range_m,
        bounces,
        nodes,
        accuracy: Accuracy::from_db(db),
        ..RcsRequest::over(frequencies_hz.to_vec(), vec![place.elevation_rad], vec![place.azimuth_rad])
    }
}

pub(crate) fn bart(mesh: &Mesh, place: Standpoint, frequencies_hz: &[f64], bounces: u8, db: f64) -> Run {
    let start_s = processor_seconds().unwrap_or(f64::NAN);
    let result = rcs(mesh, &request(place, frequencies_hz, bounces, NodeRule::Exit, db), &|_, _| {}).unwrap();
    Run {
        name: format!("BART, {db} dB asked"),
        seconds: processor_seconds().unwrap_or(f64::NAN) - start_s,
        orders: result.by_order_m,
    }
}

pub(crate) fn po(
    mesh: &Mesh,
    place: Standpoint,
    frequencies_hz: &[f64],
    per_wavelength: f64,
    shadow_levels: u32,
) -> Run {
    let sampling = po_sbr::po::Sampling {
        per_wavelength,
        shadow_levels,
        sides: Sides::Two,
        bracket: Bracket::Symmetrised,
    };
    let start_s = processor_seconds().unwrap_or(f64::NAN);
    let s = po_sbr::po::amplitude(mesh, &Aspect::monostatic(place), frequencies_hz, &sampling).unwrap();
    let name = format!("po, {per_wavelength} cells per λ, borders halved {shadow_levels} times");
    Run { name, seconds: processor_seconds().unwrap_or(f64::NAN) - start_s, orders: vec![vv(&s)] }
}

pub(crate) fn sbr(
    mesh: &Mesh,
    place: Standpoint,
    frequencies_hz: &[f64],
    per_wavelength: f64,
    bounces: u8,
) -> Run {
    let shooting =
        po_sbr::sbr::RaySettings { per_wavelength, bounces, sides: Sides::Two, bracket: Bracket::Plain };
    let start_s = processor_seconds().unwrap_or(f64::NAN);
    let found = po_sbr::sbr::amplitude(mesh, &Aspect::monostatic(place), frequencies_hz, &shooting).unwrap();
    let name = format!("sbr, {per_wavelength} rays per λ ({:.2} million)", found.rays as f64 * 1e-6);
    Run {
        name,
        seconds: processor_seconds().unwrap_or(f64::NAN) - start_s,
        orders: found.orders.iter().map(|order| vv(order)).collect(),
    }
}

fn vv(amplitudes: &[Amplitude]) -> Vec<Complex64> {
    amplitudes.iter().map(|s| s[0][0]).collect()
}

/// ‖S − S_ref‖/‖S_ref‖ (docs/conventions.md).
pub(crate) fn error(got: &[Complex64], reference: &[Complex64]) -> f64 {
    let difference: f64 = got.iter().zip(reference).map(|(g, r)| (g - r).norm_sqr()).sum();
    (difference / reference.iter().map(|r| r.norm_sqr()).sum::<f64>()).sqrt()
}

pub(crate) fn decibels(ratio: f64) -> f64 {
    artifact::units::db_from_amplitude(ratio)
}
