//! `chart`, `atlas` and `levels`: speed against accuracy, failures of each method, and levels of detail; each
//! a table, pictures and a whole page.

use crate::cli::{AtlasArguments, ChartArguments, StudyArguments};
use crate::project::{project_root, read_text};
use crate::study::extent::Extent;
use crate::study::page::{UNKNOWN_SOURCES, made_by};
use crate::study::sources::{self, SourcePaths};
use crate::study::table::Table;
use crate::study::{atlas, chart, levels};
use plotting::svg::Svg;
use std::path::{Path, PathBuf};
use wayside::host::failure::Failure;
use wayside::host::files;
use wayside::pictures::write_png;
use wayside::program::{interrupt, terminal};

/// Sources that the figures of each such study depend on.
pub(super) const CHART: SourcePaths =
    &[CHART_ROWS[0], CHART_ROWS[1], CHART_ROWS[2], CHART_ROWS[3], CHART_PAGE];
/// Sources of the chart's rows, without those that draw them.
const CHART_ROWS: SourcePaths = &[
    sources::CHAIN,
    SHARED,
    &["crates/po-sbr", "crates/classifier", "xtask/src/bench/cases"],
    &[
        "xtask/src/study/chart/answers.rs",
        "xtask/src/study/chart/frames.rs",
        "xtask/src/study/chart/receiver.rs",
        "xtask/src/study/chart/scattering.rs",
        "xtask/src/study/chart/scenes.rs",
        "xtask/src/study/chart/subjects.rs",
        "xtask/src/study/chart/synthesis.rs",
        "xtask/src/study/chart/cost.rs",
    ],
];
const CHART_PAGE: &[&str] = &["xtask/src/study/chart", "xtask/src/study/chart.rs"];
pub(super) const ATLAS: SourcePaths =
    &[sources::CHAIN, SHARED, &["xtask/src/study/atlas", "crates/po-sbr", "crates/classifier"]];
pub(super) const LEVELS: SourcePaths =
    &[sources::CHAIN, SHARED, &["xtask/src/study/levels.rs", "xtask/src/study/levels"]];
const SHARED: &[&str] = &[
    "xtask/src/study/bodies.rs",
    "xtask/src/study/closed_forms.rs",
    "xtask/src/study/rcs_solvers.rs",
    "xtask/src/study/scenes.rs",
];

/// Makes the chart: seconds against error, method by method.
pub(crate) fn chart(
    ChartArguments { of_all: arguments, against, only }: &ChartArguments,
) -> Result<(), Failure> {
    let plot = TablePlot { name: "chart", sources: CHART, columns: &chart::COLUMNS, draw: &chart::pictures };
    let before = against.as_deref().map(|file| plot.table(file)).transpose()?;
    let now = if let Some(file) = &arguments.table {
        redraw_answers(file, arguments)?;
        plot.redraw(file, arguments)?
    } else {
        let extent = if arguments.quick { Extent::Quick } else { Extent::Full };
        interrupt::declare_saved("rows");
        let request = chart::ChartRequest { extent, only: only.as_deref() };
        let measured = chart::measure(&request, &sources::hash(CHART_ROWS)?)?;
        let mut study = plot.study("", chart::tables(&measured), chart::page(&measured, extent))?;
        let text = study.tables.iter().find(|(name, _)| *name == ANSWERS.name).map_or("", |(_, text)| text);
        let answers = Table::read(text, ANSWERS.columns).map_err(Failure::refused)?;
        study.pictures.extend((ANSWERS.draw)(&answers));
        let is_whole = extent == Extent::Full && only.is_none();
        study.write("chart", arguments, if is_whole { Coverage::AllCases } else { Coverage::FewerCases })?;
        study.table
    };
    before.iter().flat_map(|before| chart::changes(before, &now)).for_each(terminal::line);
    Ok(())
}

/// Results of whole runs, a table beside the chart's own.
const ANSWERS: TablePlot = TablePlot {
    name: "chart-answers",
    sources: CHART,
    columns: &chart::COLUMNS_OF_ANSWERS,
    draw: &|table| vec![("chart-answers", chart::picture_of_answers(table))],
};

/// The picture of the results beside an earlier table of the chart, if present.
fn redraw_answers(chart: &Path, arguments: &StudyArguments) -> Result<(), Failure> {
    let file = chart.with_file_name(format!("{}.csv", ANSWERS.name));
    if !file.exists() {
        return Ok(());
    }
    let arguments = StudyArguments { out: Some(folder(arguments, "chart")), ..arguments.clone() };
    ANSWERS.redraw(&file, &arguments).map(drop)
}

/// Makes the atlas; exit code 1 if the program was wrong without a statement of it.
pub(crate) fn atlas(AtlasArguments { of_all: arguments, only }: &AtlasArguments) -> Result<(), Failure> {
    let draw = |table: &Table| vec![("atlas", atlas::picture(table))];
    let plot = TablePlot { name: "atlas", sources: ATLAS, columns: &atlas::COLUMNS, draw: &draw };
    if let Some(file) = &arguments.table {
        return plot.redraw(file, arguments).map(drop);
    }
    let extent = if arguments.quick { Extent::Quick } else { Extent::Full };
    let rows = atlas::rows(extent, only.as_deref())?;
    plot.study("", vec![("atlas", atlas::csv(&rows))], atlas::page(&rows, extent))?.write(
        "atlas",
        arguments,
        Coverage::of(extent),
    )?;
    match atlas::count(&rows, atlas::Verdict::Wrong) {
        0 => Ok(()),
        wrong => Err(Failure::Refused(format!("{wrong} cases are wrong and the program does not say so"))),
    }
}

