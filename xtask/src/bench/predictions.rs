//! `bench --predictions`: predicted and actual cost of runs over random scenes.

mod cost;
mod row;
mod child;
mod fit;
mod random_scenes;
mod table;
mod timed_scene;

use crate::cli::BenchArguments;
use crate::project::project_root;
use child::MeasuredCost;
pub(crate) use cost::{PredictedCost, RATIOS, Spread};
use fit::CountedRun;
use row::PredictionRow;
use std::path::Path;
use timed_scene::{Text, TimedScene};
use wayside::chain::expectation::Expectation;
use wayside::chain::expectation::rates::{HELD_KINDS, HELD_MIB, SECONDS};
use wayside::chain::expectation::work::ITEMS;
use wayside::chain::link::Chain;
use wayside::chain::loading;
use wayside::chain::memory_estimate::MemoryLoad;
use wayside::chain::plan::FramePlan;
use wayside::host::failure::Failure;
use wayside::host::processor_time;
use wayside::program::terminal;
use wayside::{Allowance, SceneSource};

/// Scenes that are already in the file are predicted anew, but not run again: their times hold for the new
/// predictions too.
pub(super) fn run(arguments: &BenchArguments) -> Result<(), Failure> {
    let folder = tempfile::tempdir().map_err(|e| Failure::System(format!("no temporary folder: {e}")))?;
    let known = arguments.out.as_deref().map(table::measured_costs).transpose()?.unwrap_or_default();
    let drawn =
        (0..arguments.scenes).map(|number| random_scenes::scene(arguments.seed, number, &project_root()));
    let scenes = drawn.chain(arguments.with.iter().map(|file| TimedScene::of_file(file)));
    let (old, new): (Vec<_>, Vec<_>) = scenes.partition(|scene| known.contains_key(&scene.name));
    let mut rows = Vec::new();
    for scene in old.into_iter().chain(new) {
        let known = known.get(&scene.name);
        let Some(row) = row_unless_refused(scene, folder.path(), known)? else { continue };
        terminal::line(line(&row));
        terminal::cancellation().check()?;
        rows.push(row);
        if let (Some(file), None) = (&arguments.out, known) {
            // Written after each scene, so that hours of work do not depend on the last one.
            table::write(file, &rows)?;
        }
    }
    if let Some(file) = &arguments.out {
        table::write(file, &rows)?;
    }
    quantiles(&rows).into_iter().for_each(terminal::line);
    let mut timed: Vec<_> = rows.iter().flat_map(PredictionRow::timed).collect();
    let mut held: Vec<_> = rows.iter().flat_map(PredictionRow::held).collect();
    for file in &arguments.fit_with {
        let (more_timed, more_held) = table::runs(file)?;
        timed.extend(more_timed);
        held.extend(more_held);
    }
    print_fitted_rates(&timed, &held);
    Ok(())
}

fn print_fitted_rates(timed: &[CountedRun<ITEMS>], held: &[CountedRun<HELD_KINDS>]) {
    terminal::line(format!("rates that would have told {} runs best:", timed.len()));
    for ((item, _), rate) in SECONDS.iter().zip(fit::rates(timed, SECONDS.map(|(_, rate)| rate))) {
        terminal::line(format!("    (WorkKind::{item:?}, {rate:.2e}),"));
    }
    for ((name, _), mib) in HELD_MIB.iter().zip(fit::rates(held, HELD_MIB.map(|(_, mib)| mib))) {
        terminal::line(format!("    (\"{name}\", {mib:.2e}),"));
    }
}

/// Predicted and actual cost of a random scene; `None` if it is refused, or the system does not report the
/// costs of a process.
pub(crate) fn cost_of_random(seed: u64, number: u64) -> Result<Option<PredictedCost>, Failure> {
    let folder = tempfile::tempdir().map_err(|e| Failure::System(format!("no temporary folder: {e}")))?;
    let scene = random_scenes::scene(seed, number, &project_root());
    let row = row_unless_refused(scene, folder.path(), None)?;
    Ok(row.map(|row| row.cost()))
}

/// Weight of a named scene in fitting rates: such scenes are what people run.
const NAMED: usize = 6;

impl PredictionRow {
    /// The run on the reference machine, repeated by its weight.
    fn timed(&self) -> Vec<CountedRun<ITEMS>> {
        let taken = self.taken.processor_s * self.taken.machine_speed;
        vec![CountedRun { counts: self.expected.work.0, taken }; self.times()]
    }

