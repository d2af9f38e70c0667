//! Error of leaving out paths between bodies: two bounces on two bodies, or more if most of the echo has
//! more, summed in addition to the traced paths.

use crate::bodies::world::World;
use crate::frame::frame_error::FrameReference;
use crate::frame::left_out::neglected_paths::NeglectedPaths;
use crate::frame::path_plan::Plan;
use crate::frame::snapshot::Snapshot;
use crate::joins::scatterer::meets_several_vehicles;
use crate::run_control::error::BartError;
use crate::run_control::progress::Phase;

/// Number of orders that are summed if they contain half of the echo.
const BOUNCES: u8 = 2;
/// Minimum mirror size: reflections from one body onto another come from its panels.
const MIRROR_WAVELENGTHS: f64 = 10.0;

/// Ratio ‖S between bodies‖ over ‖S‖ of the whole echo at the moment and position of the check, with the
/// margin of the measurement.
///
/// `None` if no such path is left out by [`artifact::settings::BetweenBodies`], or if their beams would
/// exceed the memory of the frame.
pub(crate) fn between_bodies_left_out(
    world: &World,
    plan: &Plan<'_>,
    reference: &FrameReference,
) -> Result<Option<f64>, BartError> {
    if !world.omits_inter_body_paths() || plan.header.fidelity.bounces < BOUNCES {
        return Ok(None);
    }
    let world = world.joined()?;
    let bounces = reference.representative_orders(BOUNCES);
    let ways = NeglectedPaths { bounces, mirror_wavelengths: MIRROR_WAVELENGTHS };
    let Some(tree) = ways.tree(&world, plan)? else { return Ok(None) };
    let snapshot = Snapshot::of(world, tree);
    let scatterer = snapshot.scatterer(plan, Phase::Checking);
    Ok(ways.relative(&scatterer, plan, reference, |joint| {
        meets_several_vehicles(&scatterer, joint.forward, joint.backward)
    }))
}
