//! The chart's pictures, drawn from its tables.

use crate::study::table::{Table, TableRow};
use plotting::layout::Layout;
use plotting::lines::{Line, LinePlot, Scale};
use plotting::svg::Svg;

/// Drawn columns.
pub(in crate::study) const COLUMNS: [&str; 6] =
    ["stage", "scene", "method", "setting", "processor_s", "error_db"];

/// Drawn columns of the table of results.
pub(in crate::study) const COLUMNS_OF_ANSWERS: [&str; 5] =
    ["scene", "asked_db", "processor_s", "range_m", "across_m"];

/// Smallest error drawn; smaller ones are rounding, and would take room from others.
const LEAST_DB: f64 = -120.0;
const BETTER: &str = "Better is lower (less time) and further left (less error).";
/// Body of the picture with every method, in the chart.
const CAR: &str = "car-suv, 30 m";

/// Processor seconds (logarithmic) over error in dB, which is logarithmic too.
pub(in crate::study) fn pictures(table: &Table) -> Vec<(&'static str, Svg)> {
    let rows = |stage: &'static str| move |row: &TableRow<'_>| row.word("stage") == stage;
    let scattering: Vec<TableRow> = table.rows().filter(rows("bart-rcs")).collect();
    let frames: Vec<TableRow> = table.rows().filter(rows("bart-rcs + fmcw-echo")).collect();
    let sums: Vec<TableRow> = table.rows().filter(rows("fmcw-echo")).collect();
    vec![
        ("chart", of_methods(&scattering)),
        ("chart-bodies", of_bodies(&scattering)),
        ("chart-frames", of_frames(&frames)),
        ("chart-echo", of_sums(&sums)),
    ]
}

/// A line for each method on one body.
fn of_methods(rows: &[TableRow]) -> Svg {
    let has_car = rows.iter().any(|row| row.word("scene") == CAR);
    let body = if has_car { CAR } else { rows.first().map_or("", |row| row.word("scene")) };
    let rows: Vec<&TableRow> = rows.iter().filter(|row| row.word("scene") == body).collect();
    let mut lines = lines(rows.iter().map(|row| (row.word("method").to_owned(), *row)));
    for line in &mut lines {
        let of_line = rows.iter().filter(|r| r.word("method") == line.name).map(|r| r.word("setting"));
        line.name = method(&line.name, &of_line.collect::<Vec<_>>());
    }
    plot(
        "Chart: processor seconds against error of each method",
        [format!("Body: {body}."), BETTER.into()],
        lines,
    )
}

/// The first order of every body, by beams and by dense sampling.
fn of_bodies(rows: &[TableRow]) -> Svg {
    let first = rows.iter().filter(|row| ["bart, order 1", "po, order 1"].contains(&row.word("method")));
    let name = |row: &TableRow| {
        let way = if row.word("method").starts_with("bart") { "beams" } else { "dense sampling" };
        format!("{}: {way}", row.word("scene").trim_end_matches(", 30 m"))
    };
    let lines = lines(first.map(|row| (name(row), row)));
    let note = "First order of bodies 30 m away; points of a line from coarse to fine.";
    plot("Chart: processor seconds against error of each body", [note.into(), BETTER.into()], lines)
}

/// Whole frames and their cubes: a line for each scene, from the requested accuracies of paths to the table.
fn of_frames(rows: &[TableRow]) -> Svg {
    let cubes = rows.iter().filter(|row| row.word("method").ends_with("cube"));
    let mut lines = lines(cubes.map(|row| (row.word("scene").to_owned(), row)));
    lines.iter_mut().for_each(from_the_right);
    let note = "A frame of 12 channels of each scene: from the right by the paper's table, and by paths asked for −10, −15, \
                −20 and −25 dB.";
    plot("Chart: processor seconds against error of whole frames", [note.into(), BETTER.into()], lines)
}

/// Orders the points of a line, each with its label, by decreasing error.
fn from_the_right(line: &mut Line) {
    let mut points: Vec<([f64; 2], String)> = line.points.drain(..).zip(line.tooltips.drain(..)).collect();
    points.sort_by(|(a, _), (b, _)| b[0].total_cmp(&a[0]));
    (line.points, line.tooltips) = points.into_iter().unzip();
}

/// Sums of many paths.
fn of_sums(rows: &[TableRow]) -> Svg {
    let name = |row: &TableRow| format!("{}: {}", row.word("scene"), row.word("method"));
    let lines = lines(rows.iter().map(|row| (name(row), row)));
    let note = "The same paths summed by transforms of the accuracy asked, and directly.";
    plot("Chart: processor seconds against error of sums", [note.into(), BETTER.into()], lines)
}

