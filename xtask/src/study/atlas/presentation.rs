//! The atlas as CSV and page.

use crate::study::atlas::{CaseRow, Verdict, coverage};
use crate::study::extent::Extent;
use crate::study::table;

pub(in crate::study) fn count(rows: &[CaseRow], verdict: Verdict) -> usize {
    rows.iter().filter(|row| row.verdict == verdict).count()
}

/// Table with the columns of interface.md.
pub(in crate::study) fn csv(rows: &[CaseRow]) -> String {
    let fields = |r: &CaseRow| {
        let words =
            [r.stage, r.method, r.case, r.parameter, &r.value, &table::decibels(r.error), r.verdict.name()];
        words.map(str::to_owned).to_vec()
    };
    table::csv("stage,method,case,parameter,value,error_db,verdict", rows.iter().map(fields))
}

const RULE: &str = "\
# Atlas: where each method fails

Each case has an answer that is known without the method under trial: a closed form,
a series, an integral carried to convergence, another method, or the truth of a scene.

- **good**: the error is at most −20 dB, the default accuracy of a scene.
- **degraded**: it is larger, and the program says so: a printed error that holds it, a printed estimate of
  what the model leaves out (node rules, next order, far field) at most 10 dB below it, a flag, a null or a
  remark in the result, or a limit that the documentation of the method states. The last column has it.
- **refused**: there is no answer, and the program says why.
- **wrong**: larger, and nothing is said; or an input without an answer that was taken. A bug.

Errors are complex amplitude errors as in `conventions.md`, of the level where a reference has no phase, and
relative errors of an estimate where a case is about estimates; of things that are found or lost it is their
number. `cargo xtask atlas --only WORD` tries those cases alone whose functions have the word in their names.
What random cases found beside these is a ledger of its own: [random search](validation/random-search.md).
";

pub(in crate::study) fn page(rows: &[CaseRow], extent: Extent) -> String {
    let command = match extent {
        Extent::Quick => "cargo xtask atlas --quick --docs",
        Extent::Full => "cargo xtask study atlas",
    };
    let counts: Vec<String> = Verdict::ALL.map(|v| format!("{} {}", count(rows, v), v.name())).to_vec();
    let fields = |r: &CaseRow| {
        let words = [
            r.stage,
            r.method,
            r.case,
            r.parameter,
            &r.value,
            &table::decibels(r.error),
            r.verdict.name(),
            &r.statement,
        ];
        words.map(str::to_owned).to_vec()
    };
    let header =
        ["stage", "method", "case", "parameter", "value", "error, dB", "verdict", "what the program says"];
    format!(
        "{RULE}\nMade by `{command}`. {} cases, {} rows: {}.{}\n{}\n![verdicts](pictures/atlas.svg)\n\n\
         ## What was asked for\n\n{}\n## All rows\n\n{}",
        cases(rows).len(),
        rows.len(),
        counts.join(", "),
        exceeded(rows),
        wrong(rows),
        coverage::table(rows),
        table::markdown(&header, rows.iter().map(fields))
    )
}

/// A sentence about good rows whose error exceeds the reported one; empty if there are none.
fn exceeded(rows: &[CaseRow]) -> String {
    let is_hidden = |row: &&CaseRow| row.verdict == Verdict::Good && row.excess.is_some();
    match rows.iter().filter(is_hidden).count() {
        0 => String::new(),
        count => format!(
            "\n{count} of the good rows err by more than the figure that is meant to hold the error, which is told\n\
             in their last column. The answer to which they are compared may err by as much itself."
        ),
    }
}

/// A paragraph about wrong rows, before all tables; empty if there are none.
fn wrong(rows: &[CaseRow]) -> String {
    let of = |row: &CaseRow| {
        let error = table::decibels(row.error);
        format!("- {}: {} {}, {} dB, says: {}\n", row.case, row.parameter, row.value, error, row.statement)
    };
    let all: String = rows.iter().filter(|row| row.verdict == Verdict::Wrong).map(of).collect();
    if all.is_empty() {
        all
    } else {
        format!("\n**Wrong at this moment, bugs that are not mended:**\n\n{all}")
    }
}

/// Groups the rows of each case.
fn cases(rows: &[CaseRow]) -> Vec<&[CaseRow]> {
    rows.chunk_by(|a, b| (a.case, a.method) == (b.case, b.method)).collect()
}
