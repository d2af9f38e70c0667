//! Rows as CSV, as a table of a page, and read again for drawing.

use artifact::units::db_from_amplitude;
use wayside::host::safe_text::in_csv;

/// Lines of fields, quoted where they must be.
pub(super) fn csv(header: &str, rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut text = format!("{header}\n");
    for row in rows {
        text += &row.iter().map(|field| in_csv(field)).collect::<Vec<_>>().join(",");
        text.push('\n');
    }
    text
}

/// A table in the format of [`csv`], from which pictures can be redrawn without computing.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// Reason why a table cannot be drawn.
#[derive(Debug, thiserror::Error, PartialEq)]
pub(super) enum TableError {
    #[error("has no column `{0}`")]
    NoColumn(&'static str),
    #[error("line {line}: has {found} fields, the header {columns}")]
    Fields { line: usize, found: usize, columns: usize },
}

impl Table {
    /// Reads a table that has at least these columns; quoted line breaks are not supported.
    pub(super) fn read(text: &str, columns: &[&'static str]) -> Result<Self, TableError> {
        let mut lines = text.lines().map(fields);
        let table = Self { columns: lines.next().unwrap_or_default(), rows: lines.collect() };
        if let Some(missing) = columns.iter().find(|name| table.place(name).is_none()) {
            return Err(TableError::NoColumn(missing));
        }
        let columns = table.columns.len();
        match table.rows.iter().position(|row| row.len() != columns) {
            Some(i) => Err(TableError::Fields { line: i + 2, found: table.rows[i].len(), columns }),
            None => Ok(table),
        }
    }

    fn place(&self, column: &str) -> Option<usize> {
        self.columns.iter().position(|name| name == column)
    }

    /// Rows as the contents of their columns; a missing column is empty.
    pub(super) fn rows(&self) -> impl Iterator<Item = TableRow<'_>> {
        self.rows.iter().map(|fields| TableRow { table: self, fields })
    }
}

/// A row of a table.
#[derive(Debug, Clone, Copy)]
pub(super) struct TableRow<'t> {
    table: &'t Table,
    fields: &'t [String],
}

impl<'t> TableRow<'t> {
    pub(super) fn word(&self, column: &str) -> &'t str {
        self.table.place(column).and_then(|i| self.fields.get(i)).map_or("", String::as_str)
    }

    /// The number in a column; NaN if there is none.
    pub(super) fn number(&self, column: &str) -> f64 {
        self.word(column).parse().unwrap_or(f64::NAN)
    }
}

/// Fields of a line.
fn fields(line: &str) -> Vec<String> {
    let (mut fields, mut is_quoted) = (vec![String::new()], false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        let field = fields.len() - 1;
        match letter {
            '"' if is_quoted && letters.peek() == Some(&'"') => {
                letters.next();
                fields[field].push('"');
            }
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => fields.push(String::new()),
            other => fields[field].push(other),
        }
    }
    fields
}

/// A table of a page.
pub(super) fn markdown(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let line = |fields: &[String]| format!("| {} |\n", fields.join(" | "));
    let mut text = line(&header.iter().map(|h| (*h).to_owned()).collect::<Vec<_>>());
    text += &line(&vec!["---".to_owned(); header.len()]);
    rows.for_each(|row| text += &line(&row.iter().map(|f| f.replace('|', "\\|")).collect::<Vec<_>>()));
    text
}

/// An amplitude error in dB with one decimal; empty for `None`, and NaN is never a small number.
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
    fn a_field_with_a_comma_or_a_quote_stays_one_field_and_is_read_again() {
        let rows = [vec!["a, \"b\"".to_owned(), "c".to_owned()]].into_iter();
        let text = csv("x,y", rows);
        assert_eq!(text, "x,y\n\"a, \"\"b\"\"\",c\n");
        let table = Table::read(&text, &["x", "y"]).unwrap();
        assert_eq!(
            table.rows().map(|row| (row.word("x"), row.word("y"))).collect::<Vec<_>>(),
            [("a, \"b\"", "c")]
        );
    }

    #[test]
    fn a_table_of_something_else_is_refused() {
        assert_eq!(Table::read("x,y\n1,2\n", &["seconds"]), Err(TableError::NoColumn("seconds")));
        let expected = TableError::Fields { line: 3, found: 1, columns: 2 };
        assert_eq!(Table::read("x,y\n1,2\n3\n", &["x"]), Err(expected));
    }
}
