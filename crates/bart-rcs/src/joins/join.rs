//! Joins: a forward and a backward beam that end on one facet make a path for every facet sequence, each
//! counted once.
//!
//! The integral of a sequence of K facets could be taken on any of the K. For smooth mirrors these are one
//! contribution seen at different nodes, not K contributions, so a rule selects:
//!
//! | K | middle: (order of b1, order of b2), weight | exit | own edge |
//! |---|---|---|---|
//! | odd | ((K+1)/2, (K+1)/2), 1 | (K, 1), 1 | (m, K+1−m) for every m, weights of [`crate::joins::own_edge`] |
//! | even | (K/2+1, K/2) and (K/2, K/2+1), ½ each | (K, 1), 1 | the same |
//!
//! If transmitter and receiver share a tree, every middle join is the reverse of another one, which is its
//! transpose, and so is every join of the own-edge rule: only one of the two is made. The same holds with a
//! road, whose mirror contains the reverse path.

use crate::beams::beam::{Beam, BeamTree};
use crate::beams::occlusion::shadow::LitSide;
use crate::bodies::world::World;
use crate::geometry::border::BorderLine;
use crate::geometry::convex_intersection::{bounds, intersection};
use crate::geometry::plane_frame::{PlaneFrame, area_m2};
use crate::joins::joint::{Joints, Reverse, SideOfJoint, Trees};
use crate::joins::outline::{BorderedPolygon, Outline};
use crate::joins::own_edge::weigh;
use artifact::settings::NodeRule;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::ops::Range;

/// All joints of `order` bounces; overlaps below `least_area_m2` are dropped.
pub(crate) fn joints(
    world: &World,
    trees: Trees<'_>,
    order: u8,
    rule: NodeRule,
    least_area_m2: f64,
) -> Joints {
    let mut all = Joints::default();
    let tolerance_m = ONE_LINE * world.tolerance_m();
    let limits = Limits { least_area_m2, one_line_m: (rule == NodeRule::OwnEdge).then_some(tolerance_m) };
    for meeting in meetings(trees, order, rule) {
        let forward = ByFacet::of_order(trees.transmit(), meeting.orders[0]);
        let backward = ByFacet::of_order(trees.receive(), meeting.orders[1]);
        let common = forward.common(&backward);
        let on_facet = |&(facet, ref left, ref right): &(u32, Range<usize>, Range<usize>)| {
            let frame = PlaneFrame::new(world.facet(facet).corners_m[0], world.facet(facet).normal());
            let beams = [&forward.beams[left.clone()], &backward.beams[right.clone()]];
            on_one_facet(trees, &meeting, &frame, beams, limits)
        };
        let parts: Vec<Joints> = common.par_iter().map(on_facet).collect();
        parts.into_iter().for_each(|part| all.append(part));
    }
    if rule == NodeRule::OwnEdge && order > 1 {
        weigh(world, trees, order, &mut all);
    }
    all
}

/// Factor on the tolerance within which edges of two beams are one line of the mesh: they differ by rounding
/// of mirrored planes, which grows with the length via the mirror: at most a few thousand tolerances, 3e-8 m
/// at 60 m and 1e-5 of a wavelength.
const ONE_LINE: f64 = 1e4;

/// Limits below which a piece is too small to count.
#[derive(Clone, Copy)]
struct Limits {
    least_area_m2: f64,
    /// Distance within which edges are one line, m; `None` if outlines are not requested.
    one_line_m: Option<f64>,
}

/// Maximum order of beams that a rule needs for `bounces`.
pub(crate) fn tree_order(bounces: u8, rule: NodeRule) -> u8 {
    match rule {
        NodeRule::Middle => bounces / 2 + 1,
        NodeRule::Exit | NodeRule::OwnEdge => bounces,
    }
}

/// One row of the table above.
struct BeamOrders {
    orders: [u8; 2],
    weight: f64,
    pairs: BeamPairs,
}

/// Pairs of beams on a facet that are joined.
#[derive(Clone, Copy, PartialEq, Eq)]
enum BeamPairs {
    /// All pairs, each by itself.
    Ordered,
    /// All pairs, each with its reverse.
    WithReverse,
    /// One tree, one order: each unordered pair with its reverse, and each beam with itself.
    Unordered,
}

