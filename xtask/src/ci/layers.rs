//! The layer rule: leaves depend on no crate of the workspace (`radar` and `bodies` only on `artifact`,
//! `po-sbr` and `interchange` on `artifact` and `radar`), stages on leaves and never on each other;
//! `pipeline` links them. The crates above it, each above the next, may also use stages and leaves:
//! `reporting`, `sweeps`, `formats` and `learning` use it and those before them, `wayside` all of these.
//! `xtask` is above it, as is `wayside-python`, which uses `wayside` and leaves. A crate that trains a stage
//! may use it.
//! `fuzzing` is only for tests, and its own tests may use all crates.

use crate::ci::findings::fail_on;
use crate::project::project_root;
use std::process::Command;
use wayside::host::failure::Failure;

/// Checks the dependencies between crates of the workspace, including development and build dependencies.
pub(super) fn check() -> Result<(), Failure> {
    let arguments = ["metadata", "--no-deps", "--format-version", "1", "--offline"];
    let output = Command::new("cargo").args(arguments).current_dir(project_root()).output();
    let output = output.map_err(|e| Failure::System(format!("cargo metadata: {e}")))?;
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).map_err(Failure::refused)?;
    fail_on(forbidden(&edges(&metadata)).into_iter().chain(untested_crates(&metadata)).collect())
}

/// Crates outside a plain `cargo test`: each has a check of its own (`training`, `osi`, `python`).
const SEPARATELY_TESTED: [&str; 3] = ["classifier-training", "interchange", "wayside-python"];

/// A sentence for each crate outside a plain `cargo test`, except those known.
fn untested_crates(metadata: &serde_json::Value) -> Vec<String> {
    let of = |list: &str| -> Vec<String> {
        let ids = metadata[list].as_array().into_iter().flatten().filter_map(|id| id.as_str());
        ids.map(str::to_owned).collect()
    };
    let known = of("workspace_default_members");
    let is_apart = |id: &String| SEPARATELY_TESTED.iter().any(|name| id.contains(&format!("/{name}#")));
    let forgotten = |id: &String| !known.contains(id) && !is_apart(id);
    let sentence = |id: String| format!("Cargo.toml: {id} is no default member: its tests would not run");
    of("workspace_members").into_iter().filter(forgotten).map(sentence).collect()
}

/// A dependency between crates of the workspace.
struct Edge {
    from: String,
    to: String,
    /// Whether only tests need it.
    is_of_tests: bool,
}

/// Every dependency between crates of the workspace.
fn edges(metadata: &serde_json::Value) -> Vec<Edge> {
    let packages = metadata["packages"].as_array().cloned().unwrap_or_default();
    let name = |value: &serde_json::Value| value["name"].as_str().unwrap_or_default().to_owned();
    let own: Vec<String> = packages.iter().map(name).collect();
    let of = |package: &serde_json::Value| {
        let from = name(package);
        let on = package["dependencies"].as_array().cloned().unwrap_or_default();
        let edge = move |on: serde_json::Value| Edge {
            from: from.clone(),
            to: name(&on),
            is_of_tests: on["kind"] == "dev",
        };
        on.into_iter().map(edge).collect::<Vec<_>>()
    };
    packages.iter().flat_map(of).filter(|edge| own.contains(&edge.to)).collect()
}

