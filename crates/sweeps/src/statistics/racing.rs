//! Racing (successive elimination): designs that may still be the best; the others are not repeated further.

use crate::statistics::betting_capital::capital;
use crate::statistics::interval::{Mean, ValueRange};
use crate::statistics::pairs::{best, by_mean};

/// Rule for dropping designs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EliminationRule {
    /// Probability that the best design is never dropped, over all looks.
    pub(crate) confidence: f64,
    /// Least number of situations before a design is dropped.
    pub(crate) least: usize,
    /// Largest number of looks at the designs.
    pub(crate) looks: usize,
    /// Possible values of scores, up to their sign.
    pub(crate) scale: ValueRange,
}

/// Designs among the `open` ones that stay, in their order; `scores` has each design's by situation, more is
/// better. The best by pairs ([`best`]) stays, as does each that is not worse than others by paired
/// differences. For bounded values a design is worse if the capital bet against it, on each of the others,
/// has grown enough ([`capital`]): for any distribution, at any number of looks. For other values it is worse
/// than the best by Student's interval, at a confidence shared by all comparisons with every other design at
/// every look (Bonferroni).
pub(crate) fn survivors(scores: &[Vec<Option<f64>>], open: &[usize], rule: &EliminationRule) -> Vec<usize> {
    let Some(best) = best(scores, open) else { return open.to_vec() };
    let rivals = ranked(scores, open);
    let is_worse = |design: usize| match rule.scale {
        ValueRange::Within([least, greatest]) => {
            let bets =
                |rival: &usize| capital_against(scores, [*rival, design], greatest - least, rule.least);
            let won: f64 = rivals.iter().filter(|rival| **rival != design).map(bets).sum();
            won * (1.0 - rule.confidence) >= scores.len().saturating_sub(1) as f64
        }
        ValueRange::Any | ValueRange::Fixed => {
            let confidence = bonferroni(rule.confidence, scores.len().saturating_sub(1) * rule.looks);
            let behind = Mean::of_pairs([&scores[best], &scores[design]], rule.scale, confidence);
            behind.is_some_and(|behind| behind.count >= rule.least && behind.low() > 0.0)
        }
    };
    open.iter().copied().filter(|design| *design == best || !is_worse(*design)).collect()
}

/// The open designs with the greatest means, sixty-four at most. Bets on the others are lost: they count in
/// the average and win nothing, so restricting the comparison to good designs eliminates bad ones sooner.
fn ranked(scores: &[Vec<Option<f64>>], open: &[usize]) -> Vec<usize> {
    const RIVALS: usize = 64;
    by_mean(scores, open).iter().take(RIVALS).map(|(design, _)| *design).collect()
}

/// Capital bet on one design against another, whose differences are at most `span`; none before both have
/// seen `least` situations.
fn capital_against(
    scores: &[Vec<Option<f64>>],
    [design, against]: [usize; 2],
    span: f64,
    least: usize,
) -> f64 {
    let pairs = scores[design].iter().zip(&scores[against]);
    let differences = pairs.filter_map(|(a, b)| Some(((*a)? - (*b)?) / span));
    if differences.clone().count() < least { 0.0 } else { capital(differences) }
}

