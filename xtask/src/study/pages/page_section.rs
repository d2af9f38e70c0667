//! Section of a page made by a study: tables that grow row by row and are printed as they do.

use wayside::program::terminal;

/// Lines of Markdown.
#[derive(Debug, Default)]
pub(crate) struct PageSection {
    text: String,
    /// Sentence about figures that violate their requirements.
    complaint: Option<String>,
}

impl PageSection {
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

    /// Adds a table's row that begins with a name.
    pub(super) fn named_row(&mut self, name: &str, cells: impl IntoIterator<Item = String>) {
        self.row(&std::iter::once(name.to_owned()).chain(cells).collect::<Vec<_>>());
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

/// A number with so many decimals, in a cell.
pub(super) fn figure(value: f64, decimals: usize) -> String {
    format!("{value:.decimals$}").replace('-', "−")
}

/// A number in a cell; a dash where there is none.
pub(super) fn figure_or_dash(value: Option<f64>, decimals: usize) -> String {
    value.map_or("–".to_owned(), |value| figure(value, decimals))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_have_minus_signs_and_dashes() {
        assert_eq!([figure(-22.94, 1), figure_or_dash(None, 1)], ["−22.9", "–"]);
        let mut part = PageSection::default();
        part.head(&["scene", "error, dB"]);
        part.named_row("street", [figure_or_dash(Some(-14.66), 1)]);
        assert_eq!(part.finished().0, "| scene | error, dB |\n|---|---|\n| street | −14.7 |\n");
    }
}
