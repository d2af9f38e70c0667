//! Sampled beams of a tree, each weighted by the number of beams that it represents (Knuth, Mathematics of
//! Computation 29 (1975) 121): an estimate of the tree's size for a small part of its cost.

use crate::beams::beam::{BeamTree, Growth, TraceSettings};
use crate::beams::occlusion::shadow::Shadow;
use crate::beams::occlusion::view::View;
use crate::beams::sheets::split_at_sheets;
use crate::beams::visibility::{Buffers, BvhVisibility, Visibility, direct_of};
use crate::bodies::world::World;
use crate::geometry::antenna::Antenna;
use crate::run_control::error::BartError;
use crate::run_control::progress::NoProgress;
use rayon::prelude::*;

/// Sampled beams with their weights.
pub(crate) struct SampledTree {
    pub(crate) tree: BeamTree,
    /// Number of beams that each beam represents; the expectation of the sum over beams of any kind is the
    /// number of such beams in the whole tree.
    pub(crate) stands_for: Vec<f64>,
    /// Number of facets that may be directly visible.
    pub(crate) in_sight: usize,
    /// Number of mirrors in the whole tree, by order of the reflected beam.
    pub(crate) mirrors: Vec<f64>,
}

impl SampledTree {
    /// Samples about `most` facets in direct view, and about as many mirrors of each order.
    pub(crate) fn trace(
        world: &World,
        antenna: Antenna,
        settings: &TraceSettings,
        most: usize,
    ) -> Result<Self, BartError> {
        let mut growth = Growth::new(antenna, settings, &NoProgress);
        let (mut stands_for, mut mirrors) = (Vec::new(), Vec::new());
        let in_sight = first_order(world, &mut growth, most, &mut stands_for)?;
        for order in 2..=settings.max_order {
            mirrors.push(next_order(world, order, &mut growth, most, &mut stands_for)?);
        }
        Ok(Self { tree: growth.tree, stands_for, in_sight, mirrors })
    }
}

fn first_order(
    world: &World,
    growth: &mut Growth<'_>,
    most: usize,
    stands_for: &mut Vec<f64>,
) -> Result<usize, BartError> {
    let antenna = growth.tree.antenna;
    let view = View::direct(world, growth.settings.sides, antenna);
    let (mut chosen, mut in_sight) = (Vec::new(), 0);
    let seen = direct_of(&view, |shadows| {
        let sizes: Vec<f64> = shadows.iter().map(|shadow: &Shadow| shadow.apparent_size).collect();
        (chosen, in_sight) = (sample(&sizes, most), sizes.len());
        chosen.iter().map(|(slot, _)| *slot as u32).collect()
    });
    growth.begin_order(world);
    for (parts, (_, each)) in seen.into_iter().zip(chosen) {
        growth.take(None, antenna, 1, split_at_sheets(&view, parts))?;
        stands_for.resize(growth.tree.beams.len(), each);
    }
    Ok(in_sight)
}

/// Returns the number of mirrors in the whole tree.
fn next_order(
    world: &World,
    order: u8,
    growth: &mut Growth<'_>,
    most: usize,
    stands_for: &mut Vec<f64>,
) -> Result<f64, BartError> {
    let parents = growth.begin_order(world);
    let sizes: Vec<f64> =
        parents.iter().map(|&p| growth.tree.beams[p as usize].section * stands_for[p as usize]).collect();
    let count = parents.iter().map(|&parent| stands_for[parent as usize]).sum();
    let chosen = sample(&sizes, most);
    let reflect = |buffers: &mut Buffers, &(place, each): &(usize, f64)| {
        let parent = parents[place];
        let view = growth.view(world, parent)?;
        let parts = split_at_sheets(&view, BvhVisibility::reflected(&view, buffers));
        Some((parent, view.antenna, parts, each * stands_for[parent as usize]))
    };
    let met: Vec<_> = chosen.par_iter().map_init(Buffers::default, reflect).collect();
    for (parent, image, parts, each) in met.into_iter().flatten() {
        growth.take(Some(parent), image, order, parts)?;
        stands_for.resize(growth.tree.beams.len(), each);
    }
    Ok(count)
}

