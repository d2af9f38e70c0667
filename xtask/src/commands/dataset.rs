//! `dataset`: labelled crops of scenes that a recipe draws. Shards are written whole or not at all, and a shard that
//! exists, whole and of this recipe, is not made again; beside each stands one line per scene with truth and estimate.

mod accuracy;
mod recipe;
mod resumption;
mod scenes;
mod table;

use crate::cli::DatasetArguments;
use crate::failure::Failure;
use crate::output;
use crate::progress::Work;
use artifact::dataset::Dataset;
use artifact::{Provenance, Writer};
use recipe::Recipe;
use scenes::{Drawn, Shot};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Scenes in a shard: what an interruption costs at most.
const SCENES_PER_SHARD: usize = 8;

pub(crate) fn run(arguments: &DatasetArguments) -> Result<(), Failure> {
    let recipe = Recipe::read(&arguments.spec, arguments.seed)?;
    let drawn = scenes::draw(&recipe);
    let shards: Vec<(usize, &[Drawn])> = drawn.chunks(SCENES_PER_SHARD).enumerate().collect();
    let mine = |number: usize| number % arguments.shard.of as usize == (arguments.shard.number - 1) as usize;
    output::claim(&["manifest.jsonl", "scenes.jsonl", "detection.md"].map(|name| arguments.out.join(name)))?;
    let work = Work::begin("dataset");
    let total = shards.iter().filter(|(number, _)| mine(*number)).map(|(_, scenes)| scenes.len()).sum();
    let mut done = 0;
    for (number, scenes) in shards.iter().filter(|(number, _)| mine(*number)) {
        let (shard, lines) = (shard_file(&arguments.out, *number), scene_lines(&arguments.out, *number));
        if !resumption::is_made(&recipe, scenes, &shard, &lines)? {
            make(&recipe, &arguments.out, *number, scenes, &|within| work.at(done + within, total))?;
        }
        done += scenes.len();
        work.at(done, total);
    }
    drop(work);
    conclude(&arguments.out, &shards)
}

fn shard_file(out: &Path, number: usize) -> PathBuf {
    out.join(format!("shard-{number:04}.dataset"))
}

/// Written after the shard itself: where it is, the shard is whole.
fn scene_lines(out: &Path, number: usize) -> PathBuf {
    out.join(format!("shard-{number:04}.jsonl"))
}

fn make(recipe: &Recipe, out: &Path, number: usize, scenes: &[Drawn], tell: &dyn Fn(usize)) -> Result<(), Failure> {
    let file = shard_file(out, number);
    let mut writer = Writer::<Dataset>::create(&file, &provenance(recipe), &dsp::PAPER_CROP)?;
    let mut lines = String::new();
    for (i, drawn) in scenes.iter().enumerate() {
        let shot: Shot = scenes::shoot(recipe, drawn, &file)?;
        if let Some(sample) = &shot.sample {
            writer.write(sample)?;
        }
        lines.push_str(&format!("{}\n", shot.line));
        tell(i + 1);
    }
    writer.finish()?;
    output::write_file(&scene_lines(out, number), lines.as_bytes())
}

fn provenance(recipe: &Recipe) -> Provenance {
    Provenance {
        stage: "dataset".into(),
        program_version: env!("CARGO_PKG_VERSION").into(),
        inputs: recipe.inputs.clone(),
        settings: recipe.text.clone(),
        seed: recipe.seed,
    }
}

/// `manifest.jsonl`: a line a sample; `scenes.jsonl`: a line a scene, found or not; `detection.md`: their errors.
fn conclude(out: &Path, shards: &[(usize, &[Drawn])]) -> Result<(), Failure> {
    let mut lines = Vec::new();
    for (number, _) in shards {
        let file = scene_lines(out, *number);
        let Ok(text) = std::fs::read_to_string(&file) else {
            output::line(format!("{}: not made yet (another part of --shard)", file.display()));
            return Ok(());
        };
        lines.extend(text.lines().map(str::to_owned));
    }
    let found: Vec<&String> = lines.iter().filter(|l| l.contains("\"sample\":true")).collect();
    output::write_with(&out.join("manifest.jsonl"), |s| found.iter().try_for_each(|l| writeln!(s, "{l}")))?;
    output::write_with(&out.join("scenes.jsonl"), |s| lines.iter().try_for_each(|l| writeln!(s, "{l}")))?;
    output::write_file(&out.join("detection.md"), table::detection(&lines).as_bytes())?;
    output::line(format!("{} of {} scenes gave a sample: {}", found.len(), lines.len(), out.display()));
    accuracy::lines(&lines).into_iter().for_each(output::line);
    Ok(())
}
