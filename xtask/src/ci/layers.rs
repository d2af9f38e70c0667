//! The layer rule: stages depend on `artifact` and never on each other; only `xtask` links them. What teaches a stage may see it.

use crate::project::project_root;
use std::process::Command;
use wayside::host::failure::Failure;

/// Dependencies between crates of the workspace, development and build dependencies included.
pub(super) fn check() -> Result<(), Failure> {
    let arguments = ["metadata", "--no-deps", "--format-version", "1", "--offline"];
    let output = Command::new("cargo").args(arguments).current_dir(project_root()).output();
    let output = output.map_err(|e| Failure::System(format!("cargo metadata: {e}")))?;
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).map_err(Failure::refused)?;
    match forbidden(&edges(&metadata)).as_slice() {
        [] => Ok(()),
        broken => Err(Failure::Refused(broken.join("\n"))),
    }
}

/// (from, to) of every dependency between crates of the workspace.
fn edges(metadata: &serde_json::Value) -> Vec<(String, String)> {
    let packages = metadata["packages"].as_array().cloned().unwrap_or_default();
    let name = |value: &serde_json::Value| value["name"].as_str().unwrap_or_default().to_owned();
    let own: Vec<String> = packages.iter().map(name).collect();
    let of = |package: &serde_json::Value| {
        let from = name(package);
        let on: Vec<String> = package["dependencies"].as_array().into_iter().flatten().map(name).collect();
        on.into_iter().map(move |to| (from.clone(), to)).collect::<Vec<_>>()
    };
    packages.iter().flat_map(of).filter(|(_, to)| own.contains(to)).collect()
}

/// A sentence for each edge that breaks the rule.
fn forbidden(edges: &[(String, String)]) -> Vec<String> {
    let teaches = |from: &str, to: &str| from == "classifier-training" && to == "classifier";
    let broken = |(from, to): &&(String, String)| from != "xtask" && to != "artifact" && !teaches(from, to);
    edges.iter().filter(broken).map(|(from, to)| format!("{from} → {to}: pass an artifact instead")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn stages_meet_only_in_artifacts() {
        check().unwrap();
    }

    #[test]
    fn an_edge_between_stages_is_forbidden_even_for_their_tests() {
        let metadata = json!({ "packages": [
            { "name": "xtask", "dependencies": [{ "name": "dsp" }, { "name": "scene" }] },
            { "name": "dsp", "dependencies": [{ "name": "artifact" }, { "name": "fmcw-echo", "kind": "dev" }] },
            { "name": "fmcw-echo", "dependencies": [{ "name": "rayon" }] },
            { "name": "artifact", "dependencies": [{ "name": "scene", "kind": "build" }] },
            { "name": "scene", "dependencies": [] },
        ] });
        let found = forbidden(&edges(&metadata));
        assert_eq!(found, ["dsp → fmcw-echo: pass an artifact instead", "artifact → scene: pass an artifact instead"]);
    }
}
