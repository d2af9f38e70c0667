//! Parts of a report, which stand on a page (HTML) and in a text (Markdown) alike.

use maud::{Markup, html};
use reporting::report::scrolled;

/// Columns of a text's lines.
const COLUMNS: usize = 110;

/// A part of a report.
pub(crate) enum Block {
    Heading(String),
    Words(String),
    /// Name, head and rows.
    Table(String, Vec<String>, Vec<Vec<String>>),
}

/// All parts as Markdown.
pub(crate) fn markdown(blocks: &[Block]) -> String {
    blocks.iter().map(block_in_text).collect::<Vec<_>>().join("\n")
}

fn block_in_text(block: &Block) -> String {
    match block {
        Block::Heading(words) => format!("## {words}\n"),
        Block::Words(words) => wrapped(words),
        Block::Table(_, head, rows) => {
            let line = |cells: &Vec<String>| format!("| {} |\n", cells.join(" | ").replace('\n', " "));
            let rule = format!("|{}\n", "---|".repeat(head.len()));
            line(head) + &rule + &rows.iter().map(line).collect::<String>()
        }
    }
}

/// Words in lines that fit.
fn wrapped(words: &str) -> String {
    let (mut text, mut column) = (String::new(), 0);
    for word in words.split_whitespace() {
        let wide = word.chars().count();
        if column > 0 {
            let is_full = column + 1 + wide > COLUMNS;
            text.push(if is_full { '\n' } else { ' ' });
            column = if is_full { 0 } else { column + 1 };
        }
        text.push_str(word);
        column += wide;
    }
    text + "\n"
}

/// A part on a page.
pub(crate) fn on_page(block: &Block) -> Markup {
    match block {
        Block::Heading(words) => html! { h2 { (words) } },
        Block::Words(words) => html! { p { (words) } },
        Block::Table(name, head, rows) => scrolled(
            name,
            html! { table {
                thead { tr { @for cell in head { th.words { (cell) } } } }
                tbody { @for row in rows { tr { @for cell in row { td.words { (cell) } } } } }
            } },
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_broken_into_lines_that_fit_and_none_is_lost() {
        let words = "choose the cheapest of them ".repeat(20);
        let text = wrapped(&words);
        assert!(text.lines().all(|line| line.chars().count() <= COLUMNS), "{text}");
        assert_eq!(text.split_whitespace().collect::<Vec<_>>(), words.split_whitespace().collect::<Vec<_>>());
    }
}
