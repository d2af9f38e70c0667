//! All studies: their outputs, their durations, and the age of the outputs relative to the code.

use crate::cli::{AtlasArguments, ChartArguments, PageArguments, StudyArguments};
use crate::project::project_root;
use crate::study::drawn::{self, ATLAS, CHART, LEVELS};
use crate::study::extent::Extent;
use crate::study::page::{Age, FEWER, difference, part_of, with_part};
use crate::study::pages::scattering::{
    continuity, estimates_of_errors, gates, published_levels, references, wheels,
};
use crate::study::pages::signals::{
    ambiguity, calibration, estimates, false_alarms, ghosts, rivals, super_resolution, traced_ghosts,
    transmitters_in_turn,
};
use crate::study::pages::whole_runs::{
    classifier, detection, predictions, table_2, tracking, traffic, vehicles,
};
use crate::study::pages::{Part, deployment, force, fuzz, planner, real_captures, same_bytes, sensitivity};
use crate::study::search;
use crate::study::sources::{self, Places};
use wayside::host::failure::Failure;
use wayside::host::files;
use wayside::host::progress::Work;
use wayside::program::terminal;
use wayside::program::values::Shard;

/// A study, which makes figures of a page.
pub(crate) struct Study {
    /// Name of the study as typed.
    pub(crate) name: &'static str,
    /// Path of the page, relative to the project's root.
    pub(crate) page: &'static str,
    /// Approximate duration on two cores.
    takes: &'static str,
    sources: Places,
    make: Make,
}

enum Make {
    /// A part of its page.
    Part(MakePart),
    /// A part of its page whose rows are kept: all of them, the kept ones, and a share of them.
    Rows { all: MakePart, kept: MakePart, share: MakeRows },
    /// A page, with a table and pictures.
    Whole(fn(&StudyArguments) -> Result<(), Failure>),
    /// A row of a ledger on its page.
    Ledger,
}

