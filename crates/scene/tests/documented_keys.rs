//! `docs/scenes.md` and `docs/scene.schema.json` are what the keys of scenes say; vehicles, street furniture
//! and substances stand in their pages.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use std::path::Path;

/// A file of the project's pages; `None`, and that is said, where they are not there.
fn page(name: &str) -> Option<String> {
    let page = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(name));
    if page.is_err() {
        println!("left out: docs/{name} is not there");
    }
    page.ok()
}

#[test]
fn the_page_has_the_table_of_every_key() {
    let Some(page) = page("scenes.md") else { return };
    for table in scene::keys::TABLES {
        assert!(page.contains(&scene::keys::mark(table)), "{}", scene::keys::mark(table));
    }
    let renewed = scene::keys::with_tables(&page);
    for (written, made) in page.lines().zip(renewed.lines()) {
        assert_eq!(written, made, "`cargo xtask scene-keys` makes it anew");
    }
    assert_eq!(page, renewed);
}

#[test]
fn the_schema_is_that_of_the_keys() {
    let Some(page) = page("scene.schema.json") else { return };
    let made = format!("{:#}\n", scene::keys::json_schema());
    for (written, made) in page.lines().zip(made.lines()) {
        assert_eq!(written, made, "`cargo xtask scene-keys` makes it anew");
    }
    assert_eq!(page, made);
}

#[test]
fn every_vehicle_and_piece_of_street_furniture_is_documented() {
    let Some(page) = page("scenes.md") else { return };
    for name in scene::vehicles::names().iter().chain(&scene::street::NAMES) {
        assert!(page.contains(&format!("`{name}`")), "{name}");
    }
}

#[test]
fn every_substance_is_documented_with_its_permittivity() {
    let Some(page) = page("materials.md") else { return };
    for s in artifact::permittivity::SUBSTANCES {
        let value = s.permittivity.map_or("conductor".into(), |e| format!("{:?} − {}j", e.re, -e.im));
        let row = format!("| `{}` | {value} | ", s.name);
        assert!(page.contains(&row), "{row}");
    }
}

/// The scene that docs/interface.md shows, as a user copies it.
fn shown_scene(page: &str) -> &str {
    let (_, behind) = page.split_once("```toml\nname = \"example\"\n").unwrap();
    behind.split_once("```").unwrap().0
}

/// Lines of a scene but for those whose values have defaults.
fn without_defaults(scene: &str) -> String {
    let mut table = "";
    let mut kept = vec![];
    for line in scene.lines() {
        if line.starts_with('[') {
            table = line.split_whitespace().next().unwrap();
        }
        if ["[noise]", "[[target]]"].contains(&table) && !line.starts_with("yaw_") {
            kept.push(line);
        }
    }
    kept.join("\n")
}

#[test]
fn the_scene_of_the_interface_is_read_and_shows_the_defaults() {
    let Some(page) = page("interface.md") else { return };
    let read = |keys: &str| {
        let text = format!("name = \"example\"\n{keys}");
        let options = scene::ReadOptions::names_only();
        scene::read_text(Path::new("interface.md"), &text, &options).unwrap()
    };
    let shown = shown_scene(&page);
    assert_eq!(read(shown), read(&without_defaults(shown)));
}
