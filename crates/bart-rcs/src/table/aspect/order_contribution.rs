//! S of single orders over frequency, and what their errors are measured from.

use crate::edges::off_specular_sequences::SequenceSeparations;
use crate::joins::scatterer::Scatterer;
use crate::run_control::error::BartError;
use crate::table::aspect_settings::AspectSettings;
use crate::table::order_joints::OrderJoints;
use artifact::settings::NodeRule;
use glam::DVec3;
use num_complex::Complex64;
use rayon::prelude::*;

/// Contribution of one order.
pub(crate) struct OrderContribution {
    /// S over frequency.
    pub(crate) s_m: Vec<Complex64>,
    /// Part of it that is due to edges.
    pub(crate) edges_m: Vec<Complex64>,
    /// Power over frequency of the whole matrix, of facets and of edges, m².
    pub(crate) whole_power: f64,
    /// Separations of its double reflections from their specular points.
    pub(crate) separations: SequenceSeparations,
    /// Area of dropped overlaps, as in [`Joints::dropped_sections`](crate::joins::joint::Joints).
    pub(crate) dropped_sections: [f64; 2],
}

/// Meetings of both ends in every order from `from` on.
pub(crate) fn meetings(
    scatterer: &Scatterer<'_>,
    from: u8,
    rule: NodeRule,
    settings: &AspectSettings,
) -> Vec<OrderJoints> {
    let of_order = |order: u8| OrderJoints::of(scatterer, order, &settings.meeting(rule));
    (from..=settings.bounces).into_par_iter().map(of_order).collect()
}

/// S by order of the meetings, then frequency.
pub(crate) fn sums(
    scatterer: &Scatterer<'_>,
    meetings: &[OrderJoints],
    rule: NodeRule,
    settings: &AspectSettings,
) -> Result<Vec<Vec<Complex64>>, BartError> {
    let settings = &settings.with_affordable_accuracy(scatterer, meetings, rule)?;
    Ok(meetings.par_iter().map(|meeting| of_meeting(scatterer, meeting, rule, settings).s_m).collect())
}

/// S of one order over frequency, in the requested polarization.
pub(crate) fn of_meeting(
    scatterer: &Scatterer<'_>,
    meeting: &OrderJoints,
    rule: NodeRule,
    settings: &AspectSettings,
) -> OrderContribution {
    let (p, q) = settings.polarization.indices();
    let sums = meeting.sums(scatterer, DVec3::ZERO, &settings.integration(rule));
    let whole_power = sums.iter().flatten().flatten().flatten().map(Complex64::norm_sqr).sum::<f64>();
    let whole_power = whole_power / sums[0].len().max(1) as f64;
    let [mut s_m, edges_m] = sums.map(|sum| sum.iter().map(|s| s[p][q]).collect::<Vec<_>>());
    s_m.iter_mut().zip(&edges_m).for_each(|(s, edges)| *s += edges);
    let separations = match meeting.truncations.is_empty() {
        true => SequenceSeparations::default(),
        false => SequenceSeparations::of(scatterer, &meeting.facets),
    };
    OrderContribution {
        s_m,
        edges_m,
        whole_power,
        separations,
        dropped_sections: meeting.facets.dropped_sections,
    }
}

/// Scattering amplitude of the edges in one order.
pub(crate) fn edges_of_order(
    scatterer: &Scatterer<'_>,
    order: u8,
    settings: &AspectSettings,
) -> Vec<Complex64> {
    let (p, q) = settings.polarization.indices();
    let meeting = settings.meeting(settings.nodes).on_edges(scatterer, order);
    let [_, sum] = meeting.sums(scatterer, DVec3::ZERO, &settings.integration(settings.nodes));
    sum.iter().map(|s| s[p][q]).collect()
}
