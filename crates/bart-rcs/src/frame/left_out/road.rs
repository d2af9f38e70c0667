//! Error of leaving the road out: the ways by a road, added up beside what was traced without.

use crate::beams::image_tree::{Received, origin};
use crate::bodies::road::{Half, half_of, usual_road};
use crate::bodies::world::World;
use crate::frame::frame_error::Reference;
use crate::frame::left_out::ways::LeftOutWays;
use crate::frame::path_plan::Plan;
use crate::joins::joint::{Joint, Trees};
use crate::joins::scatterer::{Scatterer, ZenithH};
use crate::oversight::error::BartError;
use artifact::settings::Sides;

/// Ratio ‖S by the road‖ over ‖S without‖ for the usual road, at the moment and the place of the check,
/// with the margin of the measurement.
///
/// One and two bounces on bodies by the middle rule, facets alone, to a quarter of each integral; what has
/// more bounces is taken to gain as much as these do. `None` where a road is there, or no body; where ways by
/// it could not be followed; and where their beams would take more memory than the frame may.
pub(crate) fn road_left_out(
    world: &World,
    plan: &Plan<'_>,
    reference: &Reference,
) -> Result<Option<f64>, BartError> {
    let Some(road) = usual_road() else { return Ok(None) };
    let can_be_followed = plan.check_m.z > 0.0 && plan.header.fidelity.sides == Sides::Two;
    if plan.header.road.is_some() || world.facets().is_empty() || !can_be_followed {
        return Ok(None);
    }
    let world = world.over(&road)?;
    let ways = LeftOutWays {
        bounces: plan.header.fidelity.bounces.min(BOUNCES),
        mirror_wavelengths: MIRROR_WAVELENGTHS,
    };
    let Some(tree) = ways.tree(&world, plan)? else { return Ok(None) };
    let received = Received::with_image(&world, &tree);
    let h = plan.zenith_h();
    let scatterer =
        Scatterer::new(&world, Trees::ByRoad(&tree, &received), ZenithH { transmit: h, receive: h });
    Ok(ways.relative(&scatterer, plan, reference, |joint| goes_by_road(&scatterer, joint)))
}

/// Orders that are added up.
const BOUNCES: u8 = 2;
/// Smaller mirrors are not followed: geometrical optics between bounces ends there (`docs/bart.md` §11), and
/// a sedan's frame takes 42 % longer for this figure instead of 56 %, which moves by 0.3 dB.
const MIRROR_WAVELENGTHS: f64 = 5.0;

/// Whether a leg of the joint's way meets the road.
fn goes_by_road(scatterer: &Scatterer<'_>, joint: &Joint) -> bool {
    let (transmit, receive) = (scatterer.trees.transmit(), scatterer.trees.receive());
    let is_below = |facet: u32| half_of(scatterer.world, facet) != Half::Above;
    let (forward, backward) = (scatterer.forward(joint), &receive.beams[joint.backward as usize]);
    origin(receive, backward) != Half::Above
        || transmit.way_back(forward).chain(receive.way_back(backward)).any(|beam| is_below(beam.facet))
}
