//! Share of a plate's bound that mirrors too small to be followed would scatter, estimated from the smallest
//! followed ones.
//!
//! A mirror of area a across the wave scatters no more than a plate, |S| ≤ k/√π·a. Most of its reflection
//! escapes, though; what meets a facet counts only if the other end sees that facet as well; and there its
//! phase varies. The mean of |S|² over mirrors is therefore a share of (k/√π·a)². For a followed mirror of
//! area A whose joints have the areas a_j, seen along the beam, a part of area a₀ anywhere on it overlaps
//! joint j by a_j·a₀/A on average. Where it does, assume that one of the two lies completely in the other,
//! which maximises a mean of squares: this has the probability max(a_j, a₀)/A, and the scattering is that of
//! j reduced to at most a₀:
//!
//! share = Σ_j max(a_j, a₀)/A · |S_j(made no larger than a₀)|²/(k/√π·a₀)²
//!
//! An edge is a line, and scatters by its length: for a part of side √a₀ that lights joint j of an edge,
//! whose length across the beam is l_j, the probability is max(l_j, √a₀)·√a₀/A, and the scattering is that of
//! j reduced to at most √a₀. If a₀ is below 1/k² that exceeds a plate's, and no bound of plates holds:
//!
//! share of edges = Σ_j max(l_j, √a₀)·√a₀/A · |S_j(made no longer than √a₀)|²/(k/√π·a₀)²
//!
//! Here a₀ is the mean area of the unfollowed mirrors. The assumption is that mirrors too small to be
//! followed lie among facets and edges like the smallest of the larger ones.

use crate::beams::beam::{Beam, BeamTree, MirrorShare};
use crate::edges::edge_scattering::part_amplitudes;
use crate::edges::lit_edge::EdgeJoint;
use crate::geometry::clip::doubled_area;
use crate::joins::joint::{Joint, Trees};
use crate::joins::scatterer::{Integration, PolygonPart, Scatterer, with_reverse};
use crate::table::order_joints::OrderJoints;
use artifact::radar::Polarization;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Number of followed mirrors sampled per order, or every n-th so that at least half as many are: the sums of
/// their shares are accurate to a third or better, since a few in a hundred dominate them, and cost a
/// twentieth of an aspect.
const MIRRORS_PER_ORDER: usize = 2048;
/// Maximum area of these mirrors relative to the smallest followed one: they are at most four times as long.
const LARGEST: f64 = 16.0;

/// Smallest followed mirrors of every reflected order, with their scattering.
pub(crate) struct SmallMirrors {
    samples: Vec<TreeSample>,
}

/// Sample of one order of one end's tree.
struct TreeSample {
    end: usize,
    order: u8,
    /// Beams of the tree, ascending.
    mirrors: Vec<u32>,
    /// Mean area across the wave of the unfollowed ones, weighted by itself, m².
    area_m2: f64,
    /// Share of every mirror, summed over its joints.
    shares: Vec<f64>,
    /// Share of every mirror, summed over its joints on edges.
    edge_shares: Vec<f64>,
}

/// A sampled mirror and the contribution of a joint to its share.
pub(crate) struct Hit {
    sample: usize,
    place: usize,
    share: f64,
    on: MirrorTarget,
}

/// Target of a mirror.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum MirrorTarget {
    Facet,
    Edge,
}

impl SmallMirrors {
    /// Mirrors of trees whose first `needed` orders are joined, with mirrors from `least_m2` on followed.
    pub(crate) fn of(trees: Trees<'_>, needed: u8, least_m2: f64) -> Self {
        let of_end = |(end, tree): (usize, &BeamTree)| {
            (1..needed).filter_map(|order| TreeSample::of(tree, end, order, least_m2)).collect::<Vec<_>>()
        };
        Self { samples: ends(trees).enumerate().flat_map(of_end).collect() }
    }

    /// Hits by the joints of one order on facets and on edges, at the highest wavenumber.
    pub(crate) fn hits(
        &self,
        scatterer: &Scatterer<'_>,
        meeting: &OrderJoints,
        integration: &Integration<'_>,
        polarization: Polarization,
    ) -> Vec<Hit> {
        let highest = integration.wavenumbers_per_m.iter().copied().max_by(f64::total_cmp);
        let Some(wavenumber_per_m) = highest else { return Vec::new() };
        let look =
            MirrorProbe { scatterer, samples: &self.samples, wavenumber_per_m, integration, polarization };
        let joints = &meeting.facets;
        let of_joint = |joint: &Joint| look.hits(joint, joints.polygon(joint));
        let of_facets: Vec<Vec<Hit>> =
            joints.list.par_iter().with_min_len(JOINTS_PER_RUN).map(of_joint).collect();
        let of_edge = |joint: &EdgeJoint| look.edge_hits(joint);
        let of_edges: Vec<Vec<Hit>> =
            meeting.edges.par_iter().with_min_len(JOINTS_PER_RUN).map(of_edge).collect();
        of_facets.into_iter().chain(of_edges).flatten().collect()
    }

