//! Scattering at one aspect: beams against dense sampling and rays.

use crate::study::chart::cost::{Cost, Measured, measured};
use crate::study::chart::row::SettingRow;
use crate::study::chart::subjects::Subject;
use crate::study::rcs_solvers;
use artifact::Accuracy;
use artifact::settings::{NodeRule, Sides};
use bart_rcs::{RcsRequest, RcsResult};
use num_complex::Complex64;
use po_sbr::{Bracket, po, sbr};
use wayside::host::failure::Failure;

/// The radar's frequencies: three over 0.6 GHz, so that an error is that of a profile and not of one
/// favourable phase.
const FREQUENCIES_HZ: [f64; 3] = [77e9, 77.3e9, 77.6e9];
const RANGE_M: f64 = 30.0;
/// Requested accuracy of the beams as reference.
const FINE_DB: f64 = -80.0;
/// Number of halvings of a cell that a shadow's border crosses.
const SHADOW_LEVELS: u32 = 3;

/// All methods for a body: its first order, and the next two separately.
pub(super) fn rows(subject: &Subject) -> Result<Vec<SettingRow>, Failure> {
    let exact = traced(subject, 3, FINE_DB)?.value;
    let body = Body { subject, exact: &exact };
    Ok([body.first_order()?, body.by_order()?].concat())
}

fn request(subject: &Subject, bounces: u8, accuracy_db: f64) -> RcsRequest {
    RcsRequest {
        frequency_hz: FREQUENCIES_HZ.to_vec(),
        range_m: RANGE_M,
        bounces,
        nodes: NodeRule::Exit,
        accuracy: Accuracy::from_db(accuracy_db),
        ..rcs_solvers::first_order_request(subject.azimuth_deg, subject.elevation_deg)
    }
}

fn traced(subject: &Subject, bounces: u8, accuracy_db: f64) -> Result<Measured<RcsResult>, Failure> {
    measured(|| rcs_solvers::trace_rcs(&subject.body, &request(subject, bounces, accuracy_db)))
}

fn sampled(
    subject: &Subject,
    per_wavelength: f64,
    shadow_levels: u32,
) -> Result<Measured<Vec<Complex64>>, Failure> {
    let sampling = po::Sampling { per_wavelength, shadow_levels, sides: Sides::Two, bracket: Bracket::Plain };
    let aspect = rcs_solvers::aspect(&request(subject, 1, FINE_DB));
    measured(|| {
        let found =
            po::amplitude(&subject.body, &aspect, &FREQUENCIES_HZ, &sampling).map_err(Failure::refused)?;
        Ok(found.iter().map(|s| s[0][0]).collect())
    })
}

/// `[order − 1][frequency]`.
type Orders = Vec<Vec<Complex64>>;

fn shot(subject: &Subject, per_wavelength: f64) -> Result<Measured<Orders>, Failure> {
    let shooting =
        sbr::RaySettings { per_wavelength, bounces: 3, sides: Sides::Two, bracket: Bracket::Plain };
    let aspect = rcs_solvers::aspect(&request(subject, 3, FINE_DB));
    measured(|| {
        let found =
            sbr::amplitude(&subject.body, &aspect, &FREQUENCIES_HZ, &shooting).map_err(Failure::refused)?;
        Ok(found.orders.iter().map(|order| order.iter().map(|s| s[0][0]).collect()).collect())
    })
}

/// Reference amplitude.
struct Reference<'a> {
    amplitude_m: &'a [Complex64],
    name: String,
}

/// A body with its beams at their finest, order by order.
struct Body<'a> {
    subject: &'a Subject,
    exact: &'a RcsResult,
}

impl Body<'_> {
    fn beams(&self, order: u8) -> Reference<'_> {
        let amplitude_m = &self.exact.by_order_m[usize::from(order) - 1];
        Reference { amplitude_m, name: format!("bart, order {order}, exit node, {FINE_DB} dB asked") }
    }

    /// First order: beams by requested accuracy against the densest sampling; sampling by its density against
    /// beams.
    fn first_order(&self) -> Result<Vec<SettingRow>, Failure> {
        let finest = self.subject.samples.finest;
        let dense = finest.map(|density| sampled(self.subject, density, SHADOW_LEVELS + 2)).transpose()?;
        let sampling = dense.as_ref().zip(finest).map(|(dense, density)| Reference {
            amplitude_m: &dense.value,
            name: format!("po, {density} samples per wavelength"),
        });
        let reference = sampling.unwrap_or_else(|| self.beams(1));
        let mut rows = Vec::new();
        for accuracy_db in [-10.0, -20.0, -30.0, -40.0, -60.0] {
            let found = traced(self.subject, 1, accuracy_db)?;
            let setting = format!("{accuracy_db} dB asked");
            rows.push(self.row("bart, order 1", setting, found.cost, &found.value.by_order_m[0], &reference));
        }
        for density in self.subject.samples.charted {
            let found = sampled(self.subject, *density, SHADOW_LEVELS)?;
            let setting = format!("{density} per wavelength");
            rows.push(self.row("po, order 1", setting, found.cost, &found.value, &self.beams(1)));
        }
        Ok(rows)
    }

    /// Orders separately, with the exit node of rays; errors are relative to the field of that order. Beams
    /// of order 1 are in [`Self::first_order`]: against rays they would show the error of the rays, whose
    /// first order converges slowly.
    fn by_order(&self) -> Result<Vec<SettingRow>, Failure> {
        let finest = self.subject.rays.finest;
        let dense = finest.map(|density| shot(self.subject, density)).transpose()?;
        let mut rows = Vec::new();
        for (order, accuracy_db) in [(2, -20.0), (2, -40.0), (3, -20.0), (3, -40.0)] {
            let rays = dense.as_ref().zip(finest).map(|(dense, density)| Reference {
                amplitude_m: &dense.value[usize::from(order) - 1],
                name: format!("sbr, order {order}, {density} rays per wavelength"),
            });
            let found = traced(self.subject, order, accuracy_db)?;
            let (method, setting) = (format!("bart, order {order}"), format!("{accuracy_db} dB asked"));
            let of_order = &found.value.by_order_m[usize::from(order) - 1];
            rows.push(self.row(
                &method,
                setting,
                found.cost,
                of_order,
                &rays.unwrap_or_else(|| self.beams(order)),
            ));
        }
        for density in self.subject.rays.charted {
            let found = shot(self.subject, *density)?;
            rows.extend((1..=3_u8).map(|order| self.rays_row(*density, order, &found)));
        }
        Ok(rows)
    }

    fn rays_row(&self, density: f64, order: u8, found: &Measured<Orders>) -> SettingRow {
        let method = format!("sbr, order {order}");
        let of_order = &found.value[usize::from(order) - 1];
        let setting = format!("{density} rays per wavelength");
        self.row(&method, setting, found.cost, of_order, &self.beams(order))
    }

    fn row(
        &self,
        method: &str,
        setting: String,
        cost: Cost,
        amplitude_m: &[Complex64],
        reference: &Reference<'_>,
    ) -> SettingRow {
        SettingRow {
            stage: "bart-rcs".into(),
            scene: self.subject.name.into(),
            method: method.into(),
            setting,
            cost,
            error: rcs_solvers::relative_error(amplitude_m, reference.amplitude_m),
            reference: reference.name.clone(),
            size: String::new(),
        }
    }
}
