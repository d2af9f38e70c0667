//! The slow obvious reference of [`crate::visibility`]: every facet is cut by every other, without hierarchy or lists.

use crate::antenna::Antenna;
use crate::clip::{Corner, Split, split};
use crate::shadow::{Hides, Scale, Shadow};
use crate::visibility::{Buffers, Parts, View, Visibility, clip_to_window};
use crate::world::World;

/// Tries all pairs.
pub(crate) struct EveryFacet;

impl Visibility for EveryFacet {
    fn direct(world: &World, antenna: Antenna, scale: &Scale) -> Vec<Parts> {
        vec![parts_in(world, &View { antenna, mirror: None, window: Vec::new() }, scale)]
    }

    fn reflected(world: &World, view: &View, scale: &Scale, _: &mut Buffers) -> Parts {
        parts_in(world, view, scale)
    }
}

fn parts_in(world: &World, view: &View, scale: &Scale) -> Parts {
    let shadows = all_shadows(world, view, scale);
    let mut parts = Parts::default();
    for target in &shadows {
        let mut corners = Vec::new();
        let Some(polygon) = clip_to_window(world, view, target, scale, &mut corners, &mut Vec::new()) else { continue };
        let mut pieces = vec![corners[polygon].to_vec()];
        for occluder in shadows.iter().filter(|occluder| occluder.facet != target.facet) {
            let (own, other) = (world.facet(occluder.facet), world.facet(target.facet));
            let hides = occluder.hides(own, target, other, scale);
            pieces = pieces.into_iter().flat_map(|piece| outside(piece, occluder, hides, scale)).collect();
        }
        pieces.iter().for_each(|piece| parts.push(target, view.antenna, piece, scale));
    }
    parts
}

fn all_shadows(world: &World, view: &View, scale: &Scale) -> Vec<Shadow> {
    let mirror = view.mirror.as_ref().map(|mirror| (mirror, world.facet(mirror.facet)));
    let facets = (0..).zip(world.facets());
    facets.filter_map(|(i, facet)| Shadow::of(i, facet, view.antenna, mirror, scale.tolerance_m)).collect()
}

/// The parts of a piece outside one shadow.
fn outside(piece: Vec<Corner>, occluder: &Shadow, hides: Hides, scale: &Scale) -> Vec<Vec<Corner>> {
    if hides == Hides::Nothing {
        return vec![piece];
    }
    let (mut kept, mut rest) = (Vec::new(), piece.clone());
    for plane in occluder.planes(hides) {
        let mut corners = rest.clone();
        match split(&mut corners, 0..rest.len(), &plane, scale.tolerance_m, &mut Vec::new()) {
            Split::Inside => {}
            Split::Outside => return vec![piece],
            Split::Cut { inside, outside } => {
                kept.push(corners[outside].to_vec());
                rest = corners[inside].to_vec();
            }
        }
    }
    kept
}