/// Studies in the order of `docs/validation/README.md`, then those with pictures.
pub(crate) const STUDIES: [Study; 42] = [
    part("reference-gates", "docs/validation/reference-gates.md", "2 minutes", gates::SOURCES, gates::part),
    part("bart-against-references", REFERENCES, "6 minutes", references::SOURCES, references::own_car),
    part("real-car", REFERENCES, "an hour", references::SOURCES, references::real_car),
    part("second-real-car", REFERENCES, "an hour", references::SOURCES, references::second_real_car),
    part("published-levels", LEVELS_PAGE, "half an hour", published_levels::SOURCES, published_levels::part),
    part("wheels", "docs/validation/wheels.md", "5 minutes", wheels::SOURCES, wheels::part),
    part(
        "continuity",
        "docs/validation/continuity.md",
        "half an hour",
        continuity::SOURCES,
        continuity::part,
    ),
    part(
        "random-cases",
        ERRORS,
        "half an hour",
        estimates_of_errors::SOURCES,
        estimates_of_errors::of_aspects,
    ),
    part("random-tables", ERRORS, "an hour", estimates_of_errors::SOURCES, estimates_of_errors::of_tables),
    part("random-frames", ERRORS, "an hour", estimates_of_errors::SOURCES, estimates_of_errors::of_frames),
    part("random-roads", ERRORS, "half an hour", estimates_of_errors::SOURCES, estimates_of_errors::of_roads),
    whole("levels", "docs/validation/levels-of-detail.md", "10 minutes", LEVELS, drawn::levels),
    part(
        "sensitivity",
        "docs/validation/sensitivity.md",
        "15 minutes",
        sensitivity::SOURCES,
        sensitivity::part,
    ),
    Study {
        name: "planner",
        page: "docs/validation/planner.md",
        takes: "a day",
        sources: planner::SOURCES,
        make: Make::Rows { all: planner::part, kept: planner::part_of_kept, share: planner::rows },
    },
    part("table-2", "docs/validation/table-2.md", "10 seconds", table_2::SOURCES, table_2::part),
    part("detection", "docs/validation/detection.md", "5 minutes", detection::SOURCES, detection::part),
    part("tracking", "docs/validation/tracking.md", "15 minutes", tracking::SOURCES, tracking::part),
    part("false-alarms", ALARMS, "half an hour", false_alarms::SOURCES, false_alarms::of_complex_samples),
    part("false-alarms-real", ALARMS, "half an hour", false_alarms::SOURCES, false_alarms::of_real_samples),
    part("false-alarms-bands", ALARMS, "a minute", false_alarms::SOURCES, false_alarms::of_narrow_bands),
    part("false-alarms-rivals", ALARMS, "a minute", rivals::SOURCES, rivals::alarms),
    Study {
        name: "predictions",
        page: "docs/validation/predictions.md",
        takes: "an hour",
        sources: predictions::SOURCES,
        make: Make::Rows {
            all: predictions::part,
            kept: predictions::part_of_kept,
            share: predictions::rows,
        },
    },
    part("rivals", "docs/validation/rivals.md", "a minute", rivals::SOURCES, rivals::part),
    part("estimates", "docs/validation/estimates.md", "10 minutes", estimates::SOURCES, estimates::part),
    part(
        "calibration",
        "docs/validation/calibration.md",
        "a minute",
        calibration::SOURCES,
        calibration::part,
    ),
    part(
        "super-resolution",
        "docs/validation/super-resolution.md",
        "a minute",
        super_resolution::SOURCES,
        super_resolution::part,
    ),
    part("ambiguity", "docs/validation/ambiguity.md", "3 minutes", ambiguity::SOURCES, ambiguity::part),
    part(
        "transmitters-in-turn",
        IN_TURN,
        "3 minutes",
        transmitters_in_turn::SOURCES,
        transmitters_in_turn::part,
    ),
    part("ghosts", "docs/validation/ghosts.md", "2 minutes", ghosts::SOURCES, ghosts::part),
    part(
        "traced-ghosts",
        "docs/validation/ghosts.md",
        "10 minutes",
        traced_ghosts::SOURCES,
        traced_ghosts::part,
    ),
    part("same-bytes", "docs/validation/same-bytes.md", "10 minutes", same_bytes::SOURCES, same_bytes::part),
    part(
        "real-captures",
        "docs/validation/real-captures.md",
        "a second",
        real_captures::SOURCES,
        real_captures::part,
    ),
    part("deployment", "docs/validation/deployment.md", "15 minutes", deployment::SOURCES, deployment::part),
    part("traffic", "docs/validation/traffic.md", "10 minutes", traffic::SOURCES, traffic::part),
    part("vehicles", "docs/validation/vehicles.md", "2 minutes", vehicles::SOURCES, vehicles::part),
    part("fuzz", "docs/validation/fuzz.md", "a second", fuzz::SOURCES, fuzz::part),
    part("force", "docs/validation/force.md", "5 minutes", force::SOURCES, force::part),
    part("classifier", NETWORK, "a second", classifier::SOURCES, classifier::part),
    part("classifier-scenes", NETWORK, "a minute", classifier::SOURCES_OF_SCENES, classifier::part_of_scenes),
    whole("chart", "docs/chart.md", "half an hour", CHART, whole_chart),
    whole("atlas", "docs/atlas.md", "10 minutes", ATLAS, whole_atlas),
    Study { name: "search", page: SEARCH, takes: "as asked", sources: search::SOURCES, make: Make::Ledger },
];

// Pages with parts of several studies, or with long names.
const REFERENCES: &str = "docs/validation/bart-against-references.md";
const LEVELS_PAGE: &str = "docs/validation/published-levels.md";
const ERRORS: &str = "docs/validation/error-estimates.md";
const ALARMS: &str = "docs/validation/false-alarms.md";
pub(super) const SEARCH: &str = "docs/validation/random-search.md";
const IN_TURN: &str = "docs/validation/transmitters-in-turn.md";
const NETWORK: &str = "docs/validation/classifier.md";

