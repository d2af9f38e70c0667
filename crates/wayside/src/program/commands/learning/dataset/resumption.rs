//! Resumption of a dataset from what an earlier run has left: a shard is taken up if it is whole and of the
//! same scenes.

use crate::host::failure::Failure;
use crate::host::progress;
use crate::program::commands::learning::dataset::draws::Drawn;
use crate::program::commands::learning::dataset::lines as told;
use crate::program::commands::learning::dataset::recipe::Recipe;
use artifact::dataset::{Dataset, Sample};
use artifact::{ArtifactError, Reader};
use serde_json::Value;
use std::path::Path;

/// Whether a shard need not be made; a damaged one is named and made anew. Refused where the folder is
/// another recipe's: what two recipes make is no dataset.
pub(super) fn is_made(
    recipe: &Recipe,
    scenes: &[Drawn],
    shard: &Path,
    lines: &Path,
) -> Result<bool, Failure> {
    if !shard.is_file() {
        return Ok(false);
    }
    let samples = match samples(recipe, shard) {
        Ok(samples) => samples,
        Err(Obstacle::OtherRecipe) => return Err(of_another(shard)),
        Err(Obstacle::Damaged(error)) => {
            progress::note(format!("note: made anew: {error}"));
            return Ok(false);
        }
    };
    if !lines.is_file() {
        return Ok(false); // the last run was ended before it wrote them
    }
    let is_whole = told::read(lines).is_ok_and(|lines| agree(scenes, &samples, &lines));
    if !is_whole {
        progress::note(format!(
            "note: made anew: {}: does not tell of the scenes of its shard",
            lines.display()
        ));
    }
    Ok(is_whole)
}

enum Obstacle {
    OtherRecipe,
    Damaged(ArtifactError),
}

/// All samples of a shard, its checksums held against them.
fn samples(recipe: &Recipe, shard: &Path) -> Result<Vec<Sample>, Obstacle> {
    let reader = Reader::<Dataset>::open_own(shard).map_err(Obstacle::Damaged)?;
    let from = &reader.preamble().provenance;
    if from.seed != recipe.seed || !recipe.draws_as(&from.settings, &from.inputs) {
        return Err(Obstacle::OtherRecipe);
    }
    reader.collect::<Result<_, _>>().map_err(Obstacle::Damaged)
}

fn of_another(shard: &Path) -> Failure {
    let rule = "was made by another recipe, scene or seed; --out takes a new folder, or that of this recipe";
    Failure::System(format!("{}: {rule}", shard.display()))
}

/// Whether there is a line for every scene, in their order, and a sample for every one that was found.
fn agree(scenes: &[Drawn], samples: &[Sample], lines: &[Value]) -> bool {
    let numbers = lines.iter().map(|line| line["scene"].as_u64());
    let vehicles = told::vehicles(lines);
    let found =
        vehicles.iter().filter(|vehicle| told::is_found(vehicle)).map(|vehicle| vehicle["id"].as_str());
    numbers.eq(scenes.iter().map(|drawn| Some(drawn.number)))
        && found.eq(samples.iter().map(|sample| Some(sample.id.as_str())))
}
