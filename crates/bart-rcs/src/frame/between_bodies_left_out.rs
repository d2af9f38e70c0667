//! What leaving out the ways between bodies costs: two bounces on two bodies, added up beside what was traced.

use crate::beams::beam::{BeamTree, TraceSettings};
use crate::bodies::world::World;
use crate::error::BartError;
use crate::frame::frame_error::Reference;
use crate::frame::path_plan::Plan;
use crate::frame::snapshot::Snapshot;
use crate::geometry::antenna::Antenna;
use crate::joins::join::{Joint, tree_order};
use crate::joins::scatterer::{Integration, Scatterer, bracket_of, sequence};
use crate::progress::Phase;
use crate::table::joint_sum::sum_of_joints;
use artifact::settings::NodeRule;

/// Orders that are added up.
const BOUNCES: u8 = 2;
/// Smaller mirrors are not followed: what one body throws on another comes off its panels.
const MIRROR_WAVELENGTHS: f64 = 10.0;
/// Of every integral: the figure is told to a few decibels.
const ACCURACY: f64 = 0.25;

/// ‖S between bodies‖ over ‖S‖ at the moment and the place of the check, with the margin of the measurement.
///
/// Two bounces by the middle rule, facets alone; what has more bounces is taken to gain as much as these do. `None` where no such
/// way is left out by [`artifact::settings::BetweenBodies`], and where their beams would take more memory than the frame may.
pub(crate) fn between_bodies_left_out(
    world: &World,
    plan: &Plan<'_>,
    reference: &Reference,
) -> Result<Option<f64>, BartError> {
    if !world.leaves_bodies_apart() || plan.header.fidelity.bounces < BOUNCES {
        return Ok(None);
    }
    let world = world.joined()?;
    let max_order = tree_order(BOUNCES, NodeRule::Middle);
    let least_mirror_area_m2 =
        (MIRROR_WAVELENGTHS * plan.band.wavelength_m()).powi(2).max(plan.trace.least_mirror_area_m2);
    let trace = TraceSettings { max_order, least_mirror_area_m2, ..plan.trace };
    let tree = match BeamTree::trace(&world, Antenna::Point(plan.check_m), &trace) {
        Err(BartError::BeamsTakeTooMuchMemory { .. }) => return Ok(None),
        tree => tree?,
    };
    let snapshot = Snapshot::of(world, tree);
    let scatterer = snapshot.scatterer(plan, Phase::Checking);
    Ok(reference.relative_to_first_orders(BOUNCES, |order, wavenumbers_per_m| {
        let mut joints = scatterer.joints(order, NodeRule::Middle, trace.least_area_m2);
        joints.retain(|joint| meets_several_bodies(&scatterer, joint));
        let integration = Integration { wavenumbers_per_m, accuracy: ACCURACY, bracket: bracket_of(NodeRule::Middle) };
        let amplitudes = sum_of_joints(&scatterer, &joints, plan.view(0.0).origin_m, &integration);
        amplitudes.iter().map(|s| plan.seen(s)).collect()
    }))
}

fn meets_several_bodies(scatterer: &Scatterer<'_>, joint: &Joint) -> bool {
    let facets = sequence(scatterer, joint.forward, joint.backward);
    let bodies: Vec<u32> = facets.into_iter().map(|facet| scatterer.world.facet(facet).id.body).collect();
    bodies.windows(2).any(|pair| pair[0] != pair[1])
}
