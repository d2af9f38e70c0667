//! Measured error of a frame's paths, from a comparison with the same bodies traced and integrated anew at
//! another moment and from another element of the array.
//!
//! A map's error is that of its samples (Parseval), so some frequencies and moments suffice. Visibility,
//! amplitudes and apparent velocities err in proportion to the time from the frame's middle; at the moment
//! T/√12 after it the error has the mean square of the whole frame.

pub(crate) mod target_error;

use crate::frame::band_power::{MARGIN, frequencies_hz, mean, mean_difference, power_over_frame, total};
use crate::frame::integration_error::{IntegrationError, echoes_of_bodies, integration_error, of_order};
use crate::frame::path_plan::Plan;
use crate::frame::path_sum::{PathView, element_over_band};
use crate::joins::join::tree_order;
use crate::joins::scatterer::{Integration, Scatterer, bracket_of};
use crate::table::aspect_settings::{compared_rule, left_out_order};
use crate::table::order_joints::{JointSettings, OrderJoints};
use crate::table::small_mirrors::SmallMirrors;
use artifact::paths::Path;
use artifact::settings::{Edges, NodeRule};
use artifact::units::{SPEED_OF_LIGHT_MPS, amplitude_ratio};
use artifact::{ErrorBudget, ModelError};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Number of frequencies of the comparison. In the narrowest band of Table 2, 625 MHz, they are 52 MHz apart,
/// more than the c/(2·5 m) = 30 MHz over which the echo of a vehicle of 5 m is correlated, so that none
/// repeats its neighbour. The band has room for 21 such; the uncertainty of so few is covered by [`MARGIN`].
const CHECKED_FREQUENCIES: usize = 12;

/// Reference: the frame's bodies at the moment of the check.
pub(crate) struct FrameReference {
    frequencies_hz: Vec<f64>,
    /// Scattering amplitude by order from 1, then frequency.
    by_order_m: Vec<Vec<Complex64>>,
    /// Scattering amplitude by the other node rule, by order from 1, where there is a choice and the tree has
    /// the orders.
    other_m: Vec<Option<Vec<Complex64>>>,
    /// Scattering amplitude of the order after the last by the middle rule, facets alone, if the tree has
    /// that order.
    left_out_m: Option<Vec<Complex64>>,
    /// Echo of the point targets over frequency.
    points_m: Vec<Complex64>,
    /// Fineness of the reference's integrals, and of those of the paths compared with it.
    pub(crate) integration: IntegrationError,
    /// Echo between a second pair of elements; `None` unless the array is wide.
    second: Option<SecondPair>,
}

/// Echo between a second pair of elements, over frequency, summed over all orders.
struct SecondPair {
    view: PathView,
    amplitude_m: Vec<Complex64>,
    /// Echo of each body, in the order of the targets, without paths that meet others.
    bodies_m: Vec<Vec<Complex64>>,
}

/// Measured errors of one table of paths, as amplitudes relative to the frame's.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrameError {
    /// Error relative to the reference, including the reference's own, at the moment of the check.
    total: f64,
    /// Error of the integrals alone, at the same moment.
    integration: f64,
    /// Dropped paths and beams, with independent phases.
    dropped: f64,
    /// Dropped paths and beams, with equal phases of the beams.
    pub(crate) dropped_at_most: f64,
}

/// Powers that the comparison does not contain.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OmittedPowers {
    /// Power of the dropped paths, |S|² as in [`element_over_band`].
    pub(crate) paths_power_m2: f64,
    /// Area across the wave of beams over L₁L₂ of the nearest facet, relative to [`Plan::view`] like S: with
    /// independent phases, with equal ones.
    pub(crate) beams: [f64; 2],
    /// Mean over the frame of the power missed by blends beyond that at the moment of the check.
    pub(crate) blends_power_m2: f64,
}

