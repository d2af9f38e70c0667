//! Making of a shard: the first scene of each kind is measured, the others take its errors over; several
//! scenes at a time.

use crate::dataset::draws::{self, Drawn, Kind};
use crate::dataset::layout::PlannedShard;
use crate::dataset::lines;
use crate::dataset::maker::maker;
use crate::dataset::recipe::Recipe;
use crate::dataset::shots::{Measured, Shot, Surroundings, shoot};
use crate::dataset::staging::{Staged, stage};
use artifact::dataset::Dataset;
use artifact::{Provenance, Writer};
use pipeline::chain::link::Chain;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::memory::Allowance;
use pipeline::host::side_by_side::side_by_side;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Number of scenes per thread that are made before they are written: a whole shard would be too many to
/// hold.
const HELD: usize = 4;

/// Recipe, memory and listener for making shards.
pub(super) struct ShardMaking<'a> {
    pub(super) recipe: &'a Recipe,
    pub(super) memory: Allowance,
    /// Receives the number of finished scenes of the shard.
    pub(super) tell: &'a (dyn Fn(usize) + Sync),
}

/// Makes a shard and the lines of its scenes.
pub(super) fn make(making: &ShardMaking, shard: &PlannedShard) -> Result<(), Failure> {
    let recipe = making.recipe;
    files::claim(&[shard.samples.clone(), shard.lines.clone()])?;
    let scenes = draws::draw(recipe, shard.scenes.clone());
    let mut writer = Writer::<Dataset>::create(&shard.samples, &provenance(recipe), &dsp::PAPER_CROP)?;
    let mut text = String::new();
    let first = first_of_kinds(&scenes);
    let at_once = at_once(making, &scenes, &first)?;
    let work = ShardWork { making, scenes: &scenes, shard: &shard.name, at_once };
    let done = AtomicUsize::new(0);
    let mut measured = work.shots(&first, &BTreeMap::new(), &done)?;
    let errors =
        measured.iter().map(|(place, shot)| (scenes[*place].kind(), shot.measured.clone())).collect();
    let places: Vec<usize> = (0..scenes.len()).collect();
    for places in places.chunks(HELD * work.at_once) {
        let others: Vec<usize> = places.iter().copied().filter(|place| !first.contains(place)).collect();
        let mut shots = work.shots(&others, &errors, &done)?;
        for shot in places.iter().filter_map(|place| measured.remove(place).or_else(|| shots.remove(place))) {
            shot.samples.iter().try_for_each(|sample| writer.write(sample))?;
            let line =
                lines::sealed(&shot.line).map_err(|error| Failure::system(&shard.lines, "write", error))?;
            text.push_str(&format!("{line}\n"));
        }
    }
    writer.finish()?;
    files::write_file(&shard.lines, text.as_bytes())
}

fn provenance(recipe: &Recipe) -> Provenance {
    Provenance {
        stage: "dataset".into(),
        program_version: maker(),
        inputs: recipe.inputs.clone(),
        settings: recipe.text.clone(),
        seed: recipe.seed,
    }
}

/// The first scene of each kind, in order.
fn first_of_kinds(scenes: &[Drawn]) -> Vec<usize> {
    let mut kinds: BTreeSet<Kind> = BTreeSet::new();
    (0..scenes.len()).filter(|place| kinds.insert(scenes[*place].kind())).collect()
}

/// Number of scenes at once: one per thread, as many as are expected to fit into the allowed memory if all
/// are as large as the largest measured.
fn at_once(making: &ShardMaking, scenes: &[Drawn], first: &[usize]) -> Result<usize, Failure> {
    let threads = rayon::current_num_threads().min(scenes.len()).max(1);
    let Some(limit_mib) = making.memory.mib().filter(|_| threads > 1) else { return Ok(threads) };
    let triangles =
        |staged: &Staged| staged.header.meshes.iter().map(|mesh| mesh.triangles.len()).sum::<usize>();
    let largest = first.iter().map(|place| stage(making.recipe, &scenes[*place])).max_by_key(triangles);
    let Some(Staged { header, .. }) = largest else { return Ok(1) };
    let chain = Chain::of(&header, None, None, making.memory);
    let estimate_mib = chain.memory_estimate_mib(&chain.plan(0))?;
    Ok(((limit_mib / estimate_mib) as usize).clamp(1, threads))
}

/// Work on one shard: its scenes, and the number computed at once.
struct ShardWork<'a> {
    making: &'a ShardMaking<'a>,
    scenes: &'a [Drawn],
    shard: &'a str,
    at_once: usize,
}

impl ShardWork<'_> {
    /// Makes some scenes by their indices; those of a kind with known errors take them over.
    fn shots(
        &self,
        places: &[usize],
        errors: &BTreeMap<Kind, Measured>,
        done: &AtomicUsize,
    ) -> Result<BTreeMap<usize, Shot>, Failure> {
        let shot = |place: &usize| {
            let drawn = &self.scenes[*place];
            let like = errors.get(&drawn.kind());
            let surroundings =
                Surroundings { like, shard: self.shard, at_once: self.at_once, memory: self.making.memory };
            let shot = shoot(self.making.recipe, drawn, &surroundings)?;
            (self.making.tell)(done.fetch_add(1, Ordering::Relaxed) + 1);
            Ok((*place, shot))
        };
        Ok(side_by_side(places, self.at_once, shot)?.into_iter().collect())
    }
}
