//! Answer of a study: the best design, those that are not told apart from it, the cheapest of these, and
//! the front of what cannot be had better for less.

use crate::runs::ledger::Ledger;
use crate::statistics::contest;
use crate::statistics::interval::Mean;
use crate::study::axis::Pick;
use crate::study::document::Study;

/// Answer of a study; designs by their numbers.
pub(crate) struct Answer {
    pub(crate) standings: Vec<Standing>,
    /// The design of the best mean; `None` where the metric was never known.
    pub(crate) best: Option<usize>,
    /// Designs that are not told apart from the best and are behind it by no more than the margin, else by
    /// one standard error (Breiman, Friedman, Olshen, Stone 1984, §3.4.3); the best is among them.
    pub(crate) candidates: Vec<usize>,
    /// The cheapest of the candidates.
    pub(crate) chosen: Option<usize>,
    /// Designs than which none is both better and no dearer, the cheapest first.
    pub(crate) front: Vec<usize>,
    /// Confidence of each comparison, so that all hold together at the study's.
    pub(crate) jointly: f64,
}

/// A design at the end of a study.
pub(crate) struct Standing {
    /// Mean of the goal's metric with the study's interval.
    pub(crate) mean: Option<Mean>,
    /// Mean of what it costs.
    pub(crate) cost: Option<f64>,
    /// Distance behind the best, by paired differences; all such intervals hold together.
    pub(crate) behind: Option<Mean>,
    /// The goal's metric, more is better, as far as it is comparable with that of the others: the mean over
    /// the situations that the best has seen; of a design that was left before, whose situations may be
    /// harder or easier than the rest, the best's less the distance behind it.
    pub(crate) worth: Option<f64>,
}

impl Answer {
    pub(crate) fn of(study: &Study, ledger: &Ledger) -> Self {
        let scores = scores(study, ledger);
        let best = contest::best(&scores, &ledger.open);
        let jointly = contest::jointly(study.confidence, ledger.designs().saturating_sub(1));
        let rising = |design: usize| Mean::of_known(&scores[design], study.confidence).map(|mean| mean.value);
        let of_best = best.and_then(rising);
        let standing = |design: usize| {
            let pair = |best: usize| [&scores[best], &scores[design]].map(Vec::as_slice);
            let scale = study.measures.scale(study.goal.metric);
            let behind = best.and_then(|best| Mean::of_pairs(pair(best), scale, jointly));
            let less_behind = || Some(of_best? - behind?.value);
            let has_seen_less = best.is_some_and(|best| ledger.has_seen_less(design, best));
            Standing {
                mean: study.measures.mean(
                    study.goal.metric,
                    &ledger.metric(design, study.goal.metric),
                    study.confidence,
                ),
                cost: Mean::of_known(&ledger.metric(design, study.goal.cost), study.confidence)
                    .map(|m| m.value),
                behind,
                worth: if has_seen_less { less_behind() } else { rising(design) },
            }
        };
        let standings: Vec<Standing> = (0..ledger.designs()).map(standing).collect();
        let candidates = candidates(study, ledger, &standings, best);
        let chosen = cheapest(&standings, &candidates);
        let front = front(&standings);
        Self { standings, best, candidates, chosen, front, jointly }
    }
}

/// The goal's metric by design and situation, more is better.
pub(crate) fn scores(study: &Study, ledger: &Ledger) -> Vec<Vec<Option<f64>>> {
    let rising = |value: Option<f64>| value.map(|value| study.goal.better.rising(value));
    let of = |design| ledger.metric(design, study.goal.metric).into_iter().map(rising).collect();
    (0..ledger.designs()).map(of).collect()
}

fn candidates(study: &Study, ledger: &Ledger, standings: &[Standing], best: Option<usize>) -> Vec<usize> {
    let is_within = |behind: &Mean| {
        let margin = study.goal.margin.or(behind.standard_error).unwrap_or(0.0);
        behind.value <= margin
    };
    let is_candidate = |design: &usize| {
        let behind = standings[*design].behind.as_ref();
        Some(*design) == best || behind.is_some_and(|behind| behind.low() <= 0.0 && is_within(behind))
    };
    ledger.open.iter().copied().filter(is_candidate).collect()
}

/// The cheapest, of equally dear ones the best, of equally good ones the first.
fn cheapest(standings: &[Standing], candidates: &[usize]) -> Option<usize> {
    let order = |a: &usize, b: &usize| by_cost(&standings[*a], &standings[*b]);
    candidates.iter().copied().filter(|d| standings[*d].cost.is_some()).min_by(order)
}

/// The cheaper first, of equally dear ones the better.
fn by_cost(a: &Standing, b: &Standing) -> std::cmp::Ordering {
    let worth = |s: &Standing| s.worth.unwrap_or(f64::NEG_INFINITY);
    let cost = |s: &Standing| s.cost.unwrap_or(f64::INFINITY);
    cost(a).total_cmp(&cost(b)).then(worth(b).total_cmp(&worth(a)))
}

fn front(standings: &[Standing]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..standings.len()).filter(|d| standings[*d].cost.is_some()).collect();
    order.sort_by(|a, b| by_cost(&standings[*a], &standings[*b]));
    let mut reached = f64::NEG_INFINITY;
    order.retain(|design| {
        let worth = standings[*design].worth;
        let is_better = worth.is_some_and(|worth| worth > reached);
        reached = worth.filter(|_| is_better).unwrap_or(reached);
        is_better
    });
    order
}

/// Worth of one value of an axis.
pub(crate) struct Effect {
    pub(crate) label: String,
    /// Designs with it.
    pub(crate) designs: usize,
    /// Mean of the goal's metric over these designs, in the situations that every design has seen.
    pub(crate) mean: Option<f64>,
    /// The best of these designs.
    pub(crate) best: Option<usize>,
}

/// Effects of the listed values of an axis, in their order; none of an axis that is drawn.
pub(crate) fn effects(
    study: &Study,
    designs: &[Vec<Pick>],
    ledger: &Ledger,
    answer: &Answer,
    axis: usize,
) -> Vec<Effect> {
    let picks = study.vary[axis].listed().unwrap_or_default();
    let worth: Vec<Vec<Option<f64>>> = answer.standings.iter().map(|s| vec![s.worth]).collect();
    let with = |pick: &Pick| (0..designs.len()).filter(|d| designs[*d][axis] == *pick).collect::<Vec<_>>();
    let effect = |pick: &Pick| {
        let with = with(pick);
        let values = |design: &usize| {
            let values = ledger.metric(*design, study.goal.metric);
            Mean::of_known(&values[..ledger.common()], 0.5).map(|mean| mean.value)
        };
        let means: Vec<f64> = with.iter().filter_map(values).collect();
        let mean = Mean::of(&means, 0.5).map(|mean| mean.value);
        Effect { label: pick.label.clone(), designs: with.len(), mean, best: contest::best(&worth, &with) }
    };
    picks.iter().map(effect).collect()
}
