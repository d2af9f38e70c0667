//! A shard made whole: the first scene of each kind is measured, the others take its errors over; several scenes at a time.

use super::draws::{Drawn, Kind};
use super::recipe::Recipe;
use super::shots::{Measured, Shot, Surroundings, shoot};
use crate::failure::Failure;
use crate::output;
use artifact::dataset::Dataset;
use artifact::{Provenance, Writer};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Makes a shard and the lines of its scenes; `tell` hears how many scenes are done.
pub(super) fn make(
    recipe: &Recipe,
    scenes: &[Drawn],
    shard: &Path,
    lines: &Path,
    tell: &(dyn Fn(usize) + Sync),
) -> Result<(), Failure> {
    let mut writer = Writer::<Dataset>::create(shard, &provenance(recipe), &dsp::PAPER_CROP)?;
    let mut text = String::new();
    for shot in shots(recipe, scenes, &shard.file_name().unwrap_or_default().to_string_lossy(), tell)? {
        shot.samples.iter().try_for_each(|sample| writer.write(sample))?;
        text.push_str(&format!("{}\n", shot.line));
    }
    writer.finish()?;
    output::write_file(lines, text.as_bytes())
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

/// All scenes of a shard, in their order.
fn shots(recipe: &Recipe, scenes: &[Drawn], shard: &str, tell: &(dyn Fn(usize) + Sync)) -> Result<Vec<Shot>, Failure> {
    let mut first_of: BTreeMap<Kind, usize> = BTreeMap::new();
    for (place, drawn) in scenes.iter().enumerate() {
        first_of.entry(drawn.kind()).or_insert(place);
    }
    let (first, others): (Vec<usize>, Vec<usize>) =
        (0..scenes.len()).partition(|place| first_of[&scenes[*place].kind()] == *place);
    let threads = rayon::current_num_threads();
    let done = AtomicUsize::new(0);
    let shot = |place: usize, like: Option<&Measured>| {
        let shot = shoot(recipe, &scenes[place], &Surroundings { like, shard, at_once: threads.min(scenes.len()) });
        tell(done.fetch_add(1, Ordering::Relaxed) + 1);
        shot.map(|shot| (place, shot))
    };
    let mut shots = side_by_side(&first, |place| shot(place, None))?;
    let measured: BTreeMap<Kind, Measured> =
        shots.iter().map(|(place, shot)| (scenes[*place].kind(), shot.measured.clone())).collect();
    shots.extend(side_by_side(&others, |place| shot(place, measured.get(&scenes[place].kind())))?);
    shots.sort_by_key(|(place, _)| *place);
    Ok(shots.into_iter().map(|(_, shot)| shot).collect())
}

/// Each on one of as many threads as there are, in their order: threads of the pool would take up a further scene while they
/// wait for a part of one, and hold more than was allowed.
fn side_by_side<T: Send>(
    places: &[usize],
    work: impl Fn(usize) -> Result<T, Failure> + Sync,
) -> Result<Vec<T>, Failure> {
    let next = AtomicUsize::new(0);
    let worker = || {
        let taken = std::iter::from_fn(|| places.get(next.fetch_add(1, Ordering::Relaxed)));
        taken.map(|place| work(*place)).collect::<Result<Vec<T>, Failure>>()
    };
    let threads = rayon::current_num_threads().min(places.len()).max(1);
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        let joined = workers.into_iter().map(|w| w.join().unwrap_or_else(|p| std::panic::resume_unwind(p)));
        joined.collect::<Result<Vec<_>, _>>().map(|parts| parts.into_iter().flatten().collect())
    })
}
