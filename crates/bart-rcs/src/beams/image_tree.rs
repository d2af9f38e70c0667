//! Beams of the antenna's image below the road, beside the antenna's own.

use crate::beams::beam::{Beam, BeamTree};
use crate::bodies::road::HalfSpace;
use crate::bodies::road_mirror::{below, image};
use crate::bodies::world::World;

/// Beams that arrive at the antenna, directly and via the road.
pub(crate) struct RoadTree {
    /// Beams of the antenna and of its image as those of one antenna, by order.
    pub(crate) tree: BeamTree,
    /// Twin of every beam: for the antenna's own the beam itself, for the image's the beam that it mirrors.
    pub(crate) twins: Vec<u32>,
}

impl RoadTree {
    /// Adds the beams of the antenna's image. It sees the images of what the antenna sees, so they are
    /// mirrored rather than traced.
    pub(crate) fn with_image(world: &World, direct: &BeamTree) -> Self {
        let mut tree = BeamTree { beams: Vec::new(), passed: 2 * direct.passed, ..direct.clone() };
        let mut twins = Vec::with_capacity(2 * direct.beams.len());
        let mut places = [vec![0_u32; direct.beams.len()], vec![0_u32; direct.beams.len()]];
        let of_order = |a: &(usize, &Beam), b: &(usize, &Beam)| a.1.order == b.1.order;
        let beams: Vec<(usize, &Beam)> = direct.beams.iter().enumerate().collect();
        for order in beams.chunk_by(of_order) {
            for (half, places) in [HalfSpace::Above, HalfSpace::Below].into_iter().zip(&mut places) {
                for &(index, beam) in order {
                    let beam = if half == HalfSpace::Below {
                        below_road(world, direct, beam, &mut tree)
                    } else {
                        beam.clone()
                    };
                    places[index] = tree.beams.len() as u32;
                    let parent = beam.parent.map(|parent| places[parent as usize]);
                    tree.beams.push(Beam { parent, ..beam });
                    twins.push(index as u32);
                }
            }
        }
        Self { tree, twins }
    }

    /// Approximate memory, bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.tree.bytes() + self.twins.len() * size_of::<u32>()
    }
}

/// Image of a beam, its corners appended to those of `tree`.
fn below_road(world: &World, direct: &BeamTree, beam: &Beam, tree: &mut BeamTree) -> Beam {
    let start = tree.vertices_m.len();
    tree.vertices_m.extend(direct.polygon(beam).iter().rev().map(|corner| below(*corner)));
    // Seen from the other side the edge from a corner to the next runs in reverse.
    tree.borders.extend(direct.borders(beam).iter().rev());
    tree.borders[start..].rotate_left(1);
    Beam {
        facet: world.image_of(beam.facet),
        lit_normal: below(beam.lit_normal),
        image: image(beam.image),
        sheets: beam.sheets.iter().map(|sheet| world.image_of(*sheet)).collect(),
        polygon: start as u32..tree.vertices_m.len() as u32,
        ..beam.clone()
    }
}

/// Whether a leg of the path to a beam meets the road: it starts at the antenna's image, or a facet on it is
/// an image.
pub(crate) fn goes_by_road(world: &World, tree: &BeamTree, beam: &Beam) -> bool {
    world.road().is_some()
        && (origin(tree, beam) != HalfSpace::Above
            || tree.mirror_chain(beam).any(|met| world.is_image(met.facet)))
}

/// Half-space of the antenna, the real one or its image, from which a beam came.
pub(crate) fn origin(tree: &BeamTree, beam: &Beam) -> HalfSpace {
    let is_direct = tree.mirror_chain(beam).last().is_none_or(|first| first.image == tree.antenna);
    if is_direct { HalfSpace::Above } else { HalfSpace::Below }
}
