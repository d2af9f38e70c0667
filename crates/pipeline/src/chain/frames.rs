//! Frames of a scene: made side by side and handed on in order, with the sub-frames of a cycle joined.

use crate::chain::keys::Key;
use crate::chain::link::{Chain, FrameProducts};
use crate::chain::plan::FramePlan;
use crate::host::cancellation::Cancellation;
use crate::host::failure::Failure;
use crate::host::ordered_jobs::run_in_order;
use crate::host::progress::{FrameStage, Work};
use std::collections::HashMap;

/// Hands on the results of these frames, in order and on this thread, while later ones are made: as many at a
/// time as threads and memory allow. `stages` are those that `make` runs.
///
/// # Errors
/// The first error of `make` or `take`; the work was cancelled between two frames.
pub fn each_frame<T: Send>(
    chain: &Chain,
    (plans, stages): (&[FramePlan], &[FrameStage]),
    cancellation: &Cancellation,
    make: impl Fn(&FramePlan) -> Result<T, Failure> + Sync,
    mut take: impl FnMut(T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let work = Work::in_stages("frames", stages);
    work.at(0, plans.len());
    let at_once = chain.frames_at_once(plans)?;
    chain.share_memory(at_once);
    let make = |i: usize| cancellation.check().and_then(|()| make(&plans[i]));
    let mut taken = 0;
    let take = |of_frame: T| {
        taken += 1;
        work.at(taken, plans.len());
        take(of_frame)
    };
    run_in_order(&needed_frames(chain, plans), at_once, make, take)
}

/// Earlier frames that each frame waits for: those with the same poses, whose paths it finds in the cache,
/// and those whose measured errors it takes over.
fn needed_frames<'a>(chain: &Chain, plans: &'a [FramePlan]) -> Vec<Vec<usize>> {
    let mut last_of_paths: HashMap<&'a Key, usize> = HashMap::new();
    let of_frame = |(i, plan): (usize, &'a FramePlan)| {
        let same = last_of_paths.insert(&plan.keys.bart_rcs, i);
        let measured_in = chain.header.measured_in(plan.index) as usize;
        same.into_iter().chain((measured_in < i).then_some(measured_in)).collect()
    };
    plans.iter().enumerate().map(of_frame).collect()
}

/// Resolves the velocities of a cycle's sub-frames by each other. A single frame stays as it is, and no
/// receiver is made if everything is in the cache.
pub fn resolved(chain: &Chain, mut cycle: Vec<FrameProducts>) -> Result<Vec<FrameProducts>, Failure> {
    if cycle.len() < 2 {
        return Ok(cycle);
    }
    let points = cycle.iter().map(|frame| frame.result.points.clone()).collect();
    let points = chain.receiver()?.resolved(points);
    cycle.iter_mut().zip(points).for_each(|(frame, points)| frame.result.points = points);
    Ok(cycle)
}
