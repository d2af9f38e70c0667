//! Speed against accuracy: every method on the same work, with its seconds, its memory and its error relative
//! to another method. Rows are kept, so that an interrupted chart resumes.

mod row;
mod work;
mod subjects;
mod scenes;
mod scattering;
mod frames;
mod synthesis;
mod receiver;
mod outside;
mod answers;
mod presentation;
mod pictures;
mod changes;

pub(super) use changes::changes;
pub(super) use pictures::{COLUMNS, COLUMNS_OF_ANSWERS, picture_of_answers, pictures};
pub(super) use presentation::{page, tables};

use crate::study::extent::Extent;
use crate::study::pages::kept::Kept;
use answers::Answers;
use outside::RivalRow;
use receiver::EstimateRow;
use row::SettingRow;
use scenes::SCENES;
use wayside::host::failure::Failure;
use wayside::host::progress::Work;

/// Rows of methods, estimates of the receiver, other programs, and results of the whole chain.
pub(super) struct Chart {
    rows: Vec<SettingRow>,
    estimates: Vec<EstimateRow>,
    rivals: Vec<RivalRow>,
    answers: Vec<Answers>,
}

/// Measures all rows, or those that an earlier run with this hash of sources lacks.
pub(super) fn measured(extent: Extent, sources: &str) -> Result<Chart, Failure> {
    let name = if extent == Extent::Quick { "chart-quick" } else { "chart" };
    let kept = Kept::of(name, sources);
    Ok(Chart {
        rows: rows(extent, &kept)?,
        estimates: kept.or_made("estimates", || receiver::rows(extent))?,
        rivals: kept.or_made("outside", || outside::rows(extent))?,
        answers: all_answers(extent, &kept)?,
    })
}

/// Every row, body by body, then scene by scene.
fn rows(extent: Extent, kept: &Kept) -> Result<Vec<SettingRow>, Failure> {
    let (subjects, counts, scenes) = (subjects::all(extent)?, synthesis::counts(extent), scenes_of(extent));
    let work = Work::begin("chart");
    let (mut all, mut done) = (vec![], 0);
    let parts = subjects.len() + counts.len() + scenes.len();
    let mut add = |name: String, make: &dyn Fn() -> Result<Vec<SettingRow>, Failure>| {
        work.at(done, parts);
        done += 1;
        all.extend(kept.or_made(&file_name(&name), || Ok(finite(make()?)))?);
        Ok::<(), Failure>(())
    };
    for subject in &subjects {
        add(format!("scattering of {}", subject.name), &|| scattering::rows(subject))?;
    }
    for count in counts {
        add(format!("synthesis of {count}"), &|| synthesis::rows(*count))?;
    }
    let folder = scenes::folder_of_bodies()?;
    for scene in scenes {
        add(format!("frames of {}", scene.name), &|| frames::rows(scene, folder.path(), extent))?;
    }
    Ok(all)
}

/// Rows with a finite error: orders without any field have none.
fn finite(mut rows: Vec<SettingRow>) -> Vec<SettingRow> {
    rows.retain(|row| row.error.is_finite());
    rows
}

fn all_answers(extent: Extent, kept: &Kept) -> Result<Vec<Answers>, Failure> {
    let work = Work::begin("whole chain");
    let folder = scenes::folder_of_bodies()?;
    let scenes = scenes_of(extent);
    let mut all = vec![];
    for (number, scene) in scenes.iter().enumerate() {
        work.at(number, scenes.len());
        let name = file_name(&format!("answers of {}", scene.name));
        all.extend(kept.or_made(&name, || answers::rows(scene, folder.path(), extent))?);
    }
    Ok(all)
}

/// All scenes, or two of them.
fn scenes_of(extent: Extent) -> &'static [scenes::Scene] {
    match extent {
        Extent::Quick => &SCENES[..2],
        Extent::Full => &SCENES,
    }
}

/// Name of a file of rows.
fn file_name(name: &str) -> String {
    name.chars().map(|letter| if letter.is_alphanumeric() { letter } else { '-' }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::project_root;
    use crate::study::table::{RowOf, Table};

    /// A change that moves a front is seen where it is made, and not when the chart is made the next time.
    #[test]
    fn no_method_errs_on_a_corner_by_more_than_the_chart_tells() {
        let told = std::fs::read_to_string(project_root().join("docs/pictures/chart.csv")).unwrap();
        let told = Table::read(&told, &COLUMNS).unwrap();
        let error_db = |row: &SettingRow| {
            let key = [("scene", &row.scene), ("method", &row.method), ("setting", &row.setting)];
            let is_same = |other: &RowOf| key.iter().all(|(column, word)| other.word(column) == *word);
            told.rows().find(is_same).map(|row| row.number("error_db"))
        };
        let rows = scattering::rows(&subjects::corner()).unwrap();
        for row in &rows {
            let (now, told) = (artifact::units::db_from_amplitude(row.error), error_db(row).unwrap());
            assert!(now < told + 1.0, "{} {}: {now} dB, {told} dB in docs/chart.md", row.method, row.setting);
        }
    }
}
