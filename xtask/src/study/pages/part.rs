//! Part of a page that a study makes: tables that grow row by row, heard as they do.

use wayside::program::terminal;

/// Lines of Markdown.
#[derive(Debug, Default)]
pub(crate) struct Part {
    text: String,
    /// Sentence on figures that are not as they have to be.
    complaint: Option<String>,
}

impl Part {
    /// Adds a line, or several.
    pub(super) fn line(&mut self, line: impl std::fmt::Display) {
        let line = line.to_string();
        terminal::lines(&line);
        self.text += &line;
        self.text.push('\n');
    }

    /// Adds a table's head.
    pub(super) fn head(&mut self, columns: &[&str]) {
        self.line(format!("| {} |\n|{}", columns.join(" | "), "---|".repeat(columns.len())));
    }

    /// Adds a table's row.
    pub(super) fn row(&mut self, cells: &[String]) {
        self.line(format!("| {} |", cells.join(" | ")));
    }

    /// The study ends with this sentence once the page is written.
    pub(super) fn complain(&mut self, sentence: String) {
        self.complaint = Some(sentence);
    }

    /// All lines, and what is wrong with them.
    pub(crate) fn finished(self) -> (String, Option<String>) {
        (self.text, self.complaint)
    }
}
