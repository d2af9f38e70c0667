//! Making of a shard: the first scene of each kind is measured, the others take its errors over; several
//! scenes at a time.

use crate::dataset::computed_scene::{ComputedScene, MeasuredErrors, SceneContext, compute};
use crate::dataset::draws::{self, DrawnScene, Kind};
use crate::dataset::layout::PlannedShard;
use crate::dataset::lines;
use crate::dataset::recipe::Recipe;
use crate::dataset::shard_version::shard_version;
use crate::dataset::staging::{StagedScene, stage};
use artifact::dataset::Dataset;
use artifact::{Provenance, Writer};
use pipeline::chain::link::Chain;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::memory::Allowance;
use pipeline::host::parallel_jobs::parallel_jobs;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Number of scenes per thread that are made before they are written: a whole shard would be too many to
/// hold.
const HELD: usize = 4;

/// Recipe, memory and listener for making shards.
pub(super) struct ShardSettings<'a> {
    pub(super) recipe: &'a Recipe,
    pub(super) memory: Allowance,
    /// Receives the number of finished scenes of the shard.
    pub(super) tell: &'a (dyn Fn(usize) + Sync),
}

/// Makes a shard and the lines of its scenes.
pub(super) fn make(settings: &ShardSettings, shard: &PlannedShard) -> Result<(), Failure> {
    let recipe = settings.recipe;
    files::claim(&[shard.samples.clone(), shard.lines.clone()])?;
    let scenes = draws::draw(recipe, shard.scenes.clone());
    let mut writer = Writer::<Dataset>::create(&shard.samples, &provenance(recipe), &dsp::PAPER_CROP)?;
    let mut text = String::new();
    let first = first_of_kinds(&scenes);
    let at_once = at_once(settings, &scenes, &first)?;
    let work = ShardWork { settings, scenes: &scenes, shard: &shard.name, at_once };
    let done = AtomicUsize::new(0);
    let mut measured = work.compute_all(&first, &BTreeMap::new(), &done)?;
    let errors =
        measured.iter().map(|(place, scene)| (scenes[*place].kind(), scene.measured.clone())).collect();
    let places: Vec<usize> = (0..scenes.len()).collect();
    for places in places.chunks(HELD * work.at_once) {
        let others: Vec<usize> = places.iter().copied().filter(|place| !first.contains(place)).collect();
        let mut computed = work.compute_all(&others, &errors, &done)?;
        for scene in
            places.iter().filter_map(|place| measured.remove(place).or_else(|| computed.remove(place)))
        {
            scene.samples.iter().try_for_each(|sample| writer.write(sample))?;
            let line =
                lines::sealed(&scene.line).map_err(|error| Failure::system(&shard.lines, "write", error))?;
            text.push_str(&format!("{line}\n"));
        }
    }
    writer.finish()?;
    files::write_file(&shard.lines, text.as_bytes())
}

fn provenance(recipe: &Recipe) -> Provenance {
    Provenance {
        stage: "dataset".into(),
        program_version: shard_version(),
        inputs: recipe.inputs.clone(),
        settings: recipe.text.clone(),
        seed: recipe.seed,
    }
}

/// The first scene of each kind, in order.
fn first_of_kinds(scenes: &[DrawnScene]) -> Vec<usize> {
    let mut kinds: BTreeSet<Kind> = BTreeSet::new();
    (0..scenes.len()).filter(|place| kinds.insert(scenes[*place].kind())).collect()
}

/// Number of scenes at once: one per thread, as many as are expected to fit into the allowed memory if all
/// are as large as the largest measured.
fn at_once(settings: &ShardSettings, scenes: &[DrawnScene], first: &[usize]) -> Result<usize, Failure> {
    let threads = rayon::current_num_threads().min(scenes.len()).max(1);
    let Some(limit_mib) = settings.memory.mib().filter(|_| threads > 1) else { return Ok(threads) };
    let triangles =
        |staged: &StagedScene| staged.header.meshes.iter().map(|mesh| mesh.triangles.len()).sum::<usize>();
    let largest = first.iter().map(|place| stage(settings.recipe, &scenes[*place])).max_by_key(triangles);
    let Some(StagedScene { header, .. }) = largest else { return Ok(1) };
    let chain = Chain::of(&header, None, None, settings.memory);
    let estimate_mib = chain.memory_estimate_mib(&chain.plan(0))?;
    Ok(((limit_mib / estimate_mib) as usize).clamp(1, threads))
}

/// Work on one shard: its scenes, and the number computed at once.
struct ShardWork<'a> {
    settings: &'a ShardSettings<'a>,
    scenes: &'a [DrawnScene],
    shard: &'a str,
    at_once: usize,
}

impl ShardWork<'_> {
    /// Makes some scenes by their indices; those of a kind with known errors take them over.
    fn compute_all(
        &self,
        places: &[usize],
        errors: &BTreeMap<Kind, MeasuredErrors>,
        done: &AtomicUsize,
    ) -> Result<BTreeMap<usize, ComputedScene>, Failure> {
        let scene = |place: &usize| {
            let drawn = &self.scenes[*place];
            let like = errors.get(&drawn.kind());
            let context =
                SceneContext { like, shard: self.shard, at_once: self.at_once, memory: self.settings.memory };
            let scene = compute(self.settings.recipe, drawn, &context)?;
            (self.settings.tell)(done.fetch_add(1, Ordering::Relaxed) + 1);
            Ok((*place, scene))
        };
        Ok(parallel_jobs(places, self.at_once, scene)?.into_iter().collect())
    }
}
