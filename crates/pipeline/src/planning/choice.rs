//! Choices of the modelled physics, made from the share of each part of the echo.

use crate::planning::echo_shares::EchoShares;
use crate::planning::physics_part::PhysicsPart;
use std::collections::{BTreeMap, BTreeSet};

/// Physics that the scene itself specifies and that is not chosen.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct SpecifiedPhysics {
    /// Highest order of reflection.
    pub(crate) bounces: Option<u8>,
    /// Parts, and whether they are modelled.
    pub(crate) parts: BTreeMap<PhysicsPart, bool>,
}

/// Relative amplitude error that a plan may spend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Budget {
    /// Total error of all choices.
    pub(crate) whole: f64,
    /// Reason why that is more than was requested.
    pub(crate) limit: AccuracyLimit,
}

/// Reason why an accuracy is no finer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AccuracyLimit {
    /// The requested accuracy.
    Requested,
    /// The method: node rules disagree by more.
    Nodes,
    /// The noise of the map hides what is finer.
    Noise,
}

/// Share of the largest error of the method that all other errors may take: half of it adds a tenth, 1 dB.
const METHOD_SHARE: f64 = 0.5;

impl Budget {
    /// Budget of an accuracy: no finer than the method, nor than the noise.
    pub(crate) fn of(asked: f64, shares: &EchoShares) -> Self {
        let candidates = [
            (asked, AccuracyLimit::Requested),
            (METHOD_SHARE * shares.nodes, AccuracyLimit::Nodes),
            (shares.noise, AccuracyLimit::Noise),
        ];
        let largest = candidates.into_iter().reduce(|a, b| if b.0 > a.0 { b } else { a });
        let (whole, limit) = largest.unwrap_or((asked, AccuracyLimit::Requested));
        // At the amplitude itself, nothing at all would be modelled.
        Self { whole: whole.min(COARSEST), limit }
    }
}

/// Coarsest accuracy that a plan spends, −3 dB: coarser cells and integrals mean little.
const COARSEST: f64 = 0.7;

/// Modelled physics, and its accuracy.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PhysicsChoice {
    /// Highest order of reflection.
    pub(crate) bounces: u8,
    /// Parts that are modelled.
    pub(crate) modelled: BTreeSet<PhysicsPart>,
    /// Relative amplitude of all that is omitted by choice.
    pub(crate) left_out: f64,
    /// Relative amplitude error allowed to integrals, cells and the echo.
    pub(crate) numerical: f64,
    /// Whether node rules differ so little that the cheapest suffices.
    pub(crate) any_node_rule: bool,
}

/// Highest order of reflection in a scene.
const MOST_BOUNCES: u8 = artifact::paths::MAX_ORDER as u8;
/// Largest share of the budget's power that may be left out. Two of five plans that left out 0.7 to 0.85 of
/// it erred by more than they spend, but only one of twenty that left out less
/// (`docs/validation/planner.md`).
const LEFT_OUT_POWER: f64 = 0.7;
/// Ratio of the expected to the reported powers: shares are reported with the margin of the look, 1.4, and
/// integrals and cells have on average half of their allowed error (`docs/planning.md`).
const EXPECTED_LEFT_OUT: f64 = 1.0 / (1.4 * 1.4);
const EXPECTED_NUMERICAL: f64 = 0.25;
/// Share of the budget's power for integrals above which their additional cost is negligible.
const NEARLY_ALL: f64 = 0.6;
/// Share of the budget below which a difference between node rules is negligible.
const ONE_NODE_RULE: f64 = 0.25;

