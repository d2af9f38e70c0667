//! Plan of the physics that a scene needs for one accuracy: a look measures the share of each part of the
//! echo, and parts that the accuracy can spare are left out (`docs/planning.md`).

pub(crate) mod physics_part; // parts that are modelled or left out
pub(crate) mod echo_shares; // share of each part, over the frames looked at
pub(crate) mod choice; // choice of the modelled parts, from these shares alone
pub(crate) mod costs; // processor seconds of each part
pub mod plan_figures; // lines and figures of a plan
pub(crate) mod below_road; // bodies that the road does not hide

use crate::chain::cache::Cache;
use crate::chain::loading::{self, LoadedScene, SceneSource};
use crate::host::failure::Failure;
use crate::host::memory::Allowance;
use crate::host::progress::{self, Work};
use artifact::Accuracy;
use artifact::scene::SceneHeader;
use artifact::settings::{EchoMode, NodeRule, Sides};
use choice::{Budget, PhysicsChoice, SpecifiedPhysics};
use costs::PartCosts;
use echo_shares::EchoShares;
use physics_part::PhysicsPart;
use plan_figures::{ChosenPlan, PlanFigures};
use scene::{PhysicsKeys, Planning};
use std::path::Path;
use std::slice;

/// Scene as it is run, with the plan of its physics if one was requested.
pub struct PlannedScene {
    /// Scene as the stages take it, with the chosen physics in its settings.
    pub loaded: LoadedScene,
    /// Figures of the plan; `None` if the scene specifies all of its physics.
    pub plan: Option<PlanFigures>,
    /// Whether a plan was requested, and the scene was looked at.
    pub is_looked_at: bool,
    /// Physics that the scene's file specifies.
    pub said: PhysicsKeys,
}

/// Loads a scene as [`loading::scene`] does, and chooses its physics if its file, or an accuracy on the
/// command line, requests that.
///
/// # Errors
/// Those of loading and of the look; a plan for far-field tables, which have no paths to leave out.
pub fn scene(
    source: &SceneSource,
    cache: Option<&Cache>,
    memory: Allowance,
) -> Result<PlannedScene, Failure> {
    load_and_plan(source, cache, memory, PartCosts::Omitted)
}

/// Loads and plans a scene, with the expected cost of each part of the physics
/// ([`plan_figures::PartFigures::processor_s`]): only for display, because it takes a look for each part.
///
/// # Errors
/// Those of [`self::scene()`].
pub fn explained_scene(
    source: &SceneSource,
    cache: Option<&Cache>,
    memory: Allowance,
) -> Result<PlannedScene, Failure> {
    load_and_plan(source, cache, memory, PartCosts::Estimated)
}

fn load_and_plan(
    source: &SceneSource,
    cache: Option<&Cache>,
    memory: Allowance,
    part_costs: PartCosts,
) -> Result<PlannedScene, Failure> {
    let planned = choose(source, cache, memory, part_costs)?;
    below_road::notes(&planned.loaded.header).into_iter().for_each(progress::note);
    Ok(planned)
}

fn choose(
    source: &SceneSource,
    cache: Option<&Cache>,
    memory: Allowance,
    part_costs: PartCosts,
) -> Result<PlannedScene, Failure> {
    // The scene and its specified physics have to come from the same file content.
    let ((mut loaded, said), _) = loading::read_hashed(slice::from_ref(&source.file), || {
        let loaded = loading::scene(source, cache)?;
        Ok((loaded, scene::physics_keys(&source.file, &[]).map_err(loading::scene_failure)?))
    })?;
    if let Some(db) = source.accuracy_db {
        loaded.header.fidelity.accuracy = Accuracy::from_db(db);
        loaded.header.fidelity.goal = None;
    } else if said.planning == Planning::AsSpecified {
        return Ok(PlannedScene { loaded, plan: None, is_looked_at: false, said });
    }
    let plan = planned(&mut loaded.header, &said, memory, part_costs)?;
    Ok(PlannedScene { loaded, plan, is_looked_at: true, said })
}

/// Sentence about a scene that requests a plan, where `work` takes its keys literally; `None` if it requests
/// none.
///
/// # Errors
/// The file cannot be read.
pub fn unplanned(file: &Path, work: &str) -> Result<Option<String>, Failure> {
    let said = scene::physics_keys(file, &[]).map_err(loading::scene_failure)?;
    Ok((said.planning == Planning::ByAccuracy).then(|| {
        format!(
            "{}: `plan = \"accuracy\"` of [fidelity] is not followed: in {work} physics that the scene leaves \
             out are the defaults of their keys, the same in all runs.",
            file.display()
        )
    }))
}