/// Bodies at another moment, traced and integrated anew, beside the paths of the point targets.
pub(crate) fn reference(scatterer: &Scatterer<'_>, plan: &Plan<'_>, points: &[Path]) -> FrameReference {
    let fidelity = &plan.header.fidelity;
    let frequencies_hz = checked_frequencies_hz(plan);
    let wavenumbers = wavenumbers_per_m(&frequencies_hz);
    let meetings: Vec<OrderJoints> =
        (1..=fidelity.bounces).map(|order| OrderJoints::of(scatterer, order, &plan.meetings())).collect();
    let (integration, by_order_m) = integration_error(scatterer, plan, &meetings, &wavenumbers);
    let accuracies = &integration.accuracy_of_body;
    let of = |order: u8, settings: &JointSettings| {
        of_order(scatterer, plan, (order, settings), &wavenumbers, accuracies)
    };
    let other = JointSettings { nodes: compared_rule(fidelity.nodes), ..plan.meetings() };
    let reaches = |order: u8| order > 1 && tree_order(order, other.nodes) <= plan.trace.max_order;
    let other_m = (1..=fidelity.bounces).map(|o| reaches(o).then(|| of(o, &other))).collect();
    let alone = JointSettings { nodes: NodeRule::Middle, edges: Edges::Ignored, ..plan.meetings() };
    let left_out_m = left_out_order(fidelity.bounces, plan.trace.max_order).map(|order| of(order, &alone));
    let points_m = element_over_band(points, &plan.check_view(), plan.reception(), &frequencies_hz);
    FrameReference { by_order_m, other_m, left_out_m, points_m, frequencies_hz, integration, second: None }
}

fn checked_frequencies_hz(plan: &Plan<'_>) -> Vec<f64> {
    frequencies_hz(plan.band.centre_hz, plan.band.bandwidth_hz, CHECKED_FREQUENCIES)
}

fn wavenumbers_per_m(frequencies_hz: &[f64]) -> Vec<f64> {
    frequencies_hz.iter().map(|f| TAU * f / SPEED_OF_LIGHT_MPS).collect()
}

impl FrameReference {
    /// This reference extended by a second pair of elements at a position and moment.
    pub(crate) fn with_second(self, scatterer: &Scatterer<'_>, plan: &Plan<'_>, view: PathView) -> Self {
        let wavenumbers = wavenumbers_per_m(&self.frequencies_hz);
        let echoes = echoes_of_bodies(scatterer, plan, &wavenumbers, &self.integration.accuracy_of_body);
        let amplitude_m = total(echoes.iter().map(|echo| echo.with_others_m.clone()), wavenumbers.len());
        let bodies_m = echoes.into_iter().map(|echo| echo.alone_m).collect();
        Self { second: Some(SecondPair { view, amplitude_m, bodies_m }), ..self }
    }

    /// Scattering amplitude with other beams, summed over all orders, by the requested rule with the same
    /// fineness.
    fn of_other_beams(&self, other: &Scatterer<'_>, plan: &Plan<'_>) -> Vec<Complex64> {
        let wavenumbers = wavenumbers_per_m(&self.frequencies_hz);
        let (settings, accuracies) = (plan.meetings(), &self.integration.accuracy_of_body);
        let of = |order: u8| of_order(other, plan, (order, &settings), &wavenumbers, accuracies);
        total((1..=plan.header.fidelity.bounces).map(of), wavenumbers.len())
    }

    /// Mean power between both pairs of elements of a wide array, 0 otherwise: paths that miss the field off
    /// the array's centre are no measure of their own error.
    fn power_over_array(&self) -> f64 {
        let of_second = |second: &SecondPair| 0.5 * (self.power_m2() + mean(&second.amplitude_m));
        self.second.as_ref().map_or(0.0, of_second)
    }