/// Makes the levels of detail: error, seconds, and the chosen level.
pub(crate) fn levels(arguments: &StudyArguments) -> Result<(), Failure> {
    let draw = |table: &Table| vec![("levels-of-detail", levels::picture(table))];
    let plot =
        TablePlot { name: "levels-of-detail", sources: LEVELS, columns: &levels::COLUMNS, draw: &draw };
    if let Some(file) = &arguments.table {
        return plot.redraw(file, arguments).map(drop);
    }
    let extent = if arguments.quick { Extent::Quick } else { Extent::Full };
    let rows = levels::rows(extent)?;
    let tables = vec![("levels-of-detail", levels::csv(&rows))];
    plot.study("validation", tables, levels::page(&rows, extent))?.write(
        "levels",
        arguments,
        Coverage::of(extent),
    )
}

/// Plot of a study's pictures from its table.
struct TablePlot<'d> {
    name: &'static str,
    sources: SourcePaths,
    columns: &'d [&'static str],
    draw: &'d dyn Fn(&Table) -> Vec<(&'static str, Svg)>,
}

impl TablePlot<'_> {
    /// The whole study, its own table first; its pictures are drawn from that table, as they would be again
    /// later.
    fn study(
        &self,
        page_in: &'static str,
        tables: Vec<(&'static str, String)>,
        page: String,
    ) -> Result<StudyOutput, Failure> {
        let own = tables.first().map_or("", |(_, text)| text);
        let table = Table::read(own, self.columns).map_err(Failure::refused)?;
        let pictures = (self.draw)(&table);
        Ok(StudyOutput { name: self.name, sources: self.sources, page_in, tables, table, page, pictures })
    }

    /// Reads an earlier table.
    fn table(&self, file: &Path) -> Result<Table, Failure> {
        let text = read_text(file)?;
        let refused = |error| Failure::Refused(format!("{}: {error}", file.display()));
        Table::read(&text, self.columns).map_err(refused)
    }

    /// Draws the pictures of an earlier table, and returns it.
    fn redraw(&self, file: &Path, arguments: &StudyArguments) -> Result<Table, Failure> {
        let table = self.table(file)?;
        let pictures = (self.draw)(&table);
        write_pictures(&pictures, &folder(arguments, self.name))?;
        if arguments.docs {
            write_docs_pictures(&pictures, &project_root().join("docs"))?;
        }
        Ok(table)
    }
}

/// Output of a study: table, page and pictures.
struct StudyOutput {
    name: &'static str,
    sources: SourcePaths,
    /// Folder of the page within docs/.
    page_in: &'static str,
    /// Tables by name, the study's own first.
    tables: Vec<(&'static str, String)>,
    /// The first table, parsed.
    table: Table,
    page: String,
    /// Pictures by their names.
    pictures: Vec<(&'static str, Svg)>,
}

/// A page's statement on the sources of its figures.
#[derive(Clone, Copy)]
enum Coverage {
    /// All cases are of them.
    AllCases,
    /// It has fewer cases, and claims no sources.
    FewerCases,
}

impl Coverage {
    fn of(extent: Extent) -> Self {
        if extent == Extent::Quick { Self::FewerCases } else { Self::AllCases }
    }
}

impl StudyOutput {
    fn write(&self, word: &str, arguments: &StudyArguments, coverage: Coverage) -> Result<(), Failure> {
        let folder = folder(arguments, self.name);
        self.write_tables(&folder)?;
        write_pictures(&self.pictures, &folder)?;
        terminal::lines(&self.page);
        if !arguments.docs {
            return Ok(());
        }
        let hash = match coverage {
            Coverage::FewerCases => UNKNOWN_SOURCES.to_owned(),
            Coverage::AllCases => sources::hash(self.sources)?,
        };
        self.write_docs(&made_by(word, &hash), &project_root().join("docs"))
    }

    fn write_tables(&self, folder: &Path) -> Result<(), Failure> {
        let write = |(name, csv): &(&str, String)| {
            files::write_file(&folder.join(format!("{name}.csv")), csv.as_bytes())
        };
        self.tables.iter().try_for_each(write)
    }

    fn write_docs(&self, made_by: &str, docs: &Path) -> Result<(), Failure> {
        let page = docs.join(self.page_in).join(format!("{}.md", self.name));
        files::write_file(&page, format!("{}\n\n{made_by}\n", self.page.trim_end()).as_bytes())?;
        self.write_tables(&docs.join("pictures"))?;
        write_docs_pictures(&self.pictures, docs)
    }
}

fn folder(arguments: &StudyArguments, name: &str) -> PathBuf {
    arguments.out.clone().unwrap_or_else(|| PathBuf::from("out").join(name))
}

fn write_pictures(pictures: &[(&'static str, Svg)], folder: &Path) -> Result<(), Failure> {
    for (name, picture) in pictures {
        files::write_file(&folder.join(format!("{name}.svg")), picture.standalone().as_bytes())?;
        write_png(&folder.join(format!("{name}.png")), picture)?;
    }
    Ok(())
}

fn write_docs_pictures(pictures: &[(&'static str, Svg)], docs: &Path) -> Result<(), Failure> {
    for (name, picture) in pictures {
        let place = docs.join("pictures").join(format!("{name}.svg"));
        files::write_file(&place, picture.standalone().as_bytes())?;
    }
    Ok(())
}
