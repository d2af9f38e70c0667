//! Error of leaving out the road: the paths via a road, summed in addition to those traced without.

use crate::beams::image_tree::RoadTree;
use crate::bodies::road::usual_road;
use crate::bodies::world::World;
use crate::frame::frame_error::FrameReference;
use crate::frame::left_out::neglected_paths::{NeglectedPaths, PathsByRule, orders_by_rule};
use crate::frame::path_plan::Plan;
use crate::joins::joint::Trees;
use crate::joins::scatterer::{Scatterer, ZenithH};
use crate::run_control::error::BartError;
use artifact::settings::{NodeRule, Sides};
use num_complex::Complex64;

/// Ratio ‖S via the road‖ over ‖S of the whole echo without‖ for the usual road, at the moment and position
/// of the check, with the margin of the measurement.
///
/// It covers one and two bounces on bodies by the middle rule, facets alone, to a quarter of each integral;
/// higher orders are assumed to gain the same share, and computed too if they contain most of the echo
/// ([`FrameReference::representative_orders`]). `None` if there is a road, or no body; if paths via it could
/// not be followed; and if their beams would exceed the memory of the frame.
pub(crate) fn road_left_out(
    world: &World,
    plan: &Plan<'_>,
    reference: &FrameReference,
) -> Result<Option<f64>, BartError> {
    let bounces = reference.representative_orders(BOUNCES);
    let of = |scatterer: &Scatterer<'_>, ways: &NeglectedPaths| {
        ways.relative(scatterer, plan, reference, |joint| scatterer.goes_by_road(joint))
    };
    Ok(over_usual_road(world, plan, bounces, of)?.flatten())
}

/// S of the paths via the usual road over the wavenumbers, by order from 1, as in [`orders_by_rule`]; `None`
/// as for [`road_left_out`].
pub(crate) fn paths_by_road(
    world: &World,
    plan: &Plan<'_>,
    (bounces, rule): (u8, NodeRule),
    wavenumbers_per_m: &[f64],
) -> Result<Option<Vec<Vec<Complex64>>>, BartError> {
    over_usual_road(world, plan, bounces, |scatterer, _| {
        let ways = PathsByRule { scatterer, plan, wavenumbers_per_m };
        let by_road = |order, rule| [ways.of(order, rule, |joint| scatterer.goes_by_road(joint))];
        orders_by_rule(bounces, rule, by_road).into_iter().flatten().collect()
    })
}

/// Applies `of` to the beams over the usual road; `None` as for [`road_left_out`].
fn over_usual_road<T>(
    world: &World,
    plan: &Plan<'_>,
    bounces: u8,
    of: impl Fn(&Scatterer<'_>, &NeglectedPaths) -> T,
) -> Result<Option<T>, BartError> {
    let Some(road) = usual_road() else { return Ok(None) };
    let is_above = plan.check_middle_m().z > 0.0 && world.check_above_road().is_ok();
    let can_be_followed = is_above && plan.header.fidelity.sides == Sides::Two;
    if plan.header.road.is_some() || world.facets().is_empty() || !can_be_followed {
        return Ok(None);
    }
    // Beams via the road need twice the memory of the tree's own.
    let world = world.over(&road)?.within(world.memory_limit().share_of(3));
    let ways = NeglectedPaths { bounces, mirror_wavelengths: MIRROR_WAVELENGTHS };
    let Some(tree) = ways.tree(&world, plan)? else { return Ok(None) };
    let received = RoadTree::with_image(&world, &tree);
    let h = plan.zenith_h();
    let trees = Trees::ByRoad(&tree, &received);
    let scatterer =
        Scatterer::new(&world, trees, ZenithH { transmit: h, receive: h }).with_gains(&plan.gains);
    Ok(Some(of(&scatterer, &ways)))
}

/// Number of orders that are summed if they contain half of the echo.
const BOUNCES: u8 = 2;
/// Minimum mirror size: geometrical optics between bounces is invalid below it (`docs/bart.md` §11), and a
/// sedan's frame takes 42 % longer for this result instead of 56 %, while it changes by 0.3 dB.
const MIRROR_WAVELENGTHS: f64 = 5.0;