    /// Adds hits to their samples.
    pub(crate) fn add(&mut self, hits: Vec<Hit>) {
        for Hit { sample, place, share, on } in hits {
            let sample = &mut self.samples[sample];
            let shares = if on == MirrorTarget::Edge { &mut sample.edge_shares } else { &mut sample.shares };
            shares[place] += share;
        }
    }

    /// Amplitude of the dropped parts, k/√π times the area across the wave of dropped beams, of unfollowed
    /// mirrors and of overlaps too small to be joined, given as areas and their squares: with independent
    /// phases and the estimated share of mirrors, and all as one sum.
    pub(crate) fn dropped_m(
        &self,
        trees: Trees<'_>,
        overlaps: impl Iterator<Item = [f64; 2]>,
        (needed, wavenumbers_per_m): (u8, &[f64]),
    ) -> [f64; 2] {
        let highest = wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
        let factor = highest / PI.sqrt();
        let of_tree = |(end, tree): (usize, &BeamTree)| tree.audit.dropped_sections(needed, self.shares(end));
        let all = ends(trees).enumerate().map(of_tree).chain(overlaps);
        let [sum_m2, squares_m4] = all.fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        [factor * squares_m4.sqrt(), factor * sum_m2]
    }

    /// Share of the squared plate bound by order from 1 of an end's tree; 1 if unknown.
    pub(crate) fn shares(&self, end: usize) -> impl Fn(u8) -> MirrorShare {
        move |order| {
            self.samples
                .iter()
                .find(|s| (s.end, s.order) == (end, order))
                .map_or(MirrorShare { mean: 1.0, spread: 0.0 }, TreeSample::share)
        }
    }
}

/// Trees of both ends, or their common one.
fn ends(trees: Trees<'_>) -> impl Iterator<Item = &BeamTree> {
    let receive = matches!(trees, Trees::Apart(..)).then(|| trees.receive());
    [Some(trees.transmit()), receive].into_iter().flatten()
}

/// Number of joints examined by one thread in turn.
const JOINTS_PER_RUN: usize = 256;

impl TreeSample {
    /// Sample of an order; `None` if none of it was left unfollowed.
    fn of(tree: &BeamTree, end: usize, order: u8, least_m2: f64) -> Option<Self> {
        let audit = tree.audit.orders.get(usize::from(order) - 1)?;
        let area_m2 = audit.unreflected_across_squared_m4 / audit.unreflected_across_m2;
        let start = tree.beams.partition_point(|beam| beam.order < order);
        let stop = tree.beams.partition_point(|beam| beam.order <= order);
        let area = |index: u32| tree.beams[index as usize].across_m2;
        let is_small = |index: &u32| (least_m2..LARGEST * least_m2).contains(&area(*index));
        let mirrors: Vec<u32> = (start as u32..stop as u32).filter(is_small).collect();
        let mirrors: Vec<u32> =
            mirrors.iter().copied().step_by(mirrors.len().div_ceil(MIRRORS_PER_ORDER).max(1)).collect();
        let shares = vec![0.0; mirrors.len()];
        let edge_shares = shares.clone();
        (area_m2 > 0.0).then_some(Self { end, order, mirrors, area_m2, shares, edge_shares })
    }

    /// Mean of the shares, as an upper limit in 95 of 100 cases.
    ///
    /// The sum of n independent shares errs by √Σ share², and 95 of 100 normal errors are below 1.645 of
    /// these. It says nothing about shares rarer than one in n: 3/n of the mirrors may be whole plates of
    /// which none was sampled (e⁻³ = 5 %).
    fn share(&self) -> MirrorShare {
        // Without mirrors nothing is known: the quotient is infinite. A beam grazing a facet lights more of
        // it than its own cross-section: what was met may exceed plates.
        let count = self.mirrors.len() as f64;
        let met = at_most(&self.shares);
        let of_facets = ((met + 3.0) / count).min(1.0).max(met / count.max(1.0));
        let mean = of_facets + at_most(&self.edge_shares) / count.max(1.0);
        let all = || self.shares.iter().zip(&self.edge_shares).map(|(facet, edge)| facet + edge);
        let found = all().sum::<f64>() / count.max(1.0);
        let variance = all().map(|share| (share - found).powi(2)).sum::<f64>() / count.max(1.0);
        MirrorShare { mean, spread: 1.645 * variance.sqrt() }
    }
}

