//! Summary of a dataset, made from all of its shards by whichever process finds them complete. Shards are
//! read one by one, so that memory does not grow with the number of lines.

mod detection;
mod accuracy;

use crate::dataset::draws;
use crate::dataset::layout::{Layout, PlannedShard};
use crate::dataset::lines;
use crate::dataset::recipe::Recipe;
use crate::dataset::resumption;
use crate::dataset::scene_line::SceneLine;
use accuracy::ReachedAccuracy;
use detection::DetectionTable;
use pipeline::host::dataset_folders::SUMMARY_FILES;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress::Work;
use std::io::{Error, Write};
use std::path::{Path, PathBuf};

/// Files of the summary in a dataset's folder.
pub(super) fn files_of(out: &Path) -> [PathBuf; 3] {
    SUMMARY_FILES.map(|name| out.join(name))
}

/// Refuses to replace tables and lines of another origin.
pub(super) fn refuse_foreign(out: &Path) -> Result<(), Failure> {
    let is_own = |head: &[u8]| {
        let text = String::from_utf8_lossy(head);
        // The first keys of a sample's and of a scene's line, which are sorted, and the head of the table.
        ["{\"across_m\":", "{\"base\":", "| vehicles |"].iter().any(|begin| text.starts_with(begin))
    };
    files_of(out).iter().try_for_each(|place| files::refuse_foreign_head(place, is_own))
}

/// Missing shards of a recipe, at most `most`: checked first by their names, which suffices for all parts but
/// the last; if all names exist, the shards are opened. Refused if one belongs to another recipe.
pub(super) fn lacking(recipe: &Recipe, layout: &Layout, most: usize) -> Result<Vec<PathBuf>, Failure> {
    let work = Work::begin("looking for all shards");
    let absent: Vec<PathBuf> =
        layout.all().map(|shard| shard.lines).filter(|lines| !lines.is_file()).take(most).collect();
    if !absent.is_empty() {
        return Ok(absent);
    }
    let mut damaged = vec![];
    for (number, shard) in layout.all().enumerate() {
        if !resumption::is_there(recipe, &shard)? {
            damaged.push(shard.lines);
        }
        work.at(number + 1, layout.count() as usize);
    }
    Ok(damaged)
}

/// Writes `manifest.jsonl`: one line per sample; `scenes.jsonl`: one line per scene; `detection.md`: errors
/// of all vehicles, detected or not. `tell` receives their numbers and the accuracy of their scenes.
pub(super) fn conclude(
    recipe: &Recipe,
    layout: &Layout,
    out: &Path,
    tell: &dyn Fn(&str),
) -> Result<(), Failure> {
    let _work = Work::begin("concluding");
    let [manifest, scenes, table] = files_of(out);
    files::write_with(&manifest, |stream| {
        each_line(layout, |line| {
            lines::samples(&line)?.iter().try_for_each(|sample| writeln!(stream, "{sample}"))
        })
    })?;
    let mut reached = ReachedAccuracy::default();
    let mut detected = DetectionTable::default();
    files::write_with(&scenes, |stream| {
        each_line(layout, |line| {
            reached.add(&line, sub_frames(recipe, &line));
            line.vehicles().for_each(|(_, vehicle)| detected.add(vehicle));
            writeln!(stream, "{}", lines::text(&line)?)
        })
    })?;
    files::write_file(&table, detected.markdown().as_bytes())?;
    let (samples, asked) = detected.found_of_all();
    let (scenes, place) = (layout.scenes, out.display());
    tell(&format!("{samples} samples of {asked} vehicles in {scenes} scenes: {place}"));
    reached.lines().iter().for_each(|line| tell(line));
    Ok(())
}

/// Number of sub-frames in a cycle of the scene's radar, drawn anew: the lines do not tell it.
fn sub_frames(recipe: &Recipe, scene: &SceneLine) -> usize {
    let drawn = scene.scene.map(|number| draws::draw(recipe, number..number + 1)).unwrap_or_default();
    let radar = drawn.first().map(|drawn| &recipe.bases[drawn.base].header.radar);
    radar.map_or(1, |radar| radar.schedule.sub_frames() as usize)
}

/// Passes on the lines of all shards in the order of their scenes.
fn each_line(
    layout: &Layout,
    mut use_line: impl FnMut(SceneLine) -> std::io::Result<()>,
) -> std::io::Result<()> {
    layout.all().try_for_each(|shard| of_shard(&shard)?.into_iter().try_for_each(&mut use_line))
}

fn of_shard(shard: &PlannedShard) -> std::io::Result<Vec<SceneLine>> {
    let changed = || Error::other(format!("{}: was there and is not any more", shard.lines.display()));
    resumption::lines(shard).ok_or_else(changed)
}
