//! The slow obvious reference of [`crate::beams::visibility`]: every facet is cut by every other, without hierarchy or lists.

use crate::beams::shadow::{Hides, Shadow};
use crate::beams::view::View;
use crate::beams::visibility::{Buffers, Parts, Visibility};
use crate::geometry::border::Border;
use crate::geometry::clip::{Corner, Split, split};

/// Tries all pairs.
pub(crate) struct EveryFacet;

impl Visibility for EveryFacet {
    fn direct(view: &View) -> Vec<Parts> {
        vec![parts_in(view)]
    }

    fn reflected(view: &View, _: &mut Buffers) -> Parts {
        parts_in(view)
    }
}

fn parts_in(view: &View) -> Parts {
    let facets = 0..view.world.facets().len() as u32;
    let shadows: Vec<Shadow> = facets.filter_map(|facet| Shadow::of(facet, view)).collect();
    let mut parts = Parts::default();
    for target in &shadows {
        let mut corners = Vec::new();
        let Some(polygon) = view.clip(target, &mut corners, &mut Vec::new()) else { continue };
        let mut pieces = vec![corners[polygon].to_vec()];
        for occluder in shadows.iter().filter(|occluder| occluder.facet != target.facet) {
            let hides = occluder.hides(target, view);
            pieces = pieces.into_iter().flat_map(|piece| outside(piece, occluder, hides, view.tolerance_m())).collect();
        }
        pieces.iter().for_each(|piece| parts.push(target, view, piece));
    }
    parts
}

/// The parts of a piece outside one shadow.
fn outside(piece: Vec<Corner>, occluder: &Shadow, hides: Hides, tolerance_m: f64) -> Vec<Vec<Corner>> {
    if hides == Hides::Nothing {
        return vec![piece];
    }
    let (mut kept, mut rest) = (Vec::new(), piece.clone());
    for plane in occluder.planes(hides) {
        let mut corners = rest.clone();
        match split(&mut corners, 0..rest.len(), &plane, Border::SHADOW, tolerance_m, &mut Vec::new()) {
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
