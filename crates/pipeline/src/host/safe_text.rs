//! User texts made safe to display: no character of a name moves a cursor, begins a line or ends a table's
//! cell.

use std::borrow::Cow;

/// Makes a text one line; control characters and those that change the direction of writing become escapes.
pub fn in_a_line(text: &str) -> Cow<'_, str> {
    escaped(text, is_hidden)
}

/// Escapes the same characters in each of several lines, except tabs.
pub fn in_lines(text: &str) -> Cow<'_, str> {
    escaped(text, |sign| is_hidden(sign) && !matches!(sign, '\n' | '\t'))
}

/// Escapes a text for a line or a table's cell of Markdown: marks of tables and of HTML too.
pub fn in_markdown(text: &str) -> Cow<'_, str> {
    let shown = in_a_line(text);
    if !shown.contains(['|', '<']) {
        return shown;
    }
    shown.replace('|', "\\|").replace('<', "&lt;").into()
}

/// A table of Markdown from its columns and rows; cells must be escaped already.
pub fn markdown_table<H: AsRef<str>, C: AsRef<str>>(
    columns: &[H],
    rows: impl IntoIterator<Item = impl AsRef<[C]>>,
) -> String {
    let head = format!("{}|{}\n", markdown_row(columns), "---|".repeat(columns.len()));
    rows.into_iter().fold(head, |table, row| table + &markdown_row(row.as_ref()))
}

/// A row of such a table; an empty cell is one blank wide.
pub fn markdown_row<C: AsRef<str>>(cells: &[C]) -> String {
    let cell = |cell: &C| match cell.as_ref() {
        "" => " |".to_owned(),
        shown => format!(" {shown} |"),
    };
    format!("|{}\n", cells.iter().map(cell).collect::<String>())
}

/// Quotes a CSV cell (RFC 4180) where it contains separators.
pub fn in_csv(text: &str) -> Cow<'_, str> {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")).into(),
        false => text.into(),
    }
}

/// Escapes the same characters in JSON by JSON escapes: its texts keep their values.
pub fn in_json(json: &str) -> Cow<'_, str> {
    match json.contains(is_hidden) {
        true => json.chars().map(of_json).collect::<String>().into(),
        false => json.into(),
    }
}

fn of_json(sign: char) -> String {
    if is_hidden(sign) { format!("\\u{:04x}", u32::from(sign)) } else { sign.into() }
}

fn is_hidden(sign: char) -> bool {
    sign.is_control()
        || matches!(sign, '\u{2028}' | '\u{2029}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

fn escaped(text: &str, is_escaped: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_escaped) {
        return text.into();
    }
    let mut shown = String::with_capacity(text.len() + 8);
    for sign in text.chars() {
        match is_escaped(sign) {
            true => shown.extend(sign.escape_default()),
            false => shown.push(sign),
        }
    }
    shown.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn controls_are_shown_as_escapes_and_all_else_as_it_is() {
        assert_eq!(in_a_line("a\u{1b}[31mb\n\u{7}é\t\u{202e}"), "a\\u{1b}[31mb\\n\\u{7}é\\t\\u{202e}");
        assert_eq!(in_lines("a\u{1b}\nb\tc\r"), "a\\u{1b}\nb\tc\\r");
        assert_eq!(in_markdown("a|b\n<i>"), "a\\|b\\n&lt;i>");
        assert_eq!(in_json("\"a\u{85}\u{202e}\""), "\"a\\u0085\\u202e\"");
        assert!(matches!(in_markdown("a folder, 30 °"), Cow::Borrowed(_)));
    }

    #[test]
    fn a_table_of_markdown_has_as_many_cells_in_each_of_its_lines() {
        let rows = [["car".to_owned(), String::new()], ["bus".to_owned(), "2".to_owned()]];
        let expected = "| class | number |\n|---|---|\n| car | |\n| bus | 2 |\n";
        assert_eq!(markdown_table(&["class", "number"], rows), expected);
    }

    #[test]
    fn a_text_with_commas_quotes_and_ends_of_lines_stays_one_cell() {
        let shown = ["car-1", "a,b \"x\"", "a\rb", ""].map(in_csv);
        assert_eq!(shown, ["car-1", "\"a,b \"\"x\"\"\"", "\"a\rb\"", ""]);
    }
}
