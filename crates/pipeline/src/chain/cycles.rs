//! Sub-frames of one frame, brought together.

use crate::chain::link::{Chain, FrameProducts};
use crate::host::failure::Failure;

/// The sub-frames of a cycle, which tell each other's velocities; of a lone one there is nothing to tell, and
/// no receiver is needed where all is in the cache.
pub fn resolved(chain: &Chain, mut cycle: Vec<FrameProducts>) -> Result<Vec<FrameProducts>, Failure> {
    if cycle.len() < 2 {
        return Ok(cycle);
    }
    let points = cycle.iter().map(|frame| frame.result.points.clone()).collect();
    let points = chain.receiver()?.resolved(points);
    cycle.iter_mut().zip(points).for_each(|(frame, points)| frame.result.points = points);
    Ok(cycle)
}
