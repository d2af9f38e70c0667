//! `chart`, `atlas` and `levels`: speed against accuracy, where each method fails, and levels of detail; each a table,
//! a picture and a page.

mod looks;
mod bodies;
mod closed_forms;
mod scenes;
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
        picture: chart::picture(&rows),
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
        picture: atlas::picture(&rows),
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
        picture: levels::picture(&rows),
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
    picture: Svg,
}

impl Study {
    fn write(&self, arguments: &StudyArguments) -> Result<(), Failure> {
        let folder = arguments.out.clone().unwrap_or_else(|| PathBuf::from("out").join(self.name));
        let named = |kind: &str| folder.join(format!("{}.{kind}", self.name));
        output::write_file(&named("csv"), self.csv.as_bytes())?;
        output::write_file(&named("svg"), self.picture.text().as_bytes())?;
        write_png(&named("png"), &self.picture)?;
        output::line(&self.page);
        if arguments.docs { self.write_docs(&project_root().join("docs")) } else { Ok(()) }
    }

    fn write_docs(&self, docs: &Path) -> Result<(), Failure> {
        let page = docs.join(self.page_in).join(format!("{}.md", self.name));
        output::write_file(&page, self.page.as_bytes())?;
        output::write_file(&docs.join("pictures").join(format!("{}.svg", self.name)), self.picture.text().as_bytes())
    }
}
