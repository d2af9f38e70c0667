//! Check that a program, its tests and the Python package request the same features of every dependency: a
//! second set of features builds its dependents twice.

use crate::project::project_root;
use std::collections::BTreeMap;
use std::process::Command;
use wayside::host::failure::Failure;

/// Package and version → features.
type Features = BTreeMap<String, String>;

pub(super) fn check() -> Result<(), Failure> {
    let job = ["--package", "xtask"];
    let training = ["--package", crate::ci::training::PACKAGE];
    let python = ["--package", "wayside-python"];
    let alike = [
        ("the main job", &job[..], &[][..]),
        ("the program that trains", &training, &training),
        // Its build is that of the main job and a few more crates.
        ("the main job", &job, &python),
    ];
    for (name, program, tests) in alike {
        let of = |packages: &[&str], edges: &str| features(&[packages, &["--edges", edges]].concat());
        let (program, tests) = (of(program, "normal,build")?, of(tests, "normal,build,dev")?);
        if let found @ [_, ..] = differences(name, &program, &tests).as_slice() {
            return Err(Failure::Refused(found.join("\n")));
        }
    }
    Ok(())
}

fn features(arguments: &[&str]) -> Result<Features, Failure> {
    let mut command = Command::new("cargo");
    command.args(["tree", "--offline", "--prefix", "none", "--format", "{p}|{f}"]).args(arguments);
    let output = command
        .current_dir(project_root())
        .output()
        .map_err(|e| Failure::System(format!("cargo tree: {e}")))?;
    Ok(parse(&String::from_utf8_lossy(&output.stdout)))
}

/// Parses a dependency tree; a package that occurs twice (for the host and the target) keeps both sets.
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

fn differences(name: &str, job: &Features, tests: &Features) -> Vec<String> {
    let differs =
        |(package, set): &(&String, &String)| tests.get(*package).is_some_and(|other| other != *set);
    let sentence = |(package, set): (&String, &String)| {
        format!(
            "{package}: {name} asks for [{set}], the tests or the Python package for [{}]",
            tests[package]
        )
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
            differences("the main job", &job, &tests),
            ["burn v0.22.1: the main job asks for [default,flex], the tests or the Python package for \
                 [default,flex,ndarray]"]
        );
        assert!(differences("the main job", &job, &job).is_empty());
    }
}
