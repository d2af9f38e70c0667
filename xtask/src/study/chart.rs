//! Speed against accuracy: every method on the same work, with its seconds, its memory and its error relative
//! to another method. Rows are kept, so that an interrupted chart resumes.

mod row;
mod cost;
mod subjects;
mod scenes;
mod scattering;
mod frames;
mod synthesis;
mod receiver;
mod rivals;
mod answers;
mod presentation;
mod pictures;
mod changes;

pub(super) use changes::changes;
pub(super) use pictures::{COLUMNS, COLUMNS_OF_ANSWERS, picture_of_answers, pictures};
pub(super) use presentation::{page, tables};

use crate::study::extent::Extent;
use crate::study::pages::row_cache::RowCache;
use answers::ChainResult;
use receiver::EstimateRow;
use rivals::RivalRow;
use row::SettingRow;
use scenes::SCENES;
use serde::{Serialize, de::DeserializeOwned};
use wayside::host::failure::Failure;
use wayside::host::progress::Work;

/// Rows of methods, estimates of the receiver, other programs, and results of the whole chain.
pub(super) struct Chart {
    rows: Vec<SettingRow>,
    estimates: Vec<EstimateRow>,
    rivals: Vec<RivalRow>,
    answers: Vec<ChainResult>,
}

/// Parts of the chart that are measured.
pub(super) struct ChartRequest<'a> {
    /// Number of bodies, paths and scenes.
    pub(super) extent: Extent,
    /// A word of the names of parts; `None`: all parts.
    pub(super) only: Option<&'a str>,
}

impl ChartRequest<'_> {
    fn has(&self, part: &str) -> bool {
        self.only.is_none_or(|word| part.contains(word))
    }
}

/// Measures what is asked for, or what of it an earlier run of sources with this hash has not.
pub(super) fn measure(request: &ChartRequest<'_>, sources: &str) -> Result<Chart, Failure> {
    let name = if request.extent == Extent::Quick { "chart-quick" } else { "chart" };
    let cache = RowCache::of(name, sources);
    let chart = Chart {
        rows: rows(request, &cache)?,
        estimates: part(request, &cache, "estimates", receiver::rows)?,
        rivals: part(request, &cache, "outside", rivals::rows)?,
        answers: all_answers(request, &cache)?,
    };
    match request.only {
        Some(word) if chart.is_empty() => {
            Err(Failure::Refused(format!("--only: no part of the chart has `{word}` in its name")))
        }
        _ => Ok(chart),
    }
}

impl Chart {
    fn is_empty(&self) -> bool {
        self.rows.is_empty() && self.estimates.is_empty() && self.rivals.is_empty() && self.answers.is_empty()
    }
}

/// The rows of one name, none where they are not asked for.
fn part<R: Serialize + DeserializeOwned>(
    request: &ChartRequest<'_>,
    cache: &RowCache,
    name: &str,
    make: fn(Extent) -> Result<Vec<R>, Failure>,
) -> Result<Vec<R>, Failure> {
    if request.has(name) { cache.get_or_make(name, || make(request.extent)) } else { Ok(vec![]) }
}

/// Every row, body by body, then scene by scene.
fn rows(request: &ChartRequest<'_>, cache: &RowCache) -> Result<Vec<SettingRow>, Failure> {
    let extent = request.extent;
    let (mut subjects, mut counts) = (subjects::all(extent)?, synthesis::counts(extent).to_vec());
    subjects.retain(|subject| request.has(&scattering_of(subject)));
    counts.retain(|count| request.has(&synthesis_of(*count)));
    let scenes = scenes_of(request, "frames");
    let work = Work::begin("chart");
    let (mut all, mut done) = (vec![], 0);
    let parts = subjects.len() + counts.len() + scenes.len();
    let mut add = |name: String, make: &dyn Fn() -> Result<Vec<SettingRow>, Failure>| {
        work.at(done, parts);
        done += 1;
        all.extend(cache.get_or_make(&file_name(&name), || Ok(finite(make()?)))?);
        Ok::<(), Failure>(())
    };
    for subject in &subjects {
        add(scattering_of(subject), &|| scattering::rows(subject))?;
    }
    for count in counts {
        add(synthesis_of(count), &|| synthesis::rows(count))?;
    }
    let folder = scenes::folder_of_bodies()?;
    for scene in scenes {
        add(format!("frames of {}", scene.name), &|| frames::rows(scene, folder.path(), extent))?;
    }
    Ok(all)
}

fn scattering_of(subject: &subjects::Subject) -> String {
    format!("scattering of {}", subject.name)
}

fn synthesis_of(count: usize) -> String {
    format!("synthesis of {count}")
}

/// Rows with a finite error: orders without any field have none.
fn finite(mut rows: Vec<SettingRow>) -> Vec<SettingRow> {
    rows.retain(|row| row.error.is_finite());
    rows
}

fn all_answers(request: &ChartRequest<'_>, cache: &RowCache) -> Result<Vec<ChainResult>, Failure> {
    let work = Work::begin("whole chain");
    let folder = scenes::folder_of_bodies()?;
    let scenes = scenes_of(request, "answers");
    let mut all = vec![];
    for (number, scene) in scenes.iter().enumerate() {
        work.at(number, scenes.len());
        let name = file_name(&format!("answers of {}", scene.name));
        all.extend(cache.get_or_make(&name, || answers::rows(scene, folder.path(), request.extent))?);
    }
    Ok(all)
}

/// All scenes or two of them, those whose part of this kind is asked for.
fn scenes_of(request: &ChartRequest<'_>, kind: &str) -> Vec<&'static scenes::Scene> {
    let all: &[scenes::Scene] = match request.extent {
        Extent::Quick => &SCENES[..2],
        Extent::Full => &SCENES,
    };
    all.iter().filter(|scene| request.has(&format!("{kind} of {}", scene.name))).collect()
}

/// Name of a file of rows.
fn file_name(name: &str) -> String {
    name.chars().map(|letter| if letter.is_alphanumeric() { letter } else { '-' }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::project_root;
    use crate::study::table::{Table, TableRow};

    /// A change that moves a front is seen where it is made, and not when the chart is made the next time.
    #[test]
    fn no_method_errs_on_a_corner_by_more_than_the_chart_tells() {
        let told = std::fs::read_to_string(project_root().join("docs/pictures/chart.csv")).unwrap();
        let told = Table::read(&told, &COLUMNS).unwrap();
        let error_db = |row: &SettingRow| {
            let key = [("scene", &row.scene), ("method", &row.method), ("setting", &row.setting)];
            let is_same = |other: &TableRow| key.iter().all(|(column, word)| other.word(column) == *word);
            told.rows().find(is_same).map(|row| row.number("error_db"))
        };
        let rows = scattering::rows(&subjects::corner()).unwrap();
        for row in &rows {
            let (now, told) = (artifact::units::db_from_amplitude(row.error), error_db(row).unwrap());
            assert!(now < told + 1.0, "{} {}: {now} dB, {told} dB in docs/chart.md", row.method, row.setting);
        }
    }
}
