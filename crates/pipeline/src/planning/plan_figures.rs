//! A plan in figures, for `summary.json`, and in lines of text.

use crate::planning::choice::{AccuracyLimit, Budget, PhysicsChoice, SpecifiedPhysics};
use crate::planning::costs::PlanSeconds;
use crate::planning::echo_shares::{EchoShares, together};
use crate::planning::physics_part::PhysicsPart;
use artifact::Accuracy;
use artifact::scene::SceneHeader;
use artifact::settings::NodeRule;
use artifact::units::db_from_amplitude;
use serde::{Deserialize, Serialize};

/// Plan of a scene's physics in figures.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlanFigures {
    /// Requested accuracy, dB.
    pub asked_db: f64,
    /// Accuracy that is spent, dB: coarser than requested where a finer one has no use.
    pub spent_db: f64,
    /// Reason why the accuracy is no finer: "asked", "nodes" or "noise".
    pub limited_by: String,
    /// Total share of the omitted parts, dB.
    pub left_out_db: f64,
    /// Accuracy of integrals, cells and echo, dB.
    pub numerical_db: f64,
    /// Highest order of reflection.
    pub bounces: u8,
    /// Rule for the facet on which a multiple reflection is integrated.
    pub nodes: String,
    /// Number of frames from one measurement of errors to the next.
    pub measured_every: u32,
    /// Expected processor seconds of the plan on the reference machine.
    pub processor_s: f64,
    /// Expected processor seconds of the scene with its own keys and their defaults.
    pub as_said_processor_s: f64,
    /// Parts of the physics.
    pub parts: Vec<PartFigures>,
}

/// A part of the physics in a plan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PartFigures {
    /// Name of the part.
    pub name: String,
    /// Whether it is modelled.
    pub modelled: bool,
    /// Whether the scene itself specifies it.
    pub said: bool,
    /// Share in the whole echo, dB: the error of leaving it out; `None` if unknown.
    pub share_db: Option<f64>,
    /// Expected processor seconds that it takes, or would take; `None` if not estimated.
    pub processor_s: Option<f64>,
}

/// A choice with its basis.
pub(crate) struct ChosenPlan {
    pub(crate) asked: Accuracy,
    pub(crate) budget: Budget,
    pub(crate) shares: EchoShares,
    pub(crate) specified: SpecifiedPhysics,
    pub(crate) choice: PhysicsChoice,
    pub(crate) seconds: PlanSeconds,
}

impl ChosenPlan {
    /// Figures of the plan, whose choice is already in the header.
    pub(crate) fn figures(&self, planned: &SceneHeader) -> PlanFigures {
        let Self { budget, choice, seconds, .. } = self;
        PlanFigures {
            asked_db: self.asked.db(),
            spent_db: db_from_amplitude(budget.whole),
            limited_by: limit_name(budget.limit).into(),
            left_out_db: db_from_amplitude(choice.left_out),
            numerical_db: db_from_amplitude(choice.numerical),
            bounces: choice.bounces,
            nodes: rule_name(planned.fidelity.nodes).into(),
            measured_every: planned.fidelity.measured_every,
            processor_s: seconds.planned,
            as_said_processor_s: seconds.as_said,
            parts: self.orders().chain(PhysicsPart::ALL.into_iter().map(|part| self.part(part))).collect(),
        }
    }

    /// Orders of reflection after the first; of those not modelled only the lowest has a cost.
    fn orders(&self) -> impl Iterator<Item = PartFigures> {
        let Self { shares, choice, seconds, .. } = self;
        let known = (2..).zip(shares.within.iter().zip(&shares.between).skip(1));
        known.map(|(order, (within, between)): (u8, (&f64, &f64))| {
            let is_next = order == choice.bounces + 1;
            let more_s = seconds.with_one_bounce_more.filter(|_| is_next).map(|s| s - seconds.planned);
            PartFigures {
                name: format!("reflections of order {order}"),
                modelled: order <= choice.bounces,
                said: self.specified.bounces.is_some(),
                share_db: Some(db_from_amplitude(within.hypot(*between))),
                processor_s: more_s.map(|s| s.max(0.0)),
            }
        })
    }

