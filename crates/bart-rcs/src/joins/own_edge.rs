//! Own-edge weights: every node of a sequence is weighted by the share of its outline that is its own facet's
//! edge.
//!
//! The edges that truncate a multiple reflection belong to one of its facets, and only a node there has the
//! right phase along them. Each node is therefore weighted by the share of its lit polygon's outline that is
//! that flat patch's own edge or an occluder's shadow line on it; cuts by other facets' beams do not count,
//! and a line where both end, as at a fold, is left out: along it either node is right. Weights are
//! normalised over all K nodes of the sequence; a missing one is assigned the mean share, so that a sequence
//! seen from one node of three counts a third. Otherwise the many sequences that have only one node (round a
//! duct of narrow facets) would each count fully, once per node: +3 dB (docs/decisions/node-rule.md). Where
//! planes are exact all nodes are equal, and so is every choice of weights.
//!
//! Facets of a curved skin reflect parallel strips with gaps, and a node after them misses the divergence.
//! The node is then on the facet with the smaller radius: weights are the squares of the curvatures.

use crate::beams::image_tree::origin;
use crate::bodies::road::HalfSpace;
use crate::bodies::road_mirror::below;
use crate::bodies::world::World;
use crate::geometry::clip::doubled_area;
use crate::joins::joint::{Joint, Joints, Reverse, Trees};
use crate::joins::outline::Outline;
use crate::joins::shadow_sides::{ShadowSide, of_shadow_sides};
use artifact::paths::MAX_ORDER;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::HashMap;

/// Patches of a sequence from the transmitter on; entries beyond its order are `u32::MAX`.
type Sequence = [u32; MAX_ORDER];

/// Marker of a path that ends at the antenna's image below the road; facets are far fewer than 2³¹.
const BY_ROAD: u32 = 1 << 31;

/// Sizes of one node of a sequence, over all its pieces.
#[derive(Debug, Clone, Default)]
struct SequenceNode {
    outline: Outline,
    /// Sides along lines that cut out shadows, from all pieces, which together determine what ends there.
    shadow_sides: Vec<ShadowSide>,
    /// Area across the wave, mean of both legs, m².
    across_m2: f64,
}

type SequenceNodes = [SequenceNode; MAX_ORDER];

/// Sets the weights of all joints of one order, and consumes their outlines.
pub(crate) fn weigh(world: &World, trees: Trees<'_>, order: u8, joints: &mut Joints) {
    let count = usize::from(order);
    let placed = joints.list.par_iter().map(|joint| place(world, trees, joint, joints.polygon(joint)));
    let placed: Vec<PlacedJoint> = placed.collect();
    let nodes_of = gathered(world, count, joints, &placed);
    let weight = |PlacedJoint { sequence, node, .. }: &PlacedJoint| {
        let curvatures = sequence[..count].iter().map(|patch| world.curvature_per_m(*patch & !BY_ROAD));
        curved_weight(curvatures, *node)
            .or_else(|| nodes_of.get(sequence).map(|nodes| flat_weight(&nodes[..count], *node)))
            .unwrap_or(0.0)
    };
    joints.list.par_iter_mut().zip(&placed).for_each(|(joint, placed)| joint.weight = weight(placed));
    (joints.outlines, joints.shadow_sides) = (Vec::new(), Vec::new());
    joints.drop_weightless();
}

