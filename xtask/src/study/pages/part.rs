//! Part of a page made by a study: tables that grow row by row and are printed as they do.

use wayside::program::terminal;

/// Lines of Markdown.
#[derive(Debug, Default)]
pub(crate) struct Part {
    text: String,
    /// Sentence about figures that violate their requirements.
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

    /// Makes the study fail with this sentence once the page is written.
    pub(super) fn complain(&mut self, sentence: String) {
        self.complaint = Some(sentence);
    }

    /// All lines, and the complaint.
    pub(crate) fn finished(self) -> (String, Option<String>) {
        (self.text, self.complaint)
    }
}
