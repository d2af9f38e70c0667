//! The program tried by force: tests that stand beside it, with many more cases than they have by default and
//! of another seed; how many, and what came of them.

use crate::project::project_root;
use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::SourcePaths;
use std::process::Command;
use wayside::host::failure::Failure;
use wayside::host::progress::Work;

/// Sources that the figures hang on: what is tried, and how.
pub(crate) const SOURCES: SourcePaths = &[&[
    "crates/wayside/tests/mutated_numbers",
    "crates/wayside/tests/hostile_files",
    "crates/wayside/tests/files/damage.rs",
    "crates/wayside/tests/files/crafted_artifacts.rs",
    "crates/wayside/tests/files/full_disk.rs",
    "crates/wayside/tests/kills.rs",
    "xtask/tests/commands.rs",
    "xtask/src/study/pages/force.rs",
]];

/// Seed of all that is drawn; no plain test has it.
const SEED: u64 = 77;

/// Tests of one kind of force.
struct StressTest {
    package: &'static str,
    /// Name of the test program, and words that all of its tests to be run have in their names.
    test: [&'static str; 2],
    /// Variable that says how much is tried, and how much; `None`: all that there is.
    amount: Option<(&'static str, u64)>,
    /// Variable of the seed; `None`: nothing is drawn.
    seed: Option<&'static str>,
}

const fn of_program(
    test: [&'static str; 2],
    amount: Option<(&'static str, u64)>,
    seed: Option<&'static str>,
) -> StressTest {
    StressTest { package: "wayside", test, amount, seed }
}

/// Kills of each command.
const KILLS: Option<(&str, u64)> = Some(("WAYSIDE_KILLS", 15));
const OF_ALL: Option<&str> = Some("WAYSIDE_SEED");

const STRESS_TESTS: [StressTest; 8] = [
    // So many of each number of a scene, of which there are about a hundred.
    of_program(
        ["mutated_numbers", "a_scene_with_any"],
        Some(("WAYSIDE_NUMBERS", 24)),
        Some("WAYSIDE_NUMBERS_SEED"),
    ),
    of_program(["files", "damage::"], Some(("WAYSIDE_DAMAGES", 2_000)), OF_ALL),
    of_program(
        ["files", "crafted_artifacts::artifacts_of"],
        Some(("WAYSIDE_CRAFTED", 500)),
        Some("WAYSIDE_CRAFTED_SEED"),
    ),
    of_program(["hostile_files", ""], None, None),
    of_program(["files", "full_disk::every"], None, None),
    of_program(["kills", ""], KILLS, OF_ALL),
    of_program(["sweeps", "that_is_killed"], KILLS, OF_ALL),
    StressTest { package: "xtask", test: ["commands", "that_is_killed"], amount: KILLS, seed: OF_ALL },
];

pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    part.head(&["what is done to it", "cases", "what came of them", "seed", "found"]);
    let work = Work::begin("kinds of force");
    for (number, trial) in STRESS_TESTS.iter().enumerate() {
        work.at(number, STRESS_TESTS.len());
        let result = trial.run(extent)?;
        let seed = trial.seed.map_or("–".to_owned(), |_| SEED.to_string());
        for CaseCount { kind, cases, came } in &result.counted {
            part.row(&[kind, cases, came, &seed, "nothing"].map(str::to_owned));
        }
        if let Some(found) = result.found {
            let name = trial.test.join(" ");
            part.row(&[&name, "–", "–", &seed, &found].map(String::from));
            part.complain(format!("{name}: {found}"));
        }
    }
    Ok(part)
}

/// Results that tests have printed.
struct StressResult {
    counted: Vec<CaseCount>,
    /// Words of a test that has failed.
    found: Option<String>,
}

/// A line of a test: cases of a kind, and what came of them.
#[derive(Debug, PartialEq)]
struct CaseCount {
    kind: String,
    cases: String,
    came: String,
}

impl CaseCount {
    fn of(line: &str) -> Option<Self> {
        let (_, told) = line.split_once("force: ")?;
        let (kind, told) = told.split_once(": ")?;
        let (cases, came) = told.split_once(" cases: ")?;
        Some(Self { kind: kind.into(), cases: cases.into(), came: came.into() })
    }
}

impl StressTest {
    fn run(&self, extent: Extent) -> Result<StressResult, Failure> {
        let [test, words] = self.test;
        let mut command = Command::new("cargo");
        command.args(["test", "--release", "--package", self.package, "--test", test]);
        command.args(["--", "--nocapture", words]).current_dir(project_root());
        if let Some((variable, amount)) = self.amount {
            command.env(variable, extent.case_count(amount).to_string());
        }
        if let Some(variable) = self.seed {
            command.env(variable, SEED.to_string());
        }
        let output = command.output().map_err(|e| Failure::System(format!("cargo: {e}")))?;
        let [out, err] = [output.stdout, output.stderr].map(|b| String::from_utf8_lossy(&b).into_owned());
        let mut counted: Vec<CaseCount> = out.lines().filter_map(CaseCount::of).collect();
        counted.sort_by(|a, b| a.kind.cmp(&b.kind)); // tests end in any order
        let found = (!output.status.success()).then(|| first_fault(&out, &err));
        Ok(StressResult { counted, found })
    }
}

/// The first sentence of a test that has failed, as a cell of a table holds it.
fn first_fault(out: &str, err: &str) -> String {
    let lines = || out.lines().chain(err.lines());
    let fault = lines().skip_while(|line| !line.contains("panicked at")).nth(1);
    let fault = fault.or_else(|| lines().find(|line| line.starts_with("error"))).unwrap_or("a test failed");
    fault.chars().take(300).collect::<String>().replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_a_test_is_a_row_and_a_failed_one_is_told() {
        let line = "test a ... force: kills of run within 1.0s: 15 cases: 3 temporary files met and swept";
        let counted = CaseCount::of(line).unwrap();
        assert_eq!([&*counted.kind, &*counted.cases], ["kills of run within 1.0s", "15"]);
        assert_eq!(counted.came, "3 temporary files met and swept");
        assert_eq!(CaseCount::of("running 3 tests"), None);
        let said = "thread 'x' panicked at a.rs:1:2:\nf.cube: damage 3 | is taken for right\n";
        assert_eq!(first_fault("", said), "f.cube: damage 3 \\| is taken for right");
        assert_eq!(first_fault("", "error: no test target named `x`"), "error: no test target named `x`");
    }
}