impl PhysicsChoice {
    /// Choices that keep the budget and omit as much as possible; the rest of the budget is for integrals.
    /// The first choice is the whole physics, where the omissions would require considerably finer integrals.
    /// The cheapest choice depends on the costs.
    ///
    /// Omissions are judged by power: parts of an echo have independent phases.
    pub(crate) fn all(budget: &Budget, shares: &EchoShares, specified: &SpecifiedPhysics) -> Vec<Self> {
        let whole = Physics::whole(specified);
        let begin = whole.left_out_power(shares);
        let chosen = |physics: &Physics| (physics.left_out_power(shares) - begin).max(0.0);
        let room = LEFT_OUT_POWER * budget.whole.powi(2);
        let keeps = |physics: &Physics| chosen(physics) <= room;
        let any_node_rule = shares.nodes <= ONE_NODE_RULE * budget.whole;
        let leaves_most = |physics: &Physics| !physics.with_one_omitted(specified).iter().any(keeps);
        let every = whole.all_reductions(specified);
        let least = every.iter().filter(|physics| keeps(physics) && leaves_most(physics));
        let of = |physics: &Physics| Self {
            left_out: chosen(physics).sqrt(),
            numerical: budget.whole * numerical_power(chosen(physics) / budget.whole.powi(2)).sqrt(),
            bounces: physics.bounces,
            modelled: physics.modelled.clone(),
            any_node_rule,
        };
        let mut all: Vec<Self> = least.map(of).collect();
        let is_fine = |choice: &Self| choice.numerical.powi(2) < NEARLY_ALL * budget.whole.powi(2);
        if all.iter().any(is_fine) {
            all.insert(0, of(&whole));
        }
        all
    }
}

/// Power of the errors allowed to integrals and cells when `left_out` is omitted, both relative to the
/// budget's.
///
/// Both are given as bounds, which they seldom reach together: their sum is limited to the budget with the
/// expected values added linearly and the independent excesses of the bounds added by their squares, ℓ + n +
/// √((L − ℓ)² + (N − n)²) = 1 with ℓ = [`EXPECTED_LEFT_OUT`]·L and n = [`EXPECTED_NUMERICAL`]·N.
fn numerical_power(left_out: f64) -> f64 {
    let room = 1.0 - EXPECTED_LEFT_OUT * left_out;
    let excess = (1.0 - EXPECTED_LEFT_OUT) * left_out;
    // (room − νN)² = excess² + (1 − ν)²N² is a quadratic equation, with N as its positive root.
    let (half, quadratic) = (EXPECTED_NUMERICAL * room, 1.0 - 2.0 * EXPECTED_NUMERICAL);
    let constant = room.powi(2) - excess.powi(2);
    ((half.powi(2) + quadratic * constant).sqrt() - half) / quadratic
}

/// A set of modelled physics, between all of it and the least.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Physics {
    bounces: u8,
    modelled: BTreeSet<PhysicsPart>,
}

impl Physics {
    /// All physics except that which the scene itself omits.
    fn whole(specified: &SpecifiedPhysics) -> Self {
        let is_in = |part: &PhysicsPart| specified.parts.get(part).copied().unwrap_or(true);
        Self {
            bounces: specified.bounces.unwrap_or(MOST_BOUNCES),
            modelled: PhysicsPart::ALL.into_iter().filter(is_in).collect(),
        }
    }

    /// Omits one more part or order, in every possible way.
    fn with_one_omitted(&self, specified: &SpecifiedPhysics) -> Vec<Self> {
        let open = |part: &PhysicsPart| self.modelled.contains(part) && !specified.parts.contains_key(part);
        let without = |part: PhysicsPart| {
            let mut modelled = self.modelled.clone();
            modelled.remove(&part);
            Self { modelled, ..*self }
        };
        let fewer = (specified.bounces.is_none() && self.bounces > 1)
            .then(|| Self { bounces: self.bounces - 1, modelled: self.modelled.clone() });
        fewer.into_iter().chain(PhysicsPart::ALL.into_iter().filter(open).map(without)).collect()
    }

    /// This physics and all that omit more, in the order of orders and parts.
    fn all_reductions(&self, specified: &SpecifiedPhysics) -> BTreeSet<Self> {
        let mut every = BTreeSet::from([self.clone()]);
        let mut open = vec![self.clone()];
        while let Some(physics) = open.pop() {
            open.extend(
                physics.with_one_omitted(specified).into_iter().filter(|less| every.insert(less.clone())),
            );
        }
        every
    }

