//! The work of a run, counted before it begins.

use crate::chain::cache::Cache;
use crate::chain::expectation::tracer_work;
use crate::chain::expectation::work::{WorkCounts, WorkKind};
use crate::chain::link::Chain;
use crate::chain::plan::FramePlan;
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use artifact::settings::Angle;

/// The work of all frames.
pub(super) fn of_run(
    chain: &Chain,
    cache: Option<&Cache>,
    plans: &[FramePlan],
) -> Result<WorkCounts, Failure> {
    let mut work = WorkCounts::NONE;
    work.add(WorkKind::Run, 1.0);
    work.add(WorkKind::Frames, plans.len() as f64);
    let meshes = chain.header.meshes.iter();
    work.add(WorkKind::Triangles, meshes.map(|mesh| mesh.triangles.len() as f64).sum());
    let paths = tracer_work::add(chain, cache, plans, &mut work)?;
    for (plan, paths) in plans.iter().zip(paths) {
        add_signal(chain, plan, paths, &mut work);
    }
    Ok(work)
}

/// Echo, maps and points of one frame.
fn add_signal(chain: &Chain, plan: &FramePlan, paths: f64, work: &mut WorkCounts) {
    let samples = chain.cube_header().shape().iter().product::<usize>() as f64;
    let channels = chain.header.radar.virtual_channels() as f64;
    if plan.runs(Stage::FmcwEcho) {
        work.add(WorkKind::Echoes, paths * channels);
        work.add(WorkKind::Samples, samples);
        let patches = chain.header.backscatter.map_or(0, |_| fmcw_echo::ground::patches(&chain.header.radar));
        work.add(WorkKind::GroundEchoes, patches as f64 * channels);
    }
    if plan.runs(Stage::Dsp) {
        work.add(WorkKind::MapCells, samples);
        let bodies = bodies(chain, plan.index);
        work.add(WorkKind::Bodies, bodies);
        if chain.header.dsp.angle != Angle::Fft {
            work.add(WorkKind::SeparatedBodies, bodies);
        }
    }
}

fn bodies(chain: &Chain, index: u32) -> f64 {
    (chain.header.targets.len() + scene::vehicles_in_view(chain.header, index).len()) as f64
}