type MakeRows = fn(Extent, Shard) -> Result<(), Failure>;
type MakePart = fn(Extent) -> Result<Part, Failure>;
type MakeWhole = fn(&StudyArguments) -> Result<(), Failure>;

const fn part(
    name: &'static str,
    page: &'static str,
    takes: &'static str,
    sources: Places,
    make: MakePart,
) -> Study {
    Study { name, page, takes, sources, make: Make::Part(make) }
}

const fn whole(
    name: &'static str,
    page: &'static str,
    takes: &'static str,
    sources: Places,
    make: MakeWhole,
) -> Study {
    Study { name, page, takes, sources, make: Make::Whole(make) }
}

/// The chart with all its parts.
fn whole_chart(of_all: &StudyArguments) -> Result<(), Failure> {
    drawn::chart(&ChartArguments { of_all: of_all.clone(), against: None, only: None })
}

/// The atlas with all its cases.
fn whole_atlas(of_all: &StudyArguments) -> Result<(), Failure> {
    drawn::atlas(&AtlasArguments { of_all: of_all.clone(), only: None })
}

/// The study with this name.
pub(crate) fn by_name(name: &str) -> Option<&'static Study> {
    STUDIES.iter().find(|study| study.name == name)
}

/// Makes a study's output, or lists all studies.
pub(crate) fn run(arguments: &PageArguments) -> Result<(), Failure> {
    let Some(name) = &arguments.name else { return list() };
    let unknown =
        || Failure::Refused(format!("there is no study `{name}`; `cargo xtask study` tells of all"));
    let study = by_name(name).ok_or_else(unknown)?;
    let keeps_none = |word: &str| {
        Err(Failure::Refused(format!("{word}: `{name}` keeps no rows; `planner` and `predictions` do")))
    };
    match (&study.make, arguments.shard) {
        (Make::Rows { share, .. }, Some(shard)) => share(extent(arguments), shard),
        (Make::Rows { kept, .. }, None) if arguments.kept => study.make_part(*kept, arguments),
        (_, Some(_)) => keeps_none("--shard"),
        (_, None) if arguments.kept => keeps_none("--kept"),
        (make, None) => study.make(make, arguments),
    }
}

/// Refuses figures on a page of docs/ that differ from those that its study makes now.
///
/// # Errors
/// The first line that differs, and the new one; a refusal of the study itself.
pub(crate) fn compare(name: &str) -> Result<(), Failure> {
    let refused = |rule: String| Failure::Refused(format!("{name}: {rule}"));
    let study = by_name(name).ok_or_else(|| refused("there is no such study".into()))?;
    let Make::Part(make) = study.make else { return Err(refused("makes no part of a page".into())) };
    let (made, complaint) = make(Extent::Full)?.finished();
    let place = project_root().join(study.page);
    let page = std::fs::read_to_string(&place).map_err(|e| Failure::system(&place, "read", e))?;
    let told = part_of(&page, name).ok_or_else(|| refused(format!("{} has no part for it", study.page)))?;
    let differs = difference(told, &made).map(|differs| format!("{}: {differs}", study.page));
    differs.or(complaint).map_or(Ok(()), |rule| Err(refused(rule)))
}

fn extent(arguments: &PageArguments) -> Extent {
    if arguments.quick { Extent::Quick } else { Extent::Full }
}

fn list() -> Result<(), Failure> {
    let line = |name, page, takes, age| terminal::line(format!("{name:<25}{page:<45}{takes:<15}{age}"));
    line("cargo xtask study …", "page", "takes about", "is");
    for study in &STUDIES {
        line(study.name, study.page, study.takes, study.age()?.words());
    }
    Ok(())
}

impl Study {
    /// Age of the study's part of its page, relative to its sources.
    pub(crate) fn age(&self) -> Result<Age, Failure> {
        let page = std::fs::read_to_string(project_root().join(self.page)).unwrap_or_default();
        Ok(Age::of(&page, self.name, &sources::hash(self.sources)?))
    }