/// Sum of independent shares, as an upper limit in 95 of 100 cases.
fn at_most(shares: &[f64]) -> f64 {
    shares.iter().sum::<f64>() + 1.645 * shares.iter().map(|share| share * share).sum::<f64>().sqrt()
}

/// Data for examining joints.
struct MirrorProbe<'a> {
    scatterer: &'a Scatterer<'a>,
    samples: &'a [TreeSample],
    wavenumber_per_m: f64,
    integration: &'a Integration<'a>,
    polarization: Polarization,
}

/// Accuracy of shares, needed to 10 %.
const ACCURACY: f64 = 0.1;

impl MirrorProbe<'_> {
    /// Hits of a joint: its contribution to each sampled mirror on its paths.
    fn hits(&self, joint: &Joint, corners_m: &[DVec3]) -> Vec<Hit> {
        if joint.weight == 0.0 {
            return Vec::new();
        }
        self.on_ways([joint.forward, joint.backward], MirrorTarget::Facet, |way, mirror| {
            self.share(joint, corners_m, way, mirror)
        })
    }

    /// Hits of a joint on an edge.
    fn edge_hits(&self, joint: &EdgeJoint) -> Vec<Hit> {
        self.on_ways([joint.forward, joint.backward], MirrorTarget::Edge, |way, mirror| {
            self.edge_share(joint, way, mirror)
        })
    }

    /// Hits on both paths of a joint, from its share of each end's beam and a sampled mirror.
    fn on_ways(
        &self,
        beams: [u32; 2],
        on: MirrorTarget,
        share: impl Fn((usize, u32), (usize, usize)) -> f64,
    ) -> Vec<Hit> {
        let mut hits: Vec<Hit> = Vec::new();
        for (end, beam) in beams.into_iter().enumerate() {
            for (sample, place) in self.sampled_on_way(end, beam) {
                // A mirror on both paths is lost once.
                if !hits.iter().any(|hit| (hit.sample, hit.place) == (sample, place)) {
                    hits.push(Hit { sample, place, share: share((end, beam), (sample, place)), on });
                }
            }
        }
        hits
    }

    /// Samples and positions in them of the mirrors met by a beam.
    fn sampled_on_way(&self, end: usize, beam: u32) -> impl Iterator<Item = (usize, usize)> {
        let trees = self.scatterer.trees;
        let tree = self.tree(end);
        let mirrors =
            std::iter::successors(tree.beams[beam as usize].parent, |m| tree.beams[*m as usize].parent);
        mirrors.filter_map(move |mirror| {
            let order = tree.beams[mirror as usize].order;
            let (of_end, mirror) = match (end, trees) {
                (0, _) => (0, mirror),
                (_, Trees::Apart(..)) => (1, mirror),
                (_, Trees::Shared(_) | Trees::ByRoad(..)) => (0, trees.twin(mirror)),
            };
            let sample = self.samples.iter().position(|s| (s.end, s.order) == (of_end, order))?;
            Some((sample, self.samples[sample].mirrors.binary_search(&mirror).ok()?))
        })
    }

    /// Share max(a_j, a₀)/A · |S_j(made no larger than a₀)|²/(k/√π·a₀)².
    fn share(
        &self,
        joint: &Joint,
        corners_m: &[DVec3],
        (end, beam): (usize, u32),
        (sample, place): (usize, usize),
    ) -> f64 {
        let sample = &self.samples[sample];
        let middle_m = corners_m.iter().sum::<DVec3>() / corners_m.len() as f64;
        let area_m2 = across_m2(&self.tree(end).beams[beam as usize], corners_m, middle_m);
        let mirror = &self.tree(sample.end).beams[sample.mirrors[place] as usize];
        let scale = (sample.area_m2 / area_m2).min(1.0);
        let small_m: Vec<DVec3> =
            corners_m.iter().map(|x| middle_m + scale.sqrt() * (x - middle_m)).collect();
        let part =
            PolygonPart { corners_m: &small_m, reference_m: middle_m, bracket: self.integration.bracket };
        let amplitudes = self.scatterer.amplitudes(joint, &part, &[self.wavenumber_per_m], ACCURACY).value;
        let (p, q) = self.polarization.indices();
        let scattered = with_reverse(joint.reverse, &amplitudes[0])[p][q].norm_sqr();
        let plate_m = self.wavenumber_per_m / PI.sqrt() * sample.area_m2;
        (area_m2.max(sample.area_m2) / mirror.across_m2).min(1.0) * scattered / (plate_m * plate_m)
    }

    /// Share max(l_j, √a₀)·√a₀/A · |S_j(made no longer than √a₀)|²/(k/√π·a₀)² of a joint on an edge.
    fn edge_share(
        &self,
        joint: &EdgeJoint,
        (end, beam): (usize, u32),
        (sample, place): (usize, usize),
    ) -> f64 {
        let sample = &self.samples[sample];
        let mirror = &self.tree(sample.end).beams[sample.mirrors[place] as usize];
        let edge = &self.scatterer.world.edges_in(joint.band).edges[joint.edge as usize];
        let [from_m, to_m] = joint.span_m;
        let middle = 0.5 * (from_m + to_m);
        let towards = self.tree(end).beams[beam as usize].image.towards(edge.point_m(middle));
        let across_m = (to_m - from_m) * edge.wedge.along.cross(towards.normalize_or_zero()).length();
        let side_m = sample.area_m2.sqrt();
        let half_m = 0.5 * (to_m - from_m) * (side_m / across_m).min(1.0);
        let span_m = [middle - half_m, middle + half_m];
        let wavenumbers_per_m = [self.wavenumber_per_m];
        let (_, found) = part_amplitudes(self.scatterer, joint, span_m, &wavenumbers_per_m, ACCURACY);
        let (p, q) = self.polarization.indices();
        let scattered = with_reverse(joint.reverse, &found.value[0])[p][q].norm_sqr();
        let plate_m = self.wavenumber_per_m / PI.sqrt() * sample.area_m2;
        (across_m.max(side_m) * side_m / mirror.across_m2).min(1.0) * scattered / (plate_m * plate_m)
    }

    fn tree(&self, end: usize) -> &BeamTree {
        if end == 0 { self.scatterer.trees.transmit() } else { self.scatterer.trees.receive() }
    }
}

