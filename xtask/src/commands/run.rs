//! `run`: a scene to everything that can be known of it.

use super::load::{self, LoadedScene};
use crate::cache::Cache;
use crate::chain::{Chain, FrameProducts};
use crate::cli::RunArguments;
use crate::expectation;
use crate::failure::Failure;
use crate::output;
use crate::pictures::FrameFigures;
use crate::plan::FramePlan;
use crate::products::Products;
use crate::progress;
use crate::report;
use crate::stages::Stage;
use crate::summary;
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};

pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let cache = (!arguments.no_cache).then(|| Cache::open(&arguments.cache));
    let loaded = load::scene(&arguments.scene, cache.as_ref())?;
    let model = load::model(arguments.classifier.as_deref())?;
    let chain = Chain::of(&loaded.header, cache.as_ref(), model.as_ref());
    let plans: Vec<FramePlan> = (0..loaded.header.frames).map(|i| chain.plan(i)).collect();
    if arguments.explain {
        let verdict = if loaded.cached { "cached" } else { "runs: a file it reads is new or changed" };
        output::line(format!("{}: {verdict}", Stage::Scene.name()));
        plans.iter().for_each(FramePlan::explain);
    }
    if arguments.dry_run {
        return expectation::tell(&chain, cache.as_ref(), &plans);
    }
    let out = arguments.out.clone().unwrap_or_else(|| PathBuf::from("out").join(&loaded.header.name));
    let (frames, figures) = compute(&chain, &loaded, &plans, &out)?;
    if let Some(cache) = &cache {
        expectation::learn(cache, &chain, &frames);
        cache.trim();
    }
    conclude(&loaded, frames, &figures, &out)
}

/// Frame after frame, so that memory does not grow with their number.
fn compute(
    chain: &Chain,
    loaded: &LoadedScene,
    plans: &[FramePlan],
    out: &Path,
) -> Result<(Vec<Value>, Vec<FrameFigures>), Failure> {
    let mut products = Products::create(chain, out, &loaded.files)?;
    let mut frames = Vec::new();
    for plan in plans {
        progress::note(format!("frame {} of {}", plan.index + 1, plans.len()));
        let mut frame: FrameProducts = chain.frame(plan)?;
        frame.result.seconds.insert(0, (Stage::Scene, if plan.index == 0 { loaded.seconds } else { 0.0 }));
        if loaded.cached {
            frame.result.cached.insert(0, Stage::Scene);
        }
        products.write(chain, &mut frame)?;
        frames.push(summary::frame(chain.header, &frame.result));
    }
    Ok((frames, products.finish()?))
}

fn conclude(loaded: &LoadedScene, frames: Vec<Value>, figures: &[FrameFigures], out: &Path) -> Result<(), Failure> {
    let mut root: Map<String, Value> = summary::head(&loaded.header);
    root.insert("frames".into(), frames.into());
    let root = Value::Object(root);
    let text = serde_json::to_string_pretty(&root).map_err(Failure::refused)?;
    output::write_file(&out.join("summary.json"), text.as_bytes())?;
    report::write(&root, figures, out)?;
    summary::tell(&root);
    output::line(format!("report: {}", out.join("report.html").display()));
    Ok(())
}
