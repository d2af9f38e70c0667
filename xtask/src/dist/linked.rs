//! Third-party packages that are linked into the program, with their licence files.

use crate::dist::system::{entries, output};
use crate::project::project_root;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use wayside::host::failure::Failure;

/// A third-party package.
pub(super) struct LinkedPackage {
    /// Name and version.
    pub(super) name: String,
    /// Licence as an SPDX expression.
    pub(super) expression: String,
    /// Files that its licences require to be distributed.
    pub(super) licences: Vec<PathBuf>,
}

/// Beginnings of the names of licence files, in capitals.
const LICENCES: [&str; 5] = ["LICENSE", "LICENCE", "COPYING", "NOTICE", "UNLICENSE"];

/// Third-party packages that a package of the project with some features depends on for a platform, in the
/// order of their names.
pub(super) fn linked_packages(
    target: &str,
    [package, features]: [&str; 2],
) -> Result<Vec<LinkedPackage>, Failure> {
    let mut cargo = Command::new("cargo");
    cargo.args(["metadata", "--format-version", "1", "--locked", "--filter-platform", target]);
    cargo
        .args(["--features", features, "--manifest-path"])
        .arg(project_root().join(format!("crates/{package}/Cargo.toml")));
    let metadata: Value = serde_json::from_slice(&output(&mut cargo)?).map_err(Failure::refused)?;
    let linked = linked_ids(&metadata);
    let is_linked = |package: &&Value| package["id"].as_str().is_some_and(|id| linked.contains(id));
    let is_of_others = |package: &&Value| !package["source"].is_null();
    let packages = metadata["packages"].as_array().into_iter().flatten();
    let mut of_others: Vec<LinkedPackage> =
        packages.filter(is_linked).filter(is_of_others).map(linked_package).collect::<Result<_, _>>()?;
    of_others.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(of_others)
}

fn linked_package(package: &Value) -> Result<LinkedPackage, Failure> {
    let text = |key: &str| package[key].as_str().unwrap_or_default();
    let folder = Path::new(text("manifest_path")).parent().unwrap_or(Path::new("."));
    let mut licences = entries(folder)?;
    licences.retain(|file| file.is_file() && is_licence(file));
    let name = format!("{}-{}", text("name"), text("version"));
    Ok(LinkedPackage { name, expression: text("license").to_owned(), licences })
}

fn is_licence(file: &Path) -> bool {
    let name = file.file_name().unwrap_or_default().to_string_lossy().to_uppercase();
    LICENCES.iter().any(|beginning| name.starts_with(beginning))
}

/// Ids of packages linked into `wayside`, without those only for tests or the build.
fn linked_ids(metadata: &Value) -> BTreeSet<&str> {
    let nodes = || metadata["resolve"]["nodes"].as_array().into_iter().flatten();
    let mut linked = BTreeSet::new();
    let mut open: Vec<&str> = metadata["resolve"]["root"].as_str().into_iter().collect();
    while let Some(id) = open.pop() {
        if linked.insert(id) {
            let of_node = nodes().filter(|node| node["id"] == id).flat_map(|node| node["deps"].as_array());
            open.extend(of_node.flatten().filter(|dep| is_normal(dep)).filter_map(|dep| dep["pkg"].as_str()));
        }
    }
    linked
}

fn is_normal(dependency: &Value) -> bool {
    dependency["dep_kinds"].as_array().is_some_and(|kinds| kinds.iter().any(|kind| kind["kind"].is_null()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_is_linked_is_neither_for_tests_nor_for_the_build_alone() {
        let dep = |id: &str, kind: Value| json!({ "pkg": id, "dep_kinds": [{ "kind": kind }] });
        let metadata = json!({ "resolve": { "root": "wayside", "nodes": [
            { "id": "wayside", "deps": [dep("png", Value::Null), dep("tempfile", json!("dev"))] },
            { "id": "png", "deps": [dep("flate2", Value::Null), dep("cc", json!("build"))] },
            { "id": "flate2", "deps": [] },
        ] } });
        assert_eq!(linked_ids(&metadata).into_iter().collect::<Vec<_>>(), ["flate2", "png", "wayside"]);
    }

    #[test]
    fn files_of_licences_are_known_by_their_names() {
        for (name, expected) in [
            ("LICENSE-MIT", true),
            ("license.txt", true),
            ("COPYING", true),
            ("Notice.md", true),
            ("lib.rs", false),
        ] {
            assert_eq!(is_licence(Path::new(name)), expected, "{name}");
        }
    }
}
