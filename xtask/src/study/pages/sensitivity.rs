//! Sensitivity of a run's results to the requested accuracy: scenes at several accuracies compared with the
//! finest that memory allows, and the accuracy that each result needs.

mod scenes;
mod run_results;
mod changes;
mod needs;

use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{CHAIN, RUN, SourcePaths};
use artifact::goal::Goal;
use changes::Changes;
use needs::Measures;
use run_results::{RunResult, RunResults};
use scenes::Case;
use wayside::host::failure::Failure;
use wayside::host::progress::note;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths =
    &[CHAIN, RUN, &["crates/classifier", "scenes", "xtask/src/study/pages/sensitivity", file!()]];

/// Tested accuracies, coarsest first, dB.
const TRIED_DB: [f64; 4] = [-10.0, -15.0, -20.0, -30.0];
/// Seed of another draw of the receiver's noise.
const OTHER_NOISE: u64 = 1001;

/// Runs of one scene.
struct Runs {
    name: String,
    reference: RunResult,
    /// Run at the coarsest tested accuracy with other noise.
    noise: RunResult,
    /// Runs in the order of [`TRIED_DB`], those coarser than the reference.
    tried: Vec<RunResult>,
}

pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let results = RunResults::open(SOURCES)?;
    let all: Vec<Runs> =
        scenes::cases(extent)?.iter().map(|case| runs(&results, case)).collect::<Result<_, _>>()?;
    let every: Vec<&Runs> = all.iter().collect();
    let followed: Vec<&Runs> = all.iter().filter(|run| !run.reference.tracks.is_empty()).collect();
    let mut part = PageSection::default();
    part.line("## Objects\n");
    table(&mut part, &every, |a| &a.truth_of_objects, objects_of);
    part.line("\n## Tracks\n");
    table(&mut part, &followed, |a| &a.truth_of_tracks, tracks_of);
    part.line("\n## What each result needs\n");
    needs(&mut part, &every);
    part.line("\n## What it saves\n");
    seconds(&mut part, &every);
    Ok(part)
}

fn runs(results: &RunResults, case: &Case) -> Result<Runs, Failure> {
    let at = |accuracy_db, seed| {
        note(format!("{}, {accuracy_db} dB", case.name));
        results.of(case, accuracy_db, seed)
    };
    let coarser = TRIED_DB.iter().filter(|db| **db > case.reference_db);
    let tried = coarser.map(|db| at(*db, None)).collect::<Result<_, _>>()?;
    let (reference, noise) = (at(case.reference_db, None)?, at(TRIED_DB[0], Some(OTHER_NOISE))?);
    Ok(Runs { name: case.group.to_owned(), reference, noise, tried })
}

/// Kind of results of a scene: its objects or its tracks.
type EstimateSelector = fn(&RunResult) -> &run_results::EstimatesByBody;

fn objects_of(result: &RunResult) -> &run_results::EstimatesByBody {
    &result.objects
}

fn tracks_of(result: &RunResult) -> &run_results::EstimatesByBody {
    &result.tracks
}

/// Changes of an accuracy against the reference, of all runs together.
fn changed(all: &[&Runs], index: usize, select: EstimateSelector) -> Changes {
    let of = |run: &&Runs| Some(Changes::between(select(&run.reference), select(run.tried.get(index)?)));
    all.iter().filter_map(of).fold(Changes::default(), Changes::and)
}

/// Changes between two draws of the receiver's noise, at the coarsest accuracy.
fn by_noise(all: &[&Runs], select: EstimateSelector) -> Changes {
    let of = |run: &&Runs| Some(Changes::between(select(run.tried.first()?), select(&run.noise)));
    all.iter().filter_map(of).fold(Changes::default(), Changes::and)
}

/// The reference against the truth.
fn errors(all: &[&Runs], truth: EstimateSelector, select: EstimateSelector) -> Changes {
    let of = |run: &&Runs| Changes::between(truth(&run.reference), select(&run.reference));
    all.iter().map(of).fold(Changes::default(), Changes::and)
}

const COLUMNS: [&str; 11] = [
    "scenes",
    "accuracy",
    "there",
    "lost",
    "gained",
    "range, m",
    "velocity, m/s",
    "direction, °",
    "other lane",
    "other class",
    "probability",
];

const OF_NOISE: &str = "−10 dB, other noise";
const OF_TRUTH: &str = "the finest, against truth";

/// Adds the rows of each group and of all.
fn table(part: &mut PageSection, all: &[&Runs], truth: EstimateSelector, select: EstimateSelector) {
    part.head(&COLUMNS);
    for (name, group) in groups(all) {
        rows(part, name, &group, select);
    }
    rows(part, "all", all, select);
    row(part, "all", OF_TRUTH, &errors(all, truth, select));
}

