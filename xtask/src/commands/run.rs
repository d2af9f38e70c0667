//! `run`: a scene to everything that can be known of it.

use super::load::{self, LoadedScene};
use crate::cache::Cache;
use crate::chain::{Chain, FrameProducts};
use crate::cli::{RunArguments, SceneArguments};
use crate::console;
use crate::expectation;
use crate::failure::Failure;
use crate::frame_truth::FrameTruth;
use crate::loaded_model::LoadedModel;
use crate::output;
use crate::plan::FramePlan;
use crate::processor_time;
use crate::products::{Figures, Products};
use crate::progress::{self, Work};
use crate::report;
use crate::several_radars::{self, Told};
use crate::stages::Stage;
use crate::sub_frames;
use crate::summary;
use crate::tracking::{self, Tracking};
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};
use std::time::Instant;

pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let cache = (!arguments.no_cache).then(|| Cache::open(&arguments.cache)).transpose()?;
    if let (Some(cache), Some(out)) = (&cache, &arguments.out) {
        apart(cache, out)?;
    }
    let model = load::model(arguments.classifier.as_deref())?;
    let runs = runs(arguments)?;
    // All before the first is computed: what is wrong with the last radar is said at once.
    let load = |run: &Run| load::scene(&run.scene, cache.as_ref());
    let loaded: Vec<LoadedScene> = runs.iter().map(load).collect::<Result<_, _>>()?;
    let mut told = vec![];
    for (run, loaded) in runs.iter().zip(&loaded) {
        if runs.len() > 1 {
            output::line(format!("radar {}", run.scene.radar.as_deref().unwrap_or_default()));
        }
        told.extend(one_radar(arguments, loaded, cache.as_ref(), model.as_ref(), run.out.as_deref())?);
    }
    let is_of_all = arguments.scene.radar.is_none() && runs.iter().all(|run| run.scene.radar.is_some());
    if is_of_all && !told.is_empty() { several_radars::conclude(&told) } else { Ok(()) }
}

/// Results are for good, a cache is not: one folder cannot be both.
fn apart(cache: &Cache, out: &Path) -> Result<(), Failure> {
    let is_same = out == cache.root()
        || matches!((std::fs::canonicalize(out), std::fs::canonicalize(cache.root())), (Ok(a), Ok(b)) if a == b);
    match is_same {
        true => Err(Failure::System(format!("{}: --out and --cache have to be two folders", out.display()))),
        false => Ok(()),
    }
}

/// The scene through one radar, and where all of it goes.
struct Run {
    scene: SceneArguments,
    /// `None`: under the scene's name.
    out: Option<PathBuf>,
}

/// One run; or, where the scene has several radars and none is asked for, one for each.
fn runs(arguments: &RunArguments) -> Result<Vec<Run>, Failure> {
    let radars = match arguments.scene.radar {
        Some(_) => vec![],
        None => scene::radars(&arguments.scene.scene).map_err(load::of_scene)?,
    };
    if radars.is_empty() {
        return Ok(vec![Run { scene: arguments.scene.clone(), out: arguments.out.clone() }]);
    }
    let run = |id: String| {
        let out = arguments.out.as_ref().map(|out| out.join(&id));
        Run { scene: SceneArguments { radar: Some(id), ..arguments.scene.clone() }, out }
    };
    Ok(radars.into_iter().map(run).collect())
}

/// Everything that is known through one radar; `None` where it is only told what would be done.
fn one_radar(
    arguments: &RunArguments,
    loaded: &LoadedScene,
    cache: Option<&Cache>,
    model: Option<&LoadedModel>,
    out: Option<&Path>,
) -> Result<Option<Told>, Failure> {
    let chain = Chain::of(&loaded.header, cache, model);
    let plans: Vec<FramePlan> = (0..loaded.header.frames).map(|i| chain.plan(i)).collect();
    if arguments.explain {
        let verdict = if loaded.cached { "cached" } else { "runs: a file it reads is new or changed" };
        output::line(format!("{}: {verdict}", Stage::Scene.name()));
        plans.iter().for_each(FramePlan::explain);
    }
    if arguments.dry_run {
        expectation::tell(&chain, cache, &plans)?;
        return Ok(None);
    }
    let out = out.map_or_else(|| PathBuf::from("out").join(&loaded.header.name), Path::to_owned);
    output::claim(&["summary.json", "report.html"].map(|name| out.join(name)))?;
    let (start, begin) = (Instant::now(), processor_time::of_process());
    let (computed, figures) = compute(&chain, loaded, &plans, &out)?;
    let processor = processor_time::of_process().zip(begin).map(|(end, begin)| end - begin);
    let took = Took { seconds: start.elapsed().as_secs_f64(), processor };
    if let Some(cache) = cache {
        cache.trim();
    }
    let summary = conclude(loaded, computed, took, &figures, &out)?;
    Ok(Some(Told { summary, seen: figures.seen, out }))
}

/// What all frames took, to the last picture's end.
struct Took {
    /// By the clock.
    seconds: f64,
    /// Of all threads; `None` where the system does not tell.
    processor: Option<f64>,
}