fn meetings(trees: Trees<'_>, order: u8, rule: NodeRule) -> Vec<BeamOrders> {
    let half = order / 2;
    let place = if matches!(trees, Trees::Apart(..)) { EndPlaces::Apart } else { EndPlaces::Shared };
    let with = |orders: [u8; 2], pairs: BeamPairs| BeamOrders { orders, weight: 1.0, pairs };
    match (rule, order % 2, place) {
        (NodeRule::OwnEdge, _, EndPlaces::Apart) => {
            (1..=order).map(|m| with([m, order + 1 - m], BeamPairs::Ordered)).collect()
        }
        (NodeRule::OwnEdge, _, EndPlaces::Shared) if order != 1 => (order.div_ceil(2)..=order)
            .filter(|m| 2 * m > order)
            .map(|m| {
                with(
                    [m, order + 1 - m],
                    if 2 * m == order + 1 { BeamPairs::Unordered } else { BeamPairs::WithReverse },
                )
            })
            .collect(),
        // Its bracket is not reciprocal: with a road even for one bounce the reverse does not have the
        // transposed amplitude.
        (NodeRule::Exit, ..) if order != 1 || matches!(trees, Trees::ByRoad(..)) => {
            vec![BeamOrders { orders: [order, 1], weight: 1.0, pairs: BeamPairs::Ordered }]
        }
        (_, 1, EndPlaces::Shared) => {
            vec![BeamOrders { orders: [half + 1; 2], weight: 1.0, pairs: BeamPairs::Unordered }]
        }
        (_, 1, EndPlaces::Apart) => {
            vec![BeamOrders { orders: [half + 1; 2], weight: 1.0, pairs: BeamPairs::Ordered }]
        }
        (_, _, EndPlaces::Shared) => {
            vec![BeamOrders { orders: [half + 1, half], weight: 0.5, pairs: BeamPairs::WithReverse }]
        }
        (_, _, EndPlaces::Apart) => [[half + 1, half], [half, half + 1]]
            .map(|orders| BeamOrders { orders, weight: 0.5, pairs: BeamPairs::Ordered })
            .into(),
    }
}

/// Whether both ends are at one place.
#[derive(Clone, Copy)]
enum EndPlaces {
    Shared,
    Apart,
}

/// Beams of one order sorted by facet.
struct ByFacet {
    /// Pairs (facet, beam), ascending.
    beams: Vec<(u32, u32)>,
}

impl ByFacet {
    fn of_order(tree: &BeamTree, order: u8) -> Self {
        let start = tree.beams.partition_point(|beam| beam.order < order);
        let end = tree.beams.partition_point(|beam| beam.order <= order);
        let mut beams: Vec<(u32, u32)> = (start..end).map(|i| (tree.beams[i].facet, i as u32)).collect();
        beams.sort_unstable();
        Self { beams }
    }

    /// Facets that occur on both sides, with the ranges of their beams.
    fn common(&self, other: &Self) -> Vec<(u32, Range<usize>, Range<usize>)> {
        let (mut i, mut j) = (0, 0);
        let mut found = Vec::new();
        while let (Some(&(left, _)), Some(&(right, _))) = (self.beams.get(i), other.beams.get(j)) {
            let (i_end, j_end) = (self.end_of(i), other.end_of(j));
            if left == right {
                found.push((left, i..i_end, j..j_end));
            }
            i = if left <= right { i_end } else { i };
            j = if right <= left { j_end } else { j };
        }
        found
    }

    fn end_of(&self, start: usize) -> usize {
        let facet = self.beams[start].0;
        start + self.beams[start..].partition_point(|(f, _)| *f == facet)
    }
}

fn on_one_facet(
    trees: Trees<'_>,
    meeting: &BeamOrders,
    frame: &PlaneFrame,
    beams: [&[(u32, u32)]; 2],
    limits: Limits,
) -> Joints {
    let mut joints = Joints::default();
    if meeting.orders == [1, 1] && meeting.pairs == BeamPairs::Unordered && matches!(trees, Trees::Shared(_))
    {
        for &(_, beam) in beams[0] {
            joints.push(
                (beam, beam),
                meeting.weight,
                Reverse::Apart,
                polygon(trees.transmit(), beam).iter().copied(),
            );
        }
        return joints;
    }
    let forward: Vec<Footprint> =
        beams[0].iter().map(|&(_, b)| Footprint::new(trees.transmit(), b, frame)).collect();
    let backward: Vec<Footprint> =
        beams[1].iter().map(|&(_, b)| Footprint::new(trees.receive(), b, frame)).collect();
    for (i, j) in overlapping(&forward, &backward) {
        let (left, right) = (&forward[i], &backward[j]);
        let reverse = match meeting.pairs {
            BeamPairs::Unordered if left.beam > trees.twin(right.beam) => continue,
            BeamPairs::Unordered if left.beam == trees.twin(right.beam) => Reverse::Apart,
            BeamPairs::Unordered | BeamPairs::WithReverse => Reverse::Included,
            BeamPairs::Ordered => Reverse::Apart,
        };
        let part = intersection(&left.corners_m, &right.corners_m);
        let area = area_m2(&part);
        if area < limits.least_area_m2 || part.is_empty() {
            let both_ways = if reverse == Reverse::Included { 2.0 * area } else { area };
            joints.dropped_sections =
                [joints.dropped_sections[0] + both_ways, joints.dropped_sections[1] + both_ways.powi(2)];
            continue;
        }
        if let Some(one_line_m) = limits.one_line_m {
            let (joint, sides) = (joints.list.len() as u32, &mut joints.shadow_sides);
            let bordered = [&left.bordered(), &right.bordered()];
            joints.outlines.push(Outline::of_overlap(&part, bordered, one_line_m, |i, border| {
                sides.push(SideOfJoint { joint, corner: left.corner_in_world(i, part.len()), border });
            }));
        }
        joints.push((left.beam, right.beam), meeting.weight, reverse, left.in_world(frame, part));
    }
    joints
}