    fn part(&self, part: PhysicsPart) -> PartFigures {
        let Self { choice, seconds, .. } = self;
        let cost = seconds.with_one_changed.get(&part).map(|changed| (changed - seconds.planned).abs());
        PartFigures {
            name: part.name().into(),
            modelled: choice.modelled.contains(&part),
            said: self.specified.parts.contains_key(&part),
            share_db: share(part, &self.shares).map(db_from_amplitude),
            processor_s: cost,
        }
    }
}

impl PlanFigures {
    /// The plan with the seconds of a machine `machine_speed` times as fast as the reference machine.
    fn at_speed(&self, machine_speed: f64) -> Self {
        let mut here = self.clone();
        here.processor_s /= machine_speed;
        here.as_said_processor_s /= machine_speed;
        for seconds in here.parts.iter_mut().filter_map(|part| part.processor_s.as_mut()) {
            *seconds /= machine_speed;
        }
        here
    }

    /// Lines of the plan: its accuracy, and each part with its share and its cost, in seconds of a machine
    /// `machine_speed` times as fast as the reference machine
    /// ([`machine_speed`](crate::chain::expectation::machine_speed)).
    pub fn lines(&self, machine_speed: f64) -> Vec<String> {
        let here = self.at_speed(machine_speed);
        let mut lines = vec![self.first_line()];
        lines.extend(here.parts.iter().map(PartFigures::line));
        lines.push(format!(
            "plan: {} bounces, integrals and cells to {}, errors measured in every {}; about {} of processor \
             time, {} as the scene stands",
            self.bounces,
            level(Some(self.numerical_db)),
            frames(self.measured_every),
            spent(here.processor_s),
            spent(here.as_said_processor_s),
        ));
        lines
    }

    /// Line about the accuracy of the plan, and its limit.
    pub fn first_line(&self) -> String {
        let (asked, finer) = (level(Some(self.asked_db)), level(Some(self.spent_db)));
        match self.limited_by.as_str() {
            "nodes" => format!(
                "plan for {asked}: the node rules differ by twice {finer}, so that nothing finer is of use"
            ),
            "noise" => format!("plan for {asked}: what is below {finer} lies in the noise of the map"),
            _ => format!("plan for {asked}"),
        }
    }
}

impl PartFigures {
    /// Text for whether the part is modelled, and by whose choice.
    pub fn verdict(&self) -> &'static str {
        match (self.modelled, self.said) {
            (true, true) => "modelled, as the scene says",
            (false, true) => "left out, as the scene says",
            (true, false) => "modelled",
            (false, false) => "left out",
        }
    }

    fn line(&self) -> String {
        let verdict = self.verdict();
        let cost = self.processor_s.map_or(String::new(), |seconds| match self.modelled {
            true => format!(", takes {}", spent(seconds)),
            false => format!(", would take {}", spent(seconds)),
        });
        format!("  {:<24} {:>9}  {verdict}{cost}", self.name, level(self.share_db))
    }
}

fn share(part: PhysicsPart, shares: &EchoShares) -> Option<f64> {
    match part {
        PhysicsPart::BetweenBodies => Some(together(&shares.between)),
        PhysicsPart::Road => shares.road.as_deref().map(together),
        PhysicsPart::Edges => Some(together(&shares.edges)),
        PhysicsPart::Sheets => Some(shares.sheets),
    }
}

/// Name of a limit, as in [`PlanFigures::limited_by`].
pub(crate) fn limit_name(limit: AccuracyLimit) -> &'static str {
    match limit {
        AccuracyLimit::Requested => "asked",
        AccuracyLimit::Nodes => "nodes",
        AccuracyLimit::Noise => "noise",
    }
}

fn rule_name(rule: NodeRule) -> &'static str {
    match rule {
        NodeRule::Middle => "middle",
        NodeRule::Exit => "exit",
        NodeRule::OwnEdge => "own-edge",
    }
}

/// Text of a level, dB, in the lines of a plan.
pub fn level(db: Option<f64>) -> String {
    match db {
        None => "not told".into(),
        Some(db) if db <= artifact::units::LOWEST_DB => "nothing".into(),
        Some(db) => format!("{db:.1} dB").replace('-', "−"),
    }
}

fn spent(seconds: f64) -> String {
    let digits = usize::from(seconds < 10.0);
    format!("{seconds:.digits$} s")
}

fn frames(count: u32) -> String {
    match count {
        1 => "frame".into(),
        count => format!("{count} frames"),
    }
}
