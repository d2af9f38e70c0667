//! Parts of a report, common to a page (HTML) and a text (Markdown).

use maud::{Markup, html};
use pipeline::host::safe_text::{in_markdown, markdown_table};
use reporting::report::scrolled;

/// Columns of the text's lines.
const COLUMNS: usize = 110;

/// A part of a report.
pub(crate) enum Block {
    Heading(String),
    Paragraph(String),
    /// Name, head and rows.
    Table(String, Vec<String>, Vec<Vec<String>>),
}

/// All parts as Markdown.
pub(crate) fn markdown(blocks: &[Block]) -> String {
    blocks.iter().map(block_in_text).collect::<Vec<_>>().join("\n")
}

fn block_in_text(block: &Block) -> String {
    match block {
        Block::Heading(words) => format!("## {}\n", in_markdown(words)),
        Block::Paragraph(words) => wrapped(&in_markdown(words)),
        Block::Table(_, head, rows) => {
            let cells = |line: &Vec<String>| {
                line.iter().map(|cell| in_markdown(cell).into_owned()).collect::<Vec<_>>()
            };
            markdown_table(&cells(head), rows.iter().map(cells))
        }
    }
}

/// Wraps words into lines.
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
        Block::Paragraph(words) => html! { p { (words) } },
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
    fn a_name_neither_ends_a_cell_of_a_text_nor_moves_a_cursor() {
        let table = Block::Table("t".into(), vec!["a|b".into()], vec![vec!["c\u{1b}[31m\n<i>".into()]]);
        let expected = "| a\\|b |\n|---|\n| c\\u{1b}[31m\\n&lt;i> |\n";
        assert_eq!(markdown(&[table]), expected);
        assert_eq!(markdown(&[Block::Heading("By \u{7}".into())]), "## By \\u{7}\n");
    }

    #[test]
    fn words_are_broken_into_lines_that_fit_and_none_is_lost() {
        let words = "choose the cheapest of them ".repeat(20);
        let text = wrapped(&words);
        assert!(text.lines().all(|line| line.chars().count() <= COLUMNS), "{text}");
        assert_eq!(text.split_whitespace().collect::<Vec<_>>(), words.split_whitespace().collect::<Vec<_>>());
    }
}
