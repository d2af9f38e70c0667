//! The ledger of searches, on their page.

use crate::study::search::differential_testing::Tally;

const HEADER: &str = "| seed | contest | cases | processor minutes | finds |\n|---|---|---|---|---|\n";

/// Rows of one search, one per differential test, and their sum.
pub(in crate::study) fn rows(seed: u64, tallies: &[Tally]) -> String {
    let row = |name: &str, cases: u64, seconds: f64, finds: &str| {
        format!("| {seed} | {name} | {cases} | {:.1} | {finds} |\n", seconds / 60.0)
    };
    let finds = |tally: &Tally| match tally.finds.as_slice() {
        [] => "none".to_owned(),
        [first, ..] => format!("{}, the first: {}", tally.finds.len(), first.replace('|', "\\|")),
    };
    let each = tallies.iter().map(|tally| row(tally.name, tally.cases, tally.seconds, &finds(tally)));
    let all = tallies.iter().fold((0, 0.0, 0), |(cases, seconds, finds), tally| {
        (cases + tally.cases, seconds + tally.seconds, finds + tally.finds.len())
    });
    each.collect::<String>() + &row("all", all.0, all.1, &all.2.to_string())
}

/// A ledger with rows appended to its own.
pub(in crate::study) fn append_rows(ledger: &str, rows: &str) -> String {
    let earlier: String = ledger
        .lines()
        .filter(|line| line.starts_with("| ") && !line.starts_with("| seed"))
        .map(|line| format!("{line}\n"))
        .collect();
    format!("{HEADER}{earlier}{rows}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_is_entered_behind_earlier_ones() {
        let tally = Tally { name: "a", cases: 3, seconds: 90.0, finds: vec!["x | y".into()] };
        let first = append_rows("none yet", &rows(1, std::slice::from_ref(&tally)));
        assert_eq!(first.lines().nth(2), Some("| 1 | a | 3 | 1.5 | 1, the first: x \\| y |"));
        let second = append_rows(&first, &rows(2, &[tally]));
        assert_eq!(second.lines().count(), 6);
        assert!(second.starts_with(&first));
    }
}
