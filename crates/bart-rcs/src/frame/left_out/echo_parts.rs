//! Parts that a frame's echo is made of, by a coarse look: what each order of reflection, the ways between
//! bodies and by the road, edges and sheets add. A plan of what need not be modelled stands on it.

use crate::bodies::body_gains::BodyGains;
use crate::bodies::models::Models;
use crate::bodies::world::World;
use crate::frame::band_power::{MARGIN, frequencies_hz, mean, mean_difference, total};
use crate::frame::integration_error::of_meeting;
use crate::frame::left_out::between_bodies::meets_several_bodies;
use crate::frame::left_out::road::ways_by_road;
use crate::frame::left_out::ways::{ACCURACY, LeftOutWays, sum_of_ways};
use crate::frame::path_plan::Plan;
use crate::frame::snapshot::Snapshot;
use crate::joins::scatterer::{Integration, Scatterer, bracket_of};
use crate::oversight::error::BartError;
use crate::oversight::progress::{Phase, Progress};
use crate::table::aspect::other;
use crate::table::meeting::{MeetingSettings, OrderJoints};
use artifact::Accuracy;
use artifact::material::Transmission;
use artifact::scene::{SceneFrame, SceneHeader};
use artifact::settings::{BetweenBodies, EchoMode, Edges, NodeRule};
use artifact::units::{SPEED_OF_LIGHT_MPS, db_from_amplitude};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Parts of the echo of one frame, as amplitudes relative to that of all orders without a road: ratios of
/// root mean squares over the sampled sweep, with the margin of a measurement on so few frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct EchoParts {
    /// Scattering amplitude of all orders looked at, without road, edges and transmission, at frequencies
    /// spread over the sweep, m: of one radar in two scenes it may be compared.
    pub amplitude_m: Vec<Complex64>,
    /// Ways within one body, by order from 1.
    pub within: Vec<f64>,
    /// Ways that meet several bodies, by order from 1.
    pub between: Vec<f64>,
    /// Spread between the node rules of double and triple reflections, without the margin, as
    /// [`artifact::ModelError::nodes`] tells that of a run.
    pub nodes: f64,
    /// Ways by a road of dry asphalt, by order from 1, and the whole with them; `None` where these cannot be
    /// followed.
    pub road: Option<RoadParts>,
    /// Diffraction by edges of ways that do not meet the road, by order from 1.
    pub edges: Vec<f64>,
    /// Change by following waves through sheets; 0 where there are none.
    pub transmission: f64,
}

/// Parts of the echo by a road, relative as all [`EchoParts`].
#[derive(Debug, Clone, PartialEq)]
pub struct RoadParts {
    /// Ways that meet the road, by the number of bounces on bodies from 1.
    pub by_order: Vec<f64>,
    /// The whole echo with them, without the margin.
    pub whole: f64,
}

/// Highest order that is looked at.
pub const ORDERS: u8 = 4;
/// Orders by which transmission is told.
const TRANSMITTED_ORDERS: u8 = 2;
/// Frequencies of the look: as many as errors are measured at.
const FREQUENCIES: usize = 12;
/// Ways of the look. Mirrors below a wavelength are not followed; those of five alone tell the fourth order of
/// own cars 10 dB too weak.
const WAYS: LeftOutWays = LeftOutWays { bounces: ORDERS, mirror_wavelengths: 1.0 };
/// Highest order by which node rules are compared: trees of the fourth by the middle rule hold its nodes.
const COMPARED_ORDERS: u8 = 3;
/// Order whose polygons are parted where own edges take over.
const PARTED_ORDER: u8 = 2;

/// [`crate::Tracer::parts`] of these models.
pub(crate) fn echo_parts(
    models: &Models,
    header: &SceneHeader,
    frame: &SceneFrame,
    progress: &dyn Progress,
) -> Result<Option<EchoParts>, BartError> {
    let header = &looked_at(&header.in_frame(frame.index));
    let gains = BodyGains::of(models, header, frame)?;
    let plan = Plan::of(header, frame, progress).with_gains(gains);
    let world = World::posed(models, header, frame, plan.check_s)?;
    if world.facets().is_empty() {
        return Ok(None);
    }
    let Some(tree) = WAYS.tree(&world, &plan)? else { return Ok(None) };
    let snapshot = Snapshot::of(world, tree);
    let look = Look::of(snapshot.scatterer(&plan, Phase::Checking), &plan);
    let through = through_sheets(models, &plan, frame)?;
    look.parts(through)
}

/// The scene as coarse and as whole as the look takes it.
fn looked_at(header: &SceneHeader) -> SceneHeader {
    let mut header = header.clone();
    header.fidelity.accuracy = Accuracy::from_db(db_from_amplitude(ACCURACY));
    header.fidelity.bounces = ORDERS;
    header.fidelity.nodes = NodeRule::Middle;
    header.fidelity.echo = EchoMode::Paths;
    header.fidelity.between_bodies = BetweenBodies::Traced;
    header.materials.transmission = Transmission::Ignored;
    header.road = None;
    header
}

/// Bodies and beams that are looked at.
struct Look<'a> {
    scatterer: Scatterer<'a>,
    plan: &'a Plan<'a>,
    wavenumbers_per_m: Vec<f64>,
}

