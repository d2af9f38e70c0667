//! Plans of random scenes, beside the same scenes with everything on and finer: whether what was promised is
//! kept, and what a plan costs beside the cheapest setting that keeps it.

mod drawn; // scenes of a seed
mod kept; // rows of a study that was ended
mod trial; // a plan, its truth, and other settings

use crate::study::extent::Extent;
use crate::study::pages::part::Part;
use crate::study::sources::{self, CHAIN, Places};
use kept::Kept;
use trial::{Searched, Trial};
use wayside::host::failure::Failure;
use wayside::host::progress::Work;

/// Sources that the figures hang on.
pub(crate) const SOURCES: Places = &[
    CHAIN,
    &["crates/pipeline/src/planning", "xtask/src/study/pages/planner", "xtask/src/study/pages/planner.rs"],
];

/// Accuracies asked, dB, in turn; the finest of one vehicle alone.
const ASKED_DB: [f64; 4] = [-10.0, -15.0, -20.0, -30.0];
const SCENES: u64 = 200;
/// Every so manieth scene is searched for the cheapest setting too.
const SEARCHED_EVERY: u64 = 20;

pub(crate) fn part(extent: Extent) -> Result<Part, Failure> {
    let (mut part, count) = (Part::default(), extent.of(SCENES));
    let kept = Kept::of(&sources::hash(SOURCES)?);
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
    for number in 0..count {
        work.at(number as usize, count as usize);
        let asked_db = ASKED_DB[(number % 4) as usize];
        let scene = drawn::scene(1, number, if asked_db < -25.0 { 1 } else { 3 });
        let trial = kept.or_made(&format!("planned-{number:03}"), || Trial::of(&scene, asked_db))?;
        part.row(&trial.cells());
        trials.push(trial);
    }
    told(&mut part, &trials);
    searched(&mut part, count, &kept)?;
    Ok(part)
}

/// Shares of the scenes that are as good as was promised.
fn told(part: &mut Part, trials: &[Trial]) {
    let within = |db: f64| trials.iter().filter(|trial| trial.beyond_db() <= db).count();
    let worst = trials.iter().map(Trial::beyond_db).fold(f64::NEG_INFINITY, f64::max);
    let count = trials.len();
    part.line(format!(
        "\n{} of {count} plans err by no more than they spend, {} by no more than 3 dB beyond; the worst by \
         {worst:+.1} dB.",
        within(0.0),
        within(3.0)
    ));
    let sum = |of: fn(&Trial) -> f64| trials.iter().map(of).sum::<f64>();
    let (planned_s, as_said_s) = (sum(|trial| trial.planned_s), sum(|trial| trial.as_said_s));
    part.line(format!(
        "All of them take {planned_s:.0} processor seconds, looks among them; with the default keys at the \
         accuracy asked {as_said_s:.0}.\n"
    ));
    if within(0.0) * 100 < 95 * count {
        part.complain(format!("{} of {count} plans keep what they promise", within(0.0)));
    }
}

/// Plans beside the cheapest of all settings that err by no more than the plan spends.
fn searched(part: &mut Part, count: u64, kept: &Kept) -> Result<(), Failure> {
    part.head(&[
        "scene",
        "spent",
        "s planned",
        "the look among them",
        "cheapest that keeps it",
        "its s",
        "ratio",
    ]);
    let work = Work::begin("scenes searched");
    for number in (0..count).step_by(SEARCHED_EVERY as usize) {
        work.at(number as usize, count as usize);
        let asked_db = ASKED_DB[((number / SEARCHED_EVERY) % 3) as usize];
        let scene = drawn::scene(2, number, 1);
        let searched = kept.or_made(&format!("searched-{number:03}"), || Searched::of(&scene, asked_db))?;
        part.row(&searched.cells());
    }
    Ok(())
}
