//! Speed against accuracy: every method on the same work, its seconds, its memory and its error against another method.

mod work;
mod scattering;
mod echo;
mod both_ways;
mod presentation;
mod pictures;

pub(super) use pictures::{COLUMNS, picture, picture_of_frames};
pub(super) use presentation::{csv, page};

use wayside::host::failure::Failure;
use wayside::host::progress::Work;
use work::Subject;

/// How much is tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Extent {
    /// A corner with a cube in front of it.
    Quick,
    /// The project's car.
    Full,
}

/// One setting of one method on one piece of work.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub(super) stage: &'static str,
    pub(super) scene: String,
    pub(super) method: &'static str,
    pub(super) setting: String,
    pub(super) seconds: f64,
    /// Largest resident size of the program while this ran, MiB.
    pub(super) peak_mib: Option<f64>,
    /// Relative amplitude.
    pub(super) error: f64,
    /// What the error is against.
    pub(super) reference: String,
}

/// One method's rows over a subject.
type Part = fn(&Subject) -> Result<Vec<Row>, Failure>;

/// Every row, method by method.
pub(super) fn rows(extent: Extent) -> Result<Vec<Row>, Failure> {
    const PARTS: [Part; 5] =
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
