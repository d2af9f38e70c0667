//! The chart as CSV, page and picture.

use super::{Extent, Row};
use crate::commands::study::table;
use crate::pictures::{Line, LinePlot, Scale, Svg};
use artifact::units::db_from_amplitude;

/// Columns of interface.md.
pub(in super::super) fn csv(rows: &[Row]) -> String {
    table::csv("stage,scene,method,setting,seconds,peak_mib,error_db,reference", rows.iter().map(fields))
}

fn fields(row: &Row) -> Vec<String> {
    let peak = row.peak_mib.map_or(String::new(), |m| format!("{m:.0}"));
    let (seconds, error) = (format!("{:.3e}", row.seconds), table::decibels(Some(row.error)));
    let words = [row.stage, &row.scene, row.method, &row.setting, &seconds, &peak, &error, &row.reference];
    words.map(str::to_owned).to_vec()
}

pub(in super::super) fn page(rows: &[Row], extent: Extent) -> String {
    let header = ["stage", "scene", "method", "setting", "seconds", "peak, MiB", "error, dB", "reference"];
    let command = match extent {
        Extent::Quick => "cargo xtask chart --quick --docs",
        Extent::Full => "cargo xtask chart --docs",
    };
    format!(
        "# Chart: speed against accuracy\n\n\
         Made by `{command}` on {}. Seconds are those of one run, all threads, building of hierarchies included. The peak is \
         the largest resident size of the whole program while a row ran (empty where the system does not count it). Errors \
         are complex amplitude errors as in `conventions.md`, against another method, carried to convergence as far as it goes; \
         never against a method's own next setting. Beams use the exit node here, because rays do.\n\n\
         \"frame by …\" are whole frames of vehicles in lane 2, path by path and by the paper's table (`echo = \"rcs-table\"`): the \
         cube's complex error, and that of the magnitudes of its range-Doppler maps; seconds are of tracing + echo. \
         The table errs by as much as there is to see at any range of a road ([why](rcs-tables.md)).\n\n\
         ![seconds against error](pictures/chart.svg)\n\n\
         Whole frames, each a line from its paths to its table:\n\n\
         ![seconds against error of whole frames](pictures/chart-frames.svg)\n\n{}",
        machine(),
        table::markdown(&header, rows.iter().map(fields))
    )
}

/// Cores and instructions: what times depend on most.
fn machine() -> String {
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
    format!("{cores} cores, {}", instructions())
}

#[cfg(target_arch = "x86_64")]
fn instructions() -> &'static str {
    if std::arch::is_x86_feature_detected!("avx512f") {
        "x86-64 with AVX-512"
    } else if std::arch::is_x86_feature_detected!("avx2") {
        "x86-64 with AVX2"
    } else {
        "x86-64"
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn instructions() -> &'static str {
    std::env::consts::ARCH
}

/// Errors below are rounding, and the picture's room is for the others.
const LEAST_DB: f64 = -120.0;

/// Seconds (by powers of ten) over error in dB, which is by powers of ten too; a line for each method on parts of the chain.
pub(in super::super) fn picture(rows: &[Row]) -> Svg {
    let parts = rows.iter().filter(|row| !row.method.starts_with(WHOLE_FRAME));
    plot("Seconds against error", parts.map(|row| (row.method, row)))
}

/// The same of whole frames and their cubes: a line for each, from paths to table.
pub(in super::super) fn picture_of_frames(rows: &[Row]) -> Svg {
    let cubes = rows.iter().filter(|row| row.method.starts_with(WHOLE_FRAME) && row.method.ends_with("cube"));
    let name = |row: &'_ Row| row.scene.find(", a frame").unwrap_or(row.scene.len());
    plot(
        "Seconds against error of whole frames, by paths and by tables",
        cubes.map(|row| (&row.scene[..name(row)], row)),
    )
}

/// Methods that make whole frames.
const WHOLE_FRAME: &str = "frame by";

fn plot<'a>(title: &str, rows: impl Iterator<Item = (&'a str, &'a Row)>) -> Svg {
    let mut lines: Vec<Line> = Vec::new();
    for (name, row) in rows {
        let place = [db_from_amplitude(row.error).max(LEAST_DB), row.seconds];
        match lines.iter_mut().find(|line| line.name == name) {
            Some(line) => line.points.push(place),
            None => lines.push(Line { name: name.into(), points: vec![place], marked: true }),
        }
    }
    let plot = LinePlot {
        title: title.into(),
        x_label: "error, dB (complex amplitude; −120 stands for less)".into(),
        y_label: "seconds".into(),
        x_scale: Scale::Linear,
        y_scale: Scale::Logarithmic,
        lines,
    };
    plot.draw()
}
