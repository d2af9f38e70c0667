//! Results of an earlier study, distinguished from the user's own files of these names.

use crate::runs::run_store::RunStore;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use reporting::report;
use std::path::Path;

/// Largest result: a table of a hundred million cells.
const LIMIT_BYTES: u64 = 1 << 30;

/// Whether content belongs to a study.
type IsOwn = fn(&[u8]) -> bool;

/// Results that are recognized by their content; a picture is recognized by one of them, or by kept runs,
/// beside it.
const KNOWN: [(&str, IsOwn); 4] = [
    ("sweep.csv", |table| begins(table, "design,condition,repeat,seed,")),
    ("designs.csv", |table| begins(table, "design,")),
    ("report.md", is_page),
    ("report.html", report::is_report),
];
const PICTURES: [&str; 2] = ["pareto.svg", "pareto.png"];

/// Refuses to replace files in `out` that no study left.
pub(crate) fn refuse_foreign(out: &Path) -> Result<(), Failure> {
    for (name, is_own) in KNOWN {
        files::refuse_foreign(&out.join(name), LIMIT_BYTES, |bytes| bytes.is_empty() || is_own(bytes))?;
    }
    let is_of_study =
        KNOWN.iter().any(|(name, _)| out.join(name).is_file()) || RunStore::folder_in(out).is_dir();
    let mut pictures = PICTURES.iter().filter(|_| !is_of_study);
    pictures.try_for_each(|name| files::refuse_foreign(&out.join(name), 0, |_| false))
}

fn begins(text: &[u8], head: &str) -> bool {
    text.starts_with(head.as_bytes())
}

/// Whether a text is a `report.md`: it has a heading and the picture of the front.
fn is_page(text: &[u8]) -> bool {
    let text = String::from_utf8_lossy(text);
    text.starts_with("# ") && text.contains("\n![The front](pareto.svg)\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_and_pictures_of_anybody_else_are_told_from_a_studys() {
        let out = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| std::fs::write(out.path().join(name), text).unwrap();
        write("pareto.svg", "<svg/>");
        let refused = refuse_foreign(out.path()).unwrap_err().to_string();
        assert!(refused.contains("pareto.svg: was not written by this program"), "{refused}");
        write("report.md", "# study.toml\n\nTake 3.\n\n![The front](pareto.svg)\n");
        write("sweep.csv", "design,condition,repeat,seed,chirps\n");
        refuse_foreign(out.path()).unwrap();
        for (name, text) in [("report.md", "# My thesis\n"), ("sweep.csv", "frequency,level\n")] {
            let before = std::fs::read_to_string(out.path().join(name)).unwrap();
            write(name, text);
            assert!(refuse_foreign(out.path()).is_err(), "{name}");
            write(name, &before);
        }
    }
}
