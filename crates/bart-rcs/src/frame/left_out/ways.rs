//! Ways that a frame leaves out, added up beside what was traced: by a road (`road.rs`), between bodies
//! (`between_bodies.rs`).

use crate::beams::beam::{BeamTree, TraceSettings};
use crate::bodies::world::World;
use crate::frame::frame_error::Reference;
use crate::frame::path_plan::Plan;
use crate::geometry::antenna::Antenna;
use crate::joins::join::tree_order;
use crate::joins::joint::Joint;
use crate::joins::scatterer::{Integration, Scatterer, bracket_of};
use crate::oversight::error::BartError;
use crate::table::joint_sum::sum_of_joints;
use artifact::settings::NodeRule;
use num_complex::Complex64;

/// Accuracy of every integral: the figure is told to a few decibels.
pub(crate) const ACCURACY: f64 = 0.25;

/// Orders that are added up by the middle rule, and the reach of their mirrors.
pub(crate) struct LeftOutWays {
    /// Orders that are added up.
    pub(crate) bounces: u8,
    /// Mirrors with less area than a square of this side are not followed, wavelengths.
    pub(crate) mirror_wavelengths: f64,
}

impl LeftOutWays {
    /// Beams from the place of the check; `None` where they would take more memory than the frame may.
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

    /// Ratio ‖S of the joints that are left out‖ over ‖S‖, facets alone, with the margin of the
    /// measurement; what has more bounces is taken to gain as much as these do.
    pub(crate) fn relative(
        &self,
        scatterer: &Scatterer<'_>,
        plan: &Plan<'_>,
        reference: &Reference,
        is_left_out: impl Fn(&Joint) -> bool,
    ) -> Option<f64> {
        reference.relative_to_first_orders(self.bounces, |order, wavenumbers_per_m| {
            sum_of_ways(scatterer, plan, order, wavenumbers_per_m, &is_left_out)
        })
    }
}

/// S of some joints of one order over the wavenumbers, facets alone by the middle rule, as the radar sees it.
pub(crate) fn sum_of_ways(
    scatterer: &Scatterer<'_>,
    plan: &Plan<'_>,
    order: u8,
    wavenumbers_per_m: &[f64],
    is_meant: impl Fn(&Joint) -> bool,
) -> Vec<Complex64> {
    let mut joints = scatterer.joints(order, NodeRule::Middle, plan.trace.least_area_m2);
    joints.retain(is_meant);
    let bracket = bracket_of(NodeRule::Middle);
    let integration = Integration { wavenumbers_per_m, accuracy: ACCURACY, bracket };
    let amplitudes = sum_of_joints(scatterer, &joints, plan.view(0.0).origin_m, &integration);
    amplitudes.iter().map(|s| plan.seen(s)).collect()
}
