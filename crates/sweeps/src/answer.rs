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
}

impl Answer {
    pub(crate) fn of(study: &Study, ledger: &Ledger) -> Self {
        let scores = scores(study, ledger);
        let best = contest::best(&scores, &ledger.open);
        let jointly = contest::jointly(study.confidence, ledger.designs().saturating_sub(1));
        let standing = |design: usize| Standing {
            mean: study.measures.mean(
                study.goal.metric,
                &ledger.metric(design, study.goal.metric),
                study.confidence,
            ),
            cost: Mean::of_known(&ledger.metric(design, study.goal.cost), study.confidence).map(|m| m.value),
            behind: best.and_then(|best| Mean::of_pairs(&scores[best], &scores[design], jointly)),
        };
        let standings: Vec<Standing> = (0..ledger.designs()).map(standing).collect();
        let candidates = candidates(study, ledger, &standings, best);
        let chosen = cheapest(study, &standings, &candidates);
        let front = front(study, &standings);
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
fn cheapest(study: &Study, standings: &[Standing], candidates: &[usize]) -> Option<usize> {
    let order = |a: &usize, b: &usize| by_cost(study, &standings[*a], &standings[*b]);
    candidates.iter().copied().filter(|d| standings[*d].cost.is_some()).min_by(order)
}

/// The cheaper first, of equally dear ones the better.
fn by_cost(study: &Study, a: &Standing, b: &Standing) -> std::cmp::Ordering {
    let worth = |s: &Standing| s.mean.map_or(f64::NEG_INFINITY, |mean| study.goal.better.rising(mean.value));
    let cost = |s: &Standing| s.cost.unwrap_or(f64::INFINITY);
    cost(a).total_cmp(&cost(b)).then(worth(b).total_cmp(&worth(a)))
}

fn front(study: &Study, standings: &[Standing]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..standings.len()).filter(|d| standings[*d].cost.is_some()).collect();
    order.sort_by(|a, b| by_cost(study, &standings[*a], &standings[*b]));
    let mut reached = f64::NEG_INFINITY;
    order.retain(|design| {
        let worth = standings[*design].mean.map(|mean| study.goal.better.rising(mean.value));
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
pub(crate) fn effects(study: &Study, designs: &[Vec<Pick>], ledger: &Ledger, axis: usize) -> Vec<Effect> {
    let picks = study.vary[axis].listed().unwrap_or_default();
    let scores = scores(study, ledger);
    let with = |pick: &Pick| (0..designs.len()).filter(|d| designs[*d][axis] == *pick).collect::<Vec<_>>();
    let effect = |pick: &Pick| {
        let with = with(pick);
        let values = |design: &usize| {
            let values = ledger.metric(*design, study.goal.metric);
            Mean::of_known(&values[..ledger.common()], 0.5).map(|mean| mean.value)
        };
        let means: Vec<f64> = with.iter().filter_map(values).collect();
        let mean = Mean::of(&means, 0.5).map(|mean| mean.value);
        Effect { label: pick.label.clone(), designs: with.len(), mean, best: contest::best(&scores, &with) }
    };
    picks.iter().map(effect).collect()
}