/// Runs of scenes that are reported together, in order.
fn groups<'r>(all: &[&'r Runs]) -> Vec<(&'r str, Vec<&'r Runs>)> {
    let mut groups: Vec<(&str, Vec<&Runs>)> = vec![];
    for &run in all {
        match groups.last_mut() {
            Some((name, group)) if *name == run.name => group.push(run),
            _ => groups.push((&run.name, vec![run])),
        }
    }
    groups
}

fn rows(part: &mut PageSection, name: &str, group: &[&Runs], select: EstimateSelector) {
    for (index, accuracy_db) in TRIED_DB.iter().enumerate() {
        let changes = changed(group, index, select);
        if changes.there > 0 {
            row(part, name, &decibels(*accuracy_db), &changes);
        }
    }
    row(part, name, OF_NOISE, &by_noise(group, select));
}

fn row(part: &mut PageSection, name: &str, accuracy: &str, changes: &Changes) {
    let Changes { there, lost, gained, .. } = changes;
    let counts = [there, lost, gained].map(usize::to_string);
    let rms = |values: &[f64], digits: usize| {
        changes::rms(values).map_or("–".into(), |x| format!("{x:.digits$}"))
    };
    let share = |(other, of): (usize, usize)| if of == 0 { "–".into() } else { format!("{other} of {of}") };
    let numbers = [rms(&changes.range_m, 3), rms(&changes.velocity_mps, 3), rms(&changes.azimuth_deg, 3)];
    let words = [share(changes.lanes), share(changes.classes), rms(&changes.probability, 3)];
    let head = [name.to_owned(), accuracy.to_owned()];
    part.row(&[head.as_slice(), &counts, &numbers, &words].concat());
}

/// Adds the coarsest accuracy that suffices for each result, and whether the program requests it.
fn needs(part: &mut PageSection, all: &[&Runs]) {
    part.head(&["`for`", "`accuracy_db`", "measured"]);
    for goal in Goal::ALL {
        let asked_db = goal.accuracy().db();
        let measured_db = needed_db(goal, all);
        let found = match (goal, measured_db) {
            (Goal::Cube, _) => "an agreement: 10 % of the amplitude".to_owned(),
            (_, Some(db)) => decibels(db),
            (_, None) => format!("finer than {}", decibels(TRIED_DB[TRIED_DB.len() - 1])),
        };
        let to_ask_db = needs::accuracy_to_request(goal, |goal| needed_db(goal, all));
        if goal != Goal::Cube && to_ask_db.is_none_or(|db| (db - asked_db).abs() > 1e-9) {
            part.complain(format!("`{}` asks for {asked_db} dB, measured: {found}", goal.name()));
        }
        part.row(&[format!("\"{}\"", goal.name()), decibels(asked_db), found]);
    }
}

/// The coarsest tested accuracy that suffices for a result; `None` if the finest does not.
fn needed_db(goal: Goal, all: &[&Runs]) -> Option<f64> {
    let (truth, select): (EstimateSelector, EstimateSelector) = match goal {
        Goal::Tracks => (|a| &a.truth_of_tracks, tracks_of),
        Goal::Cube | Goal::Detection | Goal::Class => (|a| &a.truth_of_objects, objects_of),
    };
    let holds = |index: usize| {
        // Measures of the scenes that were run at this accuracy.
        let tried: Vec<&Runs> = all.iter().copied().filter(|run| run.tried.len() > index).collect();
        let measures = Measures { errors: errors(&tried, truth, select), noise: by_noise(&tried, select) };
        let changes = changed(&tried, index, select);
        (changes.there >= needs::ENOUGH).then(|| needs::result_holds(goal, &changes, &measures))
    };
    needs::coarsest(&TRIED_DB, holds)
}

fn seconds(part: &mut PageSection, all: &[&Runs]) {
    let tried = TRIED_DB.map(decibels);
    let columns: Vec<&str> = tried.iter().map(String::as_str).collect();
    part.head(&[&["scenes, processor seconds"], columns.as_slice(), &["the finest"]].concat());
    for (name, group) in groups(all) {
        let sum = |of: &dyn Fn(&Runs) -> f64| group.iter().map(|run| of(run)).sum::<f64>();
        let tried = (0..TRIED_DB.len())
            .map(|index| sum(&|run| run.tried.get(index).map_or(0.0, |result| result.seconds)));
        let all = tried.chain([sum(&|run| run.reference.seconds)]);
        let cells = all.map(|s| if s > 0.0 { format!("{s:.0}") } else { "–".to_owned() });
        part.row(&[name.to_owned()].into_iter().chain(cells).collect::<Vec<_>>());
    }
}

fn decibels(db: f64) -> String {
    format!("{db:.0} dB").replace('-', "−")
}
