//! All studies: their outputs, their durations, and the age of the outputs relative to the code.

use crate::cli::{AtlasArguments, ChartArguments, PageArguments, StudyArguments};
use crate::project::project_root;
use crate::study::extent::Extent;
use crate::study::page::{Freshness, UNKNOWN_SOURCES, difference, part_of, with_part};
use crate::study::pages::scattering::{
    continuity, error_estimates, gates, published_levels, references, wheels,
};
use crate::study::pages::signals::{
    ambiguity, calibration, estimates, false_alarms, ghosts, rivals, super_resolution, traced_ghosts,
    transmitters_in_turn,
};
use crate::study::pages::whole_runs::{
    classifier, detection, predictions, table_2, tracking, traffic, vehicles,
};
use crate::study::pages::{
    PageSection, deployment, force, fuzz, planner, real_captures, same_bytes, sensitivity,
};
use crate::study::plotted_studies::{self, ATLAS, CHART, LEVELS};
use crate::study::search;
use crate::study::sources::{self, SourcePaths};
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
    sources: SourcePaths,
    make: Make,
}

enum Make {
    /// A part of its page.
    Section(MakeSection),
    /// A part of its page whose rows are kept: all of them, the kept ones, and a share of them.
    Rows { all: MakeSection, kept: MakeSection, share: MakeRows },
    /// A page, with a table and pictures.
    Whole(fn(&StudyArguments) -> Result<(), Failure>),
    /// A row of a ledger on its page.
    Ledger,
}

/// Studies in the order of `docs/validation/README.md`, then those with pictures.
pub(crate) const STUDIES: [Study; 42] = [
    section(
        "reference-gates",
        "docs/validation/reference-gates.md",
        "2 minutes",
        gates::SOURCES,
        gates::section,
    ),
    section("bart-against-references", REFERENCES, "6 minutes", references::SOURCES, references::own_car),
    section("real-car", REFERENCES, "an hour", references::SOURCES, references::real_car),
    section("second-real-car", REFERENCES, "an hour", references::SOURCES, references::second_real_car),
    section(
        "published-levels",
        LEVELS_PAGE,
        "half an hour",
        published_levels::SOURCES,
        published_levels::section,
    ),
    section("wheels", "docs/validation/wheels.md", "5 minutes", wheels::SOURCES, wheels::section),
    section(
        "continuity",
        "docs/validation/continuity.md",
        "half an hour",
        continuity::SOURCES,
        continuity::section,
    ),
    section("random-cases", ERRORS, "half an hour", error_estimates::SOURCES, error_estimates::of_aspects),
    section("random-tables", ERRORS, "an hour", error_estimates::SOURCES, error_estimates::of_tables),
    section("random-frames", ERRORS, "an hour", error_estimates::SOURCES, error_estimates::of_frames),
    section("random-roads", ERRORS, "half an hour", error_estimates::SOURCES, error_estimates::of_roads),
    whole("levels", "docs/validation/levels-of-detail.md", "10 minutes", LEVELS, plotted_studies::levels),
    section(
        "sensitivity",
        "docs/validation/sensitivity.md",
        "15 minutes",
        sensitivity::SOURCES,
        sensitivity::section,
    ),
    Study {
        name: "planner",
        page: "docs/validation/planner.md",
        takes: "a day",
        sources: planner::SOURCES,
        make: Make::Rows { all: planner::section, kept: planner::section_from_cache, share: planner::rows },
    },
    section("table-2", "docs/validation/table-2.md", "10 seconds", table_2::SOURCES, table_2::section),
    section("detection", "docs/validation/detection.md", "5 minutes", detection::SOURCES, detection::section),
    section("tracking", "docs/validation/tracking.md", "15 minutes", tracking::SOURCES, tracking::section),
    section("false-alarms", ALARMS, "half an hour", false_alarms::SOURCES, false_alarms::of_complex_samples),
    section(
        "false-alarms-real",
        ALARMS,
        "half an hour",
        false_alarms::SOURCES,
        false_alarms::of_real_samples,
    ),
    section("false-alarms-bands", ALARMS, "a minute", false_alarms::SOURCES, false_alarms::of_narrow_bands),
    section("false-alarms-rivals", ALARMS, "a minute", rivals::SOURCES, rivals::alarms),
    Study {
        name: "predictions",
        page: "docs/validation/predictions.md",
        takes: "an hour",
        sources: predictions::SOURCES,
        make: Make::Rows {
            all: predictions::section,
            kept: predictions::section_from_cache,
            share: predictions::rows,
        },
    },
    section("rivals", "docs/validation/rivals.md", "a minute", rivals::SOURCES, rivals::section),
    section(
        "estimates",
        "docs/validation/estimates.md",
        "10 minutes",
        estimates::SOURCES,
        estimates::section,
    ),
    section(
        "calibration",
        "docs/validation/calibration.md",
        "a minute",
        calibration::SOURCES,
        calibration::section,
    ),
    section(
        "super-resolution",
        "docs/validation/super-resolution.md",
        "a minute",
        super_resolution::SOURCES,
        super_resolution::section,
    ),
    section("ambiguity", "docs/validation/ambiguity.md", "3 minutes", ambiguity::SOURCES, ambiguity::section),
    section(
        "transmitters-in-turn",
        IN_TURN,
        "3 minutes",
        transmitters_in_turn::SOURCES,
        transmitters_in_turn::section,
    ),
    section("ghosts", "docs/validation/ghosts.md", "2 minutes", ghosts::SOURCES, ghosts::section),
    section(
        "traced-ghosts",
        "docs/validation/ghosts.md",
        "10 minutes",
        traced_ghosts::SOURCES,
        traced_ghosts::section,
    ),
    section(
        "same-bytes",
        "docs/validation/same-bytes.md",
        "10 minutes",
        same_bytes::SOURCES,
        same_bytes::section,
    ),
    section(
        "real-captures",
        "docs/validation/real-captures.md",
        "a second",
        real_captures::SOURCES,
        real_captures::section,
    ),
    section(
        "deployment",
        "docs/validation/deployment.md",
        "15 minutes",
        deployment::SOURCES,
        deployment::section,
    ),
    section("traffic", "docs/validation/traffic.md", "10 minutes", traffic::SOURCES, traffic::section),
    section("vehicles", "docs/validation/vehicles.md", "2 minutes", vehicles::SOURCES, vehicles::section),
    section("fuzz", "docs/validation/fuzz.md", "a second", fuzz::SOURCES, fuzz::section),
    section("force", "docs/validation/force.md", "5 minutes", force::SOURCES, force::section),
    section("classifier", NETWORK, "a second", classifier::SOURCES, classifier::section),
    section(
        "classifier-scenes",
        NETWORK,
        "a minute",
        classifier::SOURCES_OF_SCENES,
        classifier::scenes_section,
    ),
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
type MakeSection = fn(Extent) -> Result<PageSection, Failure>;
type MakeWhole = fn(&StudyArguments) -> Result<(), Failure>;

const fn section(
    name: &'static str,
    page: &'static str,
    takes: &'static str,
    sources: SourcePaths,
    make: MakeSection,
) -> Study {
    Study { name, page, takes, sources, make: Make::Section(make) }
}

const fn whole(
    name: &'static str,
    page: &'static str,
    takes: &'static str,
    sources: SourcePaths,
    make: MakeWhole,
) -> Study {
    Study { name, page, takes, sources, make: Make::Whole(make) }
}

/// The chart with all its parts.
fn whole_chart(of_all: &StudyArguments) -> Result<(), Failure> {
    plotted_studies::chart(&ChartArguments { of_all: of_all.clone(), against: None, only: None })
}

/// The atlas with all its cases.
fn whole_atlas(of_all: &StudyArguments) -> Result<(), Failure> {
    plotted_studies::atlas(&AtlasArguments { of_all: of_all.clone(), only: None })
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
        (Make::Rows { kept, .. }, None) if arguments.kept => study.write_section(*kept, arguments),
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
    let Make::Section(make) = study.make else { return Err(refused("makes no part of a page".into())) };
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
        line(study.name, study.page, study.takes, study.freshness()?.words());
    }
    Ok(())
}

