//! Speed against accuracy: every method on the same work, its seconds, its memory and its error against
//! another method.

mod row;
mod work;
mod scattering;
mod echo;
mod both_ways;
mod answers;
mod presentation;
mod pictures;

pub(super) use pictures::{COLUMNS, picture, picture_of_answers, picture_of_frames};
pub(super) use presentation::{answers_csv, csv, page};

use crate::study::extent::Extent;
use answers::Answers;
use row::SettingRow;
use wayside::host::failure::Failure;
use wayside::host::progress::Work;
use work::Subject;

/// Rows of methods, and answers of the whole chain.
pub(super) struct Chart {
    pub(super) rows: Vec<SettingRow>,
    pub(super) answers: Vec<Answers>,
}

/// One method's rows over a subject.
type MethodRows = fn(&Subject) -> Result<Vec<SettingRow>, Failure>;

/// Measures all of it.
pub(super) fn measured(extent: Extent) -> Result<Chart, Failure> {
    Ok(Chart { rows: rows(extent)?, answers: answers::rows(extent)? })
}

/// Every row, method by method.
fn rows(extent: Extent) -> Result<Vec<SettingRow>, Failure> {
    const PARTS: [MethodRows; 5] =
        [scattering::first_order, scattering::by_order, echo::paths, echo::tables, echo::synthesis];
    let work = Work::begin("chart");
    let subject = Subject::of(extent)?;
    let mut all = Vec::new();
    for (number, part) in PARTS.iter().enumerate() {
        work.at(number, PARTS.len() + 1);
        all.extend(part(&subject)?);
    }
    work.at(PARTS.len(), PARTS.len() + 1);
    all.extend(both_ways::rows()?);
    Ok(all)
}
