//! One frame of a drawn scene with its truth.

use crate::dataset::staging::StagedScene;
use evaluation::{FrameTruth, Truth};
use pipeline::chain::link::FrameProducts;

/// One frame of a scene.
pub(super) struct ObservedFrame {
    pub(super) products: FrameProducts,
    pub(super) truths: Vec<Truth>,
    /// Index of each vehicle's object; `None` if it was not detected.
    pub(super) object_of: Vec<Option<usize>>,
}

/// Pairs the vehicles of a frame with its objects, by the radar of its sub-frame.
pub(super) fn observe(staged: &StagedScene, products: FrameProducts) -> ObservedFrame {
    let result = &products.result;
    let paths = result.scattering.paths();
    let truth = FrameTruth::of(&staged.header, &result.scene, paths, &result.points.objects);
    ObservedFrame { products, truths: truth.truths, object_of: truth.pairing.object_of }
}