impl Study {
    /// Freshness of the study's part of its page, relative to its sources.
    pub(crate) fn freshness(&self) -> Result<Freshness, Failure> {
        let page = std::fs::read_to_string(project_root().join(self.page)).unwrap_or_default();
        Ok(Freshness::of(&page, self.name, &sources::hash(self.sources)?))
    }

    /// Makes the study's output.
    fn make(&self, make: &Make, arguments: &PageArguments) -> Result<(), Failure> {
        match make {
            Make::Ledger => self.append_search(arguments),
            Make::Section(make) | Make::Rows { all: make, .. } => self.write_section(*make, arguments),
            Make::Whole(make) => make(&StudyArguments {
                quick: arguments.quick,
                out: arguments.out.clone(),
                docs: !arguments.quick && arguments.out.is_none(),
                table: None,
            }),
        }
    }

    /// Searches, and appends the finds to those of earlier searches.
    fn append_search(&self, arguments: &PageArguments) -> Result<(), Failure> {
        let place = project_root().join(self.page);
        let seed = arguments.seed.unwrap_or(1);
        let until = match (arguments.quick, arguments.minutes) {
            (true, _) => search::StopCondition::Cases(2),
            (false, minutes) => search::StopCondition::ProcessorSeconds(60.0 * minutes.unwrap_or(2.0)),
        };
        let hash = sources::hash(self.sources)?;
        let _work = Work::begin(self.name);
        let word = arguments.contest.as_deref().unwrap_or_default();
        let rows = search::rows(seed, &search::search(seed, until, word)?);
        terminal::lines(rows.trim());
        if arguments.quick && arguments.out.is_none() {
            return Ok(());
        }
        // Read after the search, because another search may have added its rows meanwhile.
        let page = std::fs::read_to_string(&place).map_err(|e| Failure::system(&place, "read", e))?;
        let missing = || Failure::Refused(format!("{}: has no part for `{}`", self.page, self.name));
        let earlier = part_of(&page, self.name).ok_or_else(missing)?;
        let page =
            with_part(&page, self.name, &hash, &search::append_rows(earlier, &rows)).ok_or_else(missing)?;
        files::write_file(arguments.out.as_ref().unwrap_or(&place), page.as_bytes())
    }

    /// Writes the part into its page; with fewer cases only if another place than `docs/` is given.
    fn write_section(&self, make: MakeSection, arguments: &PageArguments) -> Result<(), Failure> {
        let place = project_root().join(self.page);
        let extent = extent(arguments);
        // Hashed before the work, so that it identifies the sources even if they change meanwhile.
        let hash = if arguments.quick { UNKNOWN_SOURCES.to_owned() } else { sources::hash(self.sources)? };
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
            let asked = PageArguments { name, quick, shard, kept, ..PageArguments::default() };
            let refused = run(&asked).unwrap_err().to_string();
            assert!(refused.contains(word) && refused.contains("`wheels` keeps no rows"), "{refused}");
        }
    }

    #[test]
    fn every_study_has_a_name_of_its_own_and_sources_that_are_there() {
        for (index, study) in STUDIES.iter().enumerate() {
            assert!(STUDIES[..index].iter().all(|other| other.name != study.name), "{}", study.name);
            assert_ne!(study.freshness().unwrap(), Freshness::Missing, "{}", study.name);
        }
    }
}
