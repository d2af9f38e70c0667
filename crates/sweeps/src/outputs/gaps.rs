//! Sentences about means that do not cover all situations.

use crate::answer::DesignResult;
use crate::statistics::interval::Mean;

/// A sentence about the number of designs that know the metric in fewer situations than others, the one that
/// lacks most, and the effect on the answer; none if all know it in the same.
pub(crate) fn sentence(
    results: &[DesignResult],
    seen: impl Fn(usize) -> usize,
    metric: &str,
) -> Option<String> {
    let lacks = |design: &usize| results[*design].lacks;
    let count = (0..results.len()).filter(|design| lacks(design) > 0).count();
    // The first of those that lack equally many.
    let worst = (0..results.len()).rev().max_by_key(lacks).filter(|design| lacks(design) > 0)?;
    let known = results[worst].mean.map_or(0, |mean| mean.count);
    let all = results.len();
    let know = if count == 1 { "knows" } else { "know" };
    Some(format!(
        "{count} of {all} designs {know} {metric} in FEWER SITUATIONS than others, design {worst} in \
         {known} of {}: two designs are compared in those that both know, so one that finds less is judged \
         by what it finds alone. Look at a detection rate or a coverage as well (another [goal] makes no run \
         anew).",
        seen(worst),
    ))
}

/// Words appended to a mean that covers fewer situations than it could.
pub(crate) fn of_fewer(mean: Option<Mean>, seen: usize) -> String {
    match mean {
        Some(mean) if mean.count < seen => format!(" (in {} of {seen})", mean.count),
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn result(known: usize, lacks: usize) -> DesignResult {
        let mean = Mean::of(&vec![1.0; known], 0.95);
        DesignResult { mean, cost: None, behind: None, worth: None, lacks }
    }

    #[test]
    fn the_designs_that_know_less_are_counted_and_the_one_that_lacks_most_is_named() {
        let told = |results: &[DesignResult]| sentence(results, |_| 24, "range_error_m");
        assert_eq!(told(&[result(24, 0), result(24, 0)]), None);
        let one = told(&[result(12, 12), result(24, 0)]).unwrap();
        assert!(one.starts_with("1 of 2 designs knows range_error_m in FEWER SITUATIONS"), "{one}");
        let some = told(&[result(20, 4), result(12, 12), result(12, 12), result(24, 0)]).unwrap();
        let begin =
            "3 of 4 designs know range_error_m in FEWER SITUATIONS than others, design 1 in 12 of 24: ";
        assert!(some.starts_with(begin), "{some}");
        let none = told(&[result(0, 24), result(24, 0)]).unwrap();
        assert!(none.contains("design 0 in 0 of 24"), "{none}");
    }

    #[test]
    fn a_mean_over_all_situations_needs_no_words_and_one_over_fewer_tells_them() {
        let mean = Mean::of(&[1.0, 2.0], 0.95);
        assert_eq!([2, 5].map(|seen| of_fewer(mean, seen)), ["", " (in 2 of 5)"]);
        assert_eq!(of_fewer(None, 5), "");
    }
}
