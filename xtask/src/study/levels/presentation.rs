//! The levels as CSV, page and picture.

use crate::study::extent::Extent;
use crate::study::levels::row::LevelRow;
use crate::study::table::{self, Table};
use artifact::settings::Detail;
use artifact::units::db_from_amplitude;
use plotting::layout::Layout;
use plotting::lines::{Line, LinePlot, Scale};
use plotting::svg::Svg;

pub(in crate::study) fn csv(rows: &[LevelRow]) -> String {
    let header = "scene,asked_db,level,paths,error_told_db,error_db,total_db,trace_seconds,reduce_seconds,echo_seconds,chosen";
    table::csv(header, rows.iter().map(fields))
}

fn fields(row: &LevelRow) -> Vec<String> {
    let [trace, reduce, echo] = row.seconds.map(|s| format!("{s:.3}"));
    let errors = [row.told, row.error, row.total].map(table::decibels);
    let mut fields = vec![
        row.scene.to_owned(),
        format!("{}", row.asked_db),
        row.level.name().into(),
        row.paths.to_string(),
    ];
    fields.extend(errors);
    fields.extend([trace, reduce, echo, row.chosen.clone()]);
    fields
}

pub(in crate::study) fn page(rows: &[LevelRow], extent: Extent) -> String {
    let command = match extent {
        Extent::Quick => "cargo xtask levels --quick --docs",
        Extent::Full => "cargo xtask study levels",
    };
    let header = [
        "scene",
        "asked, dB",
        "level",
        "paths",
        "error told, dB",
        "error of the cube, dB",
        "all errors told, dB",
        "trace, s",
        "reduce, s",
        "echo, s",
        "taken by each target",
    ];
    format!(
        "# Levels of detail\n\n\
         Made by `{command}`. How they are made and chosen:\n\
         [decision](../decisions/levels-of-detail.md). The error of a level is that of its whole cube\n\
         (all channels, chirps and samples) against the cube of all paths of the same frame; \"told\" is\n\
         what the run measures at 12 looks of 16 instants, with its margin of 1.8 dB. A level by name may\n\
         err by 0.3 of the accuracy asked, or by what the other errors leave of it if that is more;\n\
         statistical points are another field of the same level, so that their complex error\n\
         is near +3 dB whatever is asked.\n{}\n\
         Scenes that say nothing keep all paths. Cars and buses at 40 m are traced down to −30 dB, the\n\
         others to −20 dB: beyond, that table is what is reduced, and no other errors are counted. Seconds\n\
         are those of the processor, all threads; the radar has 3 × 4 elements, 128 chirps of 256 samples\n\
         where nothing else is said.\n\n\
         ![processor seconds of reducing and echo against accuracy](../pictures/levels-of-detail.svg)\n\n{}",
        stated_against_true(rows),
        table::markdown(&header, rows.iter().map(fields))
    )
}

/// Sentence about the accuracy of the reported errors: ratio of reported to true error.
fn stated_against_true(rows: &[LevelRow]) -> String {
    let pairs = rows.iter().filter_map(|row| row.told.zip(row.error));
    let mut above_db: Vec<f64> = pairs.map(|(told, error)| db_from_amplitude(told / error)).collect();
    above_db.sort_by(f64::total_cmp);
    let held = above_db.iter().filter(|db| **db >= 0.0).count();
    match above_db[..] {
        [] => String::new(),
        [least, ..] => format!(
            "In {held} of {} tables the error told is not below that of the cube; told over true is {least:.1} to\n\
             {:.1} dB, the median {:.1} dB.",
            above_db.len(),
            above_db[above_db.len() - 1],
            above_db[above_db.len() / 2]
        ),
    }
}

/// Drawn columns.
pub(in crate::study) const COLUMNS: [&str; 5] =
    ["scene", "asked_db", "level", "reduce_seconds", "echo_seconds"];

/// Seconds of reduction and echo over the requested accuracy, a line for each level of the first scene.
pub(in crate::study) fn picture(table: &Table) -> Svg {
    let first = table.rows().next().map_or("", |row| row.word("scene"));
    let line = |level: Detail| Line {
        name: name(level).into(),
        points: table
            .rows()
            .filter(|row| row.word("scene") == first && row.word("level") == level.name())
            .map(|row| [row.number("asked_db"), row.number("reduce_seconds") + row.number("echo_seconds")])
            .collect(),
        has_markers: true,
        tooltips: vec![],
    };
    let plot = LinePlot {
        title: "Levels of detail: processor seconds of reducing the paths and of the echo".into(),
        notes: vec![format!("Scene: {first}. Better is lower; further left more accuracy is asked.")],
        x_label: "accuracy asked, dB".into(),
        y_label: "processor seconds".into(),
        x_scale: Scale::Linear,
        y_scale: Scale::Logarithmic,
        lines: [Detail::Paths, Detail::Merged, Detail::Centres, Detail::Auto].map(line).to_vec(),
    };
    plot.draw(Layout::Wide)
}

/// Description of a level of detail.
fn name(level: Detail) -> &'static str {
    match level {
        Detail::Paths => "paths: all that were traced",
        Detail::Merged => "merged: paths whose phases stay together as one",
        Detail::Centres => "centres: fitted scattering centres",
        Detail::Statistical => "statistical: points of the same mean level",
        Detail::Auto => "auto: the cheapest that keeps the accuracy asked",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_prose_of_the_page_fits_its_lines() {
        let row = LevelRow {
            scene: "a car",
            asked_db: -20.0,
            level: Detail::Merged,
            chosen: String::new(),
            paths: 100,
            told: Some(0.1),
            error: Some(0.01),
            total: None,
            seconds: [0.0; 3],
        };
        let page = page(&[row], Extent::Full);
        let mut prose = page.lines().filter(|line| !line.starts_with(['|', '!']));
        assert!(prose.all(|line| line.chars().count() <= 110), "{page}");
    }
}