/// Sizes of the nodes of every sequence.
fn gathered(
    world: &World,
    count: usize,
    joints: &Joints,
    placed: &[PlacedJoint],
) -> HashMap<Sequence, SequenceNodes> {
    let mut nodes_of: HashMap<Sequence, SequenceNodes> = HashMap::with_capacity(placed.len());
    let mut sides = joints.shadow_sides.iter().peekable();
    for (index, ((joint, &PlacedJoint { sequence, node, across_m2 }), outline)) in
        (0..).zip(joints.list.iter().zip(placed).zip(&joints.outlines))
    {
        let of_joint: Vec<ShadowSide> = std::iter::from_fn(|| sides.next_if(|side| side.joint == index))
            .map(|s| joints.side(s))
            .collect();
        let mut take = |sequence: Sequence, node: usize, sides: &[ShadowSide]| {
            let node = &mut nodes_of.entry(sequence).or_default()[node];
            node.outline.add(*outline);
            node.shadow_sides.extend_from_slice(sides);
            node.across_m2 += across_m2;
        };
        take(sequence, node, &of_joint);
        if joint.reverse == Reverse::Included {
            let by_road = is_by_road(&sequence[..count]);
            let back = of_joint.iter().map(|side| if by_road { mirrored(side) } else { *side });
            take(reversed(world, sequence, count), count - 1 - node, &back.collect::<Vec<_>>());
        }
    }
    nodes_of.values_mut().flatten().for_each(|node| {
        let mut sides = std::mem::take(&mut node.shadow_sides);
        node.outline.add(of_shadow_sides(&mut sides));
    });
    nodes_of
}

/// Weight of one node of a sequence with curved facets; `None` if all are flat.
fn curved_weight(curvatures_per_m: impl Iterator<Item = f64> + Clone, node: usize) -> Option<f64> {
    let mut squares = curvatures_per_m.map(|curvature| curvature * curvature);
    let all: f64 = squares.clone().sum();
    squares.nth(node).filter(|_| all > 0.0).map(|own| own / all)
}

/// Size relative to the largest node of a sequence below which a node is faded out, so that nothing jumps
/// when it vanishes.
const FADING: f64 = 0.1;

/// Minimum share of own edges assigned to a node: if none has own edges all count alike. Both constants were
/// chosen for continuity; 0.03 … 0.4 and 0.001 … 0.05 change the error against full-wave results by 0.05 dB.
const LEAST_SHARE: f64 = 0.02;

/// Weight of one node among the K of a sequence of flat patches.
fn flat_weight(nodes: &[SequenceNode], node: usize) -> f64 {
    let widest_m2 = nodes.iter().map(|node| node.across_m2).fold(f64::MIN_POSITIVE, f64::max);
    let presence = |node: &SequenceNode| (node.across_m2 / (FADING * widest_m2)).min(1.0);
    let share = |node: &SequenceNode| node.outline.own_share().max(LEAST_SHARE);
    let present: f64 = nodes.iter().map(presence).sum();
    let mean = nodes.iter().map(|node| presence(node) * share(node)).sum::<f64>() / present;
    let held = |node: &SequenceNode| presence(node) * share(node) + (1.0 - presence(node)) * mean;
    held(&nodes[node]) / nodes.iter().map(held).sum::<f64>()
}

/// Area of a joint's polygon across the wave, mean of both legs.
fn across_m2(trees: Trees<'_>, joint: &Joint, corners_m: &[DVec3]) -> f64 {
    let area = 0.5 * doubled_area(corners_m.iter().copied());
    let forward = &trees.transmit().beams[joint.forward as usize];
    let backward = &trees.receive().beams[joint.backward as usize];
    0.5 * [forward, backward]
        .map(|beam| area.dot(beam.image.travel_direction_at(corners_m[0])).abs())
        .iter()
        .sum::<f64>()
}

/// A joint assigned to a sequence.
struct PlacedJoint {
    /// Patches met by its path.
    sequence: Sequence,
    /// Index of its node among the patches.
    node: usize,
    /// Area of its polygon across the wave, mean of both legs.
    across_m2: f64,
}

