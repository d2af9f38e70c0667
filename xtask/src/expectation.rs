//! What a run is expected to take: seconds learned from earlier runs on this machine, memory from the stages' own bounds.

use crate::cache::Cache;
use crate::chain::Chain;
use crate::failure::Failure;
use crate::output;
use crate::plan::FramePlan;
use crate::stages::Stage;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Seconds per unit of work by stage name.
type Rates = BTreeMap<String, f64>;

/// Before the first run: seconds per million units on two x86-64 cores, replaced by what this machine shows.
const FIRST_GUESS: [(Stage, f64); 4] =
    [(Stage::BartRcs, 200.0), (Stage::FmcwEcho, 0.002), (Stage::Dsp, 0.15), (Stage::Classifier, 0.05)];

/// Says what the plans cost.
pub(crate) fn tell(chain: &Chain, cache: Option<&Cache>, plans: &[FramePlan]) -> Result<(), Failure> {
    let rates = cache.map(read).unwrap_or_default();
    let mut seconds = 0.0;
    for plan in plans {
        let running: Vec<Stage> = plan.steps.iter().filter(|(_, why)| why.is_some()).map(|(s, _)| *s).collect();
        let expected: f64 = running.iter().map(|s| rate(&rates, *s) * work(chain, plan.index, *s)).sum();
        seconds += expected;
        let names: Vec<_> = running.iter().map(|s| s.name()).collect();
        let stages = if names.is_empty() { "nothing".into() } else { names.join(", ") };
        output::line(format!("frame {}: runs {stages}, about {expected:.1} s", plan.index));
    }
    let memory = plans.iter().map(|plan| chain.memory_estimate_mib(plan.index)).fold(0.0, f64::max);
    let memory = memory * chain.side_by_side() as f64;
    output::line(format!("{} frames, about {seconds:.1} s, at most about {memory:.0} MiB", plans.len()));
    Ok(())
}

/// Learns from the frames of a run that computed.
pub(crate) fn learn(cache: &Cache, chain: &Chain, frames: &[Value]) {
    let mut rates = read(cache);
    for (index, frame) in (0..).zip(frames) {
        let cached: Vec<&str> = frame["cached"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
        for (stage, _) in FIRST_GUESS {
            let seconds = frame["stage_seconds"][stage.name()].as_f64();
            if let (Some(seconds), false) = (seconds, cached.contains(&stage.name())) {
                rates.insert(stage.name().into(), seconds / work(chain, index, stage));
            }
        }
    }
    let bytes = serde_json::to_vec(&rates).unwrap_or_default();
    let _ = output::write_file(&place(cache), &bytes); // only expectations need it
}

fn read(cache: &Cache) -> Rates {
    std::fs::read(place(cache)).ok().and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default()
}

fn place(cache: &Cache) -> PathBuf {
    cache.root().join("seconds.json")
}

fn rate(rates: &Rates, stage: Stage) -> f64 {
    let guess = FIRST_GUESS.iter().find(|(s, _)| *s == stage).map_or(0.0, |(_, per_million)| per_million * 1e-6);
    rates.get(stage.name()).copied().unwrap_or(guess)
}

/// Units of work: triangles in view; triangles times samples; samples; one.
fn work(chain: &Chain, index: u32, stage: Stage) -> f64 {
    let triangles = chain.triangles(index);
    let samples = chain.cube_header.shape().iter().product::<usize>() as f64;
    match stage {
        Stage::BartRcs => triangles as f64,
        Stage::FmcwEcho => triangles as f64 * samples,
        Stage::Dsp => samples,
        Stage::Scene | Stage::Classifier => 1.0,
    }
}
