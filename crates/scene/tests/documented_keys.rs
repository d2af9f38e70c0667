//! `docs/scenes.md` and the reader know the same keys.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use std::collections::BTreeSet;

const PAGE: &str = include_str!("../../../docs/scenes.md");

/// Keys of a section: what stands between backticks in the first column of tables headed `key`.
fn documented_keys(heading: &str) -> BTreeSet<String> {
    let section = PAGE.split("\n## ").find(|section| section.lines().next() == Some(heading));
    let lines = section.unwrap_or_else(|| panic!("no section `{heading}`")).lines();
    let table = lines
        .skip_while(|line| !line.starts_with("| key |"))
        .skip(2)
        .take_while(|line| line.starts_with('|'));
    let first_columns = table.filter_map(|line| line.split('|').nth(1));
    first_columns.flat_map(|column| column.split('`').skip(1).step_by(2).map(str::to_owned)).collect()
}

#[test]
fn every_key_of_a_scene_is_documented_and_every_documented_key_is_known() {
    for table in scene::TABLES {
        let heading = if table.name.is_empty() { "The beginning of the file" } else { table.heading };
        let known: BTreeSet<String> = table.keys.iter().map(|key| (*key).to_owned()).collect();
        assert_eq!(documented_keys(heading), known, "{heading}");
    }
}

#[test]
fn every_vehicle_and_piece_of_street_furniture_is_documented() {
    for name in scene::vehicles::names().iter().chain(&scene::street::NAMES) {
        assert!(PAGE.contains(&format!("`{name}`")), "{name}");
    }
}

#[test]
fn every_substance_is_documented_with_its_permittivity() {
    const MATERIALS: &str = include_str!("../../../docs/materials.md");
    for s in artifact::permittivity::SUBSTANCES {
        let value = s.permittivity.map_or("conductor".into(), |e| format!("{:?} − {}j", e.re, -e.im));
        let row = format!("| `{}` | {value} | ", s.name);
        assert!(MATERIALS.contains(&row), "{row}");
    }
}
