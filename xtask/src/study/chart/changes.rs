//! Changes since an earlier table: errors to their last digit, seconds beyond noise.

use crate::study::table::{Table, TableRow};

/// Range of the ratios of processor seconds of two runs of the same work, under other load.
const NOISE: [f64; 2] = [0.7, 1.4];

/// A line for each setting whose error or seconds changed, or that is in only one of the tables.
pub(in crate::study) fn changes(before: &Table, now: &Table) -> Vec<String> {
    let mut lines: Vec<String> = now.rows().filter_map(|row| change(before, &row)).collect();
    let is_gone = |row: &TableRow| now.rows().all(|other| key(&other) != key(row));
    lines.extend(before.rows().filter(is_gone).map(|row| format!("{}: no longer there", named(&row))));
    lines
}

fn key<'t>(row: &TableRow<'t>) -> [&'t str; 3] {
    ["scene", "method", "setting"].map(|column| row.word(column))
}

fn named(row: &TableRow) -> String {
    key(row).join(" · ")
}

fn change(before: &Table, row: &TableRow) -> Option<String> {
    let Some(old) = before.rows().find(|old| key(old) == key(row)) else {
        return Some(format!("{}: new", named(row)));
    };
    let [error, old_error] = [row, &old].map(|row| row.word("error_db"));
    let ratio = row.number("processor_s") / old.number("processor_s");
    let error = (error != old_error).then(|| format!("error {old_error} → {error} dB"));
    let is_noise = ratio.is_nan() || (NOISE[0]..=NOISE[1]).contains(&ratio);
    let seconds = (!is_noise).then(|| format!("processor seconds × {ratio:.2}"));
    let told: Vec<String> = error.into_iter().chain(seconds).collect();
    (!told.is_empty()).then(|| format!("{}: {}", named(row), told.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_told_to_their_last_digit_and_seconds_beyond_noise() {
        let table = |rows: &str| {
            Table::read(&format!("scene,method,setting,error_db,processor_s\n{rows}"), &["scene"]).unwrap()
        };
        let before = table("a,b,1,-20.0,1.0\na,b,2,-30.0,2.0\na,b,3,-40.0,4.0\n");
        let now = table("a,b,1,-20.0,1.2\na,b,2,-29.9,3.0\na,b,4,-40.0,4.0\n");
        assert_eq!(
            changes(&before, &now),
            [
                "a · b · 2: error -30.0 → -29.9 dB, processor seconds × 1.50",
                "a · b · 4: new",
                "a · b · 3: no longer there"
            ]
        );
        assert!(changes(&now, &now).is_empty());
    }
}
