//! Frames whose errors were measured, for the frames that take them over.

use artifact::paths::{ErrorOrigin, PathsFrame};
use artifact::scene::SceneHeader;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Frames whose errors were measured in this run, without their paths.
#[derive(Default)]
pub(crate) struct MeasuredFrames {
    own: Mutex<Known>,
    /// Frames of another scene whose errors this one takes over.
    taken_over: Known,
}

/// Measured frames by frame record.
pub type Known = BTreeMap<u32, Arc<PathsFrame>>;

impl MeasuredFrames {
    /// Makes the record of a scene that takes over the errors measured in another one.
    pub(crate) fn of_another(taken_over: Known) -> Self {
        Self { taken_over, ..Self::default() }
    }

    /// All frames whose errors were measured in this scene.
    pub(crate) fn all(&self) -> Known {
        self.known().clone()
    }

    /// Frame of another scene in which the errors of this frame record were measured.
    pub(crate) fn taken_over(&self, index: u32) -> Option<Arc<PathsFrame>> {
        self.taken_over.get(&index).cloned()
    }

    /// Keeps frame record `index` if other frames take over its measured errors.
    pub(crate) fn keep(&self, header: &SceneHeader, index: u32, frame: &PathsFrame) {
        if header.fidelity.measured_every > 1 && header.measured_in(index) == index {
            let without_paths = PathsFrame {
                paths: vec![],
                nearest_range_m: frame.nearest_range_m.clone(),
                trace: frame.trace.clone(),
                ..*frame
            };
            self.known().insert(index, Arc::new(without_paths));
        }
    }

    pub(crate) fn get(&self, index: u32) -> Option<Arc<PathsFrame>> {
        self.known().get(&index).cloned()
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.own.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The frame record in which the errors of record `index` were measured.
pub(crate) fn errors_of_frame(header: &SceneHeader, index: u32, paths: &PathsFrame) -> u32 {
    match paths.trace.origin {
        ErrorOrigin::Measured => index,
        ErrorOrigin::TakenOver => header.measured_in(index),
    }
}
