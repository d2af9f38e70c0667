//! Scattering at one aspect: beams against dense sampling and against rays.

use crate::study::chart::row::SettingRow;
use crate::study::chart::work::{Measured, Subject, measured};
use crate::study::looks;
use artifact::Accuracy;
use artifact::settings::{NodeRule, Sides};
use bart_rcs::{RcsRequest, RcsResult};
use num_complex::Complex64;
use po_sbr::{Bracket, po, sbr};
use wayside::host::failure::Failure;

/// The radar's frequencies: three over 0.6 GHz, so that an error is that of a profile and not of one lucky
/// phase.
const FREQUENCIES_HZ: [f64; 3] = [77e9, 77.3e9, 77.6e9];
/// Asked of the beams where they are the reference.
const FINE_DB: f64 = -80.0;
/// Halvings of a cell that a shadow's border crosses.
const SHADOW_LEVELS: u32 = 3;

fn request(subject: &Subject, bounces: u8, accuracy_db: f64) -> RcsRequest {
    RcsRequest {
        frequency_hz: FREQUENCIES_HZ.to_vec(),
        range_m: subject.range_m,
        bounces,
        nodes: NodeRule::Exit,
        accuracy: Accuracy::from_db(accuracy_db),
        ..looks::first_order(subject.azimuth_deg, subject.elevation_deg)
    }
}

fn traced(subject: &Subject, bounces: u8, accuracy_db: f64) -> Result<Measured<RcsResult>, Failure> {
    measured(|| looks::traced(&subject.body, &request(subject, bounces, accuracy_db)))
}

fn sampled(
    subject: &Subject,
    per_wavelength: f64,
    shadow_levels: u32,
) -> Result<Measured<Vec<Complex64>>, Failure> {
    let sampling = po::Sampling { per_wavelength, shadow_levels, sides: Sides::Two, bracket: Bracket::Plain };
    let aspect = looks::aspect(&request(subject, 1, FINE_DB));
    measured(|| {
        let found =
            po::amplitude(&subject.body, &aspect, &FREQUENCIES_HZ, &sampling).map_err(Failure::refused)?;
        Ok(found.iter().map(|s| s[0][0]).collect())
    })
}

/// `[order − 1][frequency]`.
fn shot(subject: &Subject, per_wavelength: f64) -> Result<Measured<Vec<Vec<Complex64>>>, Failure> {
    let shooting = sbr::Shooting { per_wavelength, bounces: 3, sides: Sides::Two, bracket: Bracket::Plain };
    let aspect = looks::aspect(&request(subject, 3, FINE_DB));
    measured(|| {
        let found =
            sbr::amplitude(&subject.body, &aspect, &FREQUENCIES_HZ, &shooting).map_err(Failure::refused)?;
        Ok(found.orders.iter().map(|order| order.iter().map(|s| s[0][0]).collect()).collect())
    })
}

fn row<T>(
    subject: &Subject,
    method: &'static str,
    setting: String,
    from: &Measured<T>,
    error: f64,
    reference: String,
) -> SettingRow {
    let (seconds, peak_mib) = (from.seconds, from.peak_mib);
    SettingRow {
        stage: "bart-rcs",
        scene: subject.name.clone(),
        method,
        setting,
        seconds,
        peak_mib,
        error,
        reference,
    }
}

/// First order: beams by the accuracy asked against the densest sampling; sampling by its density against
/// beams.
pub(super) fn first_order(subject: &Subject) -> Result<Vec<SettingRow>, Failure> {
    let dense = sampled(subject, subject.fine_samples, SHADOW_LEVELS + 2)?;
    let exact = traced(subject, 1, FINE_DB)?.value.amplitude_m;
    let dense_name = format!("po, {} samples per wavelength", subject.fine_samples);
    let mut rows = Vec::new();
    for accuracy_db in [-20.0, -40.0, -60.0] {
        let found = traced(subject, 1, accuracy_db)?;
        let error = looks::relative_error(&found.value.amplitude_m, &dense.value);
        rows.push(row(
            subject,
            "bart, order 1",
            format!("{accuracy_db} dB asked"),
            &found,
            error,
            dense_name.clone(),
        ));
    }
    for density in subject.densities {
        let found = sampled(subject, *density, SHADOW_LEVELS)?;
        let error = looks::relative_error(&found.value, &exact);
        let reference = format!("bart, order 1, {FINE_DB} dB asked");
        rows.push(row(subject, "po, order 1", format!("{density} per wavelength"), &found, error, reference));
    }
    Ok(rows)
}

/// Orders by themselves, with the exit node that rays have; errors are over the field of that order. Beams of
/// order 1 are in [`first_order`]: against rays they would show the error of the rays, whose first order
/// converges slowly.
pub(super) fn by_order(subject: &Subject) -> Result<Vec<SettingRow>, Failure> {
    let dense = shot(subject, subject.fine_rays)?;
    let exact = traced(subject, 3, FINE_DB)?;
    let mut rows = Vec::new();
    for order in 2..=3_u8 {
        let found = traced(subject, order, -40.0)?;
        let of_order = usize::from(order) - 1;
        let error = looks::relative_error(&found.value.by_order_m[of_order], &dense.value[of_order]);
        let reference = format!("sbr, order {order}, {} rays per wavelength", subject.fine_rays);
        rows.push(row(
            subject,
            "bart, by order",
            format!("order {order}, −40 dB asked"),
            &found,
            error,
            reference,
        ));
    }
    for density in subject.densities {
        let found = shot(subject, *density)?;
        rows.extend((1..=3_u8).map(|order| rays_row(subject, *density, order, &found, &exact.value)));
    }
    Ok(rows)
}

fn rays_row(
    subject: &Subject,
    density: f64,
    order: u8,
    found: &Measured<Vec<Vec<Complex64>>>,
    exact: &RcsResult,
) -> SettingRow {
    let index = usize::from(order) - 1;
    let error = looks::relative_error(&found.value[index], &exact.by_order_m[index]);
    let reference = format!("bart, order {order}, exit node, {FINE_DB} dB asked");
    let method = ["sbr, order 1", "sbr, order 2", "sbr, order 3"][index];
    row(subject, method, format!("{density} rays per wavelength"), found, error, reference)
}
