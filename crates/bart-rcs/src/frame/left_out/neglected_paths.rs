//! Paths that a frame leaves out, summed in addition to the traced ones: via a road (`road.rs`), between
//! bodies (`between_bodies.rs`).

use crate::beams::beam::{BeamTree, TraceSettings};
use crate::bodies::world::World;
use crate::frame::band_power::mean;
use crate::frame::frame_error::FrameReference;
use crate::frame::path_plan::Plan;
use crate::geometry::antenna::Antenna;
use crate::joins::join::tree_order;
use crate::joins::joint::{Joint, Joints};
use crate::joins::scatterer::{Integration, Scatterer, bracket_of};
use crate::run_control::error::BartError;
use crate::table::joint_sum::sum_of_joints;
use artifact::settings::NodeRule;
use num_complex::Complex64;

/// Accuracy of every integral: the result is needed to a few decibels.
pub(crate) const ACCURACY: f64 = 0.25;

/// Orders summed by the middle rule, and the minimum size of their mirrors.
pub(crate) struct NeglectedPaths {
    /// Number of orders that are summed.
    pub(crate) bounces: u8,
    /// Side of the square, in wavelengths, below whose area mirrors are not followed.
    pub(crate) mirror_wavelengths: f64,
}

impl NeglectedPaths {
    /// Beams from the position of the check; `None` if they would exceed the memory of the frame.
    pub(crate) fn tree(&self, world: &World, plan: &Plan<'_>) -> Result<Option<BeamTree>, BartError> {
        let max_order = tree_order(self.bounces, NodeRule::Middle);
        let least_mirror_area_m2 =
            (self.mirror_wavelengths * plan.band.wavelength_m()).powi(2).max(plan.trace.least_mirror_area_m2);
        let trace = TraceSettings { max_order, least_mirror_area_m2, ..plan.trace };
        match BeamTree::trace(world, Antenna::Point(plan.check_middle_m()), &trace) {
            Err(BartError::BeamsTakeTooMuchMemory { .. }) => Ok(None),
            tree => tree.map(Some),
        }
    }

    /// Ratio ‖S of the joints left out‖ over ‖S‖ of the whole echo, facets alone, with the margin of the
    /// measurement; higher orders are assumed to gain the same share.
    pub(crate) fn relative(
        &self,
        scatterer: &Scatterer<'_>,
        plan: &Plan<'_>,
        reference: &FrameReference,
        is_left_out: impl Fn(&Joint) -> bool,
    ) -> Option<f64> {
        reference.relative_to_first_orders(self.bounces, |order, wavenumbers_per_m| {
            sum_of_selected_paths(scatterer, plan, order, wavenumbers_per_m, &is_left_out)
        })
    }
}

/// S of selected joints of one order over the wavenumbers, facets alone by the middle rule, in the radar's
/// polarization.
pub(crate) fn sum_of_selected_paths(
    scatterer: &Scatterer<'_>,
    plan: &Plan<'_>,
    order: u8,
    wavenumbers_per_m: &[f64],
    is_meant: impl Fn(&Joint) -> bool,
) -> Vec<Complex64> {
    PathsByRule { scatterer, plan, wavenumbers_per_m }.of(order, NodeRule::Middle, is_meant)
}

/// Paths over facets alone, each order by a node rule.
pub(crate) struct PathsByRule<'a> {
    pub(crate) scatterer: &'a Scatterer<'a>,
    pub(crate) plan: &'a Plan<'a>,
    pub(crate) wavenumbers_per_m: &'a [f64],
}

/// Order up to which trees for the next one by the middle rule contain the nodes of every rule.
pub(crate) const ANY_RULE_ORDERS: u8 = 3;

