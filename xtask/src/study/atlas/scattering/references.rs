//! The slow references when they are too coarse.

use crate::study::atlas::methods;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::bodies;
use crate::study::closed_forms;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use artifact::settings::Sides;
use po_sbr::{Bracket, sbr};
use std::f64::consts::PI;
use wayside::host::failure::Failure;

/// Statement for `rcs --method po` and `sbr`, which print no figure: they are characterized by their density,
/// and compared as it increases.
const BY_DENSITY: ErrorStatement =
    ErrorStatement::Remark("error_db is null: a reference is known by its density alone");

/// Rays per wavelength over a square trihedral on its axis.
pub(in crate::study::atlas) fn few_rays(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::SBR.trial("square trihedral, order 3 alone", "rays per wavelength");
    let body = bodies::square_trihedral(0.1);
    let request = rcs_solvers::first_order_request(45.0, 0.5_f64.sqrt().atan().to_degrees());
    let level = (12.0 * PI).sqrt() * 0.01 / rcs_solvers::WAVELENGTH_M;
    let row = |per_wavelength: f64| {
        let shooting =
            sbr::RaySettings { per_wavelength, bounces: 3, sides: Sides::Two, bracket: Bracket::Plain };
        let found = rcs_solvers::sbr_amplitudes(&body, &request, &shooting)?[2].norm();
        Ok(trial.answered(per_wavelength, rcs_solvers::level_error(found, level), BY_DENSITY))
    };
    [0.2, 0.5, 1.0, 2.0, 8.0].into_iter().map(row).collect()
}

/// Samples per wavelength over a plate far off its normal.
pub(in crate::study::atlas) fn few_samples(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::PO.trial("plate 20° off its normal", "samples per wavelength");
    let (body, request) = (bodies::plate(0.3), rcs_solvers::first_order_request(20.0, 0.0));
    let exact = closed_forms::plate_far(0.3, 20_f64.to_radians());
    let row = |per_wavelength: f64| {
        let found = rcs_solvers::po_amplitude(&body, &request, per_wavelength, 0)?;
        Ok(trial.answered(per_wavelength, rcs_solvers::relative_error(&[found], &[exact]), BY_DENSITY))
    };
    [0.2, 0.5, 1.0, 2.0, 4.0].into_iter().map(row).collect()
}

/// A cylinder of flat strips with only seven samples per facet, almost like the point scatterers of fast
/// tools, against dense ones.
pub(in crate::study::atlas) fn few_samples_a_facet(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::PO.trial("cylinder of few samples a facet", "samples per wavelength, q");
    let (radius_m, height_m) = (0.5, 0.05);
    let exact = closed_forms::cylinder(radius_m, height_m);
    let row = |(per_wavelength, q): (f64, f64)| {
        let chord_m = q * (radius_m * rcs_solvers::WAVELENGTH_M).sqrt();
        let sides = (2.0 * PI * radius_m / chord_m).round() as u32;
        let tube = bodies::shifted(bodies::tube(radius_m, height_m, sides, 0.3), [0.0, 0.0, -0.5 * height_m]);
        let found =
            rcs_solvers::po_amplitude(&tube, &rcs_solvers::first_order_request(0.0, 0.0), per_wavelength, 0)?;
        let error = rcs_solvers::relative_error(&[found], &[exact]);
        Ok(trial.answered(format!("{per_wavelength}, {q}"), error, BY_DENSITY))
    };
    [(0.05, 0.25), (0.05, 0.5), (2.0, 0.25), (2.0, 0.5)].into_iter().map(row).collect()
}
