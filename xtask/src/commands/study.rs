//! `chart`, `atlas` and `levels`: speed against accuracy, where each method fails, and levels of detail; each a table,
//! a picture and a page.

mod looks;
mod bodies;
mod closed_forms;
pub(crate) mod scenes;
mod table;
mod chart;
mod atlas;
mod levels;

use crate::cache::project_root;
use crate::cli::StudyArguments;
use crate::failure::Failure;
use crate::output;
use crate::pictures::{Svg, write_png};
use std::path::{Path, PathBuf};

/// Seconds against error, method by method.
pub(crate) fn chart(arguments: &StudyArguments) -> Result<(), Failure> {
    let extent = if arguments.quick { chart::Extent::Quick } else { chart::Extent::Full };
    let rows = chart::rows(extent)?;
    let study = Study {
        name: "chart",
        page_in: "",
        csv: chart::csv(&rows),
        page: chart::page(&rows, extent),
        pictures: vec![("chart", chart::picture(&rows)), ("chart-frames", chart::picture_of_frames(&rows))],
    };
    study.write(arguments)
}

/// Cases and verdicts; ends with exit code 1 if the program was wrong and did not say so.
pub(crate) fn atlas(arguments: &StudyArguments) -> Result<(), Failure> {
    let extent = if arguments.quick { atlas::Extent::Quick } else { atlas::Extent::Full };
    let rows = atlas::rows(extent)?;
    let study = Study {
        name: "atlas",
        page_in: "",
        csv: atlas::csv(&rows),
        page: atlas::page(&rows, extent),
        pictures: vec![("atlas", atlas::picture(&rows))],
    };
    study.write(arguments)?;
    match atlas::count(&rows, atlas::Verdict::Wrong) {
        0 => Ok(()),
        wrong => Err(Failure::Refused(format!("{wrong} cases are wrong and the program does not say so"))),
    }
}

/// Levels of detail: error, seconds, which was taken.
pub(crate) fn levels(arguments: &StudyArguments) -> Result<(), Failure> {
    let extent = if arguments.quick { levels::Extent::Quick } else { levels::Extent::Full };
    let rows = levels::rows(extent)?;
    let study = Study {
        name: "levels-of-detail",
        page_in: "validation",
        csv: levels::csv(&rows),
        page: levels::page(&rows, extent),
        pictures: vec![("levels-of-detail", levels::picture(&rows))],
    };
    study.write(arguments)
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
        let folder = arguments.out.clone().unwrap_or_else(|| PathBuf::from("out").join(self.name));
        let named = |name: &str, kind: &str| folder.join(format!("{name}.{kind}"));
        output::write_file(&named(self.name, "csv"), self.csv.as_bytes())?;
        for (name, picture) in &self.pictures {
            output::write_file(&named(name, "svg"), picture.text().as_bytes())?;
            write_png(&named(name, "png"), picture)?;
        }
        output::line(&self.page);
        if arguments.docs { self.write_docs(&project_root().join("docs")) } else { Ok(()) }
    }

    fn write_docs(&self, docs: &Path) -> Result<(), Failure> {
        let page = docs.join(self.page_in).join(format!("{}.md", self.name));
        output::write_file(&page, self.page.as_bytes())?;
        for (name, picture) in &self.pictures {
            let place = docs.join("pictures").join(format!("{name}.svg"));
            output::write_file(&place, picture.text().as_bytes())?;
        }
        Ok(())
    }
}