impl PathsByRule<'_> {
    /// S of the selected joints of one order.
    pub(crate) fn of(&self, order: u8, rule: NodeRule, is_meant: impl Fn(&Joint) -> bool) -> Vec<Complex64> {
        let mut joints = self.joints(order, rule);
        joints.retain(is_meant);
        self.sum(&joints, rule)
    }

    /// [`Self::of`] the unselected joints and the selected ones, from a single search for joints.
    pub(crate) fn split_by_selection(
        &self,
        order: u8,
        rule: NodeRule,
        is_meant: impl Fn(&Joint) -> bool,
    ) -> [Vec<Complex64>; 2] {
        let mut others = self.joints(order, rule);
        let meant = others.filtered(&is_meant);
        others.retain(|joint| !is_meant(joint));
        [others, meant].map(|joints| self.sum(&joints, rule))
    }

    fn joints(&self, order: u8, rule: NodeRule) -> Joints {
        self.scatterer.joints(order, rule, self.plan.trace.least_area_m2)
    }

    fn sum(&self, joints: &Joints, rule: NodeRule) -> Vec<Complex64> {
        let (wavenumbers_per_m, bracket) = (self.wavenumbers_per_m, bracket_of(rule));
        let integration = Integration { wavenumbers_per_m, accuracy: ACCURACY, bracket };
        let origin_m = self.plan.view(0.0).origin_m;
        let amplitudes = sum_of_joints(self.scatterer, joints, origin_m, &integration);
        amplitudes.iter().map(|s| self.plan.polarization_element(s)).collect()
    }
}

/// S of the orders up to `bounces` in two parts, by a node rule as far as trees have its nodes. Later orders
/// are those of the middle rule, reduced by the ratio by which that rule exceeds the other in the last order
/// before them.
pub(crate) fn orders_by_rule<const N: usize>(
    bounces: u8,
    rule: NodeRule,
    of: impl Fn(u8, NodeRule) -> [Vec<Complex64>; N],
) -> Vec<[Vec<Complex64>; N]> {
    let of_order = |order: u8| if order == 1 { of(order, NodeRule::Middle) } else { of(order, rule) };
    let mut all: Vec<_> = (1..=bounces.min(ANY_RULE_ORDERS)).map(of_order).collect();
    if bounces <= ANY_RULE_ORDERS {
        return all;
    }
    let power = |parts: &[Vec<Complex64>; N]| parts.iter().map(|part| mean(part)).sum::<f64>();
    let by_middle = power(&of(ANY_RULE_ORDERS, NodeRule::Middle));
    let by_rule = all.last().map_or(0.0, power);
    let weaker = if by_middle > by_rule { (by_rule / by_middle).sqrt() } else { 1.0 };
    let scaled = |part: Vec<Complex64>| part.into_iter().map(|s| weaker * s).collect();
    all.extend((ANY_RULE_ORDERS + 1..=bounces).map(|order| of(order, NodeRule::Middle).map(scaled)));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// S of an order by a rule: 1 for the first, and a quarter of it by rules other than the middle one.
    fn s(order: u8, rule: NodeRule) -> [Vec<Complex64>; 2] {
        let of_rule = if rule == NodeRule::Middle { 1.0 } else { 0.25 };
        let s = Complex64::new(of_rule / f64::from(order), 0.0);
        [vec![s, s], vec![Complex64::I * s; 2]]
    }

    #[test]
    fn orders_are_those_of_the_rule_and_beyond_the_middle_one_is_as_much_weaker_as_it_is_before() {
        let all = orders_by_rule(4, NodeRule::OwnEdge, s);
        let expected = [1.0, 0.25 / 2.0, 0.25 / 3.0, 0.25 / 4.0];
        for (parts, expected) in all.iter().zip(expected) {
            assert!((parts[0][1].re - expected).abs() < 1e-15 && (parts[1][0].im - expected).abs() < 1e-15);
        }
        assert_eq!(all.len(), 4);
        assert_eq!(orders_by_rule(2, NodeRule::OwnEdge, s)[..], all[..2]);
    }

    #[test]
    fn a_rule_that_tells_more_than_the_middle_one_makes_later_orders_no_stronger() {
        let stronger = |order: u8, rule: NodeRule| {
            let times = if rule == NodeRule::Middle { 1.0 } else { 12.0 };
            s(order, rule).map(|part| part.into_iter().map(|s| times * s).collect::<Vec<_>>())
        };
        assert_eq!(orders_by_rule(4, NodeRule::OwnEdge, stronger)[3], s(4, NodeRule::Middle));
        assert_eq!(orders_by_rule(4, NodeRule::Middle, stronger)[3], s(4, NodeRule::Middle));
    }
}