    /// Spread between the node rules where both are known, and the first missing order, both relative to the
    /// whole echo.
    pub(crate) fn model_error(&self) -> ModelError {
        let power = self.power_m2();
        let relative = |part: f64| amplitude_ratio(part, power);
        let both = self.by_order_m.iter().zip(&self.other_m);
        let spreads: Vec<f64> = both.filter_map(|(m, e)| e.as_ref().map(|e| mean_difference(m, e))).collect();
        ModelError {
            nodes: (!spreads.is_empty()).then(|| relative(spreads.iter().sum())),
            bounces: self.left_out_m.as_ref().map(|s| relative(mean(s))),
            ..ModelError::default()
        }
    }

    /// Number of orders, from the first, that represent all: `few` if these contain at least half of the
    /// power, else every order. Negligible first orders (a corner of three bounces) do not represent the
    /// later ones.
    pub(crate) fn representative_orders(&self, few: u8) -> u8 {
        let (first, later) = self.by_order_m.split_at(self.by_order_m.len().min(few.into()));
        if power_of_orders(first) >= power_of_orders(later) {
            first.len() as u8
        } else {
            self.by_order_m.len() as u8
        }
    }

    /// Ratio ‖S(of)‖ of the orders up to `orders` over ‖S‖ of the whole echo, including the assumed gain of
    /// the later orders ([`with_later_orders`]). `of` gives S of an order over the wavenumbers. `None` if
    /// nothing scatters.
    pub(crate) fn relative_to_first_orders(
        &self,
        orders: u8,
        of: impl Fn(u8, &[f64]) -> Vec<Complex64>,
    ) -> Option<f64> {
        let wavenumbers = wavenumbers_per_m(&self.frequencies_hz);
        let added = total((1..=orders).map(|order| of(order, &wavenumbers)), wavenumbers.len());
        let first = power_of_orders(&self.by_order_m[..usize::from(orders)]);
        let all = power_of_orders(&self.by_order_m);
        let gained = with_later_orders(mean(&added), [first, all - first]);
        let whole = self.power_m2();
        (whole > 0.0).then(|| MARGIN * (gained / whole).sqrt())
    }

    /// Ratio ‖S − S(of other beams)‖, summed over all orders by the requested rule, over ‖S‖ of the whole
    /// echo.
    pub(crate) fn difference(&self, other: &Scatterer<'_>, plan: &Plan<'_>) -> f64 {
        let other_m = self.of_other_beams(other, plan);
        amplitude_ratio(mean_difference(&self.total_m(), &other_m), self.power_m2())
    }

    /// Mean power |S|² of the whole echo over frequency, m²: all orders on bodies, and the point targets.
    pub(crate) fn power_m2(&self) -> f64 {
        let orders = self.by_order_m.iter().chain([&self.points_m]).cloned();
        mean(&total(orders, self.frequencies_hz.len()))
    }

    /// Scattering amplitude of the bodies summed over all orders, over frequency.
    fn total_m(&self) -> Vec<Complex64> {
        total(self.by_order_m.iter().cloned(), self.frequencies_hz.len())
    }
}

/// Sum of the powers of several orders, each by itself.
fn power_of_orders(orders: &[Vec<Complex64>]) -> f64 {
    orders.iter().map(|order| mean(order)).sum()
}

/// Power added to all orders if `added` is added to the first ones: the later ones gain the same share of
/// their own power, but no more than all of it.
fn with_later_orders(added: f64, [first, later]: [f64; 2]) -> f64 {
    added + later * (added / first.max(f64::MIN_POSITIVE)).min(1.0)
}