    /// Memory of the run, repeated by its weight.
    fn held(&self) -> Vec<CountedRun<HELD_KINDS>> {
        vec![CountedRun { counts: self.expected.held, taken: self.taken.peak_mib }; self.times()]
    }

    fn cost(&self) -> PredictedCost {
        PredictedCost {
            said_s: self.expected.seconds,
            taken_s: self.taken.processor_s,
            said_mib: self.expected.expected_memory_mib,
            most_mib: self.expected.memory_mib,
            held_mib: self.taken.peak_mib,
        }
    }

    fn times(&self) -> usize {
        if matches!(self.scene.text, Text::File(_)) { NAMED } else { 1 }
    }
}

/// Quantiles of the ratio of expected to actual seconds and memory.
fn quantiles(rows: &[PredictionRow]) -> Vec<String> {
    let costs: Vec<PredictedCost> = rows.iter().map(PredictionRow::cost).collect();
    let told = |(name, ratio): (&str, cost::Ratio)| {
        let Spread { runs, quantiles, within, below } = Spread::of(&costs, ratio);
        let told = quantiles.map(|ratio| format!("{ratio:.2}")).join(" ");
        format!(
            "{name}, said over taken: quantiles 0, 5, 25, 50, 75, 95, 100 %: {told}; {within} of {runs} \
             within a factor of 2, {below} below 1"
        )
    };
    RATIOS.map(told).into()
}

/// Row of a scene, unless the program refuses it, which is told.
fn row_unless_refused(
    scene: TimedScene,
    folder: &Path,
    known: Option<&MeasuredCost>,
) -> Result<Option<PredictionRow>, Failure> {
    match row(scene, folder, known) {
        Err(refused @ (Failure::Refused(_) | Failure::Unplaced(_))) => {
            terminal::line(format!("not run: {refused}"));
            Ok(None)
        }
        row => row,
    }
}

fn row(
    scene: TimedScene,
    folder: &Path,
    known: Option<&MeasuredCost>,
) -> Result<Option<PredictionRow>, Failure> {
    let file = scene.file(folder)?;
    let taken = match known {
        Some(taken) => Some(*taken),
        None => child::run(&file, &folder.join("out"), scene.threads)?,
    };
    let Some(taken) = taken else { return Ok(None) };
    let before_s = processor_time::of_process();
    let (expected, load, at_once) = on_threads(scene.threads, || expected(&file, taken.machine_speed))??;
    let look_s =
        processor_time::of_process().zip(before_s).map_or(f64::NAN, |(after, before)| after - before);
    Ok(Some(PredictionRow { scene, expected, look_s, load, at_once, taken }))
}

/// Runs a function on the threads of a run; `None`: on all.
fn on_threads<T: Send>(threads: Option<u16>, does: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0).into()).build();
    Ok(pool.map_err(|e| Failure::System(format!("threads cannot be started: {e}")))?.install(does))
}

/// Predicts seconds and memory of a scene as `run --dry-run` does, on a machine of this speed.
fn expected(file: &Path, machine_speed: f64) -> Result<(Expectation, MemoryLoad, usize), Failure> {
    let arguments = SceneSource { file: file.to_owned(), ..SceneSource::default() };
    let loaded = loading::scene(&arguments, None)?;
    let model = loading::model(None)?;
    let chain = Chain::of(&loaded.header, None, model.as_ref(), Allowance::of(None));
    let plans: Vec<FramePlan> = (0..loaded.header.frames).map(|index| chain.plan(index)).collect();
    let expected = Expectation::at_speed(&chain, None, &plans, machine_speed)?;
    Ok((expected, chain.largest_load(&plans)?, chain.frames_at_once(&plans)?.workers))
}

fn line(row: &PredictionRow) -> String {
    let MeasuredCost { processor_s, peak_mib, .. } = row.taken;
    let Expectation { seconds, expected_memory_mib: expected_mib, memory_mib, .. } = row.expected;
    format!(
        "{}: {seconds:.1} s said, {processor_s:.1} s taken, × {:.2}; {expected_mib:.0} MiB said, at most \
         {memory_mib:.0}, {peak_mib:.0} held, × {:.2}",
        row.scene.name,
        seconds / processor_s,
        expected_mib / peak_mib
    )
}
