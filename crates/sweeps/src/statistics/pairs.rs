//! Designs compared over the situations in which both know a metric, and the best of them. Scores are each
//! design's values by situation, more is better, `None` if unknown.

use std::cmp::Ordering;

/// Distance of a design behind another, negative if it is ahead: the difference of their means over the
/// situations that both know. If they have none in common, the one that knows fewer is infinitely far behind;
/// neither is if they know equally many.
pub(crate) fn behind(design: &[Option<f64>], other: &[Option<f64>]) -> f64 {
    let shared = design.iter().zip(other).filter_map(|(own, of_other)| Some([(*own)?, (*of_other)?]));
    let add = |(sums, count): ([f64; 2], u32), [own, of_other]: [f64; 2]| {
        ([sums[0] + own, sums[1] + of_other], count + 1)
    };
    let (sums, count) = shared.fold(([0.0; 2], 0), add);
    if count > 0 {
        let [own, of_other] = sums.map(|sum| sum / f64::from(count));
        return of_other - own;
    }
    let [own, of_other] = [design, other].map(|values| values.iter().flatten().count());
    match own.cmp(&of_other) {
        Ordering::Less => f64::INFINITY,
        Ordering::Equal => 0.0,
        Ordering::Greater => f64::NEG_INFINITY,
    }
}

/// The design that is behind no other; if each is behind some, as is possible with pairs over different
/// situations, the one with the smallest greatest distance behind another (the minimax rule: Simpson, Q. J.
/// Econ. 83 (1969) 478; Kramer, J. Econ. Theory 16 (1977) 310). Among equals the one with the greatest mean,
/// then the first; `None` if nothing is known. If all know the same situations, it has the greatest mean.
pub(crate) fn best(scores: &[Vec<Option<f64>>], designs: &[usize]) -> Option<usize> {
    let order: Vec<usize> = by_mean(scores, designs).into_iter().map(|(design, _)| design).collect();
    let mut best: Option<(usize, f64)> = None;
    for design in &order {
        // The best so far comes first: most designs are further behind it than behind any other.
        let rivals = best.map(|(design, _)| design).into_iter().chain(order.iter().copied());
        let least = best.map_or(f64::INFINITY, |(_, behind)| behind);
        let found = greatest_below(least, rivals.filter(|r| r != design), |rival| {
            behind(&scores[*design], &scores[rival])
        });
        best = found.map(|behind| (*design, behind)).or(best);
    }
    best.map(|(design, _)| design)
}

/// Designs with known values and their means, the greatest first, equal ones in their order.
pub(crate) fn by_mean(scores: &[Vec<Option<f64>>], designs: &[usize]) -> Vec<(usize, f64)> {
    let mean = |design: &usize| {
        let known: Vec<f64> = scores[*design].iter().copied().flatten().collect();
        // Adding zero avoids a negative zero, which would sort after zero.
        (!known.is_empty()).then(|| (*design, known.iter().sum::<f64>() / known.len() as f64 + 0.0))
    };
    let mut means: Vec<(usize, f64)> = designs.iter().filter_map(mean).collect();
    means.sort_by(|a, b| b.1.total_cmp(&a.1));
    means
}

/// Greatest distance behind some rivals, −∞ without rivals; `None` if it is not below a bound.
fn greatest_below(
    bound: f64,
    mut rivals: impl Iterator<Item = usize>,
    behind: impl Fn(usize) -> f64,
) -> Option<f64> {
    rivals.try_fold(f64::NEG_INFINITY, |greatest, rival| {
        let greatest = greatest.max(behind(rival));
        (greatest < bound).then_some(greatest)
    })
}

/// Number of situations seen by each design in which only other designs know a value.
pub(crate) fn lacking(scores: &[Vec<Option<f64>>]) -> Vec<usize> {
    let situations = scores.iter().map(Vec::len).max().unwrap_or(0);
    let mut is_known = vec![false; situations];
    for own in scores {
        is_known.iter_mut().zip(own).for_each(|(is_known, value)| *is_known |= value.is_some());
    }
    let lacks =
        |own: &Vec<Option<f64>>| own.iter().zip(&is_known).filter(|(own, is)| **is && own.is_none()).count();
    scores.iter().map(lacks).collect()
}