/// Samples about `most` items, each with the number that it represents, the inverse of its probability: half
/// of the probability is uniform, half proportional to size, so that neither the many small nor the few large
/// are missed. Systematic sampling, in order.
pub(crate) fn sample(sizes: &[f64], most: usize) -> Vec<(usize, f64)> {
    let total: f64 = sizes.iter().sum();
    let by_number = 0.5 * most as f64 / sizes.len().max(1) as f64;
    let chance = |size: f64| {
        let by_size = if total > 0.0 { 0.5 * most as f64 * size / total } else { by_number };
        (by_number + by_size).min(1.0)
    };
    let mut reached = 0.5;
    let take = |(place, size): (usize, &f64)| {
        let (before, chance) = (reached, chance(*size));
        reached += chance;
        (reached.floor() > before.floor()).then_some((place, 1.0 / chance))
    };
    sizes.iter().enumerate().filter_map(take).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::beam::Beam;
    use artifact::scene::Mesh;
    use artifact::settings::Sides;
    use glam::DVec3;

    /// Two leaves of 20 × 20 squares of 5 cm at right angles, and between them a few thin fins that hide
    /// parts of both.
    fn fins_in_a_corner() -> World {
        let mut mesh = Mesh::default();
        let mut square = |at: DVec3, u: DVec3, v: DVec3| {
            let first = mesh.vertices_m.len() as u32;
            mesh.vertices_m.extend([at, at + u, at + u + v, at + v].map(|corner| corner.to_array()));
            mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        };
        for (u, v) in [(DVec3::X, DVec3::Y), (DVec3::Y, DVec3::Z)] {
            (0..400).for_each(|i| {
                square(0.05 * (f64::from(i % 20) * u + f64::from(i / 20) * v), 0.05 * u, 0.05 * v)
            });
        }
        for i in 0..6 {
            square(DVec3::new(0.1 + 0.15 * f64::from(i), 0.3, 0.2), 0.4 * DVec3::Y, 0.01 * DVec3::Z);
        }
        World::of_mesh(&mesh).unwrap()
    }

    #[test]
    fn a_sample_tells_how_many_beams_the_whole_tree_has() {
        let world = fins_in_a_corner();
        let antenna = Antenna::Point(DVec3::new(8.0, 3.0, 7.0));
        let settings =
            TraceSettings { max_order: 3, sides: Sides::Two, least_area_m2: 0.0, least_mirror_area_m2: 0.0 };
        let whole = BeamTree::trace(&world, antenna, &settings).unwrap();
        let sampled = SampledTree::trace(&world, antenna, &settings, 200).unwrap();
        assert!(3 * sampled.tree.beams.len() < whole.beams.len());
        for order in 1..=3 {
            let of_order = |beams: &[Beam]| beams.iter().filter(|beam| beam.order == order).count();
            let beams = sampled.tree.beams.iter().zip(&sampled.stands_for);
            let expected: f64 = beams.filter(|(beam, _)| beam.order == order).map(|(_, each)| each).sum();
            // 200 of them err by 7 % in each order, if independent; three times that of the three orders
            // together.
            let ratio = expected / of_order(&whole.beams) as f64;
            assert!((ratio - 1.0).abs() < 3.0 * 0.07 * f64::from(order).sqrt(), "order {order}: × {ratio}");
        }
    }

    #[test]
    fn a_sample_of_everything_is_the_whole_tree() {
        let world = fins_in_a_corner();
        let antenna = Antenna::Point(DVec3::new(8.0, 3.0, 7.0));
        let settings =
            TraceSettings { max_order: 3, sides: Sides::Two, least_area_m2: 0.0, least_mirror_area_m2: 0.0 };
        let whole = BeamTree::trace(&world, antenna, &settings).unwrap();
        let sampled = SampledTree::trace(&world, antenna, &settings, 10_000_000).unwrap();
        assert_eq!(sampled.tree.beams, whole.beams);
        assert!(sampled.stands_for.iter().all(|each| *each == 1.0));
    }

    #[test]
    fn a_sample_stands_for_as_many_and_as_much_as_there_are() {
        let sizes: Vec<f64> =
            (0..10_000).map(|i| if i % 500 == 0 { 100.0 } else { f64::from(i % 7) * 0.01 }).collect();
        let chosen = sample(&sizes, 400);
        let number: f64 = chosen.iter().map(|(_, each)| each).sum();
        let size: f64 = chosen.iter().map(|(place, each)| each * sizes[*place]).sum();
        let total: f64 = sizes.iter().sum();
        assert!(chosen.len() < 450 && (number / 10_000.0 - 1.0).abs() < 0.1, "{} {number}", chosen.len());
        assert!((size / total - 1.0).abs() < 0.02, "{size} of {total}");
        assert_eq!(sample(&[1.0, 2.0], 10), [(0, 1.0), (1, 1.0)]);
        assert!(sample(&[], 10).is_empty());
    }
}
