//! `chart`, `atlas` and `levels`: speed against accuracy, where each method fails, and levels of detail; each
//! a table, a picture and a page.

mod extent;
mod looks;
mod bodies;
mod closed_forms;
pub(crate) mod scenes;
mod table;
mod chart;
mod atlas;
mod levels;

use crate::cli::StudyArguments;
use crate::project::project_root;
use extent::Extent;
use plotting::svg::Svg;
use std::path::{Path, PathBuf};
use table::Table;
use wayside::host::failure::Failure;
use wayside::host::files;
use wayside::pictures::write_png;
use wayside::program::terminal;

/// Seconds against error, method by method.
pub(crate) fn chart(arguments: &StudyArguments) -> Result<(), Failure> {
    let draw = |table: &Table| {
        vec![("chart", chart::picture(table)), ("chart-frames", chart::picture_of_frames(table))]
    };
    let drawing = Drawing { name: "chart", columns: &chart::COLUMNS, draw: &draw };
    if let Some(file) = &arguments.table {
        return drawing.again(file, arguments);
    }
    let extent = if arguments.quick { Extent::Quick } else { Extent::Full };
    let rows = chart::rows(extent)?;
    drawing.study("", chart::csv(&rows), chart::page(&rows, extent))?.write(arguments)
}

/// Cases and verdicts; ends with exit code 1 if the program was wrong and did not say so.
pub(crate) fn atlas(arguments: &StudyArguments) -> Result<(), Failure> {
    let draw = |table: &Table| vec![("atlas", atlas::picture(table))];
    let drawing = Drawing { name: "atlas", columns: &atlas::COLUMNS, draw: &draw };
    if let Some(file) = &arguments.table {
        return drawing.again(file, arguments);
    }
    let extent = if arguments.quick { Extent::Quick } else { Extent::Full };
    let rows = atlas::rows(extent)?;
    drawing.study("", atlas::csv(&rows), atlas::page(&rows, extent))?.write(arguments)?;
    match atlas::count(&rows, atlas::Verdict::Wrong) {
        0 => Ok(()),
        wrong => Err(Failure::Refused(format!("{wrong} cases are wrong and the program does not say so"))),
    }
}

/// Levels of detail: error, seconds, which was taken.
pub(crate) fn levels(arguments: &StudyArguments) -> Result<(), Failure> {
    let draw = |table: &Table| vec![("levels-of-detail", levels::picture(table))];
    let drawing = Drawing { name: "levels-of-detail", columns: &levels::COLUMNS, draw: &draw };
    if let Some(file) = &arguments.table {
        return drawing.again(file, arguments);
    }
    let extent = if arguments.quick { Extent::Quick } else { Extent::Full };
    let rows = levels::rows(extent)?;
    drawing.study("validation", levels::csv(&rows), levels::page(&rows, extent))?.write(arguments)
}

/// How a study's table becomes pictures.
struct Drawing<'d> {
    name: &'static str,
    columns: &'d [&'static str],
    draw: &'d dyn Fn(&Table) -> Vec<(&'static str, Svg)>,
}

impl Drawing<'_> {
    /// The whole study; its pictures are those of its table, as they would be drawn from it again.
    fn study(&self, page_in: &'static str, csv: String, page: String) -> Result<Study, Failure> {
        let table = Table::read(&csv, self.columns).map_err(Failure::refused)?;
        Ok(Study { name: self.name, page_in, csv, page, pictures: (self.draw)(&table) })
    }

    /// The pictures of an earlier table.
    fn again(&self, file: &Path, arguments: &StudyArguments) -> Result<(), Failure> {
        let text = std::fs::read_to_string(file).map_err(|e| Failure::system(file, "read", e))?;
        let refused = |error| Failure::Refused(format!("{}: {error}", file.display()));
        let table = Table::read(&text, self.columns).map_err(refused)?;
        let pictures = (self.draw)(&table);
        write_pictures(&pictures, &folder(arguments, self.name))?;
        if arguments.docs { write_docs_pictures(&pictures, &project_root().join("docs")) } else { Ok(()) }
    }
}

/// What a study leaves.
struct Study {
    name: &'static str,
    /// Folder of the page within docs/.
    page_in: &'static str,
    csv: String,
    page: String,
    /// With their names.
    pictures: Vec<(&'static str, Svg)>,
}

impl Study {
    fn write(&self, arguments: &StudyArguments) -> Result<(), Failure> {
        let folder = folder(arguments, self.name);
        files::write_file(&folder.join(format!("{}.csv", self.name)), self.csv.as_bytes())?;
        write_pictures(&self.pictures, &folder)?;
        terminal::line(&self.page);
        if arguments.docs { self.write_docs(&project_root().join("docs")) } else { Ok(()) }
    }

    fn write_docs(&self, docs: &Path) -> Result<(), Failure> {
        let page = docs.join(self.page_in).join(format!("{}.md", self.name));
        files::write_file(&page, self.page.as_bytes())?;
        files::write_file(&docs.join("pictures").join(format!("{}.csv", self.name)), self.csv.as_bytes())?;
        write_docs_pictures(&self.pictures, docs)
    }
}

fn folder(arguments: &StudyArguments, name: &str) -> PathBuf {
    arguments.out.clone().unwrap_or_else(|| PathBuf::from("out").join(name))
}

fn write_pictures(pictures: &[(&'static str, Svg)], folder: &Path) -> Result<(), Failure> {
    for (name, picture) in pictures {
        files::write_file(&folder.join(format!("{name}.svg")), picture.text().as_bytes())?;
        write_png(&folder.join(format!("{name}.png")), picture)?;
    }
    Ok(())
}

fn write_docs_pictures(pictures: &[(&'static str, Svg)], docs: &Path) -> Result<(), Failure> {
    for (name, picture) in pictures {
        let place = docs.join("pictures").join(format!("{name}.svg"));
        files::write_file(&place, picture.text().as_bytes())?;
    }
    Ok(())
}
