//! Sentences about runs that did not reach their requested accuracy.

use crate::runs::ledger::Ledger;
use crate::runs::run_accuracy::RunAccuracy;
use pipeline::outcome::error_figures::decibels;

/// Largest number of designs listed by number.
const DESIGNS_LISTED: usize = 8;

/// A sentence about the number of runs that missed their accuracy, the worst of them, and the candidates that
/// depend on them; further ones if the accuracy of some runs is unknown or their errors were taken over.
pub(crate) fn sentences(ledger: &Ledger, candidates: &[usize]) -> Vec<String> {
    let of = |design: usize| ledger.runs(design).iter().map(move |run| (design, run.accuracy));
    let all = || (0..ledger.designs()).flat_map(of);
    let runs = all().count();
    let taken_over = all().filter(|(_, accuracy)| accuracy.is_not_measured()).count();
    let missed = all().filter(|(_, accuracy)| accuracy.is_missed());
    let worst = missed.max_by(|a, b| a.1.excess_db().total_cmp(&b.1.excess_db()));
    let unknown = all().filter(|(_, accuracy)| accuracy.met.is_none()).count();
    let told = match worst {
        Some((design, worst)) => {
            let missed = all().filter(|(_, accuracy)| accuracy.is_missed()).count();
            let resting = of_candidates(ledger, candidates, self::missed);
            Some(of_missed([missed, runs], design, &worst) + &resting)
        }
        None if unknown == 0 && taken_over == 0 => {
            Some(format!("All {runs} runs reached the accuracy that they asked for."))
        }
        None if taken_over > 0 && unknown + taken_over < runs => Some(format!(
            "The {} of {runs} runs whose errors were measured all reached the accuracy that they asked for.",
            runs - unknown - taken_over
        )),
        None => None,
    };
    let not_measured = || {
        let resting = of_candidates(ledger, candidates, self::not_measured);
        format!(
            "{taken_over} of {runs} runs take over the errors of other designs' runs: whether they reached the \
             accuracy that they asked for was NOT MEASURED; {resting}"
        )
    };
    let not_known = format!(
        "It is not known of {unknown} of {runs} runs whether they reached the accuracy that they asked for."
    );
    let not_measured = (taken_over > 0).then(not_measured);
    told.into_iter().chain(not_measured).chain((unknown > 0).then_some(not_known)).collect()
}

/// Number of runs of a design that missed their accuracy.
pub(crate) fn missed(ledger: &Ledger, design: usize) -> usize {
    ledger.runs(design).iter().filter(|run| run.accuracy.is_missed()).count()
}

/// Number of runs of a design whose accuracy is unknown because their errors were taken over.
pub(crate) fn not_measured(ledger: &Ledger, design: usize) -> usize {
    ledger.runs(design).iter().filter(|run| run.accuracy.is_not_measured()).count()
}

fn of_missed([missed, runs]: [usize; 2], design: usize, worst: &RunAccuracy) -> String {
    let (reached, asked) =
        (worst.reached_db.map_or("beyond all numbers".into(), decibels), decibels(worst.asked_db));
    format!(
        "{missed} of {runs} runs did NOT REACH the accuracy that they asked for, the worst, of design {design}, \
         {reached} for {asked} asked: with a finer one the answer may be another; "
    )
}

/// The candidates that depend on counted runs.
fn of_candidates(ledger: &Ledger, candidates: &[usize], count: fn(&Ledger, usize) -> usize) -> String {
    let resting: Vec<usize> =
        candidates.iter().copied().filter(|design| count(ledger, *design) > 0).collect();
    let (listed, more) = resting.split_at(resting.len().min(DESIGNS_LISTED));
    let listed = listed.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
    let more = if more.is_empty() { String::new() } else { format!(" and {} more", more.len()) };
    match resting.len() {
        0 => "no candidate rests on them.".into(),
        _ => format!("these candidates rest on them: {listed}{more}."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::runs::ledger::Run;
    use crate::runs::run_accuracy::ErrorSource;

    /// A ledger of designs whose runs reached these levels of −20 dB asked; `None`: it is not known.
    fn ledger(designs: &[&[Option<f64>]]) -> Ledger {
        let mut ledger = Ledger::of(designs.len());
        for (design, levels) in designs.iter().enumerate() {
            for reached_db in *levels {
                let met = reached_db.map(|db| db <= -20.0);
                let errors = ErrorSource::Own;
                let accuracy = RunAccuracy { asked_db: Some(-20.0), reached_db: *reached_db, met, errors };
                ledger.enter(design, Run { values: vec![], accuracy });
            }
        }
        ledger
    }

    #[test]
    fn runs_that_missed_their_accuracy_are_counted_with_the_worst_and_the_candidates_on_them() {
        let missed = ledger(&[&[Some(-25.0), Some(-12.0)], &[Some(3.6), Some(-30.0)], &[Some(-21.0), None]]);
        let told = sentences(&missed, &[0, 2]);
        assert_eq!(
            told[0],
            "2 of 6 runs did NOT REACH the accuracy that they asked for, the worst, of design 1, 3.6 dB for −20.0 dB \
             asked: with a finer one the answer may be another; these candidates rest on them: 0."
        );
        assert!(told[1].contains("not known of 1 of 6 runs"), "{told:?}");
        assert!(sentences(&missed, &[2])[0].ends_with("no candidate rests on them."));
    }

    #[test]
    fn a_study_whose_runs_all_reached_their_accuracy_says_so_and_one_that_knows_nothing_says_that() {
        let met = sentences(&ledger(&[&[Some(-25.0)], &[Some(-20.0)]]), &[0]);
        assert_eq!(met, ["All 2 runs reached the accuracy that they asked for."]);
        let unknown = sentences(&ledger(&[&[None], &[Some(-20.0)]]), &[0]);
        assert!(unknown.len() == 1 && unknown[0].contains("not known of 1 of 2 runs"), "{unknown:?}");
    }

    /// A study told −23.6 dB by errors of another design where its own run errs by −17.5.
    #[test]
    fn a_design_whose_errors_are_another_ones_is_not_told_to_have_reached_its_accuracy() {
        let mut ledger = ledger(&[&[Some(-23.6); 2], &[]]);
        for _ in 0..2 {
            let mut run = ledger.runs(0)[0].clone();
            run.accuracy.errors = ErrorSource::TakenOver;
            ledger.enter(1, run);
        }
        let told = sentences(&ledger, &[0, 1]);
        let measured =
            "The 2 of 4 runs whose errors were measured all reached the accuracy that they asked for.";
        assert_eq!(told[0], measured);
        assert!(
            told[1].contains("whether they reached the accuracy that")
                && told[1].ends_with("rest on them: 1."),
            "{told:?}"
        );
        assert_eq!([0, 1].map(|design| not_measured(&ledger, design)), [0, 2]);
    }

    #[test]
    fn of_many_candidates_the_first_are_listed_and_the_others_counted() {
        let all: Vec<&[Option<f64>]> = vec![&[Some(0.0)]; 11];
        let candidates: Vec<usize> = (0..11).collect();
        let told = sentences(&ledger(&all), &candidates);
        assert!(told[0].ends_with("rest on them: 0, 1, 2, 3, 4, 5, 6, 7 and 3 more."), "{told:?}");
    }
}
