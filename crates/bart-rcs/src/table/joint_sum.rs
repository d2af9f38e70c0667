//! S of joints over frequency: tiles are grouped by length and evaluated at few frequencies (see
//! [`crate::joins::band`]).

use crate::joins::band::{self, Band, ContributionKind, Groups, INTERPOLATION_ERROR};
use crate::joins::joint::{Joint, Joints};
use crate::joins::scatterer::{Integration, JointTile, Scatterer};
use artifact::paths::Amplitude;
use glam::DVec3;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// S of all joints over frequency, 2 × 2, with its phase referred to `origin_m`.
///
/// Fixed runs of joints are summed in order, so the result is bit-identical for any number of threads.
pub(crate) fn sum_of_joints(
    scatterer: &Scatterer<'_>,
    joints: &Joints,
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Vec<Amplitude> {
    // The result for a plane wave on flat facets is exact, and stays so.
    let is_exact = scatterer.is_far() && scatterer.world.skin_error() == 0.0;
    let error = if is_exact { f64::EPSILON } else { INTERPOLATION_ERROR * integration.accuracy };
    let Some(band) = Band::new(integration.wavenumbers_per_m, error, ContributionKind::Facets) else {
        return sum_at_each(scatterer, joints, origin_m, integration);
    };
    let (done, all) = (AtomicUsize::new(0), joints.list.len());
    let of_run = |run: &[Joint]| {
        scatterer.at(done.fetch_add(run.len(), Ordering::Relaxed), all);
        let mut groups = Groups::new();
        for joint in run {
            let mut give = |tile: &JointTile<'_>| {
                tile.add_to(&mut band.group(tile.path_length_range(), &mut groups));
            };
            scatterer.for_each_tile(
                joint,
                joints.polygon(joint),
                origin_m,
                band.highest_per_m(),
                integration,
                &mut give,
            );
        }
        groups
    };
    band.sum(joints.list.par_chunks(JOINTS_PER_RUN).map(of_run).collect())
}