/// Draws processor seconds over the position error of whole runs: a line for each scene, by requested
/// accuracy.
pub(in crate::study) fn picture_of_answers(answers: &Table) -> Svg {
    let mut lines: Vec<Line> = Vec::new();
    for row in answers.rows() {
        let (error_m, processor_s) =
            (row.number("range_m").hypot(row.number("across_m")), row.number("processor_s"));
        let words = format!("{} dB asked: {error_m:.2} m, {}", row.word("asked_db"), time(processor_s));
        if error_m.is_finite() {
            add(&mut lines, row.word("scene"), [error_m.max(LEAST_M), processor_s], words);
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
    plot.draw(Layout::Wide)
}

/// Smallest position error drawn, below the accuracy of any of these radars.
const LEAST_M: f64 = 1e-3;

/// Name of a method in words, with the first and the last setting.
fn method(name: &str, settings: &[&str]) -> String {
    let words = match name.split(", ").next().unwrap_or_default() {
        "bart" => "beams (bart)",
        "po" => "dense sampling (po)",
        "sbr" => "shooting and bouncing rays (sbr)",
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

fn lines<'r, 't: 'r>(rows: impl Iterator<Item = (String, &'r TableRow<'t>)>) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    for (name, row) in rows {
        let place = [row.number("error_db").max(LEAST_DB), row.number("processor_s")];
        add(&mut lines, &name, place, words(row));
    }
    lines
}

/// Setting, error and processor seconds of a row.
fn words(row: &TableRow) -> String {
    format!("{}: {} dB, {}", row.word("setting"), row.word("error_db"), time(row.number("processor_s")))
}

/// Text of seconds, short ones in thousandths.
fn time(seconds: f64) -> String {
    if seconds < 0.1 { format!("{:.2} ms", 1e3 * seconds) } else { format!("{seconds:.2} s") }
}

/// Adds a point to the line of this name, which is created if missing.
fn add(lines: &mut Vec<Line>, name: &str, place: [f64; 2], words: String) {
    let words = words.replace('-', "−");
    match lines.iter_mut().find(|line| line.name == name) {
        Some(line) => {
            line.points.push(place);
            line.tooltips.push(words);
        }
        None => {
            lines.push(Line {
                name: name.into(),
                points: vec![place],
                has_markers: true,
                tooltips: vec![words],
            });
        }
    }
}

fn plot(title: &str, notes: [String; 2], lines: Vec<Line>) -> Svg {
    let is_cut = lines.iter().flat_map(|line| &line.points).any(|[error_db, _]| *error_db == LEAST_DB);
    let cut = if is_cut { " (−120 stands for less)" } else { "" };
    let plot = LinePlot {
        title: title.into(),
        notes: notes.to_vec(),
        x_label: format!("error of the complex amplitude, dB{cut}"),
        y_label: "processor seconds".into(),
        x_scale: Scale::Linear,
        y_scale: Scale::Logarithmic,
        lines,
    };
    plot.draw(Layout::Wide)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_says_its_body_which_side_is_better_and_what_each_line_is() {
        let text = "stage,scene,method,setting,processor_s,error_db\n\
            bart-rcs,\"corner, 30 m\",\"sbr, order 2\",1 ray,1.0e-3,-0.4\n\
            bart-rcs,\"corner, 30 m\",\"sbr, order 2\",8 rays,7.0e-2,-20.7\n\
            bart-rcs,\"corner, 30 m\",\"po, order 1\",8 samples,7.0e-2,-20.7\n\
            fmcw-echo,300 paths,\"echo, formulas\",all,1.0e-1,-202.3\n";
        let drawn = pictures(&Table::read(text, &COLUMNS).unwrap());
        let of = |name: &str| drawn.iter().find(|(n, _)| *n == name).unwrap().1.inline();
        for (name, said) in [
            ("chart", "Body: corner, 30 m"),
            ("chart", "Better is lower"),
            ("chart", "shooting and bouncing rays (sbr), order 2: 1 ray … 8 rays"),
            ("chart-bodies", "corner: dense sampling"),
            ("chart-echo", "300 paths: echo, formulas"),
            ("chart-echo", "−120 stands for less"),
            ("chart", "<title>8 rays: −20.7 dB, 70.00 ms</title>"),
        ] {
            assert!(of(name).contains(said), "{name}: {said}");
        }
    }
}
