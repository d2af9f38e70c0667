//! What leaving the road out costs: the ways by a road, added up beside what was traced without.

use crate::beams::beam::{BeamTree, TraceSettings};
use crate::beams::image_tree::{Received, origin};
use crate::bodies::road::{Half, half_of, usual_road};
use crate::bodies::world::World;
use crate::error::BartError;
use crate::frame::frame_error::Reference;
use crate::frame::path_plan::Plan;
use crate::geometry::antenna::Antenna;
use crate::joins::join::{Joint, Joints, Trees, tree_order};
use crate::joins::scatterer::{Integration, Scatterer, ZenithH, bracket_of};
use crate::table::joint_sum::sum_of_joints;
use artifact::settings::{NodeRule, Sides};

/// ‖S by the road‖ over ‖S without‖ for the usual road, at the moment and the place of the check, with the margin of the
/// measurement.
///
/// One and two bounces on bodies by the middle rule, facets alone, to a quarter of each integral; what has more bounces is
/// taken to gain as much as these do. `None` where a road is there, or no body; where ways by it could not be followed; and
/// where their beams would take more memory than the frame may.
pub(crate) fn road_left_out(world: &World, plan: &Plan<'_>, reference: &Reference) -> Result<Option<f64>, BartError> {
    let Some(road) = usual_road() else { return Ok(None) };
    let can_be_followed = plan.check_m.z > 0.0 && plan.header.fidelity.sides == Sides::Two;
    if plan.header.road.is_some() || world.facets().is_empty() || !can_be_followed {
        return Ok(None);
    }
    let world = world.over(&road)?;
    let bounces = plan.header.fidelity.bounces.min(BOUNCES);
    let max_order = tree_order(bounces, NodeRule::Middle);
    let least_mirror_area_m2 =
        (MIRROR_WAVELENGTHS * plan.band.wavelength_m()).powi(2).max(plan.trace.least_mirror_area_m2);
    let trace = TraceSettings { max_order, least_mirror_area_m2, ..plan.trace };
    let tree = match BeamTree::trace(&world, Antenna::Point(plan.check_m), &trace) {
        Err(BartError::BeamsTakeTooMuchMemory { .. }) => return Ok(None),
        tree => tree?,
    };
    let received = Received::with_image(&world, &tree);
    let h = plan.zenith_h();
    let scatterer = Scatterer::new(&world, Trees::ByRoad(&tree, &received), ZenithH { transmit: h, receive: h });
    Ok(reference.relative_to_first_orders(bounces, |order, wavenumbers_per_m| {
        let mut joints = scatterer.joints(order, NodeRule::Middle, trace.least_area_m2);
        keep_ways_by_road(&scatterer, &mut joints);
        let integration = Integration { wavenumbers_per_m, accuracy: ACCURACY, bracket: bracket_of(NodeRule::Middle) };
        let amplitudes = sum_of_joints(&scatterer, &joints, plan.view(0.0).origin_m, &integration);
        amplitudes.iter().map(|s| plan.seen(s)).collect()
    }))
}

/// Orders that are added up.
const BOUNCES: u8 = 2;
/// Smaller mirrors are not followed: geometrical optics between bounces ends there (`docs/bart.md` §11), and a sedan's frame
/// takes 42 % longer for this figure instead of 56 %, which moves by 0.3 dB.
const MIRROR_WAVELENGTHS: f64 = 5.0;
/// Of every integral: the figure is told to a few decibels.
const ACCURACY: f64 = 0.25;

/// Forgets joints no leg of which meets the road.
fn keep_ways_by_road(scatterer: &Scatterer<'_>, joints: &mut Joints) {
    let (transmit, receive) = (scatterer.trees.transmit(), scatterer.trees.receive());
    let is_above = |facet: u32| half_of(scatterer.world, facet) == Half::Above;
    let is_direct = |joint: &Joint| {
        let (forward, backward) = (scatterer.forward(joint), &receive.beams[joint.backward as usize]);
        origin(receive, backward) == Half::Above
            && transmit.way_back(forward).chain(receive.way_back(backward)).all(|beam| is_above(beam.facet))
    };
    joints.retain(|joint| !is_direct(joint));
}
