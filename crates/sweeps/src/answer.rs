//! Answer of a study: the best design, those that are statistically indistinguishable from it, the cheapest
//! of these, and the Pareto front of metric and cost.

use crate::runs::ledger::Ledger;
use crate::statistics::interval::Mean;
use crate::statistics::pairs;
use crate::statistics::racing;
use crate::study::axis::AxisChoice;
use crate::study::document::Study;

/// Answer of a study; designs are given by number.
pub(crate) struct Answer {
    pub(crate) results: Vec<DesignResult>,
    /// The best design by pairs ([`pairs::best`]), which has the best mean if all designs know the metric in
    /// the same situations; `None` if the metric was never known.
    pub(crate) best: Option<usize>,
    /// Designs that are indistinguishable from the best and behind it by no more than the margin, or without
    /// one by one standard error (Breiman, Friedman, Olshen, Stone 1984, §3.4.3); the best is among them.
    pub(crate) candidates: Vec<usize>,
    /// The cheapest of the candidates.
    pub(crate) chosen: Option<usize>,
    /// Designs for which no other is both better and no more expensive, the cheapest first: for each cost the
    /// best, if it is ahead of all cheaper ones and of those here.
    pub(crate) front: Vec<usize>,
    /// Situations in which all designs know the goal's metric, except those that never do.
    pub(crate) shared: Vec<usize>,
    /// Scores for the comparison of designs: their worth if all know the metric in the same situations, else
    /// by situation, so that two are compared over those that both know.
    compared: Vec<Vec<Option<f64>>>,
    /// Confidence of each comparison, so that all hold jointly at the study's.
    pub(crate) joint_confidence: f64,
}

/// A design at the end of a study.
pub(crate) struct DesignResult {
    /// Mean of the goal's metric with the study's interval.
    pub(crate) mean: Option<Mean>,
    /// Mean cost.
    pub(crate) cost: Option<f64>,
    /// Distance behind the best, by paired differences; all such intervals hold jointly.
    pub(crate) behind: Option<Mean>,
    /// The goal's metric, more is better, made comparable with that of the others: the mean over the
    /// situations of the best; for a design that was dropped earlier, whose situations may be harder or
    /// easier than the rest, the best's mean less the distance behind it.
    pub(crate) worth: Option<f64>,
    /// Number of situations in which only another design knows the goal's metric.
    pub(crate) lacks: usize,
}

impl Answer {
    pub(crate) fn of(study: &Study, ledger: &Ledger) -> Self {
        let scores = scores(study, ledger);
        let lacks = pairs::lacking(&scores);
        let best = pairs::best(&scores, &ledger.open);
        let joint_confidence = racing::bonferroni(study.confidence, ledger.designs().saturating_sub(1));
        let rising = |design: usize| Mean::of_known(&scores[design], study.confidence).map(|mean| mean.value);
        let of_best = best.and_then(rising);
        let result = |design: usize| {
            let pair = |best: usize| [&scores[best], &scores[design]].map(Vec::as_slice);
            let scale = study.metrics.scale(study.goal.metric);
            let behind = best.and_then(|best| Mean::of_pairs(pair(best), scale, joint_confidence));
            let less_behind = || Some(of_best? - behind?.value);
            let has_seen_less = best.is_some_and(|best| ledger.has_seen_less(design, best));
            DesignResult {
                mean: study.metrics.mean(
                    study.goal.metric,
                    &ledger.metric(design, study.goal.metric),
                    study.confidence,
                ),
                cost: Mean::of_known(&ledger.metric(design, study.goal.cost), study.confidence)
                    .map(|m| m.value),
                behind,
                worth: if has_seen_less { less_behind() } else { rising(design) },
                lacks: lacks[design],
            }
        };
        let results: Vec<DesignResult> = (0..ledger.designs()).map(result).collect();
        let candidates = candidates(study, ledger, &results, best);
        let shared = pairs::shared(&scores);
        let worth = || results.iter().map(|result| vec![result.worth]).collect();
        let compared = if lacks.iter().all(|lacks| *lacks == 0) { worth() } else { scores };
        let chosen = cheapest(&results, &compared, &candidates);
        let front = front(&results, &compared);
        Self { results, best, candidates, chosen, front, shared, compared, joint_confidence }
    }

    /// Whether some designs know the goal's metric in fewer situations than others.
    pub(crate) fn is_by_pairs(&self) -> bool {
        self.results.iter().any(|result| result.lacks > 0)
    }
}

/// The goal's metric by design and situation, more is better.
pub(crate) fn scores(study: &Study, ledger: &Ledger) -> Vec<Vec<Option<f64>>> {
    let rising = |value: Option<f64>| value.map(|value| study.goal.better.rising(value));
    let of = |design| ledger.metric(design, study.goal.metric).into_iter().map(rising).collect();
    (0..ledger.designs()).map(of).collect()
}

fn candidates(study: &Study, ledger: &Ledger, results: &[DesignResult], best: Option<usize>) -> Vec<usize> {
    let is_within = |behind: &Mean| {
        let margin = study.goal.margin.or(behind.standard_error).unwrap_or(0.0);
        behind.value <= margin
    };
    let is_candidate = |design: &usize| {
        let behind = results[*design].behind.as_ref();
        Some(*design) == best || behind.is_some_and(|behind| behind.low() <= 0.0 && is_within(behind))
    };
    ledger.open.iter().copied().filter(is_candidate).collect()
}

