//! A box that lacks its front: the field comes back after many bounces.

use crate::study::atlas::verdict::Trial;
use crate::study::atlas::{CaseRow, Says};
use crate::study::bodies::{self, Face};
use crate::study::extent::Extent;
use crate::study::looks;
use artifact::settings::Sides;
use num_complex::Complex64;
use po_sbr::{Bracket, sbr};
use wayside::host::failure::Failure;

/// Highest order of the path record; the reference goes on to eight.
const ORDERS: [u8; 5] = [1, 2, 3, 4, 5];

/// Against rays that bounce eight times, 30 along a wavelength.
pub(super) fn open_box(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial =
        Trial { stage: "bart-rcs", method: "bart", case: "box without a front", parameter: "bounces" };
    let body = bodies::cube(0.06, &Face::ALL[1..]);
    let all = by_rays(&body)?;
    let row = |bounces: u8| {
        let result = looks::traced(&body, &looks::bounced(25.0, 15.0, bounces))?;
        let says = match result.model_error.bounces {
            Some(left_out) => Says::About(left_out),
            None => Says::Words("model_error_db.bounces is null: one order tells nothing of the next"),
        };
        Ok(trial.answered(bounces, looks::relative_error(&result.amplitude_m, &[all]), says))
    };
    ORDERS.into_iter().map(row).collect()
}

fn by_rays(body: &artifact::scene::Mesh) -> Result<Complex64, Failure> {
    let shooting =
        sbr::Shooting { per_wavelength: 30.0, bounces: 8, sides: Sides::Two, bracket: Bracket::Symmetrised };
    let aspect = looks::aspect(&looks::first_order(25.0, 15.0));
    let found = sbr::amplitude(body, &aspect, &[looks::FREQUENCY_HZ], &shooting).map_err(Failure::refused)?;
    Ok(found.orders.iter().map(|order| order[0][0][0]).sum())
}
