//! The runs of a study, repeat by repeat: kept runs are reused, missing ones are made, and after each repeat
//! designs that are certainly worse are dropped.

use crate::answer::scores;
use crate::runs::ledger::{Ledger, Run};
use crate::runs::one_run::{self, MeasuredErrors, RunResources};
use crate::runs::run_accuracy::{ErrorSource, RunAccuracy};
use crate::runs::run_store::RunStore;
use crate::statistics::racing::{self, EliminationRule};
use crate::study::acceptance;
use crate::study::axis::AxisChoice;
use crate::study::document::Study;
use crate::study::situations::{Situation, changes_in};
use artifact::scene::SceneHeader;
use pipeline::chain::cache::Cache;
use pipeline::chain::link::Chain;
use pipeline::chain::loaded_model::LoadedModel;
use pipeline::host::cancellation::Cancellation;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use pipeline::host::parallel_jobs::parallel_jobs;
use pipeline::host::progress::Work;
use pipeline::outcome::summary::Summary;
use scene::MeshLoading;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// A study being run.
pub(crate) struct StudyRun<'a> {
    pub(crate) study: &'a Study,
    pub(crate) designs: &'a [Vec<AxisChoice>],
    /// First design of each design's kind.
    pub(crate) first_of_kinds: &'a [usize],
    /// Situations, repeat by repeat.
    pub(crate) situations: &'a [Vec<Situation>],
    pub(crate) store: RunStore,
    pub(crate) cache: Option<Cache>,
    pub(crate) model: Option<LoadedModel>,
    pub(crate) memory: Allowance,
    /// Part of the runs to make: number from 1, and number of parts; `None`: none.
    pub(crate) shard: Option<[u32; 2]>,
    pub(crate) cancellation: &'a Cancellation,
    /// Number of runs made so far.
    pub(crate) runs_made: AtomicUsize,
}

/// State of a study's runs.
pub(crate) enum RunState {
    /// All runs that the answer needs.
    Complete(Ledger),
    /// Runs of other parts are missing, beside those made; with an early stop the number is that of one
    /// repeat, because the remaining designs are not known before.
    Incomplete { missing: usize, made: usize },
}

/// Errors of one run, once they are measured.
type SharedErrors = Mutex<Option<Arc<MeasuredErrors>>>;

/// A missing run: its number among those of its repeat.
struct Job {
    number: usize,
    key: String,
}

