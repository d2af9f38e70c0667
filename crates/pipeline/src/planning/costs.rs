//! Processor seconds, on the reference machine, of a plan, of the scene before it, and of each part.

use crate::chain::expectation::Expectation;
use crate::chain::link::Chain;
use crate::chain::plan::FramePlan;
use crate::host::failure::Failure;
use crate::host::memory::Allowance;
use crate::planning::choice::SpecifiedPhysics;
use crate::planning::physics_part::PhysicsPart;
use artifact::scene::SceneHeader;
use bart_rcs::Tracer;
use std::collections::BTreeMap;

/// Whether a plan includes the cost of each part of the physics.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PartCosts {
    Estimated,
    Omitted,
}

/// Expected processor seconds.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct PlanSeconds {
    /// Scene before the plan, with its accuracy.
    pub(crate) as_said: f64,
    /// Scene as planned.
    pub(crate) planned: f64,
    /// Seconds of the plan with one more or one fewer part.
    pub(crate) with_one_changed: BTreeMap<PhysicsPart, f64>,
    /// Seconds of the plan with one more order of reflection.
    pub(crate) with_one_bounce_more: Option<f64>,
}

/// Estimates the seconds of a plan, unless they are known, and, if part costs are requested, of its
/// neighbours, which differ in the physics that the scene does not specify.
pub(crate) fn seconds(
    before: &SceneHeader,
    (planned, planned_s): (&SceneHeader, Option<f64>),
    open: Option<&SpecifiedPhysics>,
    expected_s: impl Fn(&SceneHeader) -> Result<f64, Failure>,
) -> Result<PlanSeconds, Failure> {
    let planned_s = planned_s.map_or_else(|| expected_s(planned), Ok)?;
    let mut seconds =
        PlanSeconds { as_said: expected_s(before)?, planned: planned_s, ..PlanSeconds::default() };
    let Some(specified) = open else { return Ok(seconds) };
    for part in PhysicsPart::ALL.into_iter().filter(|part| !specified.parts.contains_key(part)) {
        if let Some(changed) = changed(planned, part) {
            seconds.with_one_changed.insert(part, expected_s(&changed)?);
        }
    }
    if usize::from(planned.fidelity.bounces) < artifact::paths::MAX_ORDER {
        let mut more = planned.clone();
        more.fidelity.bounces += 1;
        seconds.with_one_bounce_more = Some(expected_s(&more)?);
    }
    Ok(seconds)
}

/// The scene with one part switched on or off; `None` if that requires another mesh.
fn changed(planned: &SceneHeader, part: PhysicsPart) -> Option<SceneHeader> {
    if part == PhysicsPart::Sheets {
        return None;
    }
    let mut header = planned.clone();
    match part.is_in(planned) {
        true => part.leave_out(&mut header),
        false => part.model(&mut header),
    }
    Some(header)
}

/// Expected processor seconds on the reference machine, so that a plan is the same on every machine.
pub(crate) fn expected_s(header: &SceneHeader, tracer: &Tracer, memory: Allowance) -> Result<f64, Failure> {
    let chain = Chain::of(header, None, None, memory).tracing_by(tracer.clone());
    let plans: Vec<FramePlan> = (0..header.frames).map(|index| chain.plan(index)).collect();
    Ok(Expectation::at_speed(&chain, None, &plans, 1.0)?.seconds)
}
