//! Whether a result equals that at the finest accuracy: the rule of `docs/validation/sensitivity.md`.

use crate::study::pages::sensitivity::changes::{Changes, rms};
use artifact::goal::Goal;

/// Largest share of bodies that may be lost, gained, or have another lane or class: one in fifty.
const SHARE: f64 = 0.02;
/// Largest ratio of a change to the error against the truth: if independent, it adds 5 % to that error.
const PART_OF_ERROR: f64 = 1.0 / 3.0;

/// Least number of bodies, frame by frame, for judging an accuracy: among fewer, one alone is over a
/// twentieth.
pub(super) const ENOUGH: usize = 20;

/// Measures for judging a change, of the same scenes.
pub(super) struct Measures {
    /// The finest run against truth.
    pub(super) errors: Changes,
    /// Changes between two draws of the receiver's noise.
    pub(super) noise: Changes,
}

/// Whether a result with these changes is as good as the reference.
pub(super) fn result_holds(goal: Goal, changes: &Changes, measures: &Measures) -> bool {
    let few = |of: fn(&Changes) -> (usize, usize)| few(of(changes), of(&measures.noise));
    let small = |of: fn(&Changes) -> &[f64]| small([changes, &measures.errors, &measures.noise].map(of));
    let there = few(|changes| (changes.lost + changes.gained, changes.there));
    match goal {
        Goal::Class => there && few(|changes| changes.classes) && small(|changes| &changes.probability),
        Goal::Cube | Goal::Detection | Goal::Tracks => {
            there
                && few(|changes| changes.lanes)
                && small(|changes| &changes.range_m)
                && small(|changes| &changes.velocity_mps)
                && small(|changes| &changes.azimuth_deg)
        }
    }
}

/// The coarsest of these accuracies that suffices together with all finer ones; they are given coarsest
/// first, and one with too few data, `None`, decides nothing.
pub(super) fn coarsest(tried_db: &[f64], holds: impl Fn(usize) -> Option<bool>) -> Option<f64> {
    let decided = (0..tried_db.len()).rev().filter_map(|index| Some((index, holds(index)?)));
    decided.take_while(|(_, holds)| *holds).last().map(|(index, _)| tried_db[index])
}

/// Accuracy that a result is to ask for: the one that was measured for it, and for tracks no coarser than the
/// one of the objects that they are formed of. `None` where no tried accuracy suffices.
pub(super) fn accuracy_to_request(goal: Goal, measured_db: impl Fn(Goal) -> Option<f64>) -> Option<f64> {
    let own_db = measured_db(goal)?;
    match goal {
        Goal::Tracks => Some(own_db.min(measured_db(Goal::Detection)?)),
        Goal::Cube | Goal::Detection | Goal::Class => Some(own_db),
    }
}

/// Whether few are changed: a small share, or one that other noise changes as well, within the counting error
/// √n.
fn few((count, of): (usize, usize), (by_noise, of_noise): (usize, usize)) -> bool {
    let by_noise = by_noise as f64;
    let share_of_noise = (by_noise + by_noise.sqrt()) / of_noise.max(1) as f64;
    count as f64 <= SHARE.max(share_of_noise) * of as f64
}

