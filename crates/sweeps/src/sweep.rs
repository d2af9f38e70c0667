//! Execution of a study: makes its runs, and writes its tables, picture and report.

use crate::answer::Answer;
use crate::outputs::blocks::{markdown, on_page};
use crate::outputs::earlier_study;
use crate::outputs::report::{FinishedStudy, answer as answer_of, details};
use crate::outputs::{picture, tables, view};
use crate::runs::run_store::RunStore;
use crate::study::document::{RUNS_LIMIT, Study};
use crate::study::situations::Situation;
use crate::study::{acceptance, designs, kinds, situations};
use crate::study_run::{RunState, StudyRun};
use maud::html;
use pipeline::chain::cache::{Cache, CacheLocation};
use pipeline::chain::loaded_model::LoadedModel;
use pipeline::chain::loading;
use pipeline::host::cancellation::Cancellation;
use pipeline::host::failure::Failure;
use pipeline::host::files::{self, FolderLock};
use pipeline::host::memory::Allowance;
use pipeline::host::progress::{self, Work};
use pipeline::planning;
use plotting::layout::{Figure, Layout};
use reporting::pictures;
use reporting::report;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicUsize;

/// Settings of a study: its file, and the way it is run.
pub struct Settings<'a> {
    /// Study file (`docs/sweeps.md`).
    pub study: PathBuf,
    /// Folder of all results; those of an earlier study are reused.
    pub out: PathBuf,
    /// Part of the runs to make, from 1, and number of parts; `None`: none is made, and a missing one is an
    /// error.
    pub shard: Option<[u32; 2]>,
    /// Seed in place of the study's.
    pub seed: Option<u64>,
    /// The classifier's model; `None`: the shipped one.
    pub classifier: Option<PathBuf>,
    /// Cache of scattering; `None`: no cache.
    pub cache: Option<CacheLocation>,
    /// Memory allowed for tracing.
    pub memory: Allowance,
    /// Command that the report names.
    pub command: String,
    /// Receives each line of results.
    pub tell: &'a dyn Fn(&str),
    /// Ends the study between two runs.
    pub cancellation: Cancellation,
}

/// Result of a study beside its files.
pub struct Outcome {
    /// The answer as Markdown; its first sentence names the design.
    pub answer: String,
    /// Details as Markdown: front, effects of each value, all metrics, method.
    pub details: String,
    /// Number of the design of the answer, from 0; `None` if the metric was never known.
    pub chosen: Option<usize>,
}

const RESULTS: [&str; 6] =
    ["sweep.csv", "designs.csv", "report.md", "report.html", "pareto.svg", "pareto.png"];

