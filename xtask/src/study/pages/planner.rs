//! Plans of random scenes, compared with the same scenes with all physics and finer: whether the promise is
//! kept, and the cost of a plan relative to the cheapest setting that keeps it.

mod random_scenes; // scenes of a seed
mod plan_trial; // a plan, its truth, and alternative settings

use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::pages::row_cache::RowCache;
use crate::study::sources::{self, CHAIN, SourcePaths};
use plan_trial::{CheapestSetting, PlanTrial};
use random_scenes::RandomScene;
use serde::Serialize;
use serde::de::DeserializeOwned;
use wayside::host::failure::Failure;
use wayside::host::progress::Work;
use wayside::program::values::Shard;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[
    CHAIN,
    &["crates/pipeline/src/planning", "xtask/src/study/pages/planner", "xtask/src/study/pages/planner.rs"],
    &["xtask/src/random_scenes.rs"],
];

/// Requested accuracies, dB, in turn; the finest only for a single vehicle.
const ASKED_DB: [f64; 5] = [-10.0, -15.0, -20.0, -30.0, -40.0];
const SCENES: u64 = 200;
/// Requested accuracies of scenes that are also searched for the cheapest setting, and their number.
const SEARCHED_DB: [f64; 3] = [-10.0, -15.0, -20.0];
const SEARCHED: u64 = 10;

/// All rows; missing ones are made.
pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    section_of(&Rows::of(extent, MissingRows::Make)?)
}

/// The kept rows, and the number of missing ones.
pub(crate) fn section_from_cache(extent: Extent) -> Result<PageSection, Failure> {
    section_of(&Rows::of(extent, MissingRows::Skip)?)
}

fn section_of(rows: &Rows) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    let columns = [
        "scene",
        "asked",
        "spent",
        "limit",
        "bounces",
        "left out",
        "true error",
        "s planned",
        "s as it stands",
    ];
    part.head(&columns);
    let work = Work::begin("scenes");
    let mut trials = vec![];
    for number in 0..rows.scenes {
        work.at(number as usize, rows.scenes as usize);
        let Some(trial) = rows.trial(number)? else { continue };
        part.row(&trial.cells());
        trials.push(trial);
    }
    if !trials.is_empty() {
        add_accuracy_summary(&mut part, &trials);
    }
    add_cheapest_settings(&mut part, rows)?;
    if let Some(line) = rows.missing_sentence() {
        part.line(line);
    }
    Ok(part)
}

/// Makes every `of`th row from `number` on, and keeps it for the page.
pub(crate) fn rows(extent: Extent, shard: Shard) -> Result<(), Failure> {
    let rows = Rows::of(extent, MissingRows::Make)?;
    let is_ours = |index: &u64| index % u64::from(shard.of) == u64::from(shard.number - 1);
    let work = Work::begin("rows");
    let count = rows.scenes + rows.searched;
    for index in (0..count).filter(is_ours) {
        work.at(index as usize, count as usize);
        match index.checked_sub(rows.scenes) {
            None => drop(rows.trial(index)?),
            Some(number) => drop(rows.search(number)?),
        }
    }
    Ok(())
}

/// Treatment of rows that are not kept.
#[derive(Clone, Copy, PartialEq)]
enum MissingRows {
    Make,
    Skip,
}

/// Rows of both tables: made, or read if they are kept.
struct Rows {
    cache: RowCache,
    missing: MissingRows,
    scenes: u64,
    searched: u64,
}

impl Rows {
    fn of(extent: Extent, missing: MissingRows) -> Result<Self, Failure> {
        let cache = RowCache::of("planner", &sources::hash(SOURCES)?);
        Ok(Self { cache, missing, scenes: extent.case_count(SCENES), searched: extent.case_count(SEARCHED) })
    }

    /// A row of the first table; `None` if nothing scatters, a real vehicle is missing, or the row is neither
    /// kept nor made.
    fn trial(&self, number: u64) -> Result<Option<PlanTrial>, Failure> {
        self.row(trial_scene(number), PlanTrial::of)
    }

    /// A row of the second table; `None` in the same cases.
    fn search(&self, number: u64) -> Result<Option<CheapestSetting>, Failure> {
        self.row(search_scene(number), CheapestSetting::of)
    }

    fn row<R: Serialize + DeserializeOwned>(
        &self,
        scene: Option<RandomScene>,
        make: impl FnOnce(&RandomScene) -> Result<Option<R>, Failure>,
    ) -> Result<Option<R>, Failure> {
        let Some(scene) = scene else { return Ok(None) };
        if self.missing == MissingRows::Skip {
            return Ok(self.cache.get::<Option<R>>(&scene.name).flatten());
        }
        self.cache.get_or_make(&scene.name, || make(&scene))
    }

    /// Sentence about missing rows; `None` if there are none.
    fn missing_sentence(&self) -> Option<String> {
        let trials = self.cache.missing::<Option<PlanTrial>>(names(self.scenes, trial_scene));
        let searched = self.cache.missing::<Option<CheapestSetting>>(names(self.searched, search_scene));
        let all = format!("Of {} scenes {trials} are not in the first table", self.scenes);
        (trials + searched > 0)
            .then(|| format!("\n{all}, of {} {searched} not in the second.", self.searched))
    }
}

/// Names of the scenes of a table.
fn names(count: u64, scene: fn(u64) -> Option<RandomScene>) -> impl Iterator<Item = String> {
    (0..count).filter_map(move |number| Some(scene(number)?.name))
}

fn trial_scene(number: u64) -> Option<RandomScene> {
    random_scenes::scene(1, number, in_turn(&ASKED_DB, number))
}

fn search_scene(number: u64) -> Option<RandomScene> {
    random_scenes::scene(2, number, in_turn(&SEARCHED_DB, number))
}

fn in_turn(all_db: &[f64], number: u64) -> f64 {
    all_db[number as usize % all_db.len()]
}

/// Adds the shares of scenes that are as accurate as promised.
fn add_accuracy_summary(part: &mut PageSection, trials: &[PlanTrial]) {
    let within = |db: f64| trials.iter().filter(|trial| trial.excess_db() <= db).count();
    let worst = trials.iter().map(PlanTrial::excess_db).fold(f64::NEG_INFINITY, f64::max);
    let count = trials.len();
    part.line(format!(
        "\n{} of {count} plans err by no more than they spend, {} by no more than 3 dB beyond; the worst by \
         {worst:+.1} dB.",
        within(0.0),
        within(3.0)
    ));
    let sum = |of: fn(&PlanTrial) -> f64| trials.iter().map(of).sum::<f64>();
    let (planned_s, as_said_s) = (sum(|trial| trial.planned_s), sum(|trial| trial.as_said_s));
    part.line(format!(
        "All of them take {planned_s:.0} processor seconds, looks among them; with the default keys at the \
         accuracy asked {as_said_s:.0}.\n"
    ));
    if within(0.0) * 100 < 95 * count {
        part.complain(format!("{} of {count} plans keep what they promise", within(0.0)));
    }
}

/// Compares plans with the cheapest of all settings whose error is no larger than the plan's budget.
fn add_cheapest_settings(part: &mut PageSection, rows: &Rows) -> Result<(), Failure> {
    part.head(&[
        "scene",
        "channels",
        "spent",
        "s planned",
        "the look among them",
        "cheapest that keeps it",
        "its s",
        "ratio",
    ]);
    let work = Work::begin("scenes searched");
    for number in 0..rows.searched {
        work.at(number as usize, rows.searched as usize);
        if let Some(searched) = rows.search(number)? {
            part.row(&searched.cells());
        }
    }
    Ok(())
}
