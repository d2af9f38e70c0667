//! Frames whose errors were measured, for the frames that take them over.

use artifact::paths::{ErrorOrigin, PathsFrame};
use artifact::scene::SceneHeader;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Frames whose errors were measured in this run, without their paths.
#[derive(Default)]
pub(crate) struct MeasuredFrames {
    own: Mutex<FramesByIndex>,
    /// Frames of another scene whose errors this one takes over.
    taken_over: FramesByIndex,
}

/// Measured frames by frame record.
pub type FramesByIndex = BTreeMap<u32, Arc<PathsFrame>>;

impl MeasuredFrames {
    /// Makes the record of a scene that takes over the errors measured in another one.
    pub(crate) fn taking_over(taken_over: FramesByIndex) -> Self {
        Self { taken_over, ..Self::default() }
    }

    /// All frames whose errors were measured in this scene.
    pub(crate) fn all(&self) -> FramesByIndex {
        self.lock_own().clone()
    }

    /// Frame of another scene in which the errors of this frame record were measured.
    pub(crate) fn taken_over(&self, index: u32) -> Option<Arc<PathsFrame>> {
        self.taken_over.get(&index).cloned()
    }

    /// Keeps frame record `index` if other frames take over its measured errors.
    pub(crate) fn record(&self, header: &SceneHeader, index: u32, frame: &PathsFrame) {
        if header.fidelity.measured_every > 1 && header.measured_in(index) == index {
            let without_paths = PathsFrame {
                paths: vec![],
                nearest_range_m: frame.nearest_range_m.clone(),
                trace: frame.trace.clone(),
                ..*frame
            };
            self.lock_own().insert(index, Arc::new(without_paths));
        }
    }

    pub(crate) fn get(&self, index: u32) -> Option<Arc<PathsFrame>> {
        self.lock_own().get(&index).cloned()
    }

    fn lock_own(&self) -> MutexGuard<'_, FramesByIndex> {
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