/// Confidence of each of several statements that hold jointly at a given confidence (Bonferroni). A two-sided
/// interval errs to one side half as often; this margin is kept as a reserve.
pub(crate) fn bonferroni(confidence: f64, statements: usize) -> f64 {
    1.0 - (1.0 - confidence) / statements.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    const RULE: EliminationRule =
        EliminationRule { confidence: 0.95, least: 4, looks: 6, scale: ValueRange::Any };

    /// Values about the designs' means, with a part that all designs of a situation share.
    fn toy(means: &[f64], situations: usize, seed: u64) -> Vec<Vec<Option<f64>>> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
        let shared: Vec<f64> = (0..situations).map(|_| 3.0 * normal()).collect();
        let of = |mean: &f64| shared.iter().map(|s| Some(mean + s + normal())).collect::<Vec<_>>();
        means.iter().map(of).collect()
    }

    /// Designs that are left after looks at 4, 8, … situations, and how many runs that took.
    fn contest(scores: &[Vec<Option<f64>>]) -> (Vec<usize>, usize) {
        let (mut open, mut runs) = ((0..scores.len()).collect::<Vec<_>>(), 0);
        for look in 1..=RULE.looks {
            runs += 4 * open.len();
            let seen: Vec<_> = scores.iter().map(|all| all[..4 * look].to_vec()).collect();
            open = survivors(&seen, &open, &RULE);
        }
        (open, runs)
    }

    #[test]
    fn the_true_best_is_dropped_no_more_often_than_was_allowed() {
        let means = [0.0, 0.3, 0.8, 1.0, 0.9, -2.0];
        let dropped = (0..400).filter(|seed| !contest(&toy(&means, 24, *seed)).0.contains(&3)).count();
        assert!(dropped <= 20, "{dropped} of 400, 5 % are allowed");
    }

    #[test]
    fn what_is_far_behind_is_repeated_no_further() {
        let (open, runs) = contest(&toy(&[0.0, 8.0, 0.5, 1.0], 24, 5));
        assert_eq!(open, [1]);
        assert!(runs < 4 * 24, "{runs} runs");
    }

    #[test]
    fn four_situations_alike_drop_nobody_and_many_do() {
        let shares = |count: usize| [0.6, 1.0].map(|share| vec![Some(share); count]);
        let rule = EliminationRule { scale: ValueRange::SHARE, ..RULE };
        assert_eq!(survivors(&shares(4), &[0, 1], &rule), [0, 1]);
        assert_eq!(survivors(&shares(24), &[0, 1], &rule), [1]);
    }

    /// Shares of two designs: one is a thirtieth better in nine of ten situations and without any target in
    /// one of twenty, so that the other is better by a fiftieth.
    fn with_rare_failures(situations: usize, seed: u64) -> Vec<Vec<Option<f64>>> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut better = || match random.random::<f64>() {
            chance if chance < 0.05 => 0.0,
            chance if chance < 0.95 => 1.0,
            _ => 29.0 / 30.0,
        };
        vec![(0..situations).map(|_| Some(better())).collect(), vec![Some(29.0 / 30.0); situations]]
    }

    #[test]
    fn the_true_best_of_shares_is_dropped_no_more_often_than_was_allowed_however_rare_its_rivals_fail() {
        let rule = EliminationRule { looks: 50, scale: ValueRange::SHARE, ..RULE };
        let is_dropped = |seed: &u64| {
            let scores = with_rare_failures(200, *seed);
            (1..=50).any(|look| {
                let seen: Vec<_> = scores.iter().map(|all| all[..4 * look].to_vec()).collect();
                survivors(&seen, &[0, 1], &rule) == [0]
            })
        };
        let dropped = (0..400).filter(is_dropped).count();
        assert!(dropped <= 20, "{dropped} of 400, 5 % are allowed");
    }

    /// Situations in which a bad design's share is as far behind as it can be, by half and by a tenth, and
    /// how many it takes until it is left, beside one rival and beside sixty-four equals: of the first 2⁷/7
    /// and what smaller bets win have to reach 20.
    #[test]
    fn a_design_is_left_the_sooner_the_more_are_better() {
        let rule = EliminationRule { least: 2, scale: ValueRange::SHARE, ..RULE };
        let takes = |behind: f64, rivals: usize| {
            let scores = |n: usize| {
                let mut all = vec![vec![Some(1.0); n]; rivals];
                all.push(vec![Some(1.0 - behind); n]);
                all
            };
            let open: Vec<usize> = (0..=rivals).collect();
            (2..400).find(|n| survivors(&scores(*n), &open, &rule).len() == rivals)
        };
        assert_eq!([1.0, 0.5, 0.1].map(|behind| takes(behind, 1)), [Some(7), Some(12), Some(51)]);
        assert_eq!([1.0, 0.5, 0.1].map(|behind| takes(behind, 64)), [Some(7), Some(12), Some(51)]);
    }

    #[test]
    fn equal_designs_and_few_situations_drop_nobody() {
        let equal = vec![vec![Some(1.0); 8]; 3];
        assert_eq!(survivors(&equal, &[0, 1, 2], &RULE), [0, 1, 2]);
        let few = vec![vec![Some(1.0); 3], vec![Some(0.0); 3]];
        assert_eq!(survivors(&few, &[0, 1], &RULE), [0, 1]);
        assert_eq!(survivors(&[vec![None], vec![None]], &[0, 1], &RULE), [0, 1]);
    }
}