/// Chooses the physics of a scene; `None`, without a choice, if nothing scatters in the frames looked at.
fn planned(
    header: &mut SceneHeader,
    said: &PhysicsKeys,
    memory: Allowance,
    part_costs: PartCosts,
) -> Result<Option<PlanFigures>, Failure> {
    if header.fidelity.echo == EchoMode::RcsTable {
        let rule =
            "[fidelity]: a plan needs echo = \"paths\": a far-field table leaves no ways to choose among";
        return Err(Failure::refused(rule));
    }
    let _under_way = Work::begin("looking at what the echo consists of");
    let tracer = echo_shares::tracer(header, memory)?;
    let Some(shares) = echo_shares::shares(header, said, &tracer)? else { return Ok(None) };
    let asked = header.fidelity.accuracy;
    let specified = specified(header, said, &shares);
    let budget = Budget::of(asked.amplitude(), &shares);
    let before = header.clone();
    let (choice, planned_s) = cheapest(PhysicsChoice::all(&budget, &shares, &specified), |choice| {
        let mut chosen = before.clone();
        apply(&mut chosen, said, choice);
        costs::expected_s(&chosen, &tracer, memory)
    })?;
    apply(header, said, &choice);
    let expected = |header: &SceneHeader| costs::expected_s(header, &tracer, memory);
    let open = (part_costs == PartCosts::Estimated).then_some(&specified);
    let seconds = costs::seconds(&before, (header, planned_s), open, expected)?;
    Ok(Some(ChosenPlan { asked, budget, shares, specified, choice, seconds }.figures(header)))
}

/// The choice with the least expected time, and its seconds if there was more than one choice: sometimes
/// finer integrals are cheaper, and sometimes more of the physics.
fn cheapest(
    choices: Vec<PhysicsChoice>,
    expected_s: impl Fn(&PhysicsChoice) -> Result<f64, Failure>,
) -> Result<(PhysicsChoice, Option<f64>), Failure> {
    // A single choice needs no estimate.
    let choices = match <[PhysicsChoice; 1]>::try_from(choices) {
        Ok([choice]) => return Ok((choice, None)),
        Err(choices) => choices,
    };
    let expected = |choice: PhysicsChoice| expected_s(&choice).map(|seconds| (seconds, choice));
    // A choice that does not fit into the memory is discarded if another one fits.
    let (fitting, refused): (Vec<_>, Vec<_>) = choices.into_iter().map(expected).partition(Result::is_ok);
    let cheapest = fitting.into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0));
    let refusal = || refused.into_iter().find_map(Result::err);
    match cheapest {
        Some((seconds, choice)) => Ok((choice, Some(seconds))),
        None => Err(refusal().unwrap_or_else(|| Failure::refused("no choice keeps the accuracy"))),
    }
}

/// Physics that the scene's own keys specify.
fn specified(header: &SceneHeader, said: &PhysicsKeys, shares: &EchoShares) -> SpecifiedPhysics {
    let fidelity = &header.fidelity;
    let has = |key: &str| said.keys.contains(key);
    let can_follow_road = shares.road.is_some() && fidelity.sides == Sides::Two;
    let is_fixed = |part: &PhysicsPart| match part {
        PhysicsPart::BetweenBodies => has("between_bodies"),
        PhysicsPart::Road => said.road || !can_follow_road,
        PhysicsPart::Edges => has("edges"),
        PhysicsPart::Sheets => has("transmission"),
    };
    let parts =
        PhysicsPart::ALL.into_iter().filter(is_fixed).map(|part| (part, part.is_in(header))).collect();
    SpecifiedPhysics { bounces: has("bounces").then_some(fidelity.bounces), parts }
}

/// Writes a choice into the scene.
fn apply(header: &mut SceneHeader, said: &PhysicsKeys, choice: &PhysicsChoice) {
    let has = |key: &str| said.keys.contains(key);
    header.fidelity.accuracy = Accuracy::from_db(artifact::units::db_from_amplitude(choice.numerical));
    header.fidelity.bounces = choice.bounces;
    for part in PhysicsPart::ALL {
        match choice.modelled.contains(&part) {
            true => part.model(header),
            false => part.leave_out(header),
        }
    }
    if !has("nodes") && choice.bounces > 1 && choice.any_node_rule {
        header.fidelity.nodes = NodeRule::Middle;
    }
    if !has("measured_every") {
        header.fidelity.measured_every = frames_of_one_measurement(header);
    }
}

/// Time for which a measured error is valid (`docs/validation/traffic.md`), s.
const GOOD_FOR_S: f64 = 0.5;

/// Number of frames for which one measurement of the errors is valid.
fn frames_of_one_measurement(header: &SceneHeader) -> u32 {
    let of_time = (GOOD_FOR_S / header.frame_interval_s).floor();
    of_time.clamp(1.0, f64::from(header.frames.max(1))) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_measured_once_in_half_a_second_and_once_at_least() {
        let mut header = artifact_scene();
        let mut of = |interval_s: f64, frames: u32| {
            (header.frame_interval_s, header.frames) = (interval_s, frames);
            frames_of_one_measurement(&header)
        };
        assert_eq!([of(0.1, 20), of(0.1, 3), of(2.0, 20), of(0.1, 1)], [5, 3, 1, 1]);
    }

    fn artifact_scene() -> SceneHeader {
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/intersection.toml");
        let options = scene::ReadOptions::names_only();
        scene::read(&file, &options).unwrap()
    }
}