/// Whether a change is small relative to the error against the truth, or no larger than that by other noise.
fn small([changes, errors, noise]: [&[f64]; 3]) -> bool {
    let allowed = (PART_OF_ERROR * rms(errors).unwrap_or(0.0)).max(rms(noise).unwrap_or(0.0));
    rms(changes).unwrap_or(0.0) <= allowed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::project_root;

    fn moved(range_m: f64) -> Changes {
        Changes { there: 100, range_m: vec![range_m], ..Changes::default() }
    }

    fn measures(noise: Changes) -> Measures {
        Measures { errors: moved(0.3), noise }
    }

    #[test]
    fn a_result_holds_while_it_moves_by_less_than_a_third_of_its_error() {
        let quiet = measures(moved(0.0));
        assert!(result_holds(Goal::Detection, &moved(0.0999), &quiet));
        assert!(!result_holds(Goal::Detection, &moved(0.1001), &quiet));
        assert!(result_holds(Goal::Class, &moved(0.1001), &quiet), "a class has no range");
        let two_lost = Changes { lost: 1, gained: 1, ..moved(0.0) };
        let three_lost = Changes { lost: 2, gained: 1, ..moved(0.0) };
        assert!(
            result_holds(Goal::Class, &two_lost, &quiet) && !result_holds(Goal::Class, &three_lost, &quiet)
        );
        let other_class = Changes { classes: (3, 100), ..moved(0.0) };
        assert!(
            result_holds(Goal::Tracks, &other_class, &quiet)
                && !result_holds(Goal::Class, &other_class, &quiet)
        );
    }

    #[test]
    fn what_other_noise_changes_as_well_is_no_loss() {
        assert!(result_holds(Goal::Detection, &moved(0.19), &measures(moved(-0.2))));
        assert!(!result_holds(Goal::Detection, &moved(0.21), &measures(moved(-0.2))));
        let told = |other| Changes { classes: (other, 100), ..moved(0.0) };
        // Nine of a hundred by noise, counted to three more or less.
        assert!(result_holds(Goal::Class, &told(12), &measures(told(9))));
        assert!(!result_holds(Goal::Class, &told(13), &measures(told(9))));
    }

    #[test]
    fn the_coarsest_accuracy_holds_with_all_that_are_finer() {
        let tried_db = [-10.0, -15.0, -20.0, -30.0];
        let of = |holds: [Option<bool>; 4]| coarsest(&tried_db, |index| holds[index]);
        let (yes, no) = (Some(true), Some(false));
        assert_eq!(of([yes, yes, yes, yes]), Some(-10.0));
        assert_eq!(of([yes, no, yes, yes]), Some(-20.0));
        assert_eq!(of([yes, no, yes, None]), Some(-20.0), "nothing is known of −30 dB");
        assert_eq!(of([yes, yes, no, None]), None);
        assert_eq!(of([yes, yes, yes, no]), None);
    }

    /// Levels in the page's row of a goal, as asked and as measured; `None` is not a level.
    fn levels_db(page: &str, goal: Goal) -> [Option<f64>; 2] {
        let begin = format!("| \"{}\" | ", goal.name());
        let row = page.lines().find_map(|line| line.strip_prefix(&begin)).expect("a row of the goal");
        let (asked, measured) = row.trim_end_matches(" |").split_once(" | ").expect("two cells");
        [asked, measured].map(|cell| cell.strip_suffix(" dB")?.replace('−', "-").parse().ok())
    }

    #[test]
    fn tracks_ask_for_no_less_than_their_objects() {
        let measured = |of_objects, of_tracks| {
            move |goal| if goal == Goal::Tracks { Some(of_tracks) } else { Some(of_objects) }
        };
        assert_eq!(accuracy_to_request(Goal::Tracks, measured(-20.0, -15.0)), Some(-20.0));
        assert_eq!(accuracy_to_request(Goal::Tracks, measured(-15.0, -20.0)), Some(-20.0));
        assert_eq!(accuracy_to_request(Goal::Detection, measured(-15.0, -20.0)), Some(-15.0));
        assert_eq!(accuracy_to_request(Goal::Tracks, |goal| (goal == Goal::Tracks).then_some(-15.0)), None);
    }

    #[test]
    fn the_program_asks_for_what_the_page_says_that_each_result_needs() {
        let page = std::fs::read_to_string(project_root().join("docs/validation/sensitivity.md")).unwrap();
        for goal in Goal::ALL {
            let asked_db = Some(goal.accuracy().db());
            assert_eq!(levels_db(&page, goal)[0], asked_db, "{goal:?}");
            if goal != Goal::Cube {
                assert_eq!(accuracy_to_request(goal, |goal| levels_db(&page, goal)[1]), asked_db, "{goal:?}");
            }
        }
        let of_cube = "| \"cube\" | −20 dB | an agreement: 10 % of the amplitude |";
        assert!(page.contains(of_cube), "the page has no row {of_cube}");
    }
}
