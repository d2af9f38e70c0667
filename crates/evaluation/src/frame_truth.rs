//! Truth of one frame, made once when nothing can look at it any more: its bodies, whose objects are whose,
//! and what made each point.

use crate::labels::Origin;
use crate::pairing::{Pairing, Reach};
use crate::truth::{Truth, truths};
use artifact::paths::PathsFrame;
use artifact::points::Object;
use artifact::scene::{SceneFrame, SceneHeader};

/// Truth beside what was detected.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameTruth {
    /// Truths in the order of the frame's poses.
    pub truths: Vec<Truth>,
    /// Pairing of the frame's truths with its objects.
    pub pairing: Pairing,
    /// Origin of each point, in the order of the points; empty where nobody asked, and where echoes were made
    /// from tables.
    pub origins: Vec<Origin>,
    /// The scene's number of each body of the frame; empty where they are counted alike.
    pub bodies: Vec<u32>,
}

impl FrameTruth {
    /// The truth of a frame whose bodies are the targets of `view`; `paths` are those that made its echo,
    /// where they are known: without them every body counts as one that sends back an echo.
    pub fn of(
        view: &SceneHeader,
        frame: &SceneFrame,
        paths: Option<&PathsFrame>,
        objects: &[Object],
    ) -> Self {
        let view = view.in_frame(frame.index);
        let truths = truths(&view, frame, paths);
        let pairing = Pairing::of(&truths, objects, &Reach::of(&view));
        Self { truths, pairing, origins: vec![], bodies: vec![] }
    }

    /// A body of the frame as the whole scene counts it.
    pub fn number_of(&self, body: usize) -> u32 {
        self.bodies.get(body).copied().unwrap_or(body as u32)
    }
}
