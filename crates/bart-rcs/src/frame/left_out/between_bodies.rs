//! Error of leaving out the ways between bodies: two bounces on two bodies, or more where most of the echo
//! has more, added up beside what was traced.

use crate::bodies::world::World;
use crate::frame::frame_error::Reference;
use crate::frame::left_out::ways::LeftOutWays;
use crate::frame::path_plan::Plan;
use crate::frame::snapshot::Snapshot;
use crate::joins::scatterer::meets_several_vehicles;
use crate::oversight::error::BartError;
use crate::oversight::progress::Phase;

/// Orders that are added up where they hold half of the echo.
const BOUNCES: u8 = 2;
/// Smaller mirrors are not followed: what one body throws on another comes off its panels.
const MIRROR_WAVELENGTHS: f64 = 10.0;

/// Ratio ‖S between bodies‖ over ‖S‖ at the moment and the place of the check, with the margin of the
/// measurement.
///
/// `None` where no such way is left out by [`artifact::settings::BetweenBodies`], and where their beams would
/// take more memory than the frame may.
pub(crate) fn between_bodies_left_out(
    world: &World,
    plan: &Plan<'_>,
    reference: &Reference,
) -> Result<Option<f64>, BartError> {
    if !world.leaves_bodies_apart() || plan.header.fidelity.bounces < BOUNCES {
        return Ok(None);
    }
    let world = world.joined()?;
    let bounces = reference.telling_orders(BOUNCES);
    let ways = LeftOutWays { bounces, mirror_wavelengths: MIRROR_WAVELENGTHS };
    let Some(tree) = ways.tree(&world, plan)? else { return Ok(None) };
    let snapshot = Snapshot::of(world, tree);
    let scatterer = snapshot.scatterer(plan, Phase::Checking);
    Ok(ways.relative(&scatterer, plan, reference, |joint| {
        meets_several_vehicles(&scatterer, joint.forward, joint.backward)
    }))
}
