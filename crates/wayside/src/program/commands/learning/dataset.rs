//! `dataset`: labelled signatures and crops of scenes that a recipe draws. Shards are written whole or not at
//! all, and a shard that exists, whole and of this recipe, is not made again; beside each stands one line per
//! scene with truth and estimates. Whoever finds all shards made writes what is made of all.

mod recipe;
mod rules;
mod models;
mod document;
mod draws;
mod layout;
mod places;
mod staging;
mod shots;
mod seen;
mod shard;
pub(super) mod lines;
mod resumption;
mod conclusion;
mod cost;

use crate::program::learning_cli::DatasetArguments;
use crate::program::terminal;
use layout::{Layout, PlannedShard};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::memory::Allowance;
use pipeline::host::progress::Work;
use recipe::Recipe;
use std::path::Path;

pub(crate) fn run(arguments: &DatasetArguments, memory: Allowance) -> Result<(), Failure> {
    let recipe = Recipe::read(&arguments.spec, arguments.seed)?;
    let layout = Layout::of(&recipe, &arguments.out);
    if arguments.dry_run {
        cost::lines(&recipe, &layout, memory)?.into_iter().for_each(terminal::line);
        return Ok(());
    }
    files::claim(&conclusion::files_of(&arguments.out))?;
    if arguments.conclude {
        let lacking = conclusion::lacking(&recipe, &layout, usize::MAX)?;
        lacking.first().map_or(Ok(()), |first| Err(unfinished(first, lacking.len(), &layout)))?;
        return conclusion::conclude(&layout, &arguments.out);
    }
    make(&recipe, layout.part(arguments.shard.number, arguments.shard.of).collect(), memory)?;
    match conclusion::lacking(&recipe, &layout, 1)?.first() {
        None => conclusion::conclude(&layout, &arguments.out),
        Some(lines) => {
            terminal::line(format!("{}: not made yet (another part of --shard)", lines.display()));
            Ok(())
        }
    }
}

/// Makes those shards that are not made.
fn make(recipe: &Recipe, shards: Vec<PlannedShard>, memory: Allowance) -> Result<(), Failure> {
    let work = Work::begin("dataset");
    let scenes = |shard: &PlannedShard| shard.scenes.end - shard.scenes.start;
    let total = shards.iter().map(scenes).sum::<u64>() as usize;
    let mut done = 0;
    for shard in &shards {
        if !resumption::is_made(recipe, shard)? {
            shard::make(
                &shard::ShardMaking { recipe, memory, tell: &|within| work.at(done + within, total) },
                shard,
            )?;
        }
        done += scenes(shard) as usize;
        work.at(done, total);
    }
    Ok(())
}

fn unfinished(first: &Path, lacking: usize, layout: &Layout) -> Failure {
    let (first, all) = (first.display(), layout.count());
    Failure::System(format!("{first}: not made yet or damaged, and so are {lacking} of {all} shards in all"))
}
