//! Fineness of the integrals on each body, determined by measurement: no finer than the frame's accuracy
//! requires.
//!
//! Bounds of tiles are relative to the maximum scattering of a tile, and if large parts of a body cancel, the
//! remaining sum is known less accurately. A body's error counts relative to the scattering of the whole
//! frame: a kerb of −48 dBsm, long and smooth, need not be as accurate as the car beside it.

use crate::frame::band_power::{MARGIN, mean, total};
use crate::frame::path_plan::Plan;
use crate::joins::affordable_accuracy::{FAR_FINER, are_few_tiles};
use crate::joins::scatterer::{Integration, Scatterer, bracket_of};
use crate::table::order_joints::{JointSettings, OrderJoints};
use artifact::settings::Edges;
use num_complex::Complex64;

/// Accuracies found, with the error that they leave.
#[derive(Debug, Clone)]
pub(crate) struct IntegrationError {
    /// Accuracy of every node integral on a body, in the order of the targets.
    pub(crate) accuracy_of_body: Vec<f64>,
    /// Mean square error of these integrals over the checked frequencies.
    pub(crate) power: f64,
    /// Echo of each body, in the order of the targets.
    pub(crate) bodies: Vec<BodyEcho>,
}

/// Echo of a single body: all orders of the paths that meet no other.
#[derive(Debug, Clone)]
pub(crate) struct BodyEcho {
    /// S over the checked frequencies.
    pub(crate) amplitude_m: Vec<Complex64>,
    /// Mean square error of its integrals.
    pub(crate) integration_power: f64,
}

/// Ratio of the bounds of integrals to those of the coarser ones that they are compared with.
pub(crate) const FINER: f64 = 0.25;
/// Error of the finer integrals relative to their difference from the coarser: a third if errors scale with
/// bounds, FINER/(1 − FINER); a larger value is used, as in tables ([`crate::table::aspect_settings`]).
const OVER_DIFFERENCE: f64 = 0.5;
const OVER_DIFFERENCE_WITH_EDGES: f64 = 0.75;
/// Bounds of the coarser integrals tried first, relative to the requested accuracy: tiles err by a tenth of
/// their bounds and less, and mostly cancel. Beyond [`COARSEST`] bounds say little about errors.
const FIRST: f64 = 2.0;
const COARSEST: f64 = 0.25;
/// Maximum number of meetings on a body whose integrals are compared with much finer ones instead.
const FEW: usize = 64;
/// Share of the requested accuracy allotted to integrals; freezing and dropping have the rest, √(1 − 0.7²) =
/// 0.71.
const INTEGRATION_SHARE: f64 = 0.7;
/// Maximum number of refinements of integrals that err by too much.
const FINER_MOST: usize = 4;

/// Takes every body at the fineness tried first; if the error is too large, refines those that contribute
/// most. Also returns S by order from 1, over `wavenumbers_per_m`.
pub(crate) fn integration_error(
    scatterer: &Scatterer<'_>,
    plan: &Plan<'_>,
    meetings: &[OrderJoints],
    wavenumbers_per_m: &[f64],
) -> (IntegrationError, Vec<Vec<Complex64>>) {
    let asked = plan.allowed_error();
    let count = plan.header.targets.len();
    let checked = MeasuredMeetings { scatterer, plan, meetings, wavenumbers_per_m };
    let first = first_accuracy(asked);
    let mut bodies: Vec<BodyAmplitudes> =
        (0..count).map(|body| BodyAmplitudes::at(&checked, body, first)).collect();
    for _ in 0..FINER_MOST {
        let power = mean(&total(checked.by_order(&bodies).into_iter(), wavenumbers_per_m.len()));
        let allowed = (INTEGRATION_SHARE * asked / MARGIN).powi(2) * power;
        if checked.error_power(&bodies) <= allowed {
            break;
        }
        let alone: Vec<f64> =
            bodies.iter().map(|body| checked.error_power(std::slice::from_ref(body))).collect();
        let least = alone.iter().copied().fold(0.0, f64::max).min(allowed / count as f64);
        for (index, body) in bodies.iter_mut().enumerate().filter(|(index, _)| alone[*index] >= least) {
            *body = body.finer(&checked, index);
        }
    }
    let accuracy_of_body = bodies.iter().map(|body| body.accuracy).collect();
    let error = IntegrationError {
        accuracy_of_body,
        power: checked.error_power(&bodies),
        bodies: checked.echoes(&bodies),
    };
    (error, checked.by_order(&bodies))
}

/// Accuracy of the integrals tried first for a requested accuracy.
pub(crate) fn first_accuracy(asked: f64) -> f64 {
    FINER * (FIRST * asked).min(COARSEST.max(asked))
}