/// What `summary.json` tells of all frames.
struct Computed {
    frames: Vec<Value>,
    metrics: Value,
}

/// A few frames at a time, so that memory does not grow with their number; written in their order.
fn compute(
    chain: &Chain,
    loaded: &LoadedScene,
    plans: &[FramePlan],
    out: &Path,
) -> Result<(Computed, Figures), Failure> {
    let mut products = Products::create(chain, out, &loaded.files)?;
    let mut tracking = Tracking::of(chain)?;
    let (mut frames, mut cycle) = (Vec::new(), Vec::new());
    let work = Work::begin("frames");
    let at_once = chain.side_by_side(plans)?;
    chain.share_memory(at_once);
    for plans_at_once in plans.chunks(at_once) {
        let first = plans_at_once.first().map_or(0, |plan| plan.index as usize);
        work.at(first, plans.len());
        progress::note(format!("frame {} of {}", first + 1, plans.len()));
        for mut frame in side_by_side(chain, plans_at_once)? {
            let is_first = frame.result.scene.index == 0;
            frame.result.seconds.insert(0, (Stage::Scene, if is_first { loaded.seconds } else { 0.0 }));
            if loaded.cached {
                frame.result.cached.insert(0, Stage::Scene);
            }
            cycle.push(frame);
            if cycle.len() == sub_frames::in_cycle(&chain.cube_header) {
                for frame in resolved(chain, std::mem::take(&mut cycle)) {
                    let truth = FrameTruth::of(chain, &frame)?;
                    let (tracks, told_of_tracks) = tracking.follow(&frame, &truth)?;
                    let mut told = summary::frame(&frame.view, &frame.result, &truth);
                    tracking::join(&mut told["targets"], &told_of_tracks);
                    told["tracks"] = told_of_tracks;
                    frames.push(told);
                    progress::during("artifacts and pictures", || products.write(chain, frame, &truth, &tracks))?;
                }
            }
        }
    }
    Ok((Computed { frames, metrics: tracking.metrics() }, products.finish()?))
}

/// The sub-frames of a cycle, which tell each other's velocities.
fn resolved(chain: &Chain, mut cycle: Vec<FrameProducts>) -> Vec<FrameProducts> {
    let points = cycle.iter().map(|frame| frame.result.points.clone()).collect();
    let points = sub_frames::with_velocities(&chain.cube_header, points);
    cycle.iter_mut().zip(points).for_each(|(frame, points)| frame.result.points = points);
    cycle
}

/// Frames computed at the same time, in their order. Where bodies stand as in another of them, a frame waits for that one's
/// paths and finds them in the cache; so does one that takes over what is measured in another.
fn side_by_side(chain: &Chain, plans: &[FramePlan]) -> Result<Vec<FrameProducts>, Failure> {
    let waits_for = |i: usize, earlier: &FramePlan| {
        earlier.keys.bart_rcs == plans[i].keys.bart_rcs || earlier.index == chain.header.measured_in(plans[i].index)
    };
    let is_new = |i: usize| plans[..i].iter().all(|earlier| !waits_for(i, earlier));
    let (new, known): (Vec<usize>, Vec<usize>) = (0..plans.len()).partition(|i| is_new(*i));
    let mut frames = at_once(chain, new.into_iter().map(|i| &plans[i]))?;
    frames.extend(at_once(chain, known.into_iter().map(|i| &plans[i]))?);
    frames.sort_by_key(|frame| frame.result.scene.index);
    Ok(frames)
}

/// Each frame on a thread of its own: threads of the pool would take up a further frame while they wait for a part of one,
/// and hold more than was allowed.
fn at_once<'a>(chain: &Chain, plans: impl Iterator<Item = &'a FramePlan>) -> Result<Vec<FrameProducts>, Failure> {
    std::thread::scope(|scope| {
        let threads: Vec<_> = plans.map(|plan| scope.spawn(|| chain.frame(plan))).collect();
        let joined = threads.into_iter().map(|thread| thread.join().unwrap_or_else(|p| std::panic::resume_unwind(p)));
        joined.collect()
    })
}

fn conclude(
    loaded: &LoadedScene,
    computed: Computed,
    took: Took,
    figures: &Figures,
    out: &Path,
) -> Result<Value, Failure> {
    let _under_way = Work::begin("summary and report");
    let mut root: Map<String, Value> = summary::head(&loaded.header);
    root.insert("frames_seconds".into(), took.seconds.into());
    root.insert("frames_processor_seconds".into(), took.processor.into());
    root.insert("metrics".into(), computed.metrics);
    root.insert("frames".into(), computed.frames.into());
    let root = Value::Object(root);
    let text = serde_json::to_string_pretty(&root).map_err(Failure::refused)?;
    output::write_file(&out.join("summary.json"), text.as_bytes())?;
    report::write(&root, figures, out)?;
    console::tell(&root);
    output::line(format!("report: {}", out.join("report.html").display()));
    Ok(root)
}
