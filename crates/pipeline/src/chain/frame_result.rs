//! Result of one frame after all stages.

use crate::chain::class_rule::ClassRule;
use crate::chain::stages::Stage;
use artifact::accuracy::{ErrorBudget, ModelError};
use artifact::paths::PathsFrame;
use artifact::points::PointsFrame;
use artifact::rcs::RcsFrame;
use artifact::scene::{SceneFrame, SceneHeader};

/// Scattering of one frame, as the tracer hands it to the echo: paths, or tables of bodies.
#[expect(clippy::large_enum_variant, reason = "one is made a frame, and never one of many")]
pub enum Scattering {
    /// Paths from the transmitter over the bodies to the receiver.
    Paths(PathsFrame),
    /// Far-field tables of the bodies.
    Tables(RcsFrame),
}

impl Scattering {
    /// Numerical errors, and the errors of the physical model.
    pub fn error(&self) -> (ErrorBudget, ModelError) {
        match self {
            Self::Paths(frame) => (frame.error, frame.model_error),
            Self::Tables(frame) => (frame.error, frame.model_error),
        }
    }

    /// Paths of the frame; `None` for tables.
    pub fn paths(&self) -> Option<&PathsFrame> {
        match self {
            Self::Paths(frame) => Some(frame),
            Self::Tables(_) => None,
        }
    }

    /// The scattering with bodies numbered as in the scene's artifacts instead of the frame's view.
    pub fn numbered_as_in(self, scene: &SceneHeader) -> Self {
        let numbers = |index: u32| {
            let bodies = scene::bodies_in_view(scene, index);
            move |body: u32| bodies.get(body as usize).copied().unwrap_or(body)
        };
        match self {
            Self::Paths(frame) => {
                let number = numbers(frame.index);
                Self::Paths(frame.renumbered(number))
            }
            Self::Tables(mut frame) => {
                let number = numbers(frame.index);
                frame.tables.iter_mut().for_each(|table| table.target = number(table.target));
                Self::Tables(frame)
            }
        }
    }
}

/// Result of one frame: points, classes, errors, time and memory, beside the scene and its paths.
pub struct FrameResult {
    /// Poses of the bodies in this frame.
    pub scene: SceneFrame,
    /// Paths or tables that the echo is made of, as the tracer made them.
    pub scattering: Scattering,
    /// Points and objects.
    pub points: PointsFrame,
    /// Probabilities of each object, in the order of [`Class::ALL`]; empty without a classifier.
    pub(crate) classes: Vec<[f32; 4]>,
    /// Rule that decides for a class from the probabilities.
    pub(crate) rule: ClassRule,
    /// Numerical errors.
    pub error: ErrorBudget,
    /// Errors of the physical model.
    pub model_error: ModelError,
    /// Time of each stage that ran, s.
    pub seconds: Vec<(Stage, f64)>,
    /// Stages whose frame came from the cache.
    pub cached: Vec<Stage>,
    pub(crate) memory_estimate_mib: f64,
}
