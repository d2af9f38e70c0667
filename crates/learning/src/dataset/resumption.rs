//! Resumption of a dataset from an earlier run: a shard is reused if it is complete and has the same scenes,
//! made by the same program.

use crate::dataset::layout::PlannedShard;
use crate::dataset::lines as scene_lines;
use crate::dataset::own_artifact::refuse_other_artifact;
use crate::dataset::recipe::Recipe;
use crate::dataset::scene_line::SceneLine;
use crate::dataset::shard_version::shard_version;
use artifact::dataset::{Dataset, Sample};
use artifact::{ArtifactError, Fault, Reader};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use std::path::Path;

/// Refuses to replace files of another origin by a shard. One that is an input is refused as such.
pub(super) fn refuse_foreign(shard: &PlannedShard) -> Result<(), Failure> {
    let samples = refuse_other_artifact::<Dataset>(&shard.samples);
    let lines = || files::refuse_foreign_head(&shard.lines, scene_lines::begins_as_scene);
    let claim = || files::claim(&[shard.samples.clone(), shard.lines.clone()]);
    samples.and_then(|()| lines()).or_else(|foreign| claim().and(Err(foreign)))
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::classes::{Classes, ClassesHeader};
    use artifact::{Provenance, Writer};

    /// A line as the program writes it, without its frames.
    const LINE: &str = "{\"base\":\"base.toml\",\"checksum\":\"0\",\"extra_noise_db\":0.0,\"frames\":[]}\n";

    #[test]
    fn what_is_no_shard_is_refused_and_what_is_left_of_one_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let name = "shard-0000.dataset".to_owned();
        let [samples, lines] = [&*name, "shard-0000.jsonl"].map(|name| folder.path().join(name));
        let shard = PlannedShard { scenes: 0..1, samples, lines, name };
        let is_refused = || refuse_foreign(&shard).is_err();
        assert!(!is_refused(), "nothing is there");
        for (text, is_foreign) in [
            ("notes\n", true),
            ("{}\n", true),
            ("{\"base\":\"c7\",\"chord\":1}\n", true),
            ("", false),
            ("{\"ba", false),
            ("{\"base\":\"base.toml\",\"extra", false),
            (LINE, false),
        ] {
            std::fs::write(&shard.lines, text).unwrap();
            assert_eq!(is_refused(), is_foreign, "{text}");
        }
        std::fs::write(&shard.samples, "my table").unwrap();
        assert!(is_refused());
        let header = ClassesHeader { classes: vec![] };
        Writer::<Classes>::create(&shard.samples, &Provenance::default(), &header).unwrap().finish().unwrap();
        assert!(is_refused());
        std::fs::write(&shard.samples, "WAYSIDE\ncut").unwrap();
        assert!(!is_refused());
    }
}
