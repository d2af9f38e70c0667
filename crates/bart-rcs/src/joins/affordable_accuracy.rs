//! Accuracy of integrals that a limited amount of work affords: they terminate, and the remaining error is
//! measured.

use crate::joins::joint::{Joint, Joints};
use crate::joins::scatterer::{Integration, Scatterer};
use crate::run_control::error::BartError;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// Accuracy of `integration`, or the next coarser one in steps of four, that divides all joints into at most
/// `most` tiles plus a few for each joint; an error if none does.
///
/// The number of tiles scales with the accuracy to the power −⅔, and near an antenna with the inverse of its
/// distance from a facet, where the polarization vectors rotate along the line of the antenna's own zenith.
pub(crate) fn affordable_accuracy<'j>(
    scatterer: &Scatterer<'_>,
    joints: impl Iterator<Item = &'j Joints> + Clone,
    integration: &Integration<'_>,
    most: u64,
) -> Result<f64, BartError> {
    const COARSER: f64 = 4.0;
    // Beyond this, the error of a tile may equal its maximum contribution.
    const COARSEST: f64 = 1.0;
    // With very many joints each keeps these, however coarse.
    const FREE: u64 = 8;
    let most = most.saturating_add(joints.clone().map(|joints| FREE * joints.list.len() as u64).sum());
    let mut asked = *integration;
    while !fits(scatterer, joints.clone(), &asked, most) {
        if asked.accuracy >= COARSEST {
            return Err(BartError::TooManyPieces { most });
        }
        asked.accuracy *= COARSER;
    }
    Ok(asked.accuracy)
}

/// Whether there are no more than `most` tiles. Counting ends once there are more; which ones were counted by
/// then depends on the threads, the answer does not.
fn fits<'j>(
    scatterer: &Scatterer<'_>,
    joints: impl Iterator<Item = &'j Joints>,
    integration: &Integration<'_>,
    most: u64,
) -> bool {
    let tiles = AtomicU64::new(0);
    let of_joint = |joints: &Joints, joint: &Joint| {
        let left = most.checked_sub(tiles.load(Ordering::Relaxed))?;
        let found = scatterer.tiles(joint, joints.polygon(joint), integration, left);
        tiles.fetch_add(found, Ordering::Relaxed);
        Some(())
    };
    for joints in joints {
        let all =
            joints.list.par_iter().with_min_len(JOINTS_PER_RUN).try_for_each(|joint| of_joint(joints, joint));
        if all.is_none() {
            return false;
        }
    }
    tiles.into_inner() <= most
}

/// Ratio of the bounds of much finer integrals to those that they are compared with, where tiles are few: for
/// many polygons the error follows from the difference to integrals several times finer, but a few polygons
/// may be whole tiles in both, with no difference. A plate's sidelobe is as small as the error of its single
/// tile.
pub(crate) const FAR_FINER: f64 = 1.0 / 512.0;
/// Maximum number of tiles of these: polygons divided into more have many tiles anyway.
const FAR_FINER_TILES: u64 = 4096;

/// Whether integrals much finer than these have few tiles.
pub(crate) fn are_few_tiles<'j>(
    scatterer: &Scatterer<'_>,
    joints: impl Iterator<Item = &'j Joints>,
    integration: &Integration<'_>,
) -> bool {
    let far_finer = Integration { accuracy: FAR_FINER * integration.accuracy, ..*integration };
    fits(scatterer, joints, &far_finer, FAR_FINER_TILES)
}

/// Number of joints counted by one thread in turn.
const JOINTS_PER_RUN: usize = 64;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::beam::{BeamTree, TraceSettings};
    use crate::bodies::world::World;
    use crate::geometry::antenna::Antenna;
    use crate::integral::node::Bracket;
    use crate::joins::joint::Trees;
    use crate::joins::scatterer::ZenithH;
    use artifact::scene::Mesh;
    use artifact::settings::{NodeRule, Sides};
    use glam::DVec3;

    #[test]
    fn what_would_be_cut_too_often_is_integrated_coarser_and_never_more_often_than_allowed() {
        let vertices_m = vec![[0.0, -0.1, -0.1], [0.0, 0.1, -0.1], [0.0, 0.1, 0.1], [0.0, -0.1, 0.1]];
        let mesh = Mesh { vertices_m, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
        let world = World::of_mesh(&mesh).unwrap();
        let trace = TraceSettings {
            max_order: 1,
            sides: Sides::Two,
            least_area_m2: 1e-9,
            least_mirror_area_m2: 1e-9,
        };
        let tree = BeamTree::trace(&world, Antenna::Point(DVec3::new(0.02, 0.01, 0.0)), &trace).unwrap();
        let scatterer =
            Scatterer::new(&world, Trees::Shared(&tree), ZenithH { transmit: DVec3::Y, receive: DVec3::Y });
        let joints = scatterer.joints(1, NodeRule::Middle, 1e-9);
        let asked =
            Integration { wavenumbers_per_m: &[1613.8], accuracy: 1e-4, bracket: Bracket::Symmetrised };
        let tiles = |accuracy: f64| -> u64 {
            let mut tiles = 0;
            let request = Integration { accuracy, ..asked };
            for joint in &joints.list {
                let polygon = joints.polygon(joint);
                scatterer.for_each_tile(joint, polygon, DVec3::ZERO, 1613.8, &request, &mut |_| tiles += 1);
            }
            tiles
        };
        let all = tiles(asked.accuracy);
        for most in [10 * all, all / 10, all / 100] {
            let accuracy = affordable_accuracy(&scatterer, std::iter::once(&joints), &asked, most).unwrap();
            println!("{all} tiles at 1e-4, {} at {accuracy:.1e}; {most} allowed", tiles(accuracy));
            assert_eq!(accuracy > asked.accuracy, most < all);
            // The count is estimated from coarser triangles: halves are not even thirds.
            assert!(tiles(accuracy) <= 2 * most && 40 * tiles(accuracy) > most.min(all));
        }
        let refused = affordable_accuracy(&scatterer, std::iter::once(&joints), &asked, 1);
        assert!(matches!(refused, Err(BartError::TooManyPieces { .. })), "{refused:?}");
    }
}
