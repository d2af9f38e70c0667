//! Beams of an antenna above the road and of its image below, as one tree.

use crate::beams::beam::{Beam, BeamTree};
use crate::bodies::road::Half;

/// The beams of the antenna and of its image as those of one antenna, by order.
pub(crate) fn with_image(direct: &BeamTree, image: &BeamTree) -> BeamTree {
    let mut both = BeamTree { beams: Vec::new(), ..direct.clone() };
    let shift = both.vertices_m.len() as u32;
    both.vertices_m.extend_from_slice(&image.vertices_m);
    both.borders.extend_from_slice(&image.borders);
    let highest = [direct, image].iter().filter_map(|tree| tree.beams.last()).map(|beam| beam.order).max().unwrap_or(0);
    let mut place_of = [vec![0_u32; direct.beams.len()], vec![0_u32; image.beams.len()]];
    for order in 1..=highest {
        for (tree, (beams, shift)) in [(&direct.beams, 0), (&image.beams, shift)].into_iter().enumerate() {
            for (index, beam) in beams.iter().enumerate().filter(|(_, beam)| beam.order == order) {
                place_of[tree][index] = both.beams.len() as u32;
                let parent = beam.parent.map(|parent| place_of[tree][parent as usize]);
                let polygon = beam.polygon.start + shift..beam.polygon.end + shift;
                both.beams.push(Beam { parent, polygon, ..beam.clone() });
            }
        }
    }
    both
}

/// Which of the two antennas a beam came from.
pub(crate) fn origin(tree: &BeamTree, beam: &Beam) -> Half {
    let is_direct = tree.way_back(beam).last().is_none_or(|first| first.image == tree.antenna);
    if is_direct { Half::Above } else { Half::Below }
}
