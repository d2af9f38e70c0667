//! The closed-form integral where its formulas become 0/0, and where facets cancel.

use crate::study::atlas::CaseRow;
use crate::study::atlas::methods;
use crate::study::atlas::verdict::printed;
use crate::study::bodies;
use crate::study::closed_forms;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use bart_rcs::RcsRequest;
use wayside::host::failure::Failure;

/// Gordon's formula divides by the phase gradient, which vanishes at normal incidence.
pub(in crate::study::atlas) fn small_phases(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("plate almost square to the wave (Gordon 0/0)", "azimuth_deg");
    let plate = bodies::plate(0.3);
    let row = |azimuth_deg: f64| {
        let result = rcs_solvers::trace_rcs(&plate, &rcs_solvers::first_order_request(azimuth_deg, 0.0))?;
        let exact = closed_forms::plate_far(0.3, azimuth_deg.to_radians());
        Ok(trial.answered(
            azimuth_deg,
            rcs_solvers::relative_error(&result.amplitude_m, &[exact]),
            printed(&result.error),
        ))
    };
    [0.0, 1e-9, 1e-6, 1e-4, 1e-2, 1.0].into_iter().map(row).collect()
}

/// A plate of 1.2 m at 25 m is cut until its phases are linear; off the specular direction the pieces nearly
/// cancel.
pub(in crate::study::atlas) fn off_specular(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("near plate off its specular (pieces cancel)", "azimuth_deg");
    let plate = bodies::plate(1.2);
    let row = |azimuth_deg: f64| {
        let request = RcsRequest {
            range_m: 25.0,
            accuracy: artifact::Accuracy::from_db(-40.0),
            ..rcs_solvers::first_order_request(azimuth_deg, 0.0)
        };
        let result = rcs_solvers::trace_rcs(&plate, &request)?;
        let exact = closed_forms::plate_near(1.2, 25.0, azimuth_deg.to_radians());
        Ok(trial.answered(
            azimuth_deg,
            rcs_solvers::relative_error(&result.amplitude_m, &[exact]),
            printed(&result.error),
        ))
    };
    [0.0, 2.0, 20.0].into_iter().map(row).collect()
}