/// Situations that all designs have seen and know, ignoring designs that know nothing.
pub(crate) fn shared(scores: &[Vec<Option<f64>>]) -> Vec<usize> {
    let knowing: Vec<_> = scores.iter().filter(|own| own.iter().any(Option::is_some)).collect();
    let situations = scores.iter().map(Vec::len).min().unwrap_or(0);
    (0..situations).filter(|at| knowing.iter().all(|own| own[*at].is_some())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    fn all(scores: &[Vec<Option<f64>>]) -> Vec<usize> {
        (0..scores.len()).collect()
    }

    /// A design that finds the strong target alone, and there less exactly than one that finds both.
    #[test]
    fn a_design_that_is_worse_in_every_shared_situation_is_not_the_best() {
        let finds_less: Vec<_> = (0..24).map(|n| (n % 2 == 1).then_some(-0.001)).collect();
        let finds_all: Vec<_> = (0..24).map(|n| Some(if n % 2 == 1 { -0.0002 } else { -0.005 })).collect();
        let scores = vec![finds_less, finds_all];
        assert!(by_mean(&scores, &[0, 1])[0].0 == 0, "by its own mean the first would be");
        assert_eq!(best(&scores, &[0, 1]), Some(1));
        assert_eq!((lacking(&scores), shared(&scores).len()), (vec![12, 0], 12));
        assert!((behind(&scores[0], &scores[1]) - 0.0008).abs() < 1e-12);
    }

    /// Each is ahead of the next, the last of the first: by 1, by 2 and by 3.
    #[test]
    fn of_designs_of_which_each_is_behind_another_the_best_is_the_one_that_is_least_so() {
        let scores = vec![
            vec![Some(1.0), Some(0.0), None],
            vec![Some(0.0), None, Some(2.0)],
            vec![None, Some(3.0), Some(0.0)],
        ];
        let around = [[1, 0], [2, 1], [0, 2]].map(|[a, b]| behind(&scores[a], &scores[b]));
        assert_eq!(around, [1.0, 2.0, 3.0]);
        for order in [[0, 1, 2], [2, 1, 0], [1, 2, 0]] {
            assert_eq!(best(&scores, &order), Some(1), "{order:?}");
        }
    }

    #[test]
    fn a_design_that_shares_no_situation_is_behind_where_it_knows_fewer() {
        let scores = vec![vec![Some(9.0), None, None], vec![None, Some(1.0), Some(2.0)], vec![None; 3]];
        assert_eq!(
            [behind(&scores[0], &scores[1]), behind(&scores[1], &scores[0])].map(f64::signum),
            [1.0, -1.0]
        );
        assert_eq!(best(&scores, &all(&scores)), Some(1));
        assert_eq!(best(&scores, &[2]), None);
    }

    #[test]
    fn where_all_know_the_same_situations_the_best_is_the_first_of_the_greatest_mean() {
        let mut random = ChaCha8Rng::seed_from_u64(11);
        for _ in 0..200 {
            // Few values, so that means are often equal.
            let mut value = |at: usize| (at != 2).then(|| f64::from(random.random_range(0..3_u32)));
            let scores: Vec<Vec<_>> = (0..9).map(|_| (0..5).map(&mut value).collect()).collect();
            let mean = |own: &Vec<Option<f64>>| own.iter().flatten().sum::<f64>() / 4.0;
            let greatest = scores.iter().map(mean).fold(f64::NEG_INFINITY, f64::max);
            let first = scores.iter().position(|own| mean(own) == greatest);
            assert_eq!(best(&scores, &all(&scores)), first, "{scores:?}");
            assert_eq!(lacking(&scores), [0; 9]);
        }
    }

    /// The rule as it is written down, without its short cuts.
    #[test]
    fn the_best_is_that_of_all_pairs() {
        let mut random = ChaCha8Rng::seed_from_u64(12);
        for _ in 0..300 {
            let mut value = |_| (random.random::<f64>() < 0.6).then(|| random.random::<f64>());
            let scores: Vec<Vec<_>> = (0..7).map(|_| (0..6).map(&mut value).collect()).collect();
            let known: Vec<usize> = by_mean(&scores, &all(&scores)).into_iter().map(|(d, _)| d).collect();
            let greatest = |design: &usize| {
                let rivals = known.iter().filter(|rival| *rival != design);
                rivals
                    .map(|rival| behind(&scores[*design], &scores[*rival]))
                    .fold(f64::NEG_INFINITY, f64::max)
            };
            let expected = known.iter().copied().min_by(|a, b| greatest(a).total_cmp(&greatest(b)));
            assert_eq!(best(&scores, &all(&scores)), expected, "{scores:?}");
        }
    }
}
