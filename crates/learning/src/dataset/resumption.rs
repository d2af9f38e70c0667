//! Resumption of a dataset from an earlier run: a shard is reused if it is complete and has the same scenes,
//! made by the same program.

use crate::dataset::layout::PlannedShard;
use crate::dataset::lines as scene_lines;
use crate::dataset::recipe::Recipe;
use crate::dataset::scene_line::SceneLine;
use crate::dataset::shard_version::shard_version;
use artifact::dataset::{Dataset, Sample};
use artifact::{ArtifactError, Fault, Reader};
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use std::path::Path;

/// Whether a shard is complete; a damaged one is named and must be made anew. Refused if the folder belongs
/// to another recipe or program: shards of two do not form a dataset.
pub(super) fn is_made(recipe: &Recipe, shard: &PlannedShard) -> Result<bool, Failure> {
    if !shard.samples.is_file() {
        return Ok(false);
    }
    let samples = match samples(recipe, &shard.samples) {
        Ok(samples) => samples,
        Err(Obstacle::Foreign(refused)) => return Err(refused),
        Err(Obstacle::Damaged(error)) => {
            progress::note(format!("note: made anew: {error}"));
            return Ok(false);
        }
    };
    if !shard.lines.is_file() {
        return Ok(false); // the last run was ended before writing them
    }
    let is_whole = lines(shard).is_some_and(|lines| tells_of(&lines, &samples));
    if !is_whole {
        progress::note(format!(
            "note: made anew: {}: is damaged, or tells of other scenes than its shard",
            shard.lines.display()
        ));
    }
    Ok(is_whole)
}

/// Whether a shard exists, by opening it: its samples are of this recipe and complete, and its lines belong
/// to its scenes. The content of the samples is not read: the maker of the shard has verified it.
pub(super) fn is_there(recipe: &Recipe, shard: &PlannedShard) -> Result<bool, Failure> {
    if !shard.lines.is_file() {
        return Ok(false);
    }
    match opened(recipe, &shard.samples) {
        Ok(_) => Ok(lines(shard).is_some()),
        Err(Obstacle::Foreign(refused)) => Err(refused),
        Err(Obstacle::Damaged(_)) => Ok(false),
    }
}

/// Lines of a shard, one for each of its scenes, in order; `None` if they describe other scenes.
pub(super) fn lines(shard: &PlannedShard) -> Option<Vec<SceneLine>> {
    let lines = scene_lines::read(&shard.lines).ok()?;
    let numbers = lines.iter().map(|line| line.scene);
    numbers.eq(shard.scenes.clone().map(Some)).then_some(lines)
}

/// Remedies if another program has made a shard.
const ANOTHER_FOLDER: &str = "--out takes a new folder, or that version goes on with this one";

enum Obstacle {
    /// The shard belongs to another recipe, or another program has made it.
    Foreign(Failure),
    Damaged(ArtifactError),
}

/// Reads all samples of a shard and verifies its checksums.
fn samples(recipe: &Recipe, shard: &Path) -> Result<Vec<Sample>, Obstacle> {
    opened(recipe, shard)?.collect::<Result<_, _>>().map_err(Obstacle::Damaged)
}

fn opened(recipe: &Recipe, shard: &Path) -> Result<Reader<Dataset>, Obstacle> {
    let foreign = |rule: &str| Obstacle::Foreign(Failure::System(format!("{}: {rule}", shard.display())));
    let reader = Reader::<Dataset>::open_own(shard).map_err(|error| match error.fault {
        Fault::Version { .. } => foreign(&format!("{}; {ANOTHER_FOLDER}", error.fault)),
        _ => Obstacle::Damaged(error),
    })?;
    let from = &reader.preamble().provenance;
    if from.seed != recipe.seed || !recipe.draws_as(&from.settings, &from.inputs) {
        return Err(foreign(
            "was made by another recipe, scene or seed; --out takes a new folder, or that of this recipe",
        ));
    }
    let (theirs, own) = (&from.program_version, shard_version());
    if *theirs != own {
        return Err(foreign(&format!(
            "was made by another version of the program ({theirs}, this is {own}); {ANOTHER_FOLDER}"
        )));
    }
    Ok(reader)
}

/// Whether there is a sample for every detected vehicle.
fn tells_of(lines: &[SceneLine], samples: &[Sample]) -> bool {
    let vehicles = lines.iter().flat_map(SceneLine::vehicles).map(|(_, vehicle)| vehicle);
    let found = vehicles.filter(|vehicle| vehicle.estimate.is_some()).map(|vehicle| &vehicle.id);
    found.eq(samples.iter().map(|sample| &sample.id))
}