impl<'a> Look<'a> {
    fn of(scatterer: Scatterer<'a>, plan: &'a Plan<'a>) -> Self {
        let frequencies_hz = frequencies_hz(plan.band.centre_hz, plan.band.bandwidth_hz, FREQUENCIES);
        let wavenumbers_per_m = frequencies_hz.iter().map(|f| TAU * f / SPEED_OF_LIGHT_MPS).collect();
        Self { scatterer, plan, wavenumbers_per_m }
    }

    fn parts(&self, through: Option<Vec<Complex64>>) -> Result<Option<EchoParts>, BartError> {
        let within: Vec<Vec<Complex64>> = (1..=ORDERS).map(|order| self.ways(order, Bodies::One)).collect();
        let between: Vec<Vec<Complex64>> =
            (1..=ORDERS).map(|order| self.ways(order, Bodies::Several)).collect();
        let by_order: Vec<Vec<Complex64>> =
            within.iter().zip(&between).map(|(a, b)| total([a, b].into_iter().cloned(), a.len())).collect();
        let whole = total(by_order.iter().cloned(), FREQUENCIES);
        let power = mean(&whole);
        if power == 0.0 {
            return Ok(None);
        }
        let by_road = ways_by_road(self.scatterer.world, self.plan, ORDERS, &self.wavenumbers_per_m)?;
        let share = |part: &Vec<Complex64>| MARGIN * (mean(part) / power).sqrt();
        let first_orders = total(by_order.iter().take(usize::from(TRANSMITTED_ORDERS)).cloned(), FREQUENCIES);
        let changed = through.map_or(0.0, |through| mean_difference(&first_orders, &through));
        let road = by_road.map(|ways| RoadParts {
            by_order: ways.iter().map(share).collect(),
            whole: (mean(&total(ways.into_iter().chain([whole.clone()]), FREQUENCIES)) / power).sqrt(),
        });
        Ok(Some(EchoParts {
            within: within.iter().map(share).collect(),
            between: between.iter().map(share).collect(),
            nodes: (self.node_spread() / power).sqrt(),
            road,
            edges: (1..=ORDERS).map(|order| share(&self.edges(order))).collect(),
            transmission: MARGIN * (changed / power).sqrt(),
            amplitude_m: whole,
        }))
    }

    /// S of the ways of one order that meet one body, or several.
    fn ways(&self, order: u8, bodies: Bodies) -> Vec<Complex64> {
        let are_several = bodies == Bodies::Several;
        sum_of_ways(&self.scatterer, self.plan, order, &self.wavenumbers_per_m, |joint| {
            meets_several_bodies(&self.scatterer, joint) == are_several
        })
    }

    /// Mean of |S − S|² between the node rules, orders added by their powers.
    fn node_spread(&self) -> f64 {
        let by_rule = |order: u8, nodes: NodeRule| {
            let settings = MeetingSettings { nodes, ..self.plan.meetings() };
            let meeting = OrderJoints::of(&self.scatterer, order, &settings);
            of_meeting(&self.scatterer, self.plan, &meeting, &self.integration(nodes))
        };
        let rule = NodeRule::OwnEdge;
        let spread = |order: u8| mean_difference(&by_rule(order, rule), &by_rule(order, other(rule)));
        (2..=COMPARED_ORDERS).map(spread).sum()
    }

    /// S of edges, as ways of an order end and begin on them: of the last one those that the look's beams
    /// reach. With what double reflections change by where own edges take over from their polygons.
    fn edges(&self, order: u8) -> Vec<Complex64> {
        let settings =
            |edges: Edges| MeetingSettings { edges, nodes: NodeRule::OwnEdge, ..self.plan.meetings() };
        let sum = |meeting: &OrderJoints| {
            of_meeting(&self.scatterer, self.plan, meeting, &self.integration(NodeRule::OwnEdge))
        };
        if order != PARTED_ORDER {
            return sum(&settings(Edges::FirstOrder).on_edges(&self.scatterer, order));
        }
        let of = |edges: Edges| sum(&OrderJoints::of(&self.scatterer, order, &settings(edges)));
        of(Edges::FirstOrder).iter().zip(of(Edges::Ignored)).map(|(with, without)| with - without).collect()
    }

    fn integration(&self, nodes: NodeRule) -> Integration<'_> {
        let bracket = bracket_of(nodes);
        Integration { wavenumbers_per_m: &self.wavenumbers_per_m, accuracy: ACCURACY, bracket }
    }
}

/// Number of bodies on a way.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Bodies {
    One,
    Several,
}

/// S of the first orders with waves followed through sheets; `None` where there are none.
fn through_sheets(
    models: &Models,
    plan: &Plan<'_>,
    frame: &SceneFrame,
) -> Result<Option<Vec<Complex64>>, BartError> {
    let mut header = plan.header.clone();
    header.materials.transmission = Transmission::Followed;
    let plan = &Plan::of(&header, frame, plan.progress).with_gains(plan.gains.clone());
    let world = World::posed(models, &header, frame, plan.check_s)?;
    if world.sheets().is_empty() {
        return Ok(None);
    }
    let ways = LeftOutWays { bounces: TRANSMITTED_ORDERS, ..WAYS };
    let Some(tree) = ways.tree(&world, plan)? else { return Ok(None) };
    let snapshot = Snapshot::of(world, tree);
    let look = Look::of(snapshot.scatterer(plan, Phase::Checking), plan);
    let by_order = (1..=TRANSMITTED_ORDERS).map(|order| {
        total([Bodies::One, Bodies::Several].into_iter().map(|bodies| look.ways(order, bodies)), FREQUENCIES)
    });
    Ok(Some(total(by_order, FREQUENCIES)))
}
