//! One frame of a drawn scene with its truth.

use crate::dataset::staging::Staged;
use evaluation::{Pairing, Reach, Truth, truths};
use pipeline::chain::link::FrameProducts;

/// One frame of a scene.
pub(super) struct SeenFrame {
    pub(super) products: FrameProducts,
    pub(super) truths: Vec<Truth>,
    /// Index of each vehicle's object; `None` if it was not detected.
    pub(super) object_of: Vec<Option<usize>>,
}

/// Pairs the vehicles of a frame with its objects.
pub(super) fn seen(staged: &Staged, products: FrameProducts) -> SeenFrame {
    let result = &products.result;
    let truths = truths(&staged.header, &result.scene, result.scattering.paths());
    let object_of = Pairing::of(&truths, &result.points.objects, &Reach::of(&staged.header)).object_of;
    SeenFrame { products, truths, object_of }
}
