//! The work of a run, counted before it begins.

use crate::chain::cache::Cache;
use crate::chain::expectation::tracer_work;
use crate::chain::expectation::work::{WorkCounts, WorkKind};
use crate::chain::link::Chain;
use crate::chain::plan::FramePlan;
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use artifact::scene::{SceneHeader, Target, TargetKind};
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
        let [bodies, points] = bodies_and_points(chain.header, plan.index);
        work.add(WorkKind::Bodies, bodies);
        work.add(WorkKind::PointTargets, points);
        if chain.header.dsp.angle != Angle::Fft {
            work.add(WorkKind::SeparatedBodies, bodies + points);
        }
    }
}

/// Bodies with a mesh, each of many echoes, and points, each of one.
fn bodies_and_points(header: &SceneHeader, index: u32) -> [f64; 2] {
    let is_point = |target: &&Target| matches!(target.kind, TargetKind::Point { .. });
    let points = header.targets.iter().filter(is_point).count();
    let bodies = header.targets.len() - points + scene::vehicles_in_view(header, index).len();
    [bodies as f64, points as f64]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_counted_as_one_echo_and_not_as_a_body_of_many() {
        let options = scene::ReadOptions::names_only();
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/intersection.toml");
        let mut header = scene::read(&file, &options).unwrap();
        let [bodies, points] = bodies_and_points(&header, 0);
        assert!(bodies > 1.0);
        header.targets[0].kind = TargetKind::Point { rcs_m2: 1.0, wheel: None };
        assert_eq!(bodies_and_points(&header, 0), [bodies - 1.0, points + 1.0]);
    }
}
