//! The main job and the tests must ask every dependency for the same features: the learning library is most of a build,
//! and a second set of features builds it twice.

use crate::cache::project_root;
use crate::failure::Failure;
use std::collections::BTreeMap;
use std::process::Command;

/// Package and version → features.
type Features = BTreeMap<String, String>;

pub(super) fn check() -> Result<(), Failure> {
    let job = features(&["--package", "xtask", "--edges", "normal,build"])?;
    let tests = features(&["--workspace", "--edges", "normal,build,dev"])?;
    match differences(&job, &tests).as_slice() {
        [] => Ok(()),
        found => Err(Failure::Refused(found.join("\n"))),
    }
}

fn features(arguments: &[&str]) -> Result<Features, Failure> {
    let mut command = Command::new("cargo");
    command.args(["tree", "--offline", "--prefix", "none", "--format", "{p}|{f}"]).args(arguments);
    let output =
        command.current_dir(project_root()).output().map_err(|e| Failure::System(format!("cargo tree: {e}")))?;
    Ok(parse(&String::from_utf8_lossy(&output.stdout)))
}

/// A package that stands in the tree twice (for the host and the target) keeps both sets.
fn parse(tree: &str) -> Features {
    let mut features = Features::new();
    for line in tree.lines() {
        if let Some((package, set)) = line.trim_end_matches(" (*)").split_once('|') {
            let sets = features.entry(package.to_owned()).or_default();
            let set = set.trim_end_matches(" (*)");
            if !sets.split(" and ").any(|s| s == set) {
                sets.push_str(if sets.is_empty() { "" } else { " and " });
                sets.push_str(set);
            }
        }
    }
    features
}

fn differences(job: &Features, tests: &Features) -> Vec<String> {
    let differs = |(package, set): &(&String, &String)| tests.get(*package).is_some_and(|other| other != *set);
    let sentence = |(package, set): (&String, &String)| {
        format!("{package}: the main job asks for [{set}], the tests for [{}]", tests[package])
    };
    job.iter().filter(differs).map(sentence).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_feature_that_only_the_tests_ask_for_is_found() {
        let job = parse("burn v0.22.1|default,flex\nserde v1.0.0|derive\nserde v1.0.0|derive (*)\n");
        let tests = parse("burn v0.22.1|default,flex,ndarray\nserde v1.0.0|derive\nproptest v1.0.0|std\n");
        assert_eq!(
            differences(&job, &tests),
            ["burn v0.22.1: the main job asks for [default,flex], the tests for [default,flex,ndarray]"]
        );
        assert!(differences(&job, &job).is_empty());
    }
}