impl FrameError {
    /// Errors of `paths` relative to the reference; `points` are among them, and exact.
    pub(crate) fn measured_on(
        plan: &Plan<'_>,
        paths: &[Path],
        points: &[Path],
        reference: &FrameReference,
        omitted_powers: &OmittedPowers,
    ) -> Self {
        let of_reference = if plan.is_cross_polarized() { reference.power_over_array() } else { 0.0 };
        let power = power_over_frame(paths, plan).max(of_reference);
        let relative = |part: f64| amplitude_ratio(part, power);
        let missed = |view: &PathView, bodies: &[Complex64]| {
            let sum_of =
                |paths: &[Path]| element_over_band(paths, view, plan.reception(), &reference.frequencies_hz);
            let exact: Vec<Complex64> =
                bodies.iter().zip(sum_of(points)).map(|(s, of_points)| s + of_points).collect();
            mean_difference(&exact, &sum_of(paths))
        };
        let first = missed(&plan.check_view(), &reference.total_m());
        let second = reference.second.as_ref().map(|second| missed(&second.view, &second.amplitude_m));
        // The reference is integrated as finely as the paths: the errors of both are added.
        let integration_power = reference.integration.power;
        let compared = second.map_or(first, |second| 0.5 * (first + second));
        let error_power = compared + integration_power + omitted_powers.blends_power_m2;
        let [beams, beams_at_most] = omitted_powers.beams;
        let wavenumber_per_m = TAU / plan.band.wavelength_m();
        let scale = (plan.gains.largest() * wavenumber_per_m).powi(2) / std::f64::consts::PI;
        Self {
            total: relative(error_power),
            integration: relative(integration_power),
            dropped: relative(omitted_powers.paths_power_m2 + scale * beams.powi(2)),
            dropped_at_most: relative(omitted_powers.paths_power_m2 + scale * beams_at_most.powi(2)),
        }
    }

    /// Error of the frame, including the margin of the measurement.
    pub(crate) fn measured(&self) -> f64 {
        MARGIN * self.total
    }

    /// Whether freezing exceeds both the integration and the dropped error.
    pub(crate) fn is_mostly_freezing(&self) -> bool {
        self.freezing() >= self.integration.max(self.dropped)
    }

    /// Error due to neither integration nor dropping.
    fn freezing(&self) -> f64 {
        let known = self.integration.powi(2) + self.dropped.powi(2);
        (self.total.powi(2) - known).max(0.0).sqrt()
    }

    /// Named shares: the error due to neither integration nor dropping is freezing.
    pub(crate) fn budget(&self) -> ErrorBudget {
        ErrorBudget {
            integration: Some(MARGIN * self.integration),
            dropped: Some(MARGIN * self.dropped),
            freezing: Some(MARGIN * self.freezing()),
            ..ErrorBudget::default()
        }
    }
}

/// [`OmittedPowers::beams`], with the share of unfollowed mirrors that similar ones scatter.
pub(crate) fn dropped_sections(
    scatterer: &Scatterer<'_>,
    plan: &Plan<'_>,
    meetings: &[OrderJoints],
) -> [f64; 2] {
    let distances_m2 =
        scatterer.world.facets().iter().map(|f| f.corners_m[0].distance_squared(plan.position_m));
    let nearest_m2 = distances_m2.fold(f64::INFINITY, f64::min);
    let needed = plan.trace.max_order;
    let mut mirrors = SmallMirrors::of(scatterer.trees, needed, plan.trace.least_mirror_area_m2);
    let wavenumbers = plan.band.wavenumbers_per_m();
    let bracket = bracket_of(plan.header.fidelity.nodes);
    let integration =
        Integration { wavenumbers_per_m: &wavenumbers, accuracy: plan.allowed_error(), bracket };
    for meeting in meetings {
        mirrors.add(mirrors.hits(scatterer, meeting, &integration, plan.header.radar.array.polarization));
    }
    let [sum_m2, squares_m4] = scatterer.trees.transmit().audit.dropped_sections(needed, mirrors.shares(0));
    [squares_m4.sqrt() / nearest_m2, sum_m2 / nearest_m2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_orders_gain_as_the_first_ones_do_and_never_more_than_they_have() {
        // A tenth added to the first orders is a tenth added to all.
        assert!((with_later_orders(0.1, [1.0, 4.0]) - 0.5).abs() < 1e-12);
        // No order gains more than all of its power.
        assert!((with_later_orders(0.4, [0.001, 9.0]) - 9.4).abs() < 1e-12);
        assert_eq!(with_later_orders(0.3, [0.0, 2.0]), 2.3);
        assert_eq!(with_later_orders(0.0, [0.0, 2.0]), 0.0);
    }
}
