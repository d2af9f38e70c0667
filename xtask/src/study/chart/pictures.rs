//! The chart's pictures, drawn from its table.

use crate::study::chart::answers::Answers;
use crate::study::table::{RowOf, Table};
use plotting::form::Form;
use plotting::lines::{Line, LinePlot, Scale};
use plotting::svg::Svg;

/// Columns that are drawn.
pub(in crate::study) const COLUMNS: [&str; 5] = ["scene", "method", "setting", "seconds", "error_db"];

/// Errors below are rounding, and the picture's room is for the others.
const LEAST_DB: f64 = -120.0;
const BETTER: &str = "Better is lower (less time) and further left (less error).";

/// Seconds (by powers of ten) over error in dB, which is by powers of ten too; a line for each method on
/// parts of the chain.
pub(in crate::study) fn picture(table: &Table) -> Svg {
    let rows: Vec<RowOf> = table.rows().filter(|row| !row.word("method").starts_with(WHOLE_FRAME)).collect();
    let mut lines = lines(rows.iter().map(|row| (row.word("method"), row)));
    for line in &mut lines {
        let of_line: Vec<&str> =
            rows.iter().filter(|r| r.word("method") == line.name).map(|r| r.word("setting")).collect();
        line.name = method(&line.name, &of_line);
    }
    let scenes = format!("Work: {}.", listed(rows.iter().map(|row| row.word("scene"))));
    plot("Chart: seconds against error of each method", [scenes, BETTER.into()], lines)
}

/// Draws seconds over error of whole frames and their cubes: a line for each scene, from paths to table.
pub(in crate::study) fn picture_of_frames(table: &Table) -> Svg {
    let is_cube =
        |row: &RowOf| row.word("method").starts_with(WHOLE_FRAME) && row.word("method").ends_with("cube");
    let rows: Vec<RowOf> = table.rows().filter(is_cube).collect();
    fn name<'t>(row: &RowOf<'t>) -> &'t str {
        row.word("scene").split(", a frame").next().unwrap_or_default()
    }
    let notes = "A frame of 12 channels of each scene: the left end of a line is made path by path, the right end by the \
         paper's table.";
    let lines = lines(rows.iter().map(|row| (name(row), row)));
    plot("Chart: seconds against error of whole frames", [notes.into(), BETTER.into()], lines)
}

/// Draws processor seconds over the error of place of whole runs: a line for each scene, by the accuracy
/// asked.
pub(in crate::study) fn picture_of_answers(rows: &[Answers]) -> Svg {
    let mut lines: Vec<Line> = Vec::new();
    for row in rows {
        let Some([range_m, _, across_m]) = row.errors else { continue };
        let place = [range_m.hypot(across_m).max(LEAST_M), row.processor_s];
        match lines.iter_mut().find(|line| line.name == row.scene) {
            Some(line) => line.points.push(place),
            None => lines.push(Line { name: row.scene.into(), points: vec![place], marked: true }),
        }
    }
    let plot = LinePlot {
        title: "Chart: processor seconds against error of place".into(),
        notes: vec![
            "Whole runs, a line for each scene, through the accuracies asked (chart-answers.csv has them in order).".into(),
            BETTER.into(),
        ],
        x_label: "error of place (range and across, root mean square), m".into(),
        y_label: "processor seconds".into(),
        x_scale: Scale::Logarithmic,
        y_scale: Scale::Logarithmic,
        lines,
    };
    plot.draw(Form::Wide)
}

/// Errors of place below are less than any radar of these tells.
const LEAST_M: f64 = 1e-3;

/// Methods that make whole frames.
const WHOLE_FRAME: &str = "frame by";

/// Names in words, with the first and the last setting.
fn method(name: &str, settings: &[&str]) -> String {
    let words = match name.split(", ").next().unwrap_or_default() {
        "bart" => "beams (bart)",
        "po" => "dense sampling (po)",
        "sbr" => "shooting and bouncing rays (sbr)",
        "paths" => "echo of traced paths",
        "rcs-table" => "echo of the paper's table",
        _ => "",
    };
    let rest = name.split_once(", ").map_or("", |(_, rest)| rest);
    let named = match (words, rest) {
        ("", _) => name.to_owned(),
        (words, "") => words.to_owned(),
        (words, rest) => format!("{words}, {rest}"),
    };
    let settings = match settings {
        [] => return named,
        [only] => (*only).to_owned(),
        [first, .., last] => format!("{first} … {last}"),
    };
    format!("{named}: {settings}").replace(": -", ": −").replace("… -", "… −")
}

fn listed<'t>(words: impl Iterator<Item = &'t str>) -> String {
    let mut all: Vec<&str> = vec![];
    for word in words {
        if !all.contains(&word) {
            all.push(word);
        }
    }
    all.join("; ")
}

fn lines<'t>(rows: impl Iterator<Item = (&'t str, &'t RowOf<'t>)>) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    for (name, row) in rows {
        let place = [row.number("error_db").max(LEAST_DB), row.number("seconds")];
        match lines.iter_mut().find(|line| line.name == name) {
            Some(line) => line.points.push(place),
            None => lines.push(Line { name: name.into(), points: vec![place], marked: true }),
        }
    }
    lines
}

fn plot(title: &str, notes: [String; 2], lines: Vec<Line>) -> Svg {
    let is_cut = lines.iter().flat_map(|line| &line.points).any(|[error_db, _]| *error_db == LEAST_DB);
    let cut = if is_cut { " (−120 stands for less)" } else { "" };
    let plot = LinePlot {
        title: title.into(),
        notes: notes.to_vec(),
        x_label: format!("error of the complex amplitude, dB{cut}"),
        y_label: "seconds".into(),
        x_scale: Scale::Linear,
        y_scale: Scale::Logarithmic,
        lines,
    };
    plot.draw(Form::Wide)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_says_its_scene_which_side_is_better_and_what_each_line_is() {
        let text = "scene,method,setting,seconds,error_db\n\
            \"corner, 30 m\",\"sbr, order 2\",1 ray,1.0e-3,-0.4\n\"corner, 30 m\",\"sbr, order 2\",8 rays,7.0e-2,-20.7\n\
            300 paths,\"echo, formulas\",all,1.0e-1,-202.3\n";
        let drawn = picture(&Table::read(text, &COLUMNS).unwrap()).inline();
        for said in [
            "corner, 30 m; 300 paths",
            "Better is lower",
            "shooting and bouncing rays (sbr), order 2: 1 ray … 8 rays",
            "echo, formulas: all",
            "−120 stands for less",
        ] {
            assert!(drawn.contains(said), "{said}");
        }
    }
}