fn place(world: &World, trees: Trees<'_>, joint: &Joint, corners_m: &[DVec3]) -> PlacedJoint {
    let (transmit, receive) = (trees.transmit(), trees.receive());
    let forward = &transmit.beams[joint.forward as usize];
    let backward = &receive.beams[joint.backward as usize];
    let node = usize::from(forward.order) - 1;
    let mut sequence = [u32::MAX; MAX_ORDER];
    for (place, beam) in (0..=node).rev().zip(transmit.mirror_chain(forward)) {
        sequence[place] = world.patch(beam.facet);
    }
    for (place, beam) in (node..MAX_ORDER).zip(receive.mirror_chain(backward)) {
        sequence[place] = world.patch(beam.facet);
    }
    if origin(receive, backward) == HalfSpace::Below {
        // The same patches with the road at the end form another path.
        sequence[node + usize::from(backward.order) - 1] |= BY_ROAD;
    }
    PlacedJoint { sequence, node, across_m2: across_m2(trees, joint, corners_m) }
}

/// Whether a sequence ends at the antenna's image below the road.
fn is_by_road(sequence: &[u32]) -> bool {
    sequence.last().is_some_and(|last| last & BY_ROAD != 0)
}

/// A side in the road's mirror, where windings are reversed.
fn mirrored(side: &ShadowSide) -> ShadowSide {
    let [from, to] = side.ends_m;
    ShadowSide { ends_m: [below(to), below(from)], ..*side }
}

/// Reverse sequence; one that ends at the antenna's image then starts there, and is taken in the road's
/// mirror.
fn reversed(world: &World, mut sequence: Sequence, count: usize) -> Sequence {
    let is_mirrored = is_by_road(&sequence[..count]);
    sequence[..count].reverse();
    if is_mirrored {
        sequence[0] &= !BY_ROAD;
        sequence[..count].iter_mut().for_each(|patch| *patch = world.image_of(*patch));
        sequence[count - 1] |= BY_ROAD;
    }
    sequence
}

#[cfg(test)]
mod tests {
    use super::*;

    fn node(own_m: f64, across_m2: f64) -> SequenceNode {
        SequenceNode { outline: Outline { own_m, cut_m: 4.0 - own_m }, across_m2, ..SequenceNode::default() }
    }

    fn weights(nodes: &[SequenceNode]) -> Vec<f64> {
        (0..nodes.len()).map(|i| flat_weight(nodes, i)).collect()
    }

    fn assert_near(got: &[f64], asked: &[f64]) {
        let near = got.iter().zip(asked).all(|(g, a)| (g - a).abs() < 1e-12);
        assert!(near && got.len() == asked.len(), "asked {asked:?}, got {got:?}");
    }

    #[test]
    fn a_node_counts_by_its_own_edges_and_without_any_all_count_alike() {
        assert_near(&weights(&[node(1.0, 1.0), node(3.0, 2.0)]), &[0.25, 0.75]);
        assert_near(&weights(&[node(0.0, 1.0), node(0.0, 1.0), node(0.0, 1.0)]), &[1.0 / 3.0; 3]);
    }

    #[test]
    fn a_missing_node_holds_a_mean_share_and_one_that_vanishes_comes_to_it() {
        let missing = SequenceNode::default;
        let [first, _, last] = weights(&[node(1.0, 1.0), missing(), node(3.0, 2.0)])[..] else {
            panic!("three nodes")
        };
        assert_near(&[first, last], &[0.25 * 2.0 / 3.0, 0.75 * 2.0 / 3.0]);
        let vanishing = weights(&[node(1.0, 1.0), node(4.0, 1e-15), node(3.0, 2.0)]);
        assert_near(&[vanishing[0], vanishing[2]], &[first, last]);
    }

    #[test]
    fn of_curved_facets_the_one_with_the_smaller_radius_has_the_node() {
        let weights = |list: &[f64]| {
            (0..list.len()).map(|i| curved_weight(list.iter().copied(), i)).collect::<Vec<_>>()
        };
        assert_eq!(weights(&[0.0, 2.0]), [Some(0.0), Some(1.0)]);
        assert_eq!(weights(&[2.0, 2.0]), [Some(0.5), Some(0.5)]);
        assert_eq!(weights(&[0.0, 0.0]), [None, None]);
    }
}
