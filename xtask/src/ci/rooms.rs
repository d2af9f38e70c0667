//! The room rule: a room of a crate uses only rooms before it in its `lib.rs`, except in tests. So the crate
//! can be read from the first room on, and no two rooms depend on each other. `docs/architecture.md` lists
//! the rooms like `lib.rs`.

use crate::ci::findings::{fail_on, read};
use crate::house::{self, folders};
use crate::project::project_root;
use std::path::{Path, PathBuf};
use wayside::host::failure::Failure;

pub(super) fn check() -> Result<(), Failure> {
    let mut broken = Vec::new();
    let page = read(&project_root().join("docs/architecture.md"))?;
    for folder in house::crates(&project_root())? {
        let source = folder.join("src");
        // A program has only a `main.rs`.
        if source.join("lib.rs").is_file() {
            broken.extend(violations_in(&source)?);
            let rooms = rooms(&read(&source.join("lib.rs"))?);
            broken.extend(difference_from_page(&page, &house::crate_name(&folder), &rooms));
        }
    }
    fail_on(broken)
}

/// A sentence if the page's table of rooms differs from a crate's rooms or their order.
fn difference_from_page(page: &str, name: &str, rooms: &[String]) -> Option<String> {
    let row = page.lines().find_map(|line| line.strip_prefix(&format!("| `{name}` | `")))?;
    let told = row.trim_end_matches(" |").trim_end_matches('`').split("`, `");
    let is_same = told.clone().eq(rooms.iter().map(String::as_str));
    let told = || told.collect::<Vec<_>>().join(", ");
    (!is_same).then(|| {
        format!("docs/architecture.md: the rooms of `{name}` are {}, not {}", rooms.join(", "), told())
    })
}

fn violations_in(source: &Path) -> Result<Vec<String>, Failure> {
    let rooms = rooms(&read(&source.join("lib.rs"))?);
    let mut broken = Vec::new();
    for (index, room) in rooms.iter().enumerate() {
        for file in files(source, room) {
            broken.extend(forbidden(&file, &read(&file)?, &rooms[..=index]));
        }
    }
    Ok(broken)
}

/// Modules in the order of a `lib.rs`.
fn rooms(lib: &str) -> Vec<String> {
    let name = |line: &str| {
        let line = line.strip_prefix("pub ").unwrap_or(line);
        line.strip_prefix("mod ")?.split_once(';').map(|(name, _)| name.to_owned())
    };
    code(lib).filter_map(|(_, line)| name(line)).collect()
}

/// A room's own file and those in its folder, in a fixed order.
fn files(source: &Path, room: &str) -> Vec<PathBuf> {
    let own = source.join(format!("{room}.rs"));
    std::iter::once(own).chain(folders::sources(&source.join(room))).collect()
}

/// A sentence for each use of a room that is not in `known`, which ends with the file's own room.
fn forbidden(file: &Path, text: &str, known: &[String]) -> Vec<String> {
    let own = known.last().map_or("", String::as_str);
    let used = code(text)
        .flat_map(|(number, line)| line.split("crate::").skip(1).map(move |rest| (number, first_word(rest))));
    let strange = used.filter(|(_, name)| !known.iter().any(|room| room == name));
    let sentence = |(number, name): (usize, &str)| {
        format!(
            "{}:{number}: `{own}` uses `crate::{name}`, which is no room before it in lib.rs",
            file.display()
        )
    };
    strange.map(sentence).collect()
}

/// Numbered lines without comments, up to the module of tests.
fn code(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let is_test = |(line, next): &(&str, &str)| *line == "#[cfg(test)]" && next.contains("mod ");
    let pairs = text.lines().zip(text.lines().skip(1).chain([""]));
    let lines = (1..).zip(pairs).take_while(move |(_, pair)| !is_test(pair));
    lines.map(|(number, (line, _))| (number, line)).filter(|(_, line)| !line.trim_start().starts_with("//"))
}

fn first_word(text: &str) -> &str {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_lists_the_rooms_in_their_order() {
        let page = "| crate | rooms |\n| `dsp` | `windows`, `maps` |\n| `echo` | below |";
        let told = |name: &str, rooms: [&str; 2]| difference_from_page(page, name, &rooms.map(str::to_owned));
        assert_eq!(told("dsp", ["windows", "maps"]), None);
        assert_eq!(told("echo", ["sums", "links"]), None);
        let sentence = "docs/architecture.md: the rooms of `dsp` are maps, windows, not windows, maps";
        assert_eq!(told("dsp", ["maps", "windows"]).as_deref(), Some(sentence));
    }

    #[test]
    fn rooms_use_only_rooms_before_them() {
        check().unwrap();
    }

    #[test]
    fn a_room_that_looks_ahead_is_named_with_its_line() {
        let known = rooms(
            "//! mod told;\nmod mesh; // what belongs together\npub mod beams;\n#[cfg(test)]\nmod tests;\n",
        );
        assert_eq!(known, ["mesh", "beams"]);
        let text = "use crate::mesh::patch::Patches;\n// crate::beams may be told of\nuse crate::beams::beam::Beam;\n#[cfg(test)]\nmod tests {\nuse crate::table::rcs;\n";
        let found = forbidden(Path::new("mesh/a.rs"), text, &known[..1]);
        assert_eq!(found, ["mesh/a.rs:3: `mesh` uses `crate::beams`, which is no room before it in lib.rs"]);
        assert!(forbidden(Path::new("beams/a.rs"), text, &known).is_empty());
        assert_eq!(
            forbidden(Path::new("beams/a.rs"), "use crate::World;\n", &known).len(),
            1,
            "by its room, not by the front door"
        );
    }
}
