//! Result of one frame when its chain is done.

use crate::chain::stages::Stage;
use crate::chain::told_class::ClassRule;
use artifact::accuracy::{ErrorBudget, ModelError};
use artifact::paths::PathsFrame;
use artifact::points::PointsFrame;
use artifact::scene::SceneFrame;

/// Result of one frame: points, classes, errors, time and memory, beside the scene and its paths.
pub(crate) struct FrameResult {
    pub(crate) scene: SceneFrame,
    pub(crate) paths: Option<PathsFrame>,
    pub(crate) points: PointsFrame,
    /// Probabilities of each object, in the order of [`Class::ALL`]; empty without a classifier.
    pub(crate) classes: Vec<[f32; 4]>,
    /// Rule by which a class is told from the probabilities.
    pub(crate) rule: ClassRule,
    pub(crate) error: ErrorBudget,
    pub(crate) model_error: ModelError,
    pub(crate) seconds: Vec<(Stage, f64)>,
    pub(crate) cached: Vec<Stage>,
    pub(crate) memory_estimate_mib: f64,
}