/// Sums at every frequency separately: the reference of the interpolation.
pub(crate) fn sum_at_each(
    scatterer: &Scatterer<'_>,
    joints: &Joints,
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Vec<Amplitude> {
    let (done, all) = (AtomicUsize::new(0), joints.list.len());
    band::sum_at_each(&joints.list, JOINTS_PER_RUN, integration.wavenumbers_per_m.len(), |joint| {
        let number = done.fetch_add(1, Ordering::Relaxed);
        if number.is_multiple_of(JOINTS_PER_RUN) {
            scatterer.at(number, all);
        }
        scatterer.scattering(joint, joints.polygon(joint), origin_m, integration).value
    })
}

/// Number of joints summed by one thread.
const JOINTS_PER_RUN: usize = 256;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::beam::{BeamTree, TraceSettings};
    use crate::beams::image_tree::RoadTree;
    use crate::bodies::road_mirror::image;
    use crate::bodies::world::World;
    use crate::geometry::antenna::Antenna;
    use crate::integral::node::Bracket;
    use crate::joins::joint::Trees;
    use crate::joins::scatterer::{ZenithH, bracket_of};
    use artifact::material::{Material, Road};
    use artifact::permittivity::substance;
    use artifact::scene::Mesh;
    use artifact::settings::{NodeRule, Sides};

    /// Three leaves of a corner, each of 16 × 16 squares of 25 mm and two panels of up to 5 m beside them:
    /// all classes, and contributions that fit none.
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
        for antenna in
            [Antenna::Point(DVec3::new(9.0, 12.0, 8.0)), Antenna::Direction(DVec3::new(0.36, 0.48, 0.8))]
        {
            let is_far = matches!(antenna, Antenna::Direction(_));
            let trace = TraceSettings {
                max_order: 2,
                sides: Sides::Two,
                least_area_m2: 1e-7,
                least_mirror_area_m2: 1e-3,
            };
            let tree = BeamTree::trace(&world, antenna, &trace).unwrap();
            let zenith_h = ZenithH { transmit: DVec3::Y, receive: DVec3::Y };
            let scatterer = Scatterer::new(&world, Trees::Shared(&tree), zenith_h);
            let joints = [1, 2].map(|order| scatterer.joints(order, NodeRule::Middle, 1e-7));
            for accuracy in [1e-1, 1e-3] {
                for joints in &joints {
                    let of = |accuracy, sum: JointSum| {
                        let wavenumbers_per_m = &wavenumbers_per_m;
                        let integration =
                            Integration { wavenumbers_per_m, accuracy, bracket: Bracket::Symmetrised };
                        sum(&scatterer, joints, DVec3::ZERO, &integration)
                    };
                    let (fast, slow) = (of(accuracy, sum_of_joints), of(accuracy, sum_at_each));
                    let error = difference(&fast, &slow);
                    // In the far field the only error is rounding of phases of k·10 m; at near range it is
                    // below that of tiles.
                    let asked = if is_far {
                        1624.0 * 10.0 * f64::EPSILON * size(&slow)
                    } else {
                        difference(&slow, &of(0.1 * accuracy, sum_at_each))
                    };
                    println!(
                        "{antenna:?}, {accuracy:e}: asked {asked:.1e}, got {error:.1e} of {:.1e}",
                        size(&slow)
                    );
                    assert!(error < asked && size(&slow) > 0.0);
                }
            }
        }
    }

    fn size(s: &[Amplitude]) -> f64 {
        s.as_flattened().as_flattened().iter().map(|a| a.norm_sqr()).sum::<f64>().sqrt()
    }

    fn difference(a: &[Amplitude], b: &[Amplitude]) -> f64 {
        let pairs = a.iter().zip(b).map(|(a, b)| [0, 1].map(|p| [0, 1].map(|q| a[p][q] - b[p][q])));
        size(&pairs.collect::<Vec<Amplitude>>())
    }

    type JointSum = fn(&Scatterer<'_>, &Joints, DVec3, &Integration<'_>) -> Vec<Amplitude>;

    /// A corner of three tilted leaves, 1 m above the road, and a plate in front of it.
    fn corner_over_road() -> World {
        let mut mesh = Mesh::default();
        let mut quad = |at: DVec3, u: DVec3, v: DVec3| {
            let first = mesh.vertices_m.len() as u32;
            mesh.vertices_m.extend([at, at + u, at + u + v, at + v].map(|c| c.to_array()));
            mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        };
        let [x, y, z] =
            [DVec3::new(0.3, 0.05, 0.0), DVec3::new(-0.02, 0.3, 0.01), DVec3::new(0.03, 0.0, 0.3)];
        [(x, y), (y, z), (z, x)].into_iter().for_each(|(u, v)| quad(DVec3::Z, u, v));
        quad(DVec3::new(0.5, 0.1, 0.9), 0.1 * DVec3::Y, 0.1 * DVec3::Z);
        let asphalt =
            Material::HalfSpace { permittivity: substance("asphalt").unwrap().permittivity.unwrap() };
        World::of_mesh(&mesh).unwrap().over(&Road { material: asphalt, rms_height_m: 5e-4 }).unwrap()
    }

    #[test]
    fn the_mirrored_tree_and_half_of_the_joints_give_what_two_traces_and_all_joints_give() {
        let world = corner_over_road();
        let antenna = Antenna::Point(DVec3::new(9.0, 6.0, 4.0));
        let trace = TraceSettings {
            max_order: 3,
            sides: Sides::Two,
            least_area_m2: 1e-9,
            least_mirror_area_m2: 1e-7,
        };
        let tree = BeamTree::trace(&world, antenna, &trace).unwrap();
        let received = RoadTree::with_image(&world, &tree);
        let traced = BeamTree::trace(&world, image(antenna), &trace).unwrap();
        let section = |tree: &BeamTree| tree.beams.iter().map(|beam| beam.section).sum::<f64>();
        assert_eq!(received.tree.beams.len(), tree.beams.len() + traced.beams.len());
        assert!((section(&received.tree) - section(&tree) - section(&traced)).abs() < 1e-12 * section(&tree));
        let zenith_h = ZenithH { transmit: DVec3::Y, receive: DVec3::Y };
        for rule in [NodeRule::Middle, NodeRule::OwnEdge, NodeRule::Exit] {
            for order in 1..=3 {
                let of = |trees: Trees<'_>| -> Amplitude {
                    let scatterer = Scatterer::new(&world, trees, zenith_h);
                    let joints = scatterer.joints(order, rule, 1e-9);
                    let wavenumbers_per_m = &[1613.8];
                    let integration =
                        Integration { wavenumbers_per_m, accuracy: 1e-6, bracket: bracket_of(rule) };
                    sum_of_joints(&scatterer, &joints, DVec3::ZERO, &integration)[0]
                };
                let (half, all) =
                    (of(Trees::ByRoad(&tree, &received)), of(Trees::Apart(&tree, &received.tree)));
                let size = all.as_flattened().iter().map(|s| s.norm()).fold(0.0, f64::max);
                let error = (0..4)
                    .map(|i| (half.as_flattened()[i] - all.as_flattened()[i]).norm())
                    .fold(0.0, f64::max);
                println!("{rule:?}, order {order}: asked 1e-7, got {:.1e} of {size:.2e}", error / size);
                // The integrals of a path and of its reverse are equal, except for the last digits of their
                // tiles.
                assert!(error < 1e-7 * size);
            }
        }
    }
}