fn polygon(tree: &BeamTree, beam: u32) -> &[DVec3] {
    tree.polygon(&tree.beams[beam as usize])
}

/// A beam's polygon on the plane of its facet, seen from the side of the facet's own normal.
struct Footprint {
    beam: u32,
    /// Counter-clockwise about the facet's own normal.
    corners_m: Vec<DVec2>,
    borders: Vec<BorderLine>,
    side: LitSide,
    bounds_m: [DVec2; 2],
}

impl Footprint {
    fn new(tree: &BeamTree, index: u32, frame: &PlaneFrame) -> Self {
        let beam: &Beam = &tree.beams[index as usize];
        let mut corners_m: Vec<DVec2> =
            tree.polygon(beam).iter().map(|c| frame.plane_from_world(*c)).collect();
        let side = if frame.normal().dot(beam.lit_normal) > 0.0 { LitSide::Front } else { LitSide::Back };
        let mut borders = tree.borders(beam).to_vec();
        if side == LitSide::Back {
            // The edge from corner i to the next becomes the one between their positions in the reversed
            // order.
            corners_m.reverse();
            borders.reverse();
            borders.rotate_left(1);
        }
        Self { beam: index, bounds_m: bounds(&corners_m), corners_m, borders, side }
    }

    fn bordered(&self) -> BorderedPolygon<'_> {
        BorderedPolygon { corners_m: &self.corners_m, borders: &self.borders }
    }

    /// Corners around the facet's normal, transformed into the world and ordered around the lit normal.
    fn in_world(&self, frame: &PlaneFrame, mut corners_m: Vec<DVec2>) -> impl Iterator<Item = DVec3> {
        if self.side == LitSide::Back {
            corners_m.reverse();
        }
        let frame = *frame;
        corners_m.into_iter().map(move |c| frame.to_world(c))
    }

    /// Index of a side's first corner among `count` corners transformed by [`Self::in_world`].
    fn corner_in_world(&self, side: usize, count: usize) -> u32 {
        if self.side == LitSide::Back { ((2 * count - 2 - side) % count) as u32 } else { side as u32 }
    }

    fn meets(&self, other: &Self) -> bool {
        let overlaps =
            |low: f64, high: f64, other_low: f64, other_high: f64| low < other_high && other_low < high;
        let ([a, b], [c, d]) = (self.bounds_m, other.bounds_m);
        self.side == other.side && overlaps(a.x, b.x, c.x, d.x) && overlaps(a.y, b.y, c.y, d.y)
    }
}

/// Pairs whose boxes overlap, ascending: a sweep along x maintains both lists' open boxes.
fn overlapping(left: &[Footprint], right: &[Footprint]) -> Vec<(usize, usize)> {
    let mut starts: Vec<(f64, usize, bool)> =
        left.iter().enumerate().map(|(i, f)| (f.bounds_m[0].x, i, true)).collect();
    starts.extend(right.iter().enumerate().map(|(i, f)| (f.bounds_m[0].x, i, false)));
    starts.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(b.2.cmp(&a.2)));
    let (mut open_left, mut open_right): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
    let mut pairs = Vec::new();
    for (x, i, of_left) in starts {
        if of_left {
            open_right.retain(|&j| right[j].bounds_m[1].x > x);
            pairs.extend(open_right.iter().filter(|&&j| left[i].meets(&right[j])).map(|&j| (i, j)));
            open_left.push(i);
        } else {
            open_left.retain(|&j| left[j].bounds_m[1].x > x);
            pairs.extend(open_left.iter().filter(|&&j| left[j].meets(&right[i])).map(|&j| (j, i)));
            open_right.push(i);
        }
    }
    pairs.sort_unstable();
    pairs
}