/// S of one order over frequency in the radar's polarization, with the given accuracy of the integrals on
/// each body.
pub(crate) fn of_order(
    scatterer: &Scatterer<'_>,
    plan: &Plan<'_>,
    (order, settings): (u8, &JointSettings),
    wavenumbers_per_m: &[f64],
    accuracy_of_body: &[f64],
) -> Vec<Complex64> {
    let (meeting, bracket) = (OrderJoints::of(scatterer, order, settings), bracket_of(settings.nodes));
    let of_body = |(body, accuracy): (usize, &f64)| {
        let integration = Integration { wavenumbers_per_m, accuracy: *accuracy, bracket };
        of_meeting(scatterer, plan, &meeting.on_body(scatterer, body), &integration)
    };
    total(accuracy_of_body.iter().enumerate().map(of_body), wavenumbers_per_m.len())
}

/// Echo of a body over frequency, summed over all orders.
pub(crate) struct EchoOfBody {
    /// All paths whose node lies on it.
    pub(crate) with_others_m: Vec<Complex64>,
    /// Those that meet no other body.
    pub(crate) alone_m: Vec<Complex64>,
}

/// Echoes of all bodies in the radar's polarization, in the order of the targets, with the given accuracy of
/// the integrals on each.
pub(crate) fn echoes_of_bodies(
    scatterer: &Scatterer<'_>,
    plan: &Plan<'_>,
    wavenumbers_per_m: &[f64],
    accuracy_of_body: &[f64],
) -> Vec<EchoOfBody> {
    let (settings, count) = (plan.meetings(), wavenumbers_per_m.len());
    let bracket = bracket_of(settings.nodes);
    let orders = 1..=plan.header.fidelity.bounces;
    let meetings: Vec<OrderJoints> =
        orders.map(|order| OrderJoints::of(scatterer, order, &settings)).collect();
    let between = between_bodies(scatterer, &meetings, accuracy_of_body.len());
    let of = |(body, accuracy): (usize, &f64)| {
        let integration = Integration { wavenumbers_per_m, accuracy: *accuracy, bracket };
        let of_part = |meeting: &OrderJoints| {
            of_meeting(scatterer, plan, &meeting.on_body(scatterer, body), &integration)
        };
        let with_others_m = total(meetings.iter().map(of_part), count);
        let others_m = total(between.iter().map(of_part), count);
        let alone_m = with_others_m.iter().zip(&others_m).map(|(all, others)| all - others).collect();
        EchoOfBody { with_others_m, alone_m }
    };
    accuracy_of_body.iter().enumerate().map(of).collect()
}

/// Meetings of paths over several of a number of bodies, by order.
fn between_bodies(scatterer: &Scatterer<'_>, meetings: &[OrderJoints], bodies: usize) -> Vec<OrderJoints> {
    match bodies {
        0 | 1 => vec![],
        _ => meetings.iter().map(|meeting| meeting.between_vehicles(scatterer)).collect(),
    }
}

/// S of one order over frequency in the radar's polarization.
pub(crate) fn of_meeting(
    scatterer: &Scatterer<'_>,
    plan: &Plan<'_>,
    meeting: &OrderJoints,
    integration: &Integration<'_>,
) -> Vec<Complex64> {
    let amplitudes = meeting.sum(scatterer, plan.view(0.0).origin_m, integration);
    amplitudes.iter().map(|s| plan.polarization_element(s)).collect()
}

/// Integrals on a body, by which what they are compared with is chosen.
enum Tiles {
    Few,
    OfFewMeetings,
    Many,
}

/// Meetings on which integrals are measured.
struct MeasuredMeetings<'a> {
    scatterer: &'a Scatterer<'a>,
    plan: &'a Plan<'a>,
    meetings: &'a [OrderJoints],
    wavenumbers_per_m: &'a [f64],
}