    /// Makes the study's output.
    fn make(&self, make: &Make, arguments: &PageArguments) -> Result<(), Failure> {
        match make {
            Make::Ledger => self.enter_search(arguments),
            Make::Part(make) | Make::Rows { all: make, .. } => self.make_part(*make, arguments),
            Make::Whole(make) => make(&StudyArguments {
                quick: arguments.quick,
                out: arguments.out.clone(),
                docs: !arguments.quick && arguments.out.is_none(),
                table: None,
            }),
        }
    }

    /// Searches, and appends the finds to those of earlier searches.
    fn enter_search(&self, arguments: &PageArguments) -> Result<(), Failure> {
        let place = project_root().join(self.page);
        let seed = arguments.seed.unwrap_or(1);
        let until = match (arguments.quick, arguments.minutes) {
            (true, _) => search::Until::Cases(2),
            (false, minutes) => search::Until::ProcessorSeconds(60.0 * minutes.unwrap_or(2.0)),
        };
        let hash = sources::hash(self.sources)?;
        let _work = Work::begin(self.name);
        let rows = search::rows(seed, &search::searched(seed, until)?);
        terminal::lines(rows.trim());
        if arguments.quick && arguments.out.is_none() {
            return Ok(());
        }
        // Read after the search, because another search may have added its rows meanwhile.
        let page = std::fs::read_to_string(&place).map_err(|e| Failure::system(&place, "read", e))?;
        let missing = || Failure::Refused(format!("{}: has no part for `{}`", self.page, self.name));
        let earlier = part_of(&page, self.name).ok_or_else(missing)?;
        let page =
            with_part(&page, self.name, &hash, &search::entered(earlier, &rows)).ok_or_else(missing)?;
        files::write_file(arguments.out.as_ref().unwrap_or(&place), page.as_bytes())
    }

    /// Writes the part into its page; with fewer cases only if another place than `docs/` is given.
    fn make_part(&self, make: MakePart, arguments: &PageArguments) -> Result<(), Failure> {
        let place = project_root().join(self.page);
        let extent = extent(arguments);
        // Hashed before the work, so that it identifies the sources even if they change meanwhile.
        let hash = if arguments.quick { FEWER.to_owned() } else { sources::hash(self.sources)? };
        let _work = Work::begin(self.name);
        let (text, complaint) = make(extent)?.finished();
        let out = arguments.out.clone().or_else(|| (!arguments.quick).then(|| place.clone()));
        if let Some(out) = out {
            let page = std::fs::read_to_string(&place).map_err(|e| Failure::system(&place, "read", e))?;
            let page = with_part(&page, self.name, &hash, &text)
                .ok_or_else(|| Failure::Refused(format!("{}: has no part for `{}`", self.page, self.name)))?;
            files::write_file(&out, page.as_bytes())?;
        }
        complaint.map_or(Ok(()), |sentence| Err(Failure::Refused(format!("{}: {sentence}", self.name))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_rows_and_shares_of_rows_are_refused_by_name_where_none_are_kept() {
        let shard = Some(Shard { number: 1, of: 2 });
        for (word, quick, shard, kept) in [("--shard", true, shard, false), ("--kept", false, None, true)] {
            let name = Some("wheels".to_owned());
            let asked = PageArguments { name, quick, out: None, shard, kept, minutes: None, seed: None };
            let refused = run(&asked).unwrap_err().to_string();
            assert!(refused.contains(word) && refused.contains("`wheels` keeps no rows"), "{refused}");
        }
    }

    #[test]
    fn every_study_has_a_name_of_its_own_and_sources_that_are_there() {
        for (index, study) in STUDIES.iter().enumerate() {
            assert!(STUDIES[..index].iter().all(|other| other.name != study.name), "{}", study.name);
            assert_ne!(study.age().unwrap(), Age::Missing, "{}", study.name);
        }
    }
}
