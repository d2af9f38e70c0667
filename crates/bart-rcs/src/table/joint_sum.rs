//! S of joints at many frequencies from few: what scatters at about one length turns with frequency as that length does, and
//! what is left of the turning is smooth.
//!
//! Tiles of joints are gathered by their length L₁ + L₂. Less its common phase e^{−jkL}, the sum of a group turns over the band by
//! θ = Δk·(how far the lengths spread) at most, Δk half the band, and n Chebyshev points meet e^{jθx} on [−1, 1] to
//! 4(θ/2)ⁿ/n! (its Chebyshev coefficients are Bessel functions, |J_m(θ)| ≤ (θ/2)^m/m!; Trefethen, Approximation Theory and
//! Approximation Practice (2013), ch. 4 and 5). 256 frequencies of a chirp so cost six for a small facet at
//! −60 dB of the accuracy.

use crate::joins::join::{Joint, Joints};
use crate::joins::scatterer::{Integration, JointTile, Scatterer};
use artifact::paths::Amplitude;
use glam::DVec3;
use num_complex::Complex64;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// S of all joints over frequency, 2 × 2, its phase referred to `origin_m`.
///
/// Fixed runs of joints are added in their order: the same bits on any number of threads.
pub(crate) fn sum_of_joints(
    scatterer: &Scatterer<'_>,
    joints: &Joints,
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Vec<Amplitude> {
    // What a plane wave gives on flat facets is exact, and stays so.
    let is_exact = scatterer.is_far() && scatterer.world.skin_error() == 0.0;
    let error = if is_exact { f64::EPSILON } else { INTERPOLATION_ERROR * integration.accuracy };
    let classes = classes(integration.wavenumbers_per_m, error.max(f64::EPSILON));
    if classes.is_empty() {
        return sum_at_each(scatterer, joints, origin_m, integration);
    }
    let highest = integration.wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
    let of_run = |run: &[Joint]| {
        let mut groups = Groups::new();
        for joint in run {
            let mut give = |tile: &JointTile<'_>| add_tile(tile, &classes, integration, &mut groups);
            scatterer.for_each_tile(joint, joints.polygon(joint), origin_m, highest, integration, &mut give);
        }
        groups
    };
    let runs: Vec<Groups> = joints.list.par_chunks(RUN).map(of_run).collect();
    let mut groups = Groups::new();
    for (place, share) in runs.into_iter().flatten() {
        match groups.entry(place) {
            Entry::Vacant(empty) => _ = empty.insert(share),
            Entry::Occupied(mut sum) => add(sum.get_mut(), &share),
        }
    }
    let groups: Vec<(Place, Vec<Amplitude>)> = groups.into_iter().collect();
    let interpolated = |(place, samples): &(Place, Vec<Amplitude>)| match classes.get(place.class) {
        Some(class) => class.interpolated(samples, place.length_m(class), integration),
        None => samples.clone(),
    };
    let parts: Vec<Vec<Amplitude>> = groups.par_iter().map(interpolated).collect();
    let mut sum = vec![Amplitude::default(); integration.wavenumbers_per_m.len()];
    parts.iter().for_each(|part| add(&mut sum, part));
    sum
}

/// Sums by group, in the order of the groups.
type Groups = BTreeMap<Place, Vec<Amplitude>>;

/// Adds a tile to its group; one that belongs to no class to the group behind all classes, at every frequency.
fn add_tile(tile: &JointTile<'_>, classes: &[Class], integration: &Integration<'_>, groups: &mut Groups) {
    let way = tile.way();
    // Half a reach for the way from the group's length to the tile's, half for the tile itself.
    let class = classes.iter().position(|class| way.extent_m <= 0.5 * class.reach_m);
    let bin = |class: &Class| (way.length_m / class.reach_m).round() as i64;
    let place = class.map_or(Place { class: classes.len(), bin: 0 }, |i| Place { class: i, bin: bin(&classes[i]) });
    let wavenumbers_per_m = class.map_or(integration.wavenumbers_per_m, |i| &classes[i].nodes_per_m);
    let sums = groups.entry(place).or_insert_with(|| vec![Amplitude::default(); wavenumbers_per_m.len()]);
    tile.add_to(sums, wavenumbers_per_m);
}

/// The same at every frequency for itself: what the interpolation is compared with.
pub(crate) fn sum_at_each(
    scatterer: &Scatterer<'_>,
    joints: &Joints,
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Vec<Amplitude> {
    let zero = || vec![Amplitude::default(); integration.wavenumbers_per_m.len()];
    let of_run = |run: &[Joint]| {
        run.iter().fold(zero(), |mut total, joint| {
            add(&mut total, &scatterer.scattering(joint, joints.polygon(joint), origin_m, integration).value);
            total
        })
    };
    let runs: Vec<Vec<Amplitude>> = joints.list.par_chunks(RUN).map(of_run).collect();
    runs.iter().fold(zero(), |mut total, run| {
        add(&mut total, run);
        total
    })
}

/// Joints that are added by one thread.
const RUN: usize = 256;

/// Turns over the band that a group may take, rad. At finite range tiles are a few centimetres long and belong to the first;
/// a plane wave takes the side of a lorry as one. What turns farther is integrated at every frequency.
const TURNS_RAD: [f64; 4] = [0.25, 1.0, 4.0, 16.0];
/// Of a group's largest amplitude, as a part of the accuracy that its integrals are asked for.
const INTERPOLATION_ERROR: f64 = 1e-3;

/// Groups that turn alike.
struct Class {
    /// Farthest that the length of a member or of a point on it may be from the group's, m.
    reach_m: f64,
    /// Chebyshev points of the second kind over the band, its ends among them: tiles are cut for the highest frequency.
    nodes_per_m: Vec<f64>,
    /// Barycentric weights.
    weights: Vec<f64>,
}

/// The group of a tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    class: usize,
    /// Of its length, in units of the class's reach.
    bin: i64,
}

impl Place {
    fn length_m(&self, class: &Class) -> f64 {
        self.bin as f64 * class.reach_m
    }
}

/// Those with fewer points than there are frequencies, from the one with fewest points on.
fn classes(wavenumbers_per_m: &[f64], error: f64) -> Vec<Class> {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = wavenumbers_per_m.iter().fold(start, |[low, high], &k| [low.min(k), high.max(k)]);
    if low >= high {
        return Vec::new();
    }
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let of = |turn_rad: &f64| {
        let count = points(*turn_rad, error);
        let angle = |i: usize| std::f64::consts::PI * i as f64 / (count - 1) as f64;
        let mut nodes_per_m: Vec<f64> = (0..count).map(|i| middle + half * angle(i).cos()).collect();
        nodes_per_m[0] = high;
        let end = |i: usize| if i == 0 || i == count - 1 { 0.5 } else { 1.0 };
        let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        Class { reach_m: turn_rad / half, nodes_per_m, weights: (0..count).map(|i| sign(i) * end(i)).collect() }
    };
    TURNS_RAD.iter().map(of).filter(|class| class.nodes_per_m.len() < wavenumbers_per_m.len()).collect()
}

/// Points that meet a turn of θ over half the band to an error relative to the amplitude.
fn points(turn_rad: f64, error: f64) -> usize {
    let (mut bound, mut count) = (4.0, 0);
    while bound > error || f64::from(count) < turn_rad.max(2.0) {
        count += 1;
        bound *= 0.5 * turn_rad / f64::from(count);
    }
    count as usize
}

impl Class {
    /// Samples at the points, of ways about `length_m`, at every wavenumber asked for.
    fn interpolated(&self, samples: &[Amplitude], length_m: f64, integration: &Integration<'_>) -> Vec<Amplitude> {
        let still: Vec<Amplitude> =
            samples.iter().zip(&self.nodes_per_m).map(|(a, k)| turned(a, 1.0 / k, k * length_m)).collect();
        let at = |k: &f64| turned(&self.at(*k, &still), *k, -k * length_m);
        integration.wavenumbers_per_m.iter().map(at).collect()
    }

    /// The polynomial through the samples (barycentric formula; Berrut, Trefethen, SIAM Review 46 (2004) 501).
    fn at(&self, wavenumber_per_m: f64, samples: &[Amplitude]) -> Amplitude {
        let (mut sum, mut weights) = (Amplitude::default(), 0.0);
        for ((sample, node), weight) in samples.iter().zip(&self.nodes_per_m).zip(&self.weights) {
            if wavenumber_per_m == *node {
                return *sample;
            }
            let share = weight / (wavenumber_per_m - node);
            weights += share;
            sum.iter_mut().flatten().zip(sample.iter().flatten()).for_each(|(sum, a)| *sum += share * a);
        }
        sum.map(|row| row.map(|a| a / weights))
    }
}

/// Less its factor k, or with it again, and turned.
fn turned(a: &Amplitude, size: f64, phase_rad: f64) -> Amplitude {
    let factor = Complex64::from_polar(size, phase_rad);
    a.map(|row| row.map(|x| x * factor))
}

/// Adds amplitude by amplitude.
pub(crate) fn add(total: &mut [Amplitude], share: &[Amplitude]) {
    for (sum, s) in total.iter_mut().flatten().flatten().zip(share.iter().flatten().flatten()) {
        *sum += s;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::beam::{BeamTree, TraceSettings};
    use crate::bodies::world::World;
    use crate::geometry::antenna::Antenna;
    use crate::integral::physical_optics::Bracket;
    use crate::joins::join::Trees;
    use crate::joins::scatterer::ZenithH;
    use artifact::scene::Mesh;
    use artifact::settings::{NodeRule, Sides};

    /// Three leaves of a corner, each of 16 × 16 squares of 25 mm and two panels of up to 5 m beside them: all classes, and what
    /// belongs to none.
    fn corner() -> World {
        let mut mesh = Mesh::default();
        let mut square = |at: DVec3, u: DVec3, v: DVec3| {
            let first = mesh.vertices_m.len() as u32;
            mesh.vertices_m.extend([at, at + u, at + u + v, at + v].map(|c| c.to_array()));
            mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        };
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
        for (u, v) in [(x, y), (y, z), (z, x)] {
            for i in 0..256 {
                square(0.025 * (f64::from(i % 16) * u + f64::from(i / 16) * v), 0.025 * u, 0.025 * v);
            }
            square(1.1 * u + 0.02 * v, 0.9 * u, 0.3 * v);
            square(2.2 * u - 0.4 * v, 0.1 * u, 5.0 * v);
        }
        World::of_mesh(&mesh).unwrap()
    }

    #[test]
    fn a_chirp_of_256_frequencies_from_few_is_that_of_every_one() {
        let world = corner();
        let wavenumbers_per_m: Vec<f64> = (0..256).map(|i| 1603.0 + 21.0 * f64::from(i) / 255.0).collect();
        for antenna in [Antenna::Point(DVec3::new(9.0, 12.0, 8.0)), Antenna::Direction(DVec3::new(0.36, 0.48, 0.8))] {
            let trace =
                TraceSettings { max_order: 2, sides: Sides::Two, least_area_m2: 1e-7, least_mirror_area_m2: 1e-3 };
            let tree = BeamTree::trace(&world, antenna, &trace).unwrap();
            let zenith_h = ZenithH { transmit: DVec3::Y, receive: DVec3::Y };
            let scatterer = Scatterer::new(&world, Trees::Shared(&tree), zenith_h);
            let joints = [1, 2].map(|order| scatterer.joints(order, NodeRule::Middle, 1e-7));
            for accuracy in [1e-1, 1e-3] {
                for joints in &joints {
                    let of = |accuracy, sum: Sum| {
                        let wavenumbers_per_m = &wavenumbers_per_m;
                        let integration = Integration { wavenumbers_per_m, accuracy, bracket: Bracket::Symmetrised };
                        sum(&scatterer, joints, DVec3::ZERO, &integration)
                    };
                    let (fast, slow) = (of(accuracy, sum_of_joints), of(accuracy, sum_at_each));
                    let size = |s: &[Amplitude]| s.iter().flatten().flatten().map(|a| a.norm_sqr()).sum::<f64>().sqrt();
                    let difference: Vec<Amplitude> = fast
                        .iter()
                        .zip(&slow)
                        .map(|(a, b)| [0, 1].map(|p| [0, 1].map(|q| a[p][q] - b[p][q])))
                        .collect();
                    let error = size(&difference) / size(&slow);
                    // Far away: rounding of phases of k·10 m.
                    let is_far = matches!(antenna, Antenna::Direction(_));
                    let asked = if is_far { 1624.0 * 10.0 * f64::EPSILON } else { INTERPOLATION_ERROR * accuracy };
                    println!("{antenna:?}: asked {asked:.1e}, got {error:.1e}");
                    assert!(error < asked && size(&slow) > 0.0);
                }
            }
        }
    }

    type Sum = fn(&Scatterer<'_>, &Joints, DVec3, &Integration<'_>) -> Vec<Amplitude>;

    #[test]
    fn few_frequencies_or_one_are_taken_one_by_one() {
        let classes = |wavenumbers_per_m: &[f64]| classes(wavenumbers_per_m, 1e-6);
        assert!(classes(&[]).is_empty() && classes(&[1613.0]).is_empty() && classes(&[1613.0; 300]).is_empty());
        assert!(classes(&[1600.0, 1605.0, 1610.0]).is_empty());
        let many: Vec<f64> = (0..256).map(f64::from).collect();
        let counts: Vec<usize> = classes(&many).iter().map(|class| class.nodes_per_m.len()).collect();
        println!("points for a turn of {TURNS_RAD:?} rad: {counts:?}");
        assert_eq!(counts.len(), TURNS_RAD.len());
    }
}
