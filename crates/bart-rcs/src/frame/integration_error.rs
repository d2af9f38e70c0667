//! Fineness of the integrals on each body, by measurement: no finer than the frame's accuracy needs.
//!
//! Bounds of tiles are relative to what tiles could scatter at most, and where large parts of a body cancel,
//! what is left of its sum is known to less. What a body errs by counts against what the frame as a whole
//! scatters: a kerb of −48 dBsm, long and smooth, need not be known as well as the car beside it.

use crate::frame::frame_error::{Fineness, MARGIN, mean, mean_difference, of_meeting, total};
use crate::frame::path_plan::Plan;
use crate::joins::scatterer::{Scatterer, bracket_of};
use crate::table::meeting::OrderJoints;
use num_complex::Complex64;

/// Accuracies that were found, with the error that they leave.
#[derive(Debug, Clone)]
pub(crate) struct IntegrationError {
    /// Accuracy of every node integral on a body, in the order of the targets.
    pub(crate) accuracy_of_body: Vec<f64>,
    /// Mean over the band's three points of |S − S(ten times finer)|².
    pub(crate) power: f64,
}

/// Share of the accuracy asked for that integrals may take; freezing and what is dropped have the rest,
/// √(1 − 0.7²) = 0.71.
const INTEGRATION_SHARE: f64 = 0.7;
/// Steps by which integrals are made finer where they err by too much, and how many are tried.
const FINER: f64 = 0.25;
const FINER_MOST: usize = 3;

/// Every body as fine as the accuracy asked for; where that leaves too much, those finer that leave most.
pub(crate) fn integration_error(
    scatterer: &Scatterer<'_>,
    plan: &Plan<'_>,
    meetings: &[OrderJoints],
) -> IntegrationError {
    let asked = plan.asked();
    let count = plan.header.targets.len();
    let mut bodies: Vec<OfBody> =
        (0..count).map(|body| OfBody::at(scatterer, plan, meetings, body, asked)).collect();
    for _ in 0..FINER_MOST {
        let allowed = (INTEGRATION_SHARE * asked / MARGIN).powi(2) * mean(&sum(&bodies, |body| &body.fine));
        if power(&bodies) <= allowed {
            break;
        }
        let largest = bodies.iter().map(OfBody::power).fold(0.0, f64::max);
        let least = (allowed / count as f64).min(largest);
        for (index, body) in bodies.iter_mut().enumerate().filter(|(_, body)| body.power() >= least) {
            *body = OfBody::at(scatterer, plan, meetings, index, FINER * body.accuracy);
        }
    }
    let accuracy_of_body = bodies.iter().map(|body| body.accuracy).collect();
    IntegrationError { accuracy_of_body, power: power(&bodies) }
}

/// Scattering amplitude of the nodes on one body, over frequency.
struct OfBody {
    accuracy: f64,
    coarse: Vec<Complex64>,
    /// Amplitude of integrals ten times finer.
    fine: Vec<Complex64>,
}

impl OfBody {
    fn at(
        scatterer: &Scatterer<'_>,
        plan: &Plan<'_>,
        meetings: &[OrderJoints],
        body: usize,
        accuracy: f64,
    ) -> Self {
        let wavenumbers_per_m = &plan.band.wavenumbers_per_m();
        let bracket = bracket_of(plan.header.fidelity.nodes);
        let own: Vec<OrderJoints> = meetings.iter().map(|meeting| meeting.on_body(scatterer, body)).collect();
        let of = |accuracy: f64| {
            let fineness = Fineness { wavenumbers_per_m, accuracy };
            let orders = own.iter().map(|meeting| of_meeting(scatterer, plan, meeting, bracket, &fineness));
            total(orders, wavenumbers_per_m.len())
        };
        Self { accuracy, coarse: of(accuracy), fine: of(0.1 * accuracy) }
    }

    fn power(&self) -> f64 {
        mean_difference(&self.fine, &self.coarse)
    }
}

/// Power of the differences of all bodies together.
fn power(bodies: &[OfBody]) -> f64 {
    mean_difference(&sum(bodies, |body| &body.fine), &sum(bodies, |body| &body.coarse))
}

fn sum(bodies: &[OfBody], of: impl Fn(&OfBody) -> &Vec<Complex64>) -> Vec<Complex64> {
    total(bodies.iter().map(|body| of(body).clone()), bodies.first().map_or(0, |body| of(body).len()))
}
