//! The atlas as CSV, page and picture.

use super::{Extent, Row, Verdict};
use crate::commands::study::table;
use crate::pictures::Svg;
use artifact::units::db_from_amplitude;

pub(in super::super) fn count(rows: &[Row], verdict: Verdict) -> usize {
    rows.iter().filter(|row| row.verdict == verdict).count()
}

/// Columns of interface.md.
pub(in super::super) fn csv(rows: &[Row]) -> String {
    let fields = |r: &Row| {
        let words = [r.stage, r.method, r.case, r.parameter, &r.value, &table::decibels(r.error), r.verdict.name()];
        words.map(str::to_owned).to_vec()
    };
    table::csv("stage,method,case,parameter,value,error_db,verdict", rows.iter().map(fields))
}

const RULE: &str = "\
# Atlas: where each method fails

Each case has an answer that is known without the method under trial: a closed form,
a series, an integral carried to convergence, another method, or the truth of a scene.

- **good**: the error is at most −20 dB, the default accuracy of a scene.
- **degraded**: it is larger, and the program says so: a printed error that holds it, a printed estimate of what the model
  leaves out (node rules, next order, far field) at most 10 dB below it, a flag, a null or a remark in the result, or a
  limit that the documentation of the method states. The last column has it.
- **refused**: there is no answer, and the program says why.
- **wrong**: larger, and nothing is said; or an input without an answer that was taken. A bug.

Errors are complex amplitude errors as in `conventions.md`, of the level where a reference has no phase, and relative
errors of an estimate where a case is about estimates.
";

pub(in super::super) fn page(rows: &[Row], extent: Extent) -> String {
    let command = match extent {
        Extent::Quick => "cargo xtask atlas --quick --docs",
        Extent::Full => "cargo xtask atlas --docs",
    };
    let counts: Vec<String> = Verdict::ALL.map(|v| format!("{} {}", count(rows, v), v.name())).to_vec();
    let fields = |r: &Row| {
        let words =
            [r.stage, r.method, r.case, r.parameter, &r.value, &table::decibels(r.error), r.verdict.name(), &r.said];
        words.map(str::to_owned).to_vec()
    };
    let header = ["stage", "method", "case", "parameter", "value", "error, dB", "verdict", "what the program says"];
    format!(
        "{RULE}\nMade by `{command}`. {} cases, {} rows: {}.\n\n![verdicts](pictures/atlas.svg)\n\n{}",
        cases(rows).len(),
        rows.len(),
        counts.join(", "),
        table::markdown(&header, rows.iter().map(fields))
    )
}

/// Rows of one case stand together.
fn cases(rows: &[Row]) -> Vec<&[Row]> {
    rows.chunk_by(|a, b| (a.case, a.method) == (b.case, b.method)).collect()
}

const LINE_PX: f64 = 21.0;
const LEFT_PX: f64 = 430.0;
const RIGHT_PX: f64 = 880.0;
const TOP_PX: f64 = 58.0;
/// Errors shown; smaller ones stand at the left end.
const SPAN_DB: [f64; 2] = [-120.0, 45.0];

/// A line for each case, a mark for each row: its error and its verdict.
pub(in super::super) fn picture(rows: &[Row]) -> Svg {
    let cases = cases(rows);
    let bottom = TOP_PX + LINE_PX * cases.len() as f64;
    let mut sheet = Svg::new("Atlas: errors and verdicts by case", 1000.0, bottom + 46.0);
    key(&mut sheet);
    scale(&mut sheet, bottom);
    for (number, case) in cases.iter().enumerate() {
        draw_case(&mut sheet, TOP_PX + LINE_PX * (number as f64 + 0.5), case);
    }
    sheet
}

fn at(error_db: f64) -> f64 {
    let share = (error_db.clamp(SPAN_DB[0], SPAN_DB[1]) - SPAN_DB[0]) / (SPAN_DB[1] - SPAN_DB[0]);
    LEFT_PX + share * (RIGHT_PX - LEFT_PX)
}

fn colour(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Good => "#009e73",
        Verdict::Degraded => "#e69f00",
        Verdict::Refused => "#0072b2",
        Verdict::Wrong => "#c00000",
    }
}

fn key(sheet: &mut Svg) {
    for (number, verdict) in Verdict::ALL.into_iter().enumerate() {
        let x = LEFT_PX + 110.0 * number as f64;
        mark(sheet, verdict, [x, 20.0]);
        sheet.words([x + 11.0, 24.0], 12.0, "start", verdict.name());
    }
}

/// Verdicts differ in shape too.
fn mark(sheet: &mut Svg, verdict: Verdict, at: [f64; 2]) {
    let [x, y] = at;
    match verdict {
        Verdict::Good => sheet.disc(colour(verdict), at, 5.0),
        Verdict::Degraded => sheet.outline(colour(verdict), &[[x - 5.5, y + 5.0], [x + 5.5, y + 5.0], [x, y - 6.0]]),
        Verdict::Refused => sheet.ring(colour(verdict), at, 4.5),
        Verdict::Wrong => {
            sheet.polyline(colour(verdict), 2.5, &[[x - 5.0, y - 5.0], [x + 5.0, y + 5.0]]);
            sheet.polyline(colour(verdict), 2.5, &[[x - 5.0, y + 5.0], [x + 5.0, y - 5.0]]);
        }
    }
}

fn scale(sheet: &mut Svg, bottom: f64) {
    for error_db in (-6..=2).map(|i| 20.0 * f64::from(i)) {
        let x = at(error_db);
        sheet.line(if error_db == -20.0 { "ink" } else { "faint" }, [x, TOP_PX - 6.0], [x, bottom]);
        let text = format!("{error_db:.0}").replace('-', "−");
        let text = if error_db == SPAN_DB[0] { format!("≤ {text}") } else { text };
        sheet.words([x, bottom + 16.0], 11.0, "middle", &text);
    }
    sheet.words([0.5 * (LEFT_PX + RIGHT_PX), bottom + 35.0], 12.0, "middle", "error, dB");
    sheet.words([RIGHT_PX + 60.0, TOP_PX - 12.0], 11.0, "middle", "no answer");
}

fn draw_case(sheet: &mut Svg, y: f64, rows: &[Row]) {
    let Some(first) = rows.first() else { return };
    sheet.words([LEFT_PX - 14.0, y + 4.0], 11.5, "end", &format!("{} · {}", first.method, first.case));
    for (number, row) in rows.iter().enumerate() {
        let place = match row.error {
            Some(error) => at(db_from_amplitude(error)),
            None => RIGHT_PX + 30.0 + 13.0 * number as f64,
        };
        mark(sheet, row.verdict, [place, y]);
    }
}
