//! One frame of a drawn scene with its truth.

use crate::dataset::staging::StagedScene;
use evaluation::{MeasurementLimits, Pairing, Truth, truths};
use pipeline::chain::link::FrameProducts;

/// One frame of a scene.
pub(super) struct ObservedFrame {
    pub(super) products: FrameProducts,
    pub(super) truths: Vec<Truth>,
    /// Index of each vehicle's object; `None` if it was not detected.
    pub(super) object_of: Vec<Option<usize>>,
}

/// Pairs the vehicles of a frame with its objects.
pub(super) fn observe(staged: &StagedScene, products: FrameProducts) -> ObservedFrame {
    let result = &products.result;
    let truths = truths(&staged.header, &result.scene, result.scattering.paths());
    let object_of =
        Pairing::of(&truths, &result.points.objects, &MeasurementLimits::of(&staged.header)).object_of;
    ObservedFrame { products, truths, object_of }
}
