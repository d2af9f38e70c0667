//! The tables of `docs/scenes.md`.

use crate::document::keys::TABLES;
use crate::document::keys::key::Table;

const END: &str = "<!-- end of keys -->";

/// The keys of a table as Markdown: a row for each, or one for neighbours with the same description.
pub fn markdown(table: &Table) -> String {
    let mut rows: Vec<(Vec<String>, [String; 3])> = Vec::new();
    for key in table.keys {
        let (name, cells) = (format!("`{}`", key.name()), key.cells());
        match rows.last_mut() {
            Some((names, last)) if *last == cells => names.push(name),
            _ => rows.push((vec![name], cells)),
        }
    }
    let row = |(names, cells): &(Vec<String>, [String; 3])| {
        format!("| {} | {} |\n", names.join(", "), cells.join(" | ")).replace("|  |", "| |")
    };
    let rows: String = rows.iter().map(row).collect();
    format!("| key | default | allowed | meaning |\n|---|---|---|---|\n{rows}")
}

/// The page with its tables renewed, each between the mark of its heading and the next end. Tables without a
/// mark are left out.
pub fn with_tables(page: &str) -> String {
    let renewed = |page: String, table: &Table| {
        let mark = mark(table);
        let parts = page.split_once(&mark).and_then(|(before, rest)| Some((before, rest.split_once(END)?.1)));
        match parts {
            Some((before, after)) => format!("{before}{mark}\n\n{}\n{END}{after}", markdown(table)),
            None => page,
        }
    };
    TABLES.iter().fold(page.to_owned(), renewed)
}

/// The mark before a table of the page.
pub fn mark(table: &Table) -> String {
    format!("<!-- keys of {} -->", table.heading)
}