impl MeasuredMeetings<'_> {
    /// S of the nodes on one body, by order and over frequency.
    fn of_body(&self, body: usize, accuracy: f64) -> Vec<Vec<Complex64>> {
        let bracket = bracket_of(self.plan.header.fidelity.nodes);
        let integration = Integration { wavenumbers_per_m: self.wavenumbers_per_m, accuracy, bracket };
        let of_order = |meeting: &OrderJoints| {
            of_meeting(self.scatterer, self.plan, &meeting.on_body(self.scatterer, body), &integration)
        };
        self.meetings.iter().map(of_order).collect()
    }

    /// Echoes of all bodies, without paths between them.
    fn echoes(&self, bodies: &[BodyAmplitudes]) -> Vec<BodyEcho> {
        let between = between_bodies(self.scatterer, self.meetings, bodies.len());
        bodies.iter().enumerate().map(|(index, body)| self.echo((index, body), &between)).collect()
    }

    /// Echo of one body, without these paths between bodies.
    fn echo(&self, (index, body): (usize, &BodyAmplitudes), between: &[OrderJoints]) -> BodyEcho {
        let count = self.wavenumbers_per_m.len();
        let bracket = bracket_of(self.plan.header.fidelity.nodes);
        let integration =
            Integration { wavenumbers_per_m: self.wavenumbers_per_m, accuracy: body.accuracy, bracket };
        let on_body = |meeting: &OrderJoints| {
            let part = meeting.on_body(self.scatterer, index);
            (part.count() > 0).then(|| of_meeting(self.scatterer, self.plan, &part, &integration))
        };
        let of_others = total(between.iter().filter_map(on_body), count);
        let all = total(body.by_order.iter().cloned(), count);
        let amplitude_m = all.iter().zip(&of_others).map(|(all, between)| all - between).collect();
        BodyEcho { amplitude_m, integration_power: mean(&body.error) }
    }

    /// S of all bodies by order.
    fn by_order(&self, bodies: &[BodyAmplitudes]) -> Vec<Vec<Complex64>> {
        let count = self.wavenumbers_per_m.len();
        let of_order = |order: usize| total(bodies.iter().map(|body| body.by_order[order].clone()), count);
        (0..self.meetings.len()).map(of_order).collect()
    }

    /// Mean square error of all these bodies together.
    fn error_power(&self, bodies: &[BodyAmplitudes]) -> f64 {
        mean(&total(bodies.iter().map(|body| body.error.clone()), self.wavenumbers_per_m.len()))
    }

    /// Error of S of the nodes on one body over frequency, summed over orders: from the difference to coarser
    /// integrals; if its meetings are few, or to finer ones if that is larger; if their tiles are few too, to
    /// much finer ones.
    ///
    /// Tiles of a few large polygons err alike, and where these are off their specular both the sum and the
    /// difference to coarser ones are left over by chance.
    fn error(
        &self,
        (body, accuracy): (usize, f64),
        own: &[Complex64],
        coarser: impl FnOnce() -> Vec<Complex64>,
    ) -> Vec<Complex64> {
        let from = |other: Vec<Complex64>, over_difference: f64| -> Vec<Complex64> {
            own.iter().zip(other).map(|(own, other)| over_difference * (own - other)).collect()
        };
        let finer = |factor: f64| self.of_all_orders(body, factor * accuracy);
        match self.tiles_of(body, accuracy) {
            Tiles::Few => from(finer(FAR_FINER), 1.0),
            Tiles::OfFewMeetings => {
                let by_coarser = from(coarser(), self.over_difference());
                let by_finer = from(finer(FINER), 1.0 / (1.0 - FINER));
                if mean(&by_finer) > mean(&by_coarser) { by_finer } else { by_coarser }
            }
            Tiles::Many => from(coarser(), self.over_difference()),
        }
    }

    fn over_difference(&self) -> f64 {
        match self.plan.header.fidelity.edges {
            Edges::Ignored => OVER_DIFFERENCE,
            Edges::FirstOrder => OVER_DIFFERENCE_WITH_EDGES,
        }
    }

    fn of_all_orders(&self, body: usize, accuracy: f64) -> Vec<Complex64> {
        total(self.of_body(body, accuracy).into_iter(), self.wavenumbers_per_m.len())
    }

    /// Number of meetings on a body and of their tiles.
    fn tiles_of(&self, body: usize, accuracy: f64) -> Tiles {
        let on_body: Vec<OrderJoints> =
            self.meetings.iter().map(|meeting| meeting.on_body(self.scatterer, body)).collect();
        let bracket = bracket_of(self.plan.header.fidelity.nodes);
        let integration = Integration { wavenumbers_per_m: self.wavenumbers_per_m, accuracy, bracket };
        let are_few =
            || are_few_tiles(self.scatterer, on_body.iter().map(|meeting| &meeting.facets), &integration);
        match on_body.iter().map(OrderJoints::count).sum::<usize>() {
            0..=FEW if are_few() => Tiles::Few,
            0..=FEW => Tiles::OfFewMeetings,
            _ => Tiles::Many,
        }
    }
}

/// Scattering amplitude of the nodes on one body, over frequency.
struct BodyAmplitudes {
    accuracy: f64,
    /// S by order.
    by_order: Vec<Vec<Complex64>>,
    /// Error summed over all orders.
    error: Vec<Complex64>,
}

impl BodyAmplitudes {
    fn at(checked: &MeasuredMeetings<'_>, body: usize, accuracy: f64) -> Self {
        Self::compared_with(checked, (body, accuracy), || checked.of_all_orders(body, accuracy / FINER))
    }

    /// Finer integrals, with their error from the comparison with these.
    fn finer(&self, checked: &MeasuredMeetings<'_>, body: usize) -> Self {
        let count = checked.wavenumbers_per_m.len();
        Self::compared_with(checked, (body, FINER * self.accuracy), || {
            total(self.by_order.iter().cloned(), count)
        })
    }

    fn compared_with(
        checked: &MeasuredMeetings<'_>,
        (body, accuracy): (usize, f64),
        coarser: impl FnOnce() -> Vec<Complex64>,
    ) -> Self {
        let by_order = checked.of_body(body, accuracy);
        let own = total(by_order.iter().cloned(), checked.wavenumbers_per_m.len());
        let error = checked.error((body, accuracy), &own, coarser);
        Self { accuracy, by_order, error }
    }
}
