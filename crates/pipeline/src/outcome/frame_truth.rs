//! Ground truth of a frame that the chain made, from its scene, its paths and its map's noise.

use crate::chain::link::{Chain, FrameProducts};
use crate::host::failure::Failure;
use evaluation::{FrameTruth, Origin, origins};

/// Ground truth of a frame, including the origins of its points.
pub fn frame_truth(chain: &Chain, frame: &FrameProducts) -> Result<FrameTruth, Failure> {
    let result = &frame.result;
    let truth = FrameTruth::of(&frame.view, &result.scene, result.scattering.paths(), &result.points.objects);
    let bodies = scene::bodies_in_view(chain.header, result.scene.index);
    Ok(FrameTruth { origins: origins_of_points(chain, frame)?, bodies, ..truth })
}

fn origins_of_points(chain: &Chain, frame: &FrameProducts) -> Result<Vec<Origin>, Failure> {
    let Some(paths) = frame.result.scattering.paths() else { return Ok(vec![]) };
    let header = chain.cube_header().in_frame(frame.result.scene.index);
    let noise = dsp::noise_power(&header, &frame.rdm).map_err(Failure::refused)?;
    let paths = &chain.synthesizer()?.with_ground(paths);
    origins(&header, paths, noise, &frame.result.points.points).map_err(Failure::refused)
}
