//! The atlas's picture, drawn from its table.

use crate::study::atlas::Verdict;
use crate::study::table::{Table, TableRow};
use plotting::marks::{Legend, Mark};
use plotting::svg::Svg;

/// Columns that are drawn.
pub(in crate::study) const COLUMNS: [&str; 4] = ["method", "case", "error_db", "verdict"];

const LINE_PX: f64 = 21.0;
const LEFT_PX: f64 = 460.0;
const RIGHT_PX: f64 = 880.0;
const TOP_PX: f64 = 84.0;
/// Range of shown errors; smaller ones are at the left end.
const SPAN_DB: [f64; 2] = [-120.0, 45.0];

/// A line for each case, a mark for each row by its error and its verdict.
pub(in crate::study) fn picture(table: &Table) -> Svg {
    let rows: Vec<TableRow> = table.rows().collect();
    let is_one =
        |a: &TableRow, b: &TableRow| (a.word("case"), a.word("method")) == (b.word("case"), b.word("method"));
    let cases: Vec<&[TableRow]> = rows.chunk_by(is_one).collect();
    let bottom = TOP_PX + LINE_PX * cases.len() as f64;
    let mut sheet = Svg::new("Atlas: error and verdict of every case, method by method", 1000.0, 0.0);
    sheet.heading([10.0, 22.0], "Atlas: error and verdict of every case, method by method");
    sheet.text(
        [10.0, 42.0],
        "start",
        "A mark is one value of the case's parameter. Better is further left; the dark line is the default accuracy, \
         −20 dB.",
    );
    scale(&mut sheet, bottom);
    for (number, case) in cases.iter().enumerate() {
        draw_case(&mut sheet, TOP_PX + LINE_PX * (number as f64 + 0.5), case);
    }
    legend().draw(&mut sheet, bottom + 62.0, [10.0, 990.0]);
    sheet
}

fn at(error_db: f64) -> f64 {
    let share = (error_db.clamp(SPAN_DB[0], SPAN_DB[1]) - SPAN_DB[0]) / (SPAN_DB[1] - SPAN_DB[0]);
    LEFT_PX + share * (RIGHT_PX - LEFT_PX)
}

/// Mark of a verdict, distinct in shape and colour.
fn mark(verdict: Verdict) -> Mark {
    match verdict {
        Verdict::Good => Mark::Disc,
        Verdict::Degraded => Mark::TriangleUp,
        Verdict::Refused => Mark::Circle,
        Verdict::Wrong => Mark::Cross,
    }
}

fn legend() -> Legend {
    let mut legend = Legend::default();
    for verdict in Verdict::ALL {
        let words = match verdict {
            Verdict::Good => "good: −20 dB or better",
            Verdict::Degraded => "degraded: worse, and the program says so",
            Verdict::Refused => "refused: no answer, and why",
            Verdict::Wrong => "wrong: worse, and nothing is said",
        };
        legend.add(mark(verdict), verdict.name(), words);
    }
    legend
}

fn scale(sheet: &mut Svg, bottom: f64) {
    for error_db in (-6..=2).map(|i| 20.0 * f64::from(i)) {
        let x = at(error_db);
        sheet.line(if error_db == -20.0 { "ink" } else { "faint" }, [x, TOP_PX - 6.0], [x, bottom]);
        let text = format!("{error_db:.0}").replace('-', "−");
        let text = if error_db == SPAN_DB[0] { format!("≤ {text}") } else { text };
        sheet.text([x, bottom + 17.0], "middle", &text);
    }
    sheet.text([0.5 * (LEFT_PX + RIGHT_PX), bottom + 36.0], "middle", "error, dB");
    sheet.text([RIGHT_PX + 60.0, TOP_PX - 12.0], "middle", "no answer");
}

fn draw_case(sheet: &mut Svg, y: f64, rows: &[TableRow]) {
    let Some(first) = rows.first() else { return };
    sheet.text(
        [LEFT_PX - 14.0, y + 4.0],
        "end",
        &format!("{} · {}", first.word("method"), first.word("case")),
    );
    for (number, row) in rows.iter().enumerate() {
        let Some(verdict) = Verdict::ALL.into_iter().find(|v| v.name() == row.word("verdict")) else {
            continue;
        };
        let error_db = row.number("error_db");
        let place = if error_db.is_nan() { RIGHT_PX + 30.0 + 13.0 * number as f64 } else { at(error_db) };
        mark(verdict).draw(sheet, verdict.name(), [place, y]);
    }
}
