//! Change that edges would make to an aspect that is computed without them, at one frequency.

use crate::joins::scatterer::{Integration, Scatterer};
use crate::table::aspect_settings::AspectSettings;
use crate::table::order_joints::{LeftOutEdges, OrderJoints};
use artifact::settings::Edges;
use num_complex::Complex64;
use rayon::prelude::*;

/// Settings for the change by edges at the middle frequency; `None` if edges are not left out, or would cost
/// too much on so many facets.
pub(crate) fn settings_with_edges(settings: &AspectSettings, facets: usize) -> Option<AspectSettings> {
    let wavenumber_per_m = *settings.wavenumbers_per_m.get(settings.wavenumbers_per_m.len() / 2)?;
    let is_left_out = settings.edges == Edges::Ignored && facets <= FACETS_WITH_CHEAP_EDGES;
    is_left_out.then(|| AspectSettings {
        wavenumbers_per_m: vec![wavenumber_per_m],
        edges: Edges::FirstOrder,
        ..settings.clone()
    })
}

/// Change by edges in all orders; trees must have the last one.
///
/// The accuracy of edges is relative to all of them seen square, and their sum may be far below that: it is
/// made finer until the change is known to a decibel.
pub(crate) fn left_out_edges(scatterer: Scatterer<'_>, settings: &AspectSettings) -> LeftOutEdges {
    let is_small = scatterer.world.facets().len() <= FACETS_WITH_CHEAP_WAVES;
    let scatterer = &if is_small { scatterer } else { scatterer.with_waves_over_own_faces() };
    let meeting = settings.meeting(settings.nodes);
    let of_order = |order: u8| meeting.changed_by_edges(scatterer, order);
    let orders: Vec<OrderJoints> = (1..=settings.bounces).into_par_iter().map(of_order).collect();
    let [first, finer @ ..] = ACCURACIES;
    let mut change = change(scatterer, &orders, settings, first);
    for accuracy in finer {
        let before = std::mem::replace(&mut change, self::change(scatterer, &orders, settings, accuracy));
        let is_settled = |part: fn([Complex64; 2]) -> Complex64| {
            (part(change) - part(before)).norm() <= SETTLED * part(change).norm()
        };
        if is_settled(|[fringes, ends]| fringes + ends) && is_settled(|[_, ends]| ends) {
            break;
        }
    }
    let [fringes, ends] = change;
    LeftOutEdges { power: (fringes + ends).norm_sqr(), ends_power: ends.norm_sqr() }
}

/// Maximum number of facets for which edges are cheap: with more they take longer than a tenth of a second,
/// as much as the rest of an aspect.
const FACETS_WITH_CHEAP_EDGES: usize = 2_000;
/// Maximum number of facets for which edge waves over further faces are cheap; with more, they would take
/// half of the time of edges and change their level by a decibel at most.
const FACETS_WITH_CHEAP_WAVES: usize = 100;
/// Accuracies of the contribution of edges, tried one after the other.
const ACCURACIES: [f64; 4] = [1e-1, 1e-2, 1e-3, 1e-4];
/// Relative difference from a coarser value at which the finer one is right to a decibel: it errs by 7 dB
/// less than that, and more ([`IntegralsCheck`](crate::table::aspect_settings::IntegralsCheck)).
const SETTLED: f64 = 0.25;

/// Change by fringes, and by the ends of double reflections.
fn change(
    scatterer: &Scatterer<'_>,
    orders: &[OrderJoints],
    settings: &AspectSettings,
    accuracy: f64,
) -> [Complex64; 2] {
    let (p, q) = settings.polarization.indices();
    let integration = Integration { accuracy, ..settings.integration(settings.nodes) };
    let of_order = |order: &OrderJoints| order.change_by_edges(scatterer, &integration).map(|s| s[0][p][q]);
    let by_order: Vec<[Complex64; 2]> = orders.par_iter().map(of_order).collect();
    [0, 1].map(|part| by_order.iter().map(|of| of[part]).sum())
}