/// Area of a part of a beam's facet across the wave, m².
fn across_m2(beam: &Beam, corners_m: &[DVec3], middle_m: DVec3) -> f64 {
    let towards = beam.image.towards(middle_m).normalize_or_zero();
    0.5 * doubled_area(corners_m.iter().copied()).dot(towards).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::beam::TraceSettings;
    use crate::bodies::world::World;
    use crate::edges::edge_scattering::edge_share;
    use crate::geometry::antenna::Antenna;
    use crate::joins::join::tree_order;
    use crate::joins::scatterer::{ZenithH, bracket_of};
    use crate::table::order_joints::JointSettings;
    use artifact::scene::Mesh;
    use artifact::settings::{Edges, NodeRule, Sides};

    const WAVENUMBER_PER_M: f64 = 1613.0;
    const LEAST_M2: f64 = 1e-6;

    /// A floor of many small plates, of 0.6 to 3 mm so that some are below the minimum area and some are not,
    /// and walls.
    fn corner(walls: &[[[f64; 3]; 4]]) -> World {
        let mut mesh = Mesh::default();
        let mut face = |corners: &[[f64; 3]]| {
            let first = mesh.vertices_m.len() as u32;
            mesh.vertices_m.extend_from_slice(corners);
            mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        };
        for i in 0..900 {
            let (x, y) = (4e-3 * f64::from(i % 30), 4e-3 * f64::from(i / 30));
            let side = 6e-4 + 2.4e-3 * f64::from((i * 37) % 101) / 101.0;
            face(&[[x, y, 0.0], [x + side, y, 0.0], [x + side, y + side, 0.0], [x, y + side, 0.0]]);
        }
        walls.iter().for_each(|wall| face(wall));
        World::of_mesh(&mesh).unwrap()
    }

    /// Estimated share, and Σ|S|² contributed by the smaller mirrors over the bound, m².
    fn told_and_true(world: &World, edges: Edges) -> [f64; 2] {
        let antenna = Antenna::Direction(DVec3::new(0.6, 0.48, 0.64));
        let of = |least_mirror_area_m2: f64| {
            let trace =
                TraceSettings { max_order: 2, sides: Sides::Two, least_area_m2: 1e-9, least_mirror_area_m2 };
            let tree = BeamTree::trace(world, antenna, &trace).unwrap();
            let zenith_h = ZenithH { transmit: DVec3::Y, receive: DVec3::Y };
            let scatterer = Scatterer::new(world, Trees::Shared(&tree), zenith_h);
            let nodes = NodeRule::Exit;
            let integration = Integration {
                wavenumbers_per_m: &[WAVENUMBER_PER_M],
                accuracy: 1e-3,
                bracket: bracket_of(nodes),
            };
            let what =
                JointSettings { nodes, edges, least_area_m2: 1e-9, wavenumber_per_m: WAVENUMBER_PER_M };
            let mut mirrors = SmallMirrors::of(scatterer.trees, tree_order(2, nodes), least_mirror_area_m2);
            let mut power_m2 = 0.0;
            for order in 1..=2 {
                let meeting = OrderJoints::of(&scatterer, order, &what);
                mirrors.add(mirrors.hits(&scatterer, &meeting, &integration, Polarization::Vv));
                let joints = &meeting.facets;
                let is_small = |beam: u32| {
                    let parent = tree.beams[beam as usize].parent;
                    parent.is_some_and(|p| tree.beams[p as usize].across_m2 < LEAST_M2)
                };
                let power = |joint: &Joint| {
                    scatterer.scattering(joint, joints.polygon(joint), DVec3::ZERO, &integration).value[0][0]
                        [0]
                    .norm_sqr()
                };
                power_m2 +=
                    joints.list.iter().filter(|joint| is_small(joint.forward)).map(power).sum::<f64>();
                let of_edge = |joint: &EdgeJoint| {
                    edge_share(&scatterer, joint, DVec3::ZERO, &integration).value[0][0][0].norm_sqr()
                };
                let lit = meeting.edges.iter().filter(|at| is_small(at.forward) || is_small(at.backward));
                power_m2 += lit.map(of_edge).sum::<f64>();
            }
            (mirrors.shares(0)(1).mean, tree.audit.orders[0].unreflected_across_squared_m4, power_m2)
        };
        let (told, squares_m4, _) = of(LEAST_M2);
        let (_, _, power_m2) = of(1e-9);
        [told, power_m2 / (WAVENUMBER_PER_M.powi(2) / PI * squares_m4)]
    }

    /// The wall receives the floor's reflection, and returns it.
    #[test]
    fn mirrors_before_a_wall_are_told_to_scatter_what_they_do() {
        let wall = [[-0.02, -0.2, 0.0], [-0.02, 0.3, 0.0], [-0.02, 0.3, 0.3], [-0.02, -0.2, 0.3]];
        let [told, truth] = told_and_true(&corner(&[wall]), Edges::Ignored);
        println!("share told {told:.3}, true {truth:.3}");
        // At least the truth, and above it by no more than the margins of some hundred mirrors, 1.645/√100 =
        // 16 %, and the gain of small pieces with less phase variation: within half a wavelength a square
        // loses a third of its power at most.
        assert!(truth > 0.02 && told >= truth && told < 1.5 * truth);
    }

    /// Fins that are parallel to the floor's reflection to a degree, and are lit from above: no facet is met
    /// from both ends, but their front edges are.
    #[test]
    fn mirrors_before_edges_are_told_to_scatter_what_they_do() {
        let fin = |i: u32| {
            let front = 0.02 + 2e-3 * f64::from(i);
            let back = front + 0.0124;
            [[-0.02, -0.2, front], [-0.02, 0.3, front], [-0.032, 0.3, back], [-0.032, -0.2, back]]
        };
        let world = corner(&(0..60).map(fin).collect::<Vec<_>>());
        let [told, truth] = told_and_true(&world, Edges::FirstOrder);
        let [of_facets, _] = told_and_true(&world, Edges::Ignored);
        println!("share told {told:.3}, of facets alone {of_facets:.3}, true {truth:.3}");
        // At least the truth, and above it by no more than the difference for mirrors of another size.
        assert!(of_facets < truth && told >= truth && told < 3.0 * truth);
    }

    #[test]
    fn mirrors_before_nothing_are_told_to_scatter_next_to_nothing() {
        let [told, truth] = told_and_true(&corner(&[]), Edges::Ignored);
        println!("share told {told:.3}, true {truth:.3}");
        // 3 of some hundred might be plates.
        assert!(truth == 0.0 && told > 0.0 && told < 0.02);
    }

    #[test]
    fn where_no_mirror_was_followed_the_bound_stands() {
        let mesh = Mesh {
            vertices_m: vec![[0.0; 3], [1e-4, 0.0, 0.0], [0.0, 1e-4, 0.0]],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        let [told, _] = told_and_true(&World::of_mesh(&mesh).unwrap(), Edges::Ignored);
        assert!(told == 1.0);
    }
}
