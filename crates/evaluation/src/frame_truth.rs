//! Ground truth of one frame, made after all processing: its bodies, their objects, and the origin of each
//! point.

use crate::labelled_box::LabelledBox;
use crate::labels::Origin;
use crate::pairing::{Pairing, Reach};
use crate::truth::{Truth, truths};
use artifact::cube::CubeHeader;
use artifact::paths::PathsFrame;
use artifact::points::Object;
use artifact::scene::{SceneFrame, SceneHeader};

/// Ground truth of a frame's detections.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameTruth {
    /// Truths in the order of the frame's poses.
    pub truths: Vec<Truth>,
    /// Pairing of the frame's truths with its objects.
    pub pairing: Pairing,
    /// Origin of each point, in the order of the points; empty if not requested, and for echoes from tables.
    pub origins: Vec<Origin>,
    /// The scene's number of each body of the frame; empty if the numbers are the same.
    pub bodies: Vec<u32>,
}

impl FrameTruth {
    /// Ground truth of a frame whose bodies are the targets of `view`; `paths` are those of its echo, if
    /// known: without them every body counts as one that returns an echo.
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

    /// Ground truth of a frame by the labels of its bodies, which tell no velocities: objects are paired by
    /// place alone. `cube` is the radar of the frame with its settings.
    pub fn of_labels(cube: &CubeHeader, labels: &[LabelledBox], objects: &[Object]) -> Self {
        let truths: Vec<Truth> = labels.iter().map(|label| label.truth(cube)).collect();
        let pairing = Pairing::of(&truths, objects, &Reach::by_place(&cube.radar));
        Self { truths, pairing, origins: vec![], bodies: labels.iter().map(|label| label.number).collect() }
    }

    /// The scene's number of a body of the frame.
    pub fn number_of(&self, body: usize) -> u32 {
        self.bodies.get(body).copied().unwrap_or(body as u32)
    }
}
