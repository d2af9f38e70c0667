//! `fuzz-ledger`: adds the results of fuzz runs to `fixtures/fuzz.csv`, and tabulates all of them for the
//! study `fuzz`.

use crate::cli::FuzzLedgerArguments;
use crate::project::{project_root, read_text};
use std::collections::BTreeMap;
use std::path::Path;
use wayside::Failure;
use wayside::host::files;
use wayside::host::safe_text::markdown_table;

const LEDGER: &str = "fixtures/fuzz.csv";
const COLUMNS: &str = "reader,seed,cases,read,refused,minutes,peak_mib";
/// Processor minutes planned for each reader.
const GOAL_MINUTES: f64 = 60.0;

/// Adds logs to the ledger.
pub(crate) fn run(arguments: &FuzzLedgerArguments) -> Result<(), Failure> {
    let ledger = project_root().join(LEDGER);
    let mut text = read_own(&ledger)?;
    for log in &arguments.logs {
        let added = read_text(log)?;
        sums(log, &format!("{COLUMNS}\n{added}"))?;
        text += &added;
    }
    sums(&ledger, &text)?;
    files::write_file(&ledger, text.as_bytes())
}

/// The table of all runs, with a sentence about it.
pub(crate) fn table() -> Result<String, Failure> {
    let ledger = project_root().join(LEDGER);
    let all = sums(&ledger, &read_own(&ledger)?)?;
    Ok(table_of(&all))
}

/// Reads a file of the project that is rewritten, so that it does not count as an input.
fn read_own(file: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(file).map_err(|e| Failure::system(file, "read", e))
}

fn refused(file: &Path, rule: &str) -> Failure {
    Failure::Refused(format!("{}: {rule}", file.display()))
}

/// Number of cases for a reader in all runs.
#[derive(Debug, Default, Clone, PartialEq)]
struct ReaderTotals {
    seeds: Vec<u64>,
    cases: u64,
    read: u64,
    refused: u64,
    minutes: f64,
    peak_mib: u64,
}

/// Sums by reader of a ledger, which is the text of `file`.
fn sums(file: &Path, text: &str) -> Result<BTreeMap<String, ReaderTotals>, Failure> {
    let mut all: BTreeMap<String, ReaderTotals> = BTreeMap::new();
    let mut lines = text.lines();
    if lines.next() != Some(COLUMNS) {
        return Err(refused(file, &format!("does not begin with {COLUMNS}")));
    }
    for (line, number) in lines.zip(2..) {
        let rule = || refused(file, &format!("line {number}: is no line of a log: {line}"));
        let (reader, part) = entry(line).ok_or_else(rule)?;
        all.entry(reader).or_default().add(part);
    }
    Ok(all)
}

fn entry(line: &str) -> Option<(String, ReaderTotals)> {
    let [reader, seed, cases, read, refused, minutes, peak_mib] =
        line.split(',').collect::<Vec<_>>().try_into().ok()?;
    let sum = ReaderTotals {
        seeds: vec![seed.parse().ok()?],
        cases: cases.parse().ok()?,
        read: read.parse().ok()?,
        refused: refused.parse().ok()?,
        minutes: minutes.parse().ok().filter(|minutes: &f64| minutes.is_finite())?,
        peak_mib: peak_mib.parse().ok()?,
    };
    (sum.read + sum.refused == sum.cases).then(|| (reader.to_owned(), sum))
}

impl ReaderTotals {
    fn add(&mut self, part: Self) {
        self.seeds.extend(part.seeds);
        self.seeds.sort_unstable();
        self.seeds.dedup();
        self.cases += part.cases;
        self.read += part.read;
        self.refused += part.refused;
        self.minutes += part.minutes;
        self.peak_mib = self.peak_mib.max(part.peak_mib);
    }

    fn row(&self, reader: &str) -> [String; 7] {
        let seeds = self.seeds.iter().map(u64::to_string).collect::<Vec<_>>().join(", ");
        let [cases, read, refused, mib] =
            [self.cases, self.read, self.refused, self.peak_mib].map(|count| count.to_string());
        [reader.to_owned(), format!("{:.1}", self.minutes), cases, read, refused, mib, seeds]
    }
}

fn table_of(all: &BTreeMap<String, ReaderTotals>) -> String {
    let mut whole = ReaderTotals::default();
    all.values().for_each(|sum| whole.add(ReaderTotals { seeds: vec![], ..sum.clone() }));
    let least = all.values().map(|sum| sum.minutes).fold(f64::INFINITY, f64::min);
    let done = all.values().filter(|sum| sum.minutes >= GOAL_MINUTES).count();
    let columns = ["reader", "processor minutes", "cases", "read", "refused", "most memory, MiB", "seeds"];
    let table = markdown_table(&columns, all.iter().map(|(reader, sum)| sum.row(reader)));
    format!(
        "{} readers, {} cases, {:.0} processor minutes;\n\
         the least of a reader is {least:.1} minutes, and {done} of {} have the \
         {GOAL_MINUTES} minutes that are the goal.\n\n{table}",
        all.len(),
        whole.cases,
        whole.minutes,
        all.len()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_several_runs_add_up_by_reader() {
        let text =
            format!("{COLUMNS}\nfcd,2,10,4,6,1.5000,30\nobj,1,5,5,0,0.2500,20\nfcd,1,10,1,9,0.5000,40\n");
        let all = sums(Path::new(LEDGER), &text).unwrap();
        let fcd =
            ReaderTotals { seeds: vec![1, 2], cases: 20, read: 5, refused: 15, minutes: 2.0, peak_mib: 40 };
        assert_eq!((all.len(), &all["fcd"]), (2, &fcd));
        assert_eq!(fcd.row("fcd"), ["fcd", "2.0", "20", "5", "15", "40", "1, 2"]);
    }

    #[test]
    fn what_is_no_line_of_a_log_is_refused_with_its_number() {
        let log = Path::new("fuzz.log");
        for (bad, rule) in [
            ("fcd,2,10,4,6,1.5\n", "fuzz.log: line 2"),
            ("fcd,2,10,4,7,1.5,30\n", "fuzz.log: line 2"),
            ("fcd,2,10,4,6,nan,30\n", "fuzz.log: line 2"),
        ] {
            let told = sums(log, &format!("{COLUMNS}\n{bad}")).unwrap_err().to_string();
            assert!(told.contains(rule), "{told}");
        }
        assert!(sums(log, "fcd,2,10,4,6,1.5,30\n").is_err(), "the head is missing");
    }
}