/// Runs a study: makes the runs of this part and, if all are made, tables, picture and report; `None` if
/// other parts still have to make theirs.
///
/// # Errors
/// A sentence that names file, place and rule if the study, its scene or a model is refused; completed runs
/// are kept.
pub fn run(settings: &Settings) -> Result<Option<Outcome>, Failure> {
    let cache = Cache::of_run(settings.cache.as_ref())?;
    if let Some(cache) = &cache {
        cache.apart_from([settings.out.as_path(), &RunStore::folder_in(&settings.out)])?;
    }
    let study = Study::read(&settings.study, settings.seed)?;
    check_size(&study)?;
    let (designs, situations) = (designs::designs(&study), situations::situations(&study));
    let work = Work::begin("reading the scenes of all designs");
    acceptance::check(&study, &designs, situations.first().map_or(&[], Vec::as_slice))?;
    let remarks: Vec<String> = planning::unplanned(&study.scene, "a study")?.into_iter().collect();
    drop(work);
    remarks.iter().for_each(|remark| progress::note(format!("note: {remark}")));
    let model = loading::model(settings.classifier.as_deref())?;
    // All inputs are known now, and no run has been made.
    files::claim(&RESULTS.map(|name| settings.out.join(name)))?;
    earlier_study::refuse_foreign(&settings.out)?;
    let first_of_kinds = kinds::first_of_kinds(&study, &designs);
    let study_run = StudyRun {
        study: &study,
        designs: &designs,
        first_of_kinds: &first_of_kinds,
        situations: &situations,
        store: RunStore::of(&study, model.as_ref().map(LoadedModel::hash), &settings.out),
        cache,
        model,
        memory: settings.memory,
        shard: settings.shard,
        cancellation: &settings.cancellation,
        runs_made: AtomicUsize::new(0),
    };
    let ledger = match study_run.make_all()? {
        RunState::Complete(ledger) => ledger,
        RunState::Incomplete { missing, made } if settings.shard.is_none() => {
            let out = settings.out.display();
            return Err(Failure::System(format!("{out}: {missing} runs are not made yet, {made} are")));
        }
        RunState::Incomplete { missing, made } => {
            (settings.tell)(&format!(
                "{missing} runs are not made yet, {made} are (what lacks is of another part of --shard)"
            ));
            return Ok(None);
        }
    };
    let answer = Answer::of(&study, &ledger);
    let all: Vec<&Situation> = situations.iter().flatten().collect();
    let _writing = FolderLock::wait_for(&settings.out)?;
    files::remove_outdated(RESULTS.map(|name| settings.out.join(name)))?;
    let out = |name: &str| settings.out.join(name);
    files::write_file(&out("sweep.csv"), tables::runs(&study, &designs, &all, &ledger).as_bytes())?;
    files::write_file(&out("designs.csv"), tables::designs(&study, &designs, &ledger, &answer).as_bytes())?;
    let finished = FinishedStudy {
        study: &study,
        designs: &designs,
        ledger: &ledger,
        answer: &answer,
        remarks: &remarks,
    };
    conclude(settings, &finished, &all).map(Some)
}

/// Refuses too many runs before as many designs and situations are made.
fn check_size(study: &Study) -> Result<(), Failure> {
    let runs = situations::count(study).saturating_mul(designs::count(study));
    match runs {
        0..=RUNS_LIMIT => Ok(()),
        _ => Err(study.page.refused(0, "", &format!("the study has {runs} runs, more than {RUNS_LIMIT}"))),
    }
}

/// Writes picture and report, and returns the answer.
fn conclude(
    settings: &Settings,
    finished: &FinishedStudy,
    situations: &[&Situation],
) -> Result<Outcome, Failure> {
    let figure = Figure::draw(|layout: Layout| picture::draw(finished.study, finished.answer, layout));
    let out = |name: &str| settings.out.join(name);
    files::write_file(&out("pareto.svg"), figure.wide.standalone().as_bytes())?;
    pictures::write_png(&out("pareto.png"), &figure.wide)?;
    let (first, rest) = (answer_of(finished), details(finished));
    let name = settings.study.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let made = format!("Made by `{}`.", settings.command);
    let text = format!(
        "# {name}\n\n{}\n![The front](pareto.svg)\n\n{}\n{made}\n",
        markdown(&first),
        markdown(&rest)
    );
    files::write_file(&out("report.md"), text.as_bytes())?;
    let seen = view::of(finished, situations)?;
    let page = report::sheet(
        &name,
        html! {
            @for block in &first { (on_page(block)) }
            (report::sweep_view::section(&seen))
            (report::figure("Value and cost of the designs.", &figure))
            @for block in &rest { (on_page(block)) }
            p.made {
                "Made by " code { (settings.command) } ". Files beside this page: "
                a href="sweep.csv" { "sweep.csv" } " (every run), "
                a href="designs.csv" { "designs.csv" } " (every design)."
            }
        },
    );
    files::write_file(&out("report.html"), page.as_bytes())?;
    finished.sentences().iter().for_each(|line| (settings.tell)(line));
    (settings.tell)(&format!("report: {}", shown(&out("report.html"))));
    Ok(Outcome { answer: markdown(&first), details: markdown(&rest), chosen: finished.answer.chosen })
}

fn shown(file: &Path) -> String {
    file.display().to_string()
}
