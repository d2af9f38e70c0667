//! Scattering amplitude S of all edges lit from both ends.

use crate::edges::edge_currents::{edge_amplitudes, for_each_part};
use crate::edges::edge_node::{EdgeNode, EdgePart, PER_ROOT_PI, amplitude_of, spread};
use crate::edges::lit_edge::EdgeJoint;
use crate::edges::wave_exit::{ExitLeg, WaveExit};
use crate::integral::field::length_difference_m;
use crate::integral::node::Estimate;
use crate::joins::band::{self, Band, ContributionKind, Groups, INTERPOLATION_ERROR};
use crate::joins::joint::Reverse;
use crate::joins::scatterer::{Integration, PathLengthRange, Scatterer, scaled, sum as sum_of, with_reverse};
use artifact::paths::Amplitude;
use glam::DVec3;
use num_complex::Complex64;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// S of the edges on paths of `order` over frequency, 2 × 2, with its phase referred to `origin_m`: like that
/// of facets, from few frequencies (see [`crate::joins::band`]).
///
/// Fixed runs are summed in order, so the result is bit-identical for any number of threads.
pub(crate) fn sum_of_edges(
    scatterer: &Scatterer<'_>,
    joints: &[EdgeJoint],
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Vec<Amplitude> {
    let at_each = || sum_at_each(scatterer, joints, origin_m, integration);
    over_band(joints, integration, at_each, |joint, band, groups| {
        add_joint(scatterer, joint, origin_m, integration.accuracy, band, groups)
    })
}

/// Sum of contributions over frequency: `add` puts each into the groups of the band; `at_each` is their sum
/// at every frequency separately, used if there are too few to save any.
pub(crate) fn over_band<T: Sync>(
    shares: &[T],
    integration: &Integration<'_>,
    at_each: impl Fn() -> Vec<Amplitude>,
    add: impl Fn(&T, &Band<'_>, &mut Groups) + Sync,
) -> Vec<Amplitude> {
    let error = INTERPOLATION_ERROR * integration.accuracy;
    let Some(band) = Band::new(integration.wavenumbers_per_m, error, ContributionKind::Edges) else {
        return at_each();
    };
    let of_run = |run: &[T]| {
        let mut groups = Groups::new();
        run.iter().for_each(|share| add(share, &band, &mut groups));
        groups
    };
    band.sum(shares.par_chunks(EDGE_JOINTS_PER_RUN).map(of_run).collect())
}

/// Number of joints summed by one thread.
pub(crate) const EDGE_JOINTS_PER_RUN: usize = 64;

/// Adds the parts of a joint, including its reverse, to their groups.
fn add_joint(
    scatterer: &Scatterer<'_>,
    joint: &EdgeJoint,
    origin_m: DVec3,
    accuracy: f64,
    band: &Band<'_>,
    groups: &mut Groups,
) {
    let node = node(scatterer, joint, joint.span_m);
    let (spread, length_m) = way_from(scatterer, joint, node.middle_m(), origin_m);
    let whole = ReferencePath { spread, length_m, reverse: joint.reverse };
    let mut some = Vec::new();
    for_each_part(&node, node.middle_m(), band.highest_per_m(), accuracy, &mut |part, _| {
        whole.add_part(part, band, groups, &mut some);
    });
}

/// Factor and length of a contribution's reference point: R_tR_r/(L₁L₂) and L₁ + L₂ − R_t − R_r.
pub(crate) struct ReferencePath {
    pub(crate) spread: f64,
    pub(crate) length_m: f64,
    pub(crate) reverse: Reverse,
}

impl ReferencePath {
    /// Adds a part of the contribution, including its reverse, to its group; `some` is a buffer for its
    /// values, reused from part to part.
    pub(crate) fn add_part(
        &self,
        part: &dyn EdgePart,
        band: &Band<'_>,
        groups: &mut Groups,
        some: &mut Vec<[Complex64; 4]>,
    ) {
        let way = part.path_length_range();
        let group = band.group(PathLengthRange { length_m: way.length_m + self.length_m, ..way }, groups);
        some.clear();
        some.resize(group.wavenumbers_per_m.len(), [Complex64::ZERO; 4]);
        part.add_to(group.wavenumbers_per_m, some);
        let turned_m = self.length_m - group.length_m;
        for ((sum, part), k) in group.sums.iter_mut().zip(some.iter()).zip(group.wavenumbers_per_m) {
            let both = with_reverse(self.reverse, &amplitude_of(part));
            *sum = sum_of(sum, &scaled(&both, Complex64::from_polar(self.spread, -k * turned_m)));
        }
    }
}

/// Sums at every frequency separately: the reference of the interpolation.
fn sum_at_each(
    scatterer: &Scatterer<'_>,
    joints: &[EdgeJoint],
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Vec<Amplitude> {
    band::sum_at_each(joints, EDGE_JOINTS_PER_RUN, integration.wavenumbers_per_m.len(), |joint| {
        edge_share(scatterer, joint, origin_m, integration).value
    })
}

/// Amplitudes of a part of a joint referred to its centre; the reverse is not included.
pub(crate) fn part_amplitudes(
    scatterer: &Scatterer<'_>,
    joint: &EdgeJoint,
    span_m: [f64; 2],
    wavenumbers_per_m: &[f64],
    accuracy: f64,
) -> (DVec3, Estimate<Vec<Amplitude>>) {
    let node = node(scatterer, joint, span_m);
    (node.middle_m(), edge_amplitudes(&node, node.middle_m(), wavenumbers_per_m, accuracy))
}

/// Waves of a part of an edge that leave from one place, referred to the apparent ends of their paths.
pub(crate) struct EdgeWave {
    /// Points of the body at which the wave arrives from the transmitter and leaves to the receiver.
    pub(crate) nodes_m: [DVec3; 2],
    /// The same seen along the paths: one lies behind its point by the path length over faces.
    pub(crate) ends_m: [DVec3; 2],
    pub(crate) estimate: Estimate<Vec<Amplitude>>,
}

impl EdgeWave {
    /// Waves that leave from the point at which they arrive.
    pub(crate) fn at(middle_m: DVec3, estimate: Estimate<Vec<Amplitude>>) -> Self {
        Self { nodes_m: [middle_m; 2], ends_m: [middle_m; 2], estimate }
    }
}

/// Waves of a part of a joint, gathered by the place where they leave: those over faces longer than `size_m`
/// leave elsewhere, since their phase turns with the frequency by that length. The reverse is not included.
pub(crate) fn part_waves(
    scatterer: &Scatterer<'_>,
    joint: &EdgeJoint,
    span_m: [f64; 2],
    (wavenumbers_per_m, size_m): (&[f64], f64),
    accuracy: f64,
) -> Vec<EdgeWave> {
    let node = node(scatterer, joint, span_m);
    // Two legs even of one antenna: a wave over faces leaves from either end.
    let receive = node.receive.clone();
    let node = EdgeNode { receive: &receive, ..node };
    let middle_m = node.middle_m();
    let highest_per_m = wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
    let mut groups: BTreeMap<Option<ExitCell>, PartSum> = BTreeMap::new();
    for_each_part(&node, middle_m, highest_per_m, accuracy, &mut |part, error| {
        let exit = part.exit().filter(|exit| exit.way_m > size_m);
        let of_exit = exit.map(|exit| ExitCell::of(&exit, middle_m, size_m));
        let zero = || PartSum { exit, sums: vec![[Complex64::ZERO; 4]; wavenumbers_per_m.len()], error: 0.0 };
        let group = groups.entry(of_exit).or_insert_with(zero);
        part.add_to(wavenumbers_per_m, &mut group.sums);
        group.error += error;
    });
    groups.into_values().map(|group| group.wave(&node, middle_m, wavenumbers_per_m)).collect()
}

/// Cell of a grid of places and path lengths in which a wave leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct ExitCell {
    towards: ExitLeg,
    cell: [i64; 4],
}

impl ExitCell {
    fn of(exit: &WaveExit, from_m: DVec3, size_m: f64) -> Self {
        let [x, y, z] = (exit.end_m - from_m).to_array();
        Self { towards: exit.towards, cell: [x, y, z, exit.way_m].map(|m| (m / size_m).round() as i64) }
    }
}

/// Sum over the parts that leave in one cell.
struct PartSum {
    exit: Option<WaveExit>,
    sums: Vec<[Complex64; 4]>,
    error: f64,
}

impl PartSum {
    /// The wave, referred to its own apparent ends instead of the middle of the part.
    fn wave(self, node: &EdgeNode<'_>, middle_m: DVec3, wavenumbers_per_m: &[f64]) -> EdgeWave {
        let value = self.sums.iter().map(amplitude_of).collect();
        let mut wave = EdgeWave::at(middle_m, Estimate { value, error: self.error * PER_ROOT_PI });
        let Some(WaveExit { end_m, way_m, towards }) = self.exit else { return wave };
        let (leg, side) = match towards {
            ExitLeg::Transmit => (node.transmit, 0),
            ExitLeg::Receive => (node.receive, 1),
        };
        let behind_m = end_m + way_m * leg.image.travel_direction_at(end_m);
        let (longer_m, weaker) =
            (length_difference_m(leg.image, behind_m, middle_m), spread(leg.image, behind_m, middle_m));
        for (amplitude, k) in wave.estimate.value.iter_mut().zip(wavenumbers_per_m) {
            *amplitude = scaled(amplitude, Complex64::from_polar(1.0 / weaker, k * longer_m));
        }
        wave.estimate.error /= weaker;
        (wave.nodes_m[side], wave.ends_m[side]) = (end_m, behind_m);
        wave
    }
}

fn node<'a>(scatterer: &'a Scatterer<'_>, joint: &EdgeJoint, span_m: [f64; 2]) -> EdgeNode<'a> {
    let edges = scatterer.world.edges_in(joint.band);
    let [transmit, receive] = scatterer.legs(joint.forward, joint.backward);
    let (edge, waves) = (&edges.edges[joint.edge as usize], scatterer.edge_waves);
    EdgeNode { edge, edges, span_m, transmit, receive, waves }
}

/// Factor R_tR_r/(L₁L₂) and length L₁ + L₂ − R_t − R_r of a joint's reference point.
fn way_from(scatterer: &Scatterer<'_>, joint: &EdgeJoint, middle_m: DVec3, origin_m: DVec3) -> (f64, f64) {
    let apparent_m = scatterer.legs(joint.forward, joint.backward).map(|leg| leg.mirrors.unfolded(middle_m));
    scatterer.way_from(origin_m, [joint.forward, joint.backward], apparent_m)
}

/// Contribution of an edge to S, including its reverse.
pub(crate) fn edge_share(
    scatterer: &Scatterer<'_>,
    joint: &EdgeJoint,
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Estimate<Vec<Amplitude>> {
    let Integration { wavenumbers_per_m, accuracy, .. } = *integration;
    let (middle_m, mut estimate) =
        part_amplitudes(scatterer, joint, joint.span_m, wavenumbers_per_m, accuracy);
    let (spread, length_m) = way_from(scatterer, joint, middle_m, origin_m);
    for (amplitude, k) in estimate.value.iter_mut().zip(wavenumbers_per_m) {
        *amplitude =
            scaled(&with_reverse(joint.reverse, amplitude), Complex64::from_polar(spread, -k * length_m));
    }
    estimate
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::beam::{BeamTree, TraceSettings};
    use crate::bodies::world::World;
    use crate::edges::lit_edge::edge_joints;
    use crate::geometry::antenna::Antenna;
    use crate::integral::node::Bracket;
    use crate::joins::joint::Trees;
    use crate::joins::scatterer::ZenithH;
    use artifact::scene::Mesh;
    use artifact::settings::Sides;

    /// Panels of 2 mm to 2 m, each with an upright fin of half its height: open edges, ends of faces at edges
    /// and walls, edges seen in mirrors.
    fn panels() -> World {
        let mut mesh = Mesh::default();
        let mut quad = |at: DVec3, u: DVec3, v: DVec3| {
            let first = mesh.vertices_m.len() as u32;
            mesh.vertices_m.extend([at, at + u, at + u + v, at + v].map(|c| c.to_array()));
            mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        };
        for (i, size_m) in [0.002, 0.01, 0.05, 0.3, 2.0].into_iter().enumerate() {
            let at = DVec3::new(0.3 * i as f64, -0.5 * size_m, 0.7 * i as f64 - 1.4);
            quad(at, size_m * DVec3::Y, size_m * DVec3::new(-0.1, 0.0, 0.6));
            quad(at + 0.4 * size_m * DVec3::Y, 0.5 * size_m * DVec3::X, size_m * DVec3::new(0.0, 0.1, 0.5));
        }
        World::of_mesh(&mesh).unwrap()
    }

    fn relative_difference(fast: &[Amplitude], slow: &[Amplitude], scale: f64) -> f64 {
        let pairs = fast.iter().flatten().flatten().zip(slow.iter().flatten().flatten());
        pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max) / scale
    }

    #[test]
    fn edges_at_many_frequencies_from_few_are_those_of_every_one_over_seven_decades() {
        let world = panels();
        // A chirp, all of 76 to 81 GHz, and a band of 1 : 3, in which √k is not linear.
        let bands = [(1603.0, 21.0, 40), (1592.9, 104.8, 40), (600.0, 1200.0, 60)];
        let places =
            [Antenna::Point(DVec3::new(6.0, 1.1, 0.9)), Antenna::Direction(DVec3::new(0.96, 0.0, 0.28))];
        for ((low, width, count), antenna) in
            bands.into_iter().flat_map(|band| places.map(|place| (band, place)))
        {
            let wavenumbers_per_m: Vec<f64> =
                (0..count).map(|i| low + width * f64::from(i) / f64::from(count - 1)).collect();
            let trace = TraceSettings {
                max_order: 2,
                sides: Sides::Two,
                least_area_m2: 1e-9,
                least_mirror_area_m2: 1e-7,
            };
            let tree = BeamTree::trace(&world, antenna, &trace).unwrap();
            let scatterer = Scatterer::new(
                &world,
                Trees::Shared(&tree),
                ZenithH { transmit: DVec3::Y, receive: DVec3::Y },
            );
            let edges = world.edges(low + width);
            let joints = [1, 2].map(|order| edge_joints(&world, edges, scatterer.trees, order)).concat();
            // Accuracy is relative to this: every edge at normal incidence. Neither integral is exact, but
            // both are of the same integrand.
            let length_m: f64 = joints.iter().map(|joint| joint.span_m[1] - joint.span_m[0]).sum();
            for accuracy in [1e-1, 1e-3, 1e-5, 1e-7] {
                let integration = Integration {
                    wavenumbers_per_m: &wavenumbers_per_m,
                    accuracy,
                    bracket: Bracket::Symmetrised,
                };
                let of = |sum: EdgeSum| sum(&scatterer, &joints, DVec3::ZERO, &integration);
                let (fast, slow) = (of(sum_of_edges), of(sum_at_each));
                let scale = length_m / std::f64::consts::PI.sqrt();
                let error = relative_difference(&fast, &slow, scale);
                let asked = INTERPOLATION_ERROR * accuracy;
                let size = relative_difference(&slow, &vec![Amplitude::default(); slow.len()], scale);
                println!(
                    "{low}+{width}/m, {antenna:?}, {} joints: asked {asked:.0e}, got {error:.1e} of {size:.1e}",
                    joints.len()
                );
                // Rounding of phases of k·4 m.
                assert!(error < asked.max(1800.0 * 4.0 * f64::EPSILON) && size > 1e-3);
            }
        }
    }

    type EdgeSum = fn(&Scatterer<'_>, &[EdgeJoint], DVec3, &Integration<'_>) -> Vec<Amplitude>;

    #[test]
    fn waves_over_own_faces_alone_leave_edges_their_level() {
        let world = panels();
        let trace = TraceSettings {
            max_order: 2,
            sides: Sides::Two,
            least_area_m2: 1e-9,
            least_mirror_area_m2: 1e-7,
        };
        let tree = BeamTree::trace(&world, Antenna::Point(DVec3::new(6.0, 1.1, 0.9)), &trace).unwrap();
        let wavenumbers_per_m: Vec<f64> = (0..12).map(|i| 1603.0 + 21.0 * f64::from(i) / 11.0).collect();
        let scatterer = || {
            let zenith_h = ZenithH { transmit: DVec3::Y, receive: DVec3::Y };
            Scatterer::new(&world, Trees::Shared(&tree), zenith_h)
        };
        let power = |scatterer: &Scatterer<'_>| {
            let joints = edge_joints(&world, world.edges(1624.0), scatterer.trees, 1);
            let wavenumbers_per_m = &wavenumbers_per_m;
            let integration =
                Integration { wavenumbers_per_m, accuracy: 0.25, bracket: Bracket::Symmetrised };
            let s = sum_of_edges(scatterer, &joints, DVec3::ZERO, &integration);
            s.iter().flatten().flatten().map(|s| s.norm_sqr()).sum::<f64>()
        };
        let [all, own] = [power(&scatterer()), power(&scatterer().with_waves_over_own_faces())];
        let level_db = 10.0 * (own / all).log10();
        println!("{level_db:.2} dB");
        assert!(level_db.abs() < 1.0 && own != all, "{level_db} dB");
    }
}
