//! Random search for unknown failures: compares methods on random bodies, radars and cubes. A difference
//! beyond the printed errors and the reference's own is a find, and each find becomes a case of the atlas.

mod contest;
mod drawn_bodies;
mod scattering;
mod echoes;
mod maps;
mod tracks;

mod ledger;

pub(super) use contest::{Contest, Tally};
pub(super) use ledger::{entered, rows};

use crate::study::sources::{self, Places};
use contest::Outcome;
use wayside::host::failure::Failure;
use wayside::host::processor_time;
use wayside::program::terminal;

/// Sources that the finds depend on.
pub(super) const SOURCES: Places = &[sources::CHAIN, &["crates/po-sbr", "xtask/src/study/search"]];

/// Every contest, in order.
const CONTESTS: &[Contest] = &[
    Contest { name: "first order against dense sampling", trial: scattering::against_sampling },
    Contest { name: "orders 1 to 3 of boxes against rays", trial: scattering::against_rays },
    Contest { name: "transmitter and receiver exchanged", trial: scattering::exchanged },
    Contest { name: "mesh relabelled, cut and turned", trial: scattering::relabelled },
    Contest { name: "antenna far away against infinitely far", trial: scattering::far_away },
    Contest { name: "layers against matrices", trial: scattering::layers },
    Contest { name: "fast sum against the formulas", trial: echoes::against_formulas },
    Contest { name: "map against the sum of its definition", trial: maps::against_sums },
    Contest { name: "detector against its definition", trial: maps::detector },
    Contest { name: "lone points against their truth", trial: maps::lone_points },
    Contest { name: "tracks against their truth", trial: tracks::against_truth },
];

/// End condition of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Until {
    /// Number of cases of each contest.
    Cases(u64),
    /// Number of processor seconds.
    ProcessorSeconds(f64),
}

/// Searches contest by contest in turn; prints finds as they occur.
pub(super) fn searched(seed: u64, until: Until) -> Result<Vec<Tally>, Failure> {
    let mut tallies: Vec<Tally> = CONTESTS.iter().map(Tally::of).collect();
    let start_s = processor_time::of_process().unwrap_or(0.0);
    let spent_s = || processor_time::of_process().unwrap_or(f64::INFINITY) - start_s;
    let goes_on = |number: u64| match until {
        Until::Cases(cases) => number < cases,
        Until::ProcessorSeconds(seconds) => spent_s() < seconds,
    };
    for number in (0..).take_while(|number| goes_on(*number)) {
        for (contest, tally) in CONTESTS.iter().zip(&mut tallies) {
            let before_s = spent_s();
            let outcome = contest.case(seed, number)?;
            tally.seconds += spent_s() - before_s;
            tally.cases += u64::from(outcome != Outcome::Void);
            if let Outcome::Find(words) = outcome {
                terminal::line(format!("{}, seed {seed}, case {number}: {words}", contest.name));
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
        let tallies = searched(1, Until::Cases(4)).unwrap();
        for tally in &tallies {
            println!("{}: {} cases, {:.1} s", tally.name, tally.cases, tally.seconds);
            assert_eq!(tally.finds, Vec::<String>::new(), "{}", tally.name);
        }
        assert!(tallies.iter().all(|tally| tally.cases > 0));
    }

    #[test]
    fn a_case_is_the_same_whenever_it_is_drawn() {
        for contest in CONTESTS {
            assert_eq!(contest.case(5, 3).unwrap(), contest.case(5, 3).unwrap(), "{}", contest.name);
        }
    }
}
