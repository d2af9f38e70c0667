//! `dataset`: labelled signatures and crops of scenes that a recipe draws. Shards are written whole or not at
//! all, and a shard that exists, whole and of this recipe, is not made again; beside each stands one line per
//! scene with truth and estimates.

mod recipe;
mod rules;
mod models;
mod document;
mod draws;
mod places;
mod staging;
mod shots;
mod seen;
mod shard;
mod lines;
mod resumption;
mod accuracy;
mod table;

use crate::host::failure::Failure;
use crate::host::files;
use crate::host::memory::Allowance;
use crate::host::progress::Work;
use crate::program::learning_cli::DatasetArguments;
use crate::program::terminal;
use recipe::Recipe;
use serde_json::Value;
use std::io::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};

pub(crate) fn run(arguments: &DatasetArguments, memory: Allowance) -> Result<(), Failure> {
    let recipe = Recipe::read(&arguments.spec, arguments.seed)?;
    let shards = shards(&recipe);
    let mine = |number: &u64| number % u64::from(arguments.shard.of) == u64::from(arguments.shard.number - 1);
    files::claim(&["manifest.jsonl", "scenes.jsonl", "detection.md"].map(|name| arguments.out.join(name)))?;
    let work = Work::begin("dataset");
    let numbers_of = |number: u64| scenes_of(&recipe, number);
    let of_one = |number: u64| numbers_of(number).count();
    let total = shards.clone().filter(mine).map(of_one).sum();
    let mut done = 0;
    for number in shards.clone().filter(mine) {
        let scenes = draws::draw(&recipe, numbers_of(number));
        let (shard, lines) = (shard_file(&arguments.out, number), scene_lines(&arguments.out, number));
        if !resumption::is_made(&recipe, &scenes, &shard, &lines)? {
            let making =
                shard::ShardMaking { recipe: &recipe, memory, tell: &|within| work.at(done + within, total) };
            shard::make(&making, &scenes, &shard, &lines)?;
        }
        done += scenes.len();
        work.at(done, total);
    }
    drop(work);
    conclude(&arguments.out, shards)
}

/// Numbers of all shards.
fn shards(recipe: &Recipe) -> Range<u64> {
    0..draws::count(recipe).div_ceil(u64::from(recipe.asked.scenes_per_shard))
}

/// Numbers of the scenes of a shard.
fn scenes_of(recipe: &Recipe, shard: u64) -> Range<u64> {
    let each = u64::from(recipe.asked.scenes_per_shard);
    shard * each..((shard + 1) * each).min(draws::count(recipe))
}

fn shard_file(out: &Path, number: u64) -> PathBuf {
    out.join(format!("shard-{number:04}.dataset"))
}

/// Written after the shard itself: where it is, the shard is whole.
fn scene_lines(out: &Path, number: u64) -> PathBuf {
    out.join(format!("shard-{number:04}.jsonl"))
}

/// `manifest.jsonl`: a line a sample; `scenes.jsonl`: a line a scene; `detection.md`: errors of all vehicles,
/// found or not.
fn conclude(out: &Path, shards: Range<u64>) -> Result<(), Failure> {
    let mut scenes: Vec<Value> = Vec::new();
    for number in shards {
        let file = scene_lines(out, number);
        if !file.exists() {
            terminal::line(format!("{}: not made yet (another part of --shard)", file.display()));
            return Ok(());
        }
        scenes.extend(lines::read(&file)?);
    }
    let vehicles = lines::vehicles(&scenes);
    let found: Vec<&Value> = vehicles.iter().filter(|vehicle| lines::is_found(vehicle)).collect();
    files::write_with(&out.join("manifest.jsonl"), |s| found.iter().try_for_each(|l| writeln!(s, "{l}")))?;
    files::write_with(&out.join("scenes.jsonl"), |s| scenes.iter().try_for_each(|l| writeln!(s, "{l}")))?;
    files::write_file(&out.join("detection.md"), table::detection(&vehicles).as_bytes())?;
    let (samples, asked) = (found.len(), vehicles.len());
    terminal::line(format!(
        "{samples} samples of {asked} vehicles in {} scenes: {}",
        scenes.len(),
        out.display()
    ));
    accuracy::lines(&scenes).into_iter().for_each(terminal::line);
    Ok(())
}
