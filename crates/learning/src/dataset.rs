//! `dataset`: labelled signatures and crops of scenes drawn by a recipe. Shards are written whole or not at
//! all, and a complete shard of this recipe is not made again; beside each is a file with one line per scene,
//! with truth and estimates. The process that finds all shards complete writes the summary of all.

mod recipe;
mod draws;
mod layout;
mod placement;
mod staging;
mod computed_scene;
mod observed_frame;
mod shard_version;
mod shard;
pub(crate) mod scene_line;
pub(crate) mod lines;
pub(crate) mod own_artifact;
mod resumption;
mod summary;
mod cost;

use layout::{Layout, PlannedShard};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::memory::Allowance;
use pipeline::host::progress::Work;
use recipe::Recipe;
use std::path::{Path, PathBuf};

/// Settings of a dataset: its recipe, and the task.
pub struct DatasetSettings<'a> {
    /// Recipe (`docs/datasets.md`).
    pub recipe: PathBuf,
    /// Folder of the dataset; complete shards in it are reused.
    pub out: PathBuf,
    /// Seed in place of the recipe's.
    pub seed: Option<u64>,
    /// Task to carry out.
    pub task: Task,
    /// Memory allowed for tracing.
    pub memory: Allowance,
    /// Receives each line of results.
    pub tell: &'a dyn Fn(&str),
}

/// Task for a dataset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Task {
    /// Makes the shards of one part, and the summary if all shards exist then.
    Make {
        /// Number of the part, from 1, and number of parts.
        shard: [u32; 2],
    },
    /// Writes only the summary of all shards; a missing one is an error.
    Conclude,
    /// Only predicts files, bytes and core-hours of the whole.
    Predict,
}

/// Makes a dataset or a part of it.
///
/// # Errors
/// A sentence that names file, place and rule if the recipe or a model is refused; completed shards are kept.
pub fn run(settings: &DatasetSettings) -> Result<(), Failure> {
    let recipe = Recipe::read(&settings.recipe, settings.seed)?;
    let layout = Layout::of(&recipe, &settings.out);
    if settings.task == Task::Predict {
        cost::lines(&recipe, &layout, settings.memory)?.iter().for_each(|line| (settings.tell)(line));
        return Ok(());
    }
    files::claim(&summary::files_of(&settings.out))?;
    summary::refuse_foreign(&settings.out)?;
    let conclude = || summary::conclude(&recipe, &layout, &settings.out, settings.tell);
    let Task::Make { shard: [number, of] } = settings.task else {
        let lacking = summary::lacking(&recipe, &layout, usize::MAX)?;
        lacking.first().map_or(Ok(()), |first| Err(unfinished(first, lacking.len(), &layout)))?;
        return conclude();
    };
    make(&recipe, layout.part(number, of).collect(), settings.memory)?;
    match summary::lacking(&recipe, &layout, 1)?.first() {
        None => conclude(),
        Some(lines) => {
            (settings.tell)(&format!("{}: not made yet (another part of --shard)", lines.display()));
            Ok(())
        }
    }
}

/// Makes the missing shards; refused if one would replace a file of another origin.
fn make(recipe: &Recipe, shards: Vec<PlannedShard>, memory: Allowance) -> Result<(), Failure> {
    shards.iter().try_for_each(resumption::refuse_foreign)?;
    let work = Work::begin("dataset");
    let scenes = |shard: &PlannedShard| shard.scenes.end - shard.scenes.start;
    let total = shards.iter().map(scenes).sum::<u64>() as usize;
    let mut done = 0;
    for shard in &shards {
        if !resumption::is_made(recipe, shard)? {
            shard::make(
                &shard::ShardSettings { recipe, memory, tell: &|within| work.at(done + within, total) },
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