impl StudyRun<'_> {
    /// Makes this part's runs. It repeats the search until it finds nothing to make, so that the part that
    /// ends last sees the runs of the others.
    pub(crate) fn make_all(&self) -> Result<RunState, Failure> {
        loop {
            let before = self.runs_made.load(Ordering::Relaxed);
            let made = self.make_missing()?;
            if matches!(made, RunState::Complete(_)) || self.runs_made.load(Ordering::Relaxed) == before {
                return Ok(made);
            }
        }
    }

    /// Goes through all repeats and makes the missing runs of this part.
    fn make_missing(&self) -> Result<RunState, Failure> {
        let mut ledger = Ledger::of(self.designs.len());
        let (mut missing, mut made) = (0, 0);
        for (repeat, situations) in self.situations.iter().enumerate() {
            let runs = self.make_repeat(repeat, situations, &ledger.open)?;
            made += runs.iter().flatten().count();
            missing += runs.iter().filter(|run| run.is_none()).count();
            match (missing, self.study.stop) {
                (0, _) => self.enter(&mut ledger, situations, runs),
                (_, None) => continue,
                (_, Some(_)) => break,
            }
            if self.study.stop.is_some() && ledger.open.len() == 1 {
                break;
            }
        }
        Ok(if missing == 0 { RunState::Complete(ledger) } else { RunState::Incomplete { missing, made } })
    }

    /// Enters a complete repeat.
    fn enter(&self, ledger: &mut Ledger, situations: &[Situation], runs: Vec<Option<Run>>) {
        let numbers = self.numbers(situations, &ledger.open);
        for (number, run) in numbers.into_iter().zip(runs.into_iter().flatten()) {
            ledger.enter(number / situations.len(), run);
        }
        self.drop_worse(ledger);
    }

    fn drop_worse(&self, ledger: &mut Ledger) {
        if let Some(stop) = self.study.stop {
            let looks = self.situations.len();
            let scale = self.study.metrics.scale(self.study.goal.metric);
            let rule = EliminationRule { confidence: stop.confidence, least: stop.least, looks, scale };
            ledger.open = racing::survivors(&scores(self.study, ledger), &ledger.open, &rule);
        }
    }

    /// Numbers of the runs of open designs in a repeat, design by design.
    fn numbers(&self, situations: &[Situation], open: &[usize]) -> Vec<usize> {
        let count = situations.len();
        open.iter().flat_map(|design| design * count..(design + 1) * count).collect()
    }

    /// A repeat's runs in the order of their numbers; `None` if another part has to make one.
    fn make_repeat(
        &self,
        repeat: usize,
        situations: &[Situation],
        open: &[usize],
    ) -> Result<Vec<Option<Run>>, Failure> {
        let is_of = |number: usize, [part, of]: [u32; 2]| number % of as usize == (part - 1) as usize;
        let is_mine = |number: &usize| self.shard.is_some_and(|shard| is_of(*number, shard));
        let numbers = self.numbers(situations, open);
        let mut keys = vec![];
        let mut jobs = vec![];
        for number in &numbers {
            let key = self
                .key(*number, situations)
                .map_err(|failure| self.explained(failure, *number, situations))?;
            if is_mine(number) && self.store.get(self.study, &key).is_none() {
                jobs.push(Job { number: *number, key: key.clone() });
            }
            keys.push(key);
        }
        self.make(repeat, situations, &jobs)?;
        Ok(keys.iter().map(|key| self.store.get(self.study, key)).collect())
    }

    fn key(&self, number: usize, situations: &[Situation]) -> Result<String, Failure> {
        let situation = &situations[number % situations.len()];
        let measured_in = self.measured_in(number, situations);
        let changes = [number, measured_in].map(|number| self.changes(number, situations));
        self.store.key(self.study, [&changes[0], &changes[1]], situation.seed)
    }

    /// Refusal of a run's scene, which may depend on the combination of design and situation: with the values
    /// of the study that cause it.
    fn explained(&self, failure: Failure, number: usize, situations: &[Situation]) -> Failure {
        let (design, situation) = self.at(number, situations);
        acceptance::check_one(self.study, design, situation).err().unwrap_or(failure)
    }

    /// The run in which the errors of a run are measured: that of the first design of its kind in the same
    /// situation.
    fn measured_in(&self, number: usize, situations: &[Situation]) -> usize {
        let count = situations.len();
        self.first_of_kinds[number / count] * count + number % count
    }

    /// Changes that a run makes to the scene.
    fn changes(&self, number: usize, situations: &[Situation]) -> Vec<scene::Change> {
        let (design, situation) = self.at(number, situations);
        changes_in(self.study, design, situation)
    }

    /// Design and situation of a run.
    fn at<'s>(&self, number: usize, situations: &'s [Situation]) -> (&[AxisChoice], &'s Situation) {
        (&self.designs[number / situations.len()], &situations[number % situations.len()])
    }

    fn make(&self, repeat: usize, situations: &[Situation], jobs: &[Job]) -> Result<(), Failure> {
        let Some(first) = jobs.first() else { return Ok(()) };
        let work = Work::begin(format!("repeat {} of {}", repeat + 1, self.situations.len()));
        let at_once = self.at_once(&self.scene(first.number, situations)?, jobs.len())?;
        let resources = RunResources {
            cache: self.cache.as_ref(),
            model: self.model.as_ref(),
            memory: self.memory,
            at_once,
        };
        let done = AtomicUsize::new(0);
        let measured = self.not_measured_yet(jobs, situations);
        let make = |job: &Job| {
            self.cancellation.check()?;
            let run = self.run(job, situations, &measured, &resources)?;
            self.store.check_unchanged()?;
            self.store.put(self.study, &job.key, &run)?;
            self.runs_made.fetch_add(1, Ordering::Relaxed);
            work.at(done.fetch_add(1, Ordering::Relaxed) + 1, jobs.len());
            Ok(())
        };
        let made = parallel_jobs(jobs, at_once, make).map(drop);
        if let Some(cache) = &self.cache {
            cache.trim();
        }
        made
    }

    /// Empty places for the errors of all runs in which those of the jobs are measured.
    fn not_measured_yet(&self, jobs: &[Job], situations: &[Situation]) -> BTreeMap<usize, SharedErrors> {
        jobs.iter().map(|job| (self.measured_in(job.number, situations), SharedErrors::default())).collect()
    }

    /// Makes a run and measures it.
    fn run(
        &self,
        job: &Job,
        situations: &[Situation],
        measured: &BTreeMap<usize, SharedErrors>,
        resources: &RunResources,
    ) -> Result<Run, Failure> {
        let first = self.measured_in(job.number, situations);
        let header = self.scene(job.number, situations)?;
        let run_of = |(summary, errors): (Summary, ErrorSource)| Run {
            values: self.study.metrics.values(&header.radar, &summary),
            accuracy: RunAccuracy::of(&summary, errors),
        };
        if first == job.number {
            return one_run::summary(&header, None, resources).map(run_of);
        }
        // The first job measures; the others wait.
        let mut place = measured[&first].lock().unwrap_or_else(PoisonError::into_inner);
        let like = match &*place {
            Some(like) => like.clone(),
            None => Arc::new(one_run::measure_errors(&self.scene(first, situations)?, resources)?),
        };
        *place = Some(like.clone());
        drop(place);
        one_run::summary(&header, Some(&like), resources).map(run_of)
    }

    /// The scene of a run. A file that is no longer a valid scene is reported as changed since the study
    /// began: it may be half written.
    fn scene(&self, number: usize, situations: &[Situation]) -> Result<SceneHeader, Failure> {
        let (design, situation) = self.at(number, situations);
        let read = one_run::read(self.study, design, situation, MeshLoading::Whole);
        read.map_err(|failure| self.store.check_unchanged().err().unwrap_or(failure))
    }

    /// One run per thread, as many as are expected to fit into the allowed memory if all are as large as this
    /// one.
    fn at_once(&self, header: &SceneHeader, jobs: usize) -> Result<usize, Failure> {
        let threads = rayon::current_num_threads().min(jobs).max(1);
        let Some(limit_mib) = self.memory.mib().filter(|_| threads > 1) else { return Ok(threads) };
        let chain = Chain::of(header, None, None, self.memory);
        let estimate_mib = chain.memory_estimate_mib(&chain.plan(0))?;
        Ok(((limit_mib / estimate_mib) as usize).clamp(1, threads))
    }
}
