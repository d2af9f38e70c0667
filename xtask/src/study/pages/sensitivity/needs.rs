//! Whether a result is as it is at the finest accuracy: the rule of `docs/validation/sensitivity.md`.

use crate::study::pages::sensitivity::changes::{Changes, rms};
use artifact::goal::Goal;

/// Part of the bodies that may be lost, gained, or told with another lane or class: one in fifty.
const SHARE: f64 = 0.02;
/// Part of the error against truth that a change may have: independent of it, it adds 5 % to that error.
const PART_OF_ERROR: f64 = 1.0 / 3.0;

/// Whether a result with these changes is as good as the reference, which has these errors against truth.
pub(super) fn hold(goal: Goal, changes: &Changes, errors: &Changes) -> bool {
    let there = few(changes.lost + changes.gained, changes.there);
    match goal {
        Goal::Class => {
            let probability = small(&changes.probability, &errors.probability);
            there && few(changes.classes.0, changes.classes.1) && probability
        }
        Goal::Cube | Goal::Detection | Goal::Tracks => {
            let place = small(&changes.range_m, &errors.range_m)
                && small(&changes.velocity_mps, &errors.velocity_mps)
                && small(&changes.azimuth_deg, &errors.azimuth_deg);
            there && place && few(changes.lanes.0, changes.lanes.1)
        }
    }
}

/// The coarsest of these accuracies that holds with all finer ones; they are given coarsest first.
pub(super) fn coarsest(tried_db: &[f64], holds: impl Fn(usize) -> bool) -> Option<f64> {
    let held = (0..tried_db.len()).rev().take_while(|index| holds(*index)).last();
    held.map(|index| tried_db[index])
}

fn few(count: usize, of: usize) -> bool {
    count as f64 <= SHARE * of as f64
}

fn small(changes: &[f64], errors: &[f64]) -> bool {
    match (rms(changes), rms(errors)) {
        (Some(change), Some(error)) => change <= PART_OF_ERROR * error,
        (change, _) => change.is_none(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::project_root;

    fn moved(range_m: f64) -> Changes {
        Changes { there: 100, range_m: vec![range_m], ..Changes::default() }
    }

    #[test]
    fn a_result_holds_while_it_moves_by_less_than_a_third_of_its_error() {
        let errors = moved(0.3);
        assert!(hold(Goal::Detection, &moved(0.0999), &errors));
        assert!(!hold(Goal::Detection, &moved(0.1001), &errors));
        assert!(hold(Goal::Class, &moved(0.1001), &errors), "a class has no range");
        let two_lost = Changes { lost: 1, gained: 1, ..moved(0.0) };
        let three_lost = Changes { lost: 2, gained: 1, ..moved(0.0) };
        assert!(hold(Goal::Class, &two_lost, &errors) && !hold(Goal::Class, &three_lost, &errors));
        let other_class = Changes { classes: (3, 100), ..moved(0.0) };
        assert!(hold(Goal::Tracks, &other_class, &errors) && !hold(Goal::Class, &other_class, &errors));
    }

    #[test]
    fn the_coarsest_accuracy_holds_with_all_that_are_finer() {
        let tried_db = [-10.0, -15.0, -20.0, -30.0];
        let of = |holds: [bool; 4]| coarsest(&tried_db, |index| holds[index]);
        assert_eq!(of([true, true, true, true]), Some(-10.0));
        assert_eq!(of([true, false, true, true]), Some(-20.0));
        assert_eq!(of([true, true, true, false]), None);
    }

    #[test]
    fn the_program_asks_for_what_the_page_says_that_each_result_needs() {
        let page = std::fs::read_to_string(project_root().join("docs/validation/sensitivity.md")).unwrap();
        for goal in Goal::ALL {
            let level = format!("{:.0} dB", goal.accuracy().db()).replace('-', "−");
            let measured = if goal == Goal::Cube { "an agreement: 10 % of the amplitude" } else { &level };
            let row = format!("| \"{}\" | {level} | {measured} |", goal.name());
            assert!(page.contains(&row), "the page has no row {row}");
        }
    }
}