/// The cheapest, and among equally expensive ones the best.
fn cheapest(results: &[DesignResult], compared: &[Vec<Option<f64>>], candidates: &[usize]) -> Option<usize> {
    let by_cost = by_cost(results, candidates);
    by_cost.chunk_by(|a, b| a.1 == b.1).next().and_then(|cheapest| best_of(compared, cheapest))
}

/// Designs with their costs, the cheapest first, equally expensive ones in their order.
fn by_cost(results: &[DesignResult], designs: &[usize]) -> Vec<(usize, f64)> {
    let with_cost = |design: &usize| Some((*design, results[*design].cost?));
    let mut order: Vec<(usize, f64)> = designs.iter().filter_map(with_cost).collect();
    order.sort_by(|a, b| a.1.total_cmp(&b.1));
    order
}

fn best_of(compared: &[Vec<Option<f64>>], designs: &[(usize, f64)]) -> Option<usize> {
    pairs::best(compared, &designs.iter().map(|(design, _)| *design).collect::<Vec<_>>())
}

fn front(results: &[DesignResult], compared: &[Vec<Option<f64>>]) -> Vec<usize> {
    let all: Vec<usize> = (0..results.len()).collect();
    let mut front: Vec<usize> = vec![];
    for equally_dear in by_cost(results, &all).chunk_by(|a, b| a.1 == b.1) {
        let Some(best) = best_of(compared, equally_dear) else { continue };
        let is_behind = |cheaper: &usize| pairs::behind(&compared[*cheaper], &compared[best]) > 0.0;
        if front.iter().rev().all(is_behind) {
            front.push(best);
        }
    }
    front
}

/// Effect of one value of an axis.
pub(crate) struct Effect {
    pub(crate) label: String,
    /// Designs with it.
    pub(crate) designs: usize,
    /// Mean of the goal's metric over these designs, in the situations in which every design knows it.
    pub(crate) mean: Option<f64>,
    /// The best of these designs.
    pub(crate) best: Option<usize>,
}

/// Effects of the listed values of an axis, in their order; none for a drawn axis.
pub(crate) fn effects(
    study: &Study,
    designs: &[Vec<AxisChoice>],
    ledger: &Ledger,
    answer: &Answer,
    axis: usize,
) -> Vec<Effect> {
    let picks = study.vary[axis].listed().unwrap_or_default();
    let with =
        |pick: &AxisChoice| (0..designs.len()).filter(|d| designs[*d][axis] == *pick).collect::<Vec<_>>();
    let effect = |pick: &AxisChoice| {
        let with = with(pick);
        let values = |design: &usize| {
            let all = ledger.metric(*design, study.goal.metric);
            let shared: Vec<Option<f64>> = answer.shared.iter().map(|at| all[*at]).collect();
            Mean::of_known(&shared, 0.5).map(|mean| mean.value)
        };
        let means: Vec<f64> = with.iter().filter_map(values).collect();
        let mean = Mean::of(&means, 0.5).map(|mean| mean.value);
        let best = pairs::best(&answer.compared, &with);
        Effect { label: pick.label.clone(), designs: with.len(), mean, best }
    };
    picks.iter().map(effect).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Standings of designs of these costs.
    fn results(costs: &[f64]) -> Vec<DesignResult> {
        let of =
            |cost: &f64| DesignResult { mean: None, cost: Some(*cost), behind: None, worth: None, lacks: 0 };
        costs.iter().map(of).collect()
    }

    #[test]
    fn the_front_is_the_best_of_each_cost_that_is_better_than_all_cheaper_ones() {
        let results = results(&[4.0, 12.0, 4.0, 12.0, 1.0, 48.0, 48.0]);
        let worth = [0.5, 0.9, 0.7, 0.9, 0.7, 0.8, 1.0].map(|worth| vec![Some(worth)]);
        assert_eq!(front(&results, &worth), [4, 1, 6]);
        assert_eq!(cheapest(&results, &worth, &[0, 1, 2, 3]), Some(2), "of equally dear ones the better");
        assert_eq!(cheapest(&results, &worth, &[1, 3]), Some(1), "of equally good ones the first");
    }

    /// The first finds one situation of two, in which the second, as dear, is better; in the other this is
    /// worse than anything. The third is dearer and better than both in what they share.
    #[test]
    fn the_front_and_the_cheapest_are_those_of_pairs() {
        let scores = [vec![Some(-0.3), None], vec![Some(-0.2), Some(-9.0)], vec![Some(-0.1), Some(-8.0)]];
        let results = results(&[4.0, 4.0, 12.0]);
        assert_eq!(front(&results, &scores), [1, 2]);
        assert_eq!(cheapest(&results, &scores, &[0, 1, 2]), Some(1));
        let worse = [scores[0].clone(), scores[1].clone(), vec![Some(-0.25), Some(-9.5)]];
        assert_eq!(front(&results, &worse), [1]);
    }
}
