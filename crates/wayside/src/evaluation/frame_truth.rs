//! All that is true of one frame, made once when nothing can look at it any more: its bodies, whose objects
//! are whose, and what made each point.

use crate::chain::link::{Chain, FrameProducts};
use crate::evaluation::labels::{self, Origin};
use crate::evaluation::pairing::{Pairing, Reach};
use crate::evaluation::truth::{self, Truth};
use crate::host::failure::Failure;

/// Truth beside what was detected.
pub(crate) struct FrameTruth {
    /// In the order of the frame's poses.
    pub(crate) truths: Vec<Truth>,
    pub(crate) pairing: Pairing,
    /// Of each point, in their order; empty where echoes were made from tables.
    pub(crate) origins: Vec<Origin>,
    /// The scene's number of each body of the frame.
    bodies: Vec<u32>,
}

impl FrameTruth {
    pub(crate) fn of(chain: &Chain, frame: &FrameProducts) -> Result<Self, Failure> {
        let result = &frame.result;
        let view = frame.view.in_frame(result.scene.index);
        let truths = truth::truths(&view, &result.scene, result.paths.as_ref());
        let pairing = Pairing::of(&truths, &result.points.objects, &Reach::of(&view));
        let bodies = scene::bodies_in_view(chain.header, result.scene.index);
        Ok(Self { truths, pairing, origins: origins(chain, frame)?, bodies })
    }

    /// A body of the frame as the whole scene counts it.
    pub(crate) fn number_of(&self, body: usize) -> u32 {
        self.bodies.get(body).copied().unwrap_or(body as u32)
    }
}

fn origins(chain: &Chain, frame: &FrameProducts) -> Result<Vec<Origin>, Failure> {
    let Some(paths) = &frame.result.paths else { return Ok(vec![]) };
    let header = chain.cube_header.in_frame(frame.result.scene.index);
    let noise = dsp::noise_power(&header, &frame.rdm).map_err(Failure::refused)?;
    let paths = &chain.synthesizer()?.with_ground(paths);
    labels::origins(&header, paths, noise, &frame.result.points.points).map_err(Failure::refused)
}