/// A sentence for each edge that breaks the rule.
fn forbidden(edges: &[Edge]) -> Vec<String> {
    const LEAVES: [&str; 6] = ["artifact", "bodies", "interchange", "plotting", "po-sbr", "radar"];
    const STAGES: [&str; 6] = ["scene", "bart-rcs", "fmcw-echo", "dsp", "classifier", "evaluation"];
    /// Crates above the stages, from the lowest.
    const UPPER_LAYERS: [&str; 6] = ["pipeline", "reporting", "sweeps", "formats", "learning", "wayside"];
    let is_leaf = |name: &str| LEAVES.contains(&name);
    let floor = |name: &str| UPPER_LAYERS.iter().position(|floor| *floor == name);
    let is_below = |to: &str, from: usize| floor(to).is_some_and(|to| to < from);
    let may = |from: &str, to: &str| match from {
        "xtask" => true,
        "radar" | "bodies" => to == "artifact",
        "po-sbr" | "interchange" => ["artifact", "radar"].contains(&to),
        "classifier-training" => is_leaf(to) || to == "classifier",
        "wayside-python" => is_leaf(to) || to == "wayside",
        _ => match floor(from) {
            Some(from) => is_leaf(to) || STAGES.contains(&to) || is_below(to, from),
            None => is_leaf(to) && !is_leaf(from),
        },
    };
    let sentence = |Edge { from, to, is_of_tests }: &Edge| {
        let is_of_fuzzing = [from, to].iter().any(|name| *name == "fuzzing");
        match is_of_fuzzing {
            true if !is_of_tests => Some(format!("{from} → {to}: fuzzing is for tests alone")),
            true => None,
            false => (!may(from, to)).then(|| format!("{from} → {to}: pass an artifact instead")),
        }
    };
    edges.iter().filter_map(sentence).collect()
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
    fn a_crate_whose_tests_would_not_run_is_told_and_those_with_checks_of_their_own_are_not() {
        let id = |name: &str| format!("path+file:///project/crates/{name}#0.1.0");
        let metadata = json!({
            "workspace_members":
                [id("dsp"), id("evaluation"), id("classifier-training"), id("wayside-python")],
            "workspace_default_members": [id("dsp")],
        });
        let found = untested_crates(&metadata);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].contains("crates/evaluation#"), "{found:?}");
    }

    #[test]
    fn an_edge_between_stages_is_forbidden_even_for_their_tests() {
        let metadata = json!({ "packages": [
            { "name": "xtask", "dependencies": [{ "name": "dsp" }, { "name": "scene" }] },
            { "name": "dsp", "dependencies": [{ "name": "artifact" }, { "name": "fmcw-echo", "kind": "dev" }] },
            { "name": "fmcw-echo", "dependencies": [{ "name": "rayon" }] },
            { "name": "artifact", "dependencies": [{ "name": "scene", "kind": "build" }] },
            { "name": "scene", "dependencies": [{ "name": "wayside" }, { "name": "plotting" }] },
            { "name": "wayside", "dependencies": [{ "name": "scene" }, { "name": "xtask" }] },
            { "name": "plotting", "dependencies": [{ "name": "artifact" }, { "name": "fuzzing" }] },
            { "name": "fuzzing",
              "dependencies": [{ "name": "wayside", "kind": "dev" }, { "name": "artifact" }] },
            { "name": "classifier", "dependencies": [{ "name": "fuzzing", "kind": "dev" }] },
            { "name": "wayside-python", "dependencies": [{ "name": "wayside" }, { "name": "bart-rcs" }] },
            { "name": "bart-rcs", "dependencies": [{ "name": "radar" }, { "name": "pipeline" }] },
            { "name": "pipeline", "dependencies": [{ "name": "dsp" }, { "name": "reporting" }] },
            { "name": "reporting", "dependencies": [{ "name": "pipeline" }, { "name": "radar" }] },
        ] });
        let found = forbidden(&edges(&metadata));
        let instead = "pass an artifact instead";
        let expected = [
            ("dsp → fmcw-echo", instead),
            ("artifact → scene", instead),
            ("scene → wayside", instead),
            ("wayside → xtask", instead),
            ("plotting → artifact", instead),
            ("plotting → fuzzing", "fuzzing is for tests alone"),
            ("fuzzing → artifact", "fuzzing is for tests alone"),
            ("wayside-python → bart-rcs", instead),
            ("bart-rcs → pipeline", instead),
            ("pipeline → reporting", instead),
        ];
        assert_eq!(found, expected.map(|(edge, rule)| format!("{edge}: {rule}")));
    }
}
