//! Rows as CSV and as a table of a page.

use artifact::units::db_from_amplitude;

/// Lines of fields, quoted where they must be (RFC 4180).
pub(super) fn csv(header: &str, rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut text = format!("{header}\n");
    for row in rows {
        text += &row.iter().map(|field| quoted(field)).collect::<Vec<_>>().join(",");
        text.push('\n');
    }
    text
}

fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n']) { format!("\"{}\"", field.replace('"', "\"\"")) } else { field.into() }
}

/// A table of a page.
pub(super) fn markdown(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let line = |fields: &[String]| format!("| {} |\n", fields.join(" | "));
    let mut text = line(&header.iter().map(|h| (*h).to_owned()).collect::<Vec<_>>());
    text += &line(&vec!["---".to_owned(); header.len()]);
    rows.for_each(|row| text += &line(&row.iter().map(|f| f.replace('|', "\\|")).collect::<Vec<_>>()));
    text
}

/// An amplitude error in dB with one decimal; empty where there is none, and a NaN is never a small number.
pub(super) fn decibels(error: Option<f64>) -> String {
    match error {
        None => String::new(),
        Some(e) if e.is_nan() => "nan".into(),
        Some(e) => format!("{:.1}", db_from_amplitude(e)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_with_a_comma_or_a_quote_stays_one_field() {
        let rows = [vec!["a, \"b\"".to_owned(), "c".to_owned()]].into_iter();
        assert_eq!(csv("x,y", rows), "x,y\n\"a, \"\"b\"\"\",c\n");
    }
}
