//! Compared runs: every scene, and ten tables that together cover every method, polarization, surface and
//! kind of receiver.

use std::path::Path;
use wayside::host::failure::Failure;

/// A command; `OUT` in its arguments represents a separate folder.
pub(super) struct CommandRun {
    pub(super) name: String,
    pub(super) words: Vec<String>,
}

/// Scenes left out: a minute of traffic takes half an hour, and `traffic.toml` is the same junction.
const LEFT_OUT: [&str; 1] = ["traffic-minute"];

const TABLES: [(&str, &str); 10] = [
    ("rcs-car", "car-sedan --freq-ghz 76:77:3 --az-deg 0:90:7"),
    ("rcs-bus", "bus-city --freq-ghz 77 --az-deg 10:50:3 --pol hh --range-m 40"),
    ("rcs-truck", "truck-semi --freq-ghz 24 --az-deg 0:180:5 --bounces 2 --pol vh"),
    ("rcs-motorcycle", "motorcycle-street --freq-ghz 77 --az-deg 0:360:5 --el-deg 0:10:2"),
    ("rcs-edges", "car-hatchback --freq-ghz 10 --az-deg 0:90:5 --edges on --bounces 1"),
    ("rcs-smooth", "car-sedan --freq-ghz 77 --az-deg 5:25:3 --surface smooth --bounces 1"),
    ("rcs-bistatic", "car-suv --freq-ghz 24 --az-deg 0:40:3 --rx-az-deg 15 --rx-el-deg 2"),
    (
        "rcs-materials",
        "car-sedan --freq-ghz 77 --az-deg 30 --materials scenes/vehicles.materials.toml --transmission on",
    ),
    ("rcs-po", "motorcycle-street --freq-ghz 3 --az-deg 0:90:3 --method po --density 4"),
    ("rcs-sbr", "motorcycle-street --freq-ghz 3 --az-deg 0:90:3 --method sbr --density 4"),
];

/// Scenes in the order of their names, then tables.
pub(super) fn all(root: &Path) -> Result<Vec<CommandRun>, Failure> {
    let folder = root.join("scenes");
    let entries = std::fs::read_dir(&folder).map_err(|e| Failure::system(&folder, "read", e))?;
    let mut scenes: Vec<String> = entries.flatten().filter_map(|entry| scene(&entry.path())).collect();
    scenes.sort();
    let scenes = scenes.into_iter().map(|name| CommandRun {
        words: words(&format!("run scenes/{name}.toml --no-cache --quiet --out OUT")),
        name,
    });
    let table = |(name, text): (&str, &str)| CommandRun {
        name: name.into(),
        words: words(&format!("rcs {text} --quiet --out OUT/s.npy")),
    };
    Ok(scenes.chain(TABLES.map(table)).collect())
}

/// Name of a scene if the file is one: materials and recipes beside scenes have names of two parts.
fn scene(file: &Path) -> Option<String> {
    let name = file.file_name()?.to_str()?.strip_suffix(".toml")?;
    (!name.contains('.') && !LEFT_OUT.contains(&name)).then(|| name.to_owned())
}

fn words(text: &str) -> Vec<String> {
    text.split(' ').map(str::to_owned).collect()
}