    fn left_out_power(&self, shares: &EchoShares) -> f64 {
        let is_out = |part: PhysicsPart| !self.modelled.contains(&part);
        let sheets = if is_out(PhysicsPart::Sheets) { shares.sheets.powi(2) } else { 0.0 };
        let orders = (1..).zip(shares.within.iter().zip(&shares.between));
        let of_order = |(order, (within, between)): (u8, (&f64, &f64))| {
            let is_beyond = order > self.bounces;
            let of_part =
                |part: PhysicsPart, share: f64| if is_beyond || is_out(part) { share.powi(2) } else { 0.0 };
            let within = if is_beyond { within.powi(2) } else { 0.0 };
            within
                + of_part(PhysicsPart::BetweenBodies, *between)
                + of_part(PhysicsPart::Road, shares.by_road(order))
                + of_part(PhysicsPart::Edges, shares.by_edges(order))
        };
        orders.map(of_order).sum::<f64>()
            + if self.bounces < MOST_BOUNCES { higher_orders_power(shares) } else { 0.0 }
            + sheets
    }
}

/// Power of the orders beyond the look, extrapolated from the ratio of the last two, and at most that of the
/// last.
fn higher_orders_power(shares: &EchoShares) -> f64 {
    let power = |at: usize| {
        let order = at as u8 + 1;
        let all = [shares.within[at], shares.between[at], shares.by_road(order), shares.by_edges(order)];
        all.iter().map(|share| share.powi(2)).sum::<f64>()
    };
    let count = shares.within.len().min(shares.between.len());
    match count {
        0 | 1 => 0.0,
        _ => {
            let (last, before) = (power(count - 1), power(count - 2));
            if before > 0.0 { last * (last / before).min(1.0) } else { last }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shares() -> EchoShares {
        EchoShares {
            within: vec![1.0, 0.3, 0.03, 0.003],
            between: vec![0.0, 0.02, 0.002, 0.0002],
            nodes: 0.0,
            road: Some(vec![0.2, 0.02, 0.0, 0.0]),
            whole_with_road: 1.0,
            edges: vec![0.01, 0.0, 0.0, 0.0],
            sheets: 0.0,
            noise: 0.0,
        }
    }

    fn all(asked: f64, shares: &EchoShares, specified: &SpecifiedPhysics) -> Vec<PhysicsChoice> {
        PhysicsChoice::all(&Budget::of(asked, shares), shares, specified)
    }

    #[test]
    fn choices_leave_out_all_that_the_budget_spares_and_the_rest_is_the_integrals() {
        let all = all(0.1, &shares(), &SpecifiedPhysics::default());
        let [least] = &all[..] else { panic!("{all:?}") };
        assert_eq!((least.bounces, &least.modelled), (2, &BTreeSet::from([PhysicsPart::Road])));
        let left =
            [0.03, 0.003, 0.02, 0.002, 0.0002, 0.01].map(|share: f64| share.powi(2)).iter().sum::<f64>();
        assert!((least.left_out.powi(2) / left - 1.0).abs() < 1e-2, "{}", least.left_out);
        assert!(least.numerical > 0.09, "integrals keep nearly all of it: {}", least.numerical);
    }

    #[test]
    fn all_of_the_physics_is_a_choice_where_what_is_left_out_takes_much_of_the_integrals() {
        let much = EchoShares { within: vec![1.0, 0.3, 0.079, 0.003], ..shares() };
        let all = all(0.1, &much, &SpecifiedPhysics::default());
        assert_eq!((all[0].bounces, all[0].modelled.len(), all[0].left_out), (5, 4, 0.0), "everything on");
        assert!((all[0].numerical - 0.1).abs() < 1e-12, "nothing left out: {}", all[0].numerical);
        let [least] = &all[1..] else { panic!("{all:?}") };
        assert_eq!(least.bounces, 2);
        let left: f64 = [0.079, 0.003, 0.02, 0.002, 0.01].iter().map(|share: &f64| share.powi(2)).sum();
        assert!((least.left_out.powi(2) / left - 1.0).abs() < 1e-3, "{}", least.left_out);
    }

    #[test]
    fn bounds_of_what_is_left_out_and_of_integrals_add_up_to_the_budget() {
        for left_out in [0.0, 0.1, 0.5, LEFT_OUT_POWER, 1.0] {
            let numerical = numerical_power(left_out);
            assert!((0.0..=1.0).contains(&numerical), "{left_out}: {numerical}");
            let expected = [EXPECTED_LEFT_OUT * left_out, EXPECTED_NUMERICAL * numerical];
            let excess = (left_out - expected[0]).hypot(numerical - expected[1]);
            let sum = expected[0] + expected[1] + excess;
            assert!((sum - 1.0).abs() < 1e-12, "{left_out}: {numerical}, {sum}");
        }
        assert!((numerical_power(0.0) - 1.0).abs() < 1e-15 && numerical_power(1.0).abs() < 1e-15);
        assert!(numerical_power(LEFT_OUT_POWER) > 0.3, "{}", numerical_power(LEFT_OUT_POWER));
    }

    #[test]
    fn where_one_part_or_the_other_can_be_spared_both_are_choices() {
        let either = EchoShares { within: vec![1.0, 0.5, 0.08, 0.0], road: Some(vec![0.08]), ..shares() };
        let modelled: Vec<(u8, bool)> = all(0.1, &either, &SpecifiedPhysics::default())
            .iter()
            .filter(|choice| choice.left_out > 0.0)
            .map(|choice| (choice.bounces, choice.modelled.contains(&PhysicsPart::Road)))
            .collect();
        assert_eq!(modelled, [(2, true), (3, false)]);
    }

    #[test]
    fn a_coarser_accuracy_lets_more_be_left_out() {
        let mut before = usize::MAX;
        for asked in [0.003, 0.01, 0.03, 0.1, 0.3] {
            let choice = all(asked, &shares(), &SpecifiedPhysics::default()).pop().unwrap();
            let modelled = choice.modelled.len() + usize::from(choice.bounces);
            assert!(modelled <= before, "{asked}");
            before = modelled;
        }
    }

    #[test]
    fn what_the_scene_says_is_neither_left_out_nor_counted_as_a_choice() {
        let parts = BTreeMap::from([(PhysicsPart::Road, false), (PhysicsPart::Edges, true)]);
        let specified = SpecifiedPhysics { bounces: Some(4), parts };
        let choice = all(0.1, &shares(), &specified).pop().unwrap();
        assert_eq!((choice.bounces, choice.modelled), (4, BTreeSet::from([PhysicsPart::Edges])));
        assert!((choice.left_out - 0.02_f64.hypot(0.002).hypot(0.0002)).abs() < 1e-9);
    }

    #[test]
    fn edges_of_an_order_that_cannot_be_spared_are_modelled_with_the_road_up_to_it() {
        let both = EchoShares { edges: vec![0.01, 0.0, 0.15, 0.0], ..shares() };
        let least = all(0.1, &both, &SpecifiedPhysics::default()).pop().unwrap();
        assert_eq!(
            (least.bounces, least.modelled),
            (3, BTreeSet::from([PhysicsPart::Road, PhysicsPart::Edges]))
        );
    }

    #[test]
    fn nothing_is_spent_beyond_what_the_method_or_the_noise_lets_be_seen() {
        let rules = EchoShares { nodes: 0.4, ..shares() };
        assert_eq!(Budget::of(0.03, &rules), Budget { whole: 0.2, limit: AccuracyLimit::Nodes });
        let noisy = EchoShares { noise: 0.05, ..shares() };
        assert_eq!(Budget::of(0.03, &noisy), Budget { whole: 0.05, limit: AccuracyLimit::Noise });
        assert_eq!(Budget::of(0.3, &rules), Budget { whole: 0.3, limit: AccuracyLimit::Requested });
    }

    #[test]
    fn orders_beyond_the_look_fall_as_the_last_did_and_never_grow() {
        let power = |share: f64| share.powi(2);
        let falling = higher_orders_power(&shares());
        assert!((falling / (power(0.003) / 100.0) - 1.0).abs() < 0.02, "{falling}");
        let rising = EchoShares { within: vec![1.0, 0.1, 0.1, 0.2], between: vec![0.0; 4], ..shares() };
        assert!((higher_orders_power(&rising) - power(0.2)).abs() < 1e-15);
    }
}
