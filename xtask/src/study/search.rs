//! Random search for unknown failures: compares methods on random bodies, radars and cubes. A difference
//! beyond the printed errors and the reference's own is a find, and each find becomes a case of the atlas.

mod differential_testing;
mod random_bodies;
mod scattering;
mod frames;
mod echoes;
mod maps;
mod tracks;

mod ledger;

pub(super) use differential_testing::{DifferentialTest, Tally};
pub(super) use ledger::{append_rows, rows};

use crate::study::sources::{self, SourcePaths};
use differential_testing::Outcome;
use wayside::host::failure::Failure;
use wayside::host::processor_time;
use wayside::program::terminal;

/// Sources that the finds depend on.
pub(super) const SOURCES: SourcePaths = &[sources::CHAIN, &["crates/po-sbr", "xtask/src/study/search"]];

/// Every differential test, in order.
const DIFFERENTIAL_TESTS: &[DifferentialTest] = &[
    DifferentialTest { name: "first order against dense sampling", trial: scattering::against_sampling },
    DifferentialTest { name: "orders 1 to 3 of boxes against rays", trial: scattering::against_rays },
    DifferentialTest { name: "transmitter and receiver exchanged", trial: scattering::reciprocity },
    DifferentialTest { name: "mesh relabelled, cut and turned", trial: scattering::mesh_invariance },
    DifferentialTest { name: "antenna far away against infinitely far", trial: scattering::far_field },
    DifferentialTest { name: "layers against matrices", trial: scattering::layers },
    DifferentialTest { name: "frames against bodies traced anew", trial: frames::against_bodies_traced_anew },
    DifferentialTest { name: "fast sum against the formulas", trial: echoes::against_formulas },
    DifferentialTest { name: "map against the sum of its definition", trial: maps::against_sums },
    DifferentialTest { name: "detector against its definition", trial: maps::detector },
    DifferentialTest { name: "lone points against their truth", trial: maps::isolated_points },
    DifferentialTest { name: "tracks against their truth", trial: tracks::against_truth },
];

/// End condition of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum StopCondition {
    /// Number of cases of each differential test.
    Cases(u64),
    /// Number of processor seconds.
    ProcessorSeconds(f64),
}

/// Runs the differential tests with a word in their names in turn; prints finds as they occur.
pub(super) fn search(seed: u64, until: StopCondition, word: &str) -> Result<Vec<Tally>, Failure> {
    let tests: Vec<_> = DIFFERENTIAL_TESTS.iter().filter(|test| test.name.contains(word)).collect();
    if tests.is_empty() {
        let names: Vec<_> = DIFFERENTIAL_TESTS.iter().map(|test| test.name).collect();
        return Err(Failure::Refused(format!(
            "no contest has `{word}` in its name; there are {}",
            names.join("; ")
        )));
    }
    let mut tallies: Vec<Tally> = tests.iter().map(|test| Tally::of(test)).collect();
    let start_s = processor_time::of_process().unwrap_or(0.0);
    let spent_s = || processor_time::of_process().unwrap_or(f64::INFINITY) - start_s;
    let goes_on = |number: u64| match until {
        StopCondition::Cases(cases) => number < cases,
        StopCondition::ProcessorSeconds(seconds) => spent_s() < seconds,
    };
    for number in (0..).take_while(|number| goes_on(*number)) {
        for (test, tally) in tests.iter().zip(&mut tallies) {
            let before_s = spent_s();
            let outcome = test.case(seed, number)?;
            tally.seconds += spent_s() - before_s;
            tally.cases += u64::from(outcome != Outcome::Uninformative);
            if let Outcome::Discrepancy(words) = outcome {
                terminal::line(format!("{}, seed {seed}, case {number}: {words}", test.name));
                tally.finds.push(format!("case {number}: {words}"));
            }
        }
    }
    Ok(tallies)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An hour of it on request: `cargo xtask study search --minutes 60`.
    #[test]
    fn methods_agree_on_random_cases_within_what_they_print() {
        let tallies = search(1, StopCondition::Cases(4), "").unwrap();
        for tally in &tallies {
            println!("{}: {} cases, {:.1} s", tally.name, tally.cases, tally.seconds);
            assert_eq!(tally.finds, Vec::<String>::new(), "{}", tally.name);
        }
        assert!(tallies.iter().all(|tally| tally.cases > 0));
    }

    #[test]
    fn a_case_is_the_same_whenever_it_is_drawn() {
        for test in DIFFERENTIAL_TESTS {
            assert_eq!(test.case(5, 3).unwrap(), test.case(5, 3).unwrap(), "{}", test.name);
        }
    }
}
