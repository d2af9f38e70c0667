//! Composition of a frame's echo from a coarse computation: the contributions of each order of reflection, of
//! paths between bodies and via the road, of edges and of sheets. It is the basis for planning what need not
//! be modelled.

use crate::bodies::body_gains::BodyGains;
use crate::bodies::models::Models;
use crate::bodies::world::World;
use crate::frame::band_power::{frequencies_hz, mean, mean_difference, total};
use crate::frame::cells::point_paths::point_paths;
use crate::frame::integration_error::of_meeting;
use crate::frame::left_out::neglected_paths::{
    ACCURACY, ANY_RULE_ORDERS, NeglectedPaths, PathsByRule, orders_by_rule,
};
use crate::frame::left_out::road::paths_by_road;
use crate::frame::path_plan::Plan;
use crate::frame::path_sum::element_over_band;
use crate::frame::snapshot::Snapshot;
use crate::joins::scatterer::{Integration, Scatterer, bracket_of, meets_several_vehicles};
use crate::run_control::error::BartError;
use crate::run_control::progress::{Phase, Progress};
use crate::table::aspect_settings::compared_rule;
use crate::table::order_joints::{JointSettings, OrderJoints};
use artifact::Accuracy;
use artifact::material::Transmission;
use artifact::scene::{SceneFrame, SceneHeader};
use artifact::settings::{BetweenBodies, EchoMode, Edges, NodeRule};
use artifact::units::{SPEED_OF_LIGHT_MPS, db_from_amplitude};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Parts of the echo of one frame, as amplitudes relative to that of the point targets and of all orders on
/// bodies without a road: ratios of root mean squares over the sampled sweep, with the margin of a
/// measurement on so few frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct EchoParts {
    /// Scattering amplitude of the point targets and of all computed orders, without road, edges and
    /// transmission, at frequencies spread over the sweep, m; comparable between two scenes with one radar.
    pub amplitude_m: Vec<Complex64>,
    /// Paths within one body, by order from 1.
    pub within: Vec<f64>,
    /// Paths over several bodies, by order from 1.
    pub between: Vec<f64>,
    /// Spread between the node rules of double and triple reflections, without the margin, like
    /// [`artifact::ModelError::nodes`] of a run.
    pub nodes: f64,
    /// Paths via a road of dry asphalt, by order from 1, and the whole with them; `None` if these cannot be
    /// followed.
    pub road: Option<RoadParts>,
    /// Diffraction by edges on paths that do not meet the road, by order from 1.
    pub edges: Vec<f64>,
    /// Change due to transmission through sheets; 0 if there are none.
    pub transmission: f64,
}

/// Parts of the echo via a road, relative like all [`EchoParts`].
#[derive(Debug, Clone, PartialEq)]
pub struct RoadParts {
    /// Paths that meet the road, by the number of bounces on bodies from 1.
    pub by_order: Vec<f64>,
    /// Whole echo including them, without the margin.
    pub whole: f64,
}

/// Highest order computed.
pub const ORDERS: u8 = 4;
/// Number of orders from which transmission is estimated.
const TRANSMITTED_ORDERS: u8 = 2;
/// Margin of the shares. They refer to the band and frame whose errors they predict: at its other
/// frequencies, moments and elements they differ by less than those of independent samples of an echo, whose
/// ratios have [`crate::frame::band_power::MARGIN`] (`docs/planning.md` describes its validation).
const MARGIN: f64 = 1.4;
/// Number of frequencies: that at which errors are measured.
const FREQUENCIES: usize = 12;
/// Paths of the computation. Mirrors below a wavelength are not followed; with only those above five the
/// fourth order of the built-in cars is 10 dB too weak.
const WAYS: NeglectedPaths = NeglectedPaths { bounces: ORDERS, mirror_wavelengths: 1.0 };
/// Order whose polygons are separated where own edges take over.
const PARTED_ORDER: u8 = 2;

/// [`crate::Tracer::echo_parts`] for these models.
pub(crate) fn echo_parts(
    models: &Models,
    header: &SceneHeader,
    frame: &SceneFrame,
    progress: &dyn Progress,
) -> Result<Option<EchoParts>, BartError> {
    let nodes = header.fidelity.nodes;
    let header = &coarse_header(header);
    let gains = BodyGains::of(models, header, frame)?;
    let plan = Plan::of(header, frame, progress).with_gains(gains);
    let world = World::posed(models, header, frame, plan.check_s)?;
    if world.facets().is_empty() {
        return Ok(None);
    }
    let Some(tree) = WAYS.tree(&world, &plan)? else { return Ok(None) };
    let snapshot = Snapshot::of(world, tree);
    let coarse = CoarseEcho::of(snapshot.scatterer(&plan, Phase::Checking), &plan, nodes);
    let through = through_sheets(models, &plan, frame, nodes)?;
    let points = point_paths(header, frame);
    let points_m = element_over_band(&points, &plan.check_view(), plan.reception(), &checked_hz(&plan));
    coarse.parts(through, points_m)
}

/// Scene with the coarseness and completeness of the computation.
fn coarse_header(header: &SceneHeader) -> SceneHeader {
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

fn checked_hz(plan: &Plan<'_>) -> Vec<f64> {
    frequencies_hz(plan.band.centre_hz, plan.band.bandwidth_hz, FREQUENCIES)
}

/// Bodies and beams of the computation.
struct CoarseEcho<'a> {
    scatterer: Scatterer<'a>,
    plan: &'a Plan<'a>,
    wavenumbers_per_m: Vec<f64>,
    /// Node rule of the scene, used as far as trees have its nodes. Where rules differ they do so by 10 dB
    /// and more.
    nodes: NodeRule,
}

impl<'a> CoarseEcho<'a> {
    fn of(scatterer: Scatterer<'a>, plan: &'a Plan<'a>, nodes: NodeRule) -> Self {
        let wavenumbers_per_m = checked_hz(plan).iter().map(|f| TAU * f / SPEED_OF_LIGHT_MPS).collect();
        Self { scatterer: scatterer.with_waves_over_own_faces(), plan, wavenumbers_per_m, nodes }
    }

    fn parts(
        &self,
        through: Option<Vec<Complex64>>,
        points_m: Vec<Complex64>,
    ) -> Result<Option<EchoParts>, BartError> {
        let (within, between): (Vec<_>, Vec<_>) = self.ways(ORDERS).into_iter().map(<(_, _)>::from).unzip();
        let by_order: Vec<Vec<Complex64>> =
            within.iter().zip(&between).map(|(a, b)| total([a, b].into_iter().cloned(), a.len())).collect();
        let of_bodies = total(by_order.iter().cloned(), FREQUENCIES);
        if mean(&of_bodies) == 0.0 {
            return Ok(None);
        }
        let whole = total([of_bodies, points_m].into_iter(), FREQUENCIES);
        let power = mean(&whole);
        let (orders, world) = ((ORDERS, self.nodes), self.scatterer.world);
        let by_road = paths_by_road(world, self.plan, orders, &self.wavenumbers_per_m)?;
        let share = |part: &Vec<Complex64>| MARGIN * (mean(part) / power).sqrt();
        let first_orders = total(by_order.iter().take(usize::from(TRANSMITTED_ORDERS)).cloned(), FREQUENCIES);
        let changed = through.map_or(0.0, |through| mean_difference(&first_orders, &through));
        let road = by_road.map(|ways| RoadParts {
            by_order: ways.iter().map(share).collect(),
            whole: (mean(&total(ways.into_iter().chain([whole.clone()]), FREQUENCIES)) / power).sqrt(),
        });
        let doubles = self.double_reflections(&by_order);
        Ok(Some(EchoParts {
            within: within.iter().map(share).collect(),
            between: between.iter().map(share).collect(),
            nodes: (self.node_spread(&doubles, &by_order) / power).sqrt(),
            road,
            edges: (1..=ORDERS).map(|order| share(&self.edges(order, &doubles))).collect(),
            transmission: MARGIN * (changed / power).sqrt(),
            amplitude_m: whole,
        }))
    }

    /// S of paths on one body, and of those over several, by order from 1.
    fn ways(&self, bounces: u8) -> Vec<[Vec<Complex64>; 2]> {
        let Self { scatterer, plan, wavenumbers_per_m, nodes } = self;
        let ways = PathsByRule { scatterer, plan, wavenumbers_per_m };
        orders_by_rule(bounces, *nodes, |order, rule| {
            ways.split_by_selection(order, rule, |joint| {
                meets_several_vehicles(scatterer, joint.forward, joint.backward)
            })
        })
    }

    /// S of double reflections at the own edges of their facets; `by_order` contains them if the scene uses
    /// that rule.
    fn double_reflections(&self, by_order: &[Vec<Complex64>]) -> DoubleReflections {
        let settings = self.own_edge(Edges::FirstOrder);
        let meeting = OrderJoints::of(&self.scatterer, PARTED_ORDER, &settings);
        DoubleReflections {
            with_edges: self.sum(&meeting, settings.nodes),
            without: self.at_own_edges(PARTED_ORDER, by_order),
        }
    }

    /// S of an order at the own edges of its facets, without edges.
    fn at_own_edges(&self, order: u8, by_order: &[Vec<Complex64>]) -> Vec<Complex64> {
        if self.nodes == NodeRule::OwnEdge {
            return by_order[usize::from(order) - 1].clone();
        }
        let settings = self.own_edge(Edges::Ignored);
        self.sum(&OrderJoints::of(&self.scatterer, order, &settings), settings.nodes)
    }

    /// Mean of |S − S|² between the node rules, with orders added by their powers.
    fn node_spread(&self, doubles: &DoubleReflections, by_order: &[Vec<Complex64>]) -> f64 {
        let nodes = compared_rule(NodeRule::OwnEdge);
        let by_other = |order: u8, edges: Edges| {
            let settings = JointSettings { nodes, edges, ..self.plan.meetings() };
            self.sum(&OrderJoints::of(&self.scatterer, order, &settings), nodes)
        };
        let spread = |order: u8| match (order, self.plan.header.fidelity.edges) {
            (PARTED_ORDER, edges) => mean_difference(doubles.of(edges), &by_other(order, edges)),
            // Edges of other orders are the same under every rule.
            _ => mean_difference(&self.at_own_edges(order, by_order), &by_other(order, Edges::Ignored)),
        };
        (2..=ANY_RULE_ORDERS).map(spread).sum()
    }

    /// S of edges at the start or end of paths of an order; for the last order only those reached by the
    /// beams. Includes the change of double reflections where own edges take over from their polygons.
    fn edges(&self, order: u8, doubles: &DoubleReflections) -> Vec<Complex64> {
        if order != PARTED_ORDER {
            let settings = self.own_edge(Edges::FirstOrder);
            return self.sum(&settings.on_edges(&self.scatterer, order), settings.nodes);
        }
        let pairs = doubles.with_edges.iter().zip(&doubles.without);
        pairs.map(|(with, without)| with - without).collect()
    }

    fn own_edge(&self, edges: Edges) -> JointSettings {
        JointSettings { edges, nodes: NodeRule::OwnEdge, ..self.plan.meetings() }
    }

    fn sum(&self, meeting: &OrderJoints, nodes: NodeRule) -> Vec<Complex64> {
        of_meeting(&self.scatterer, self.plan, meeting, &self.integration(nodes))
    }

    fn integration(&self, nodes: NodeRule) -> Integration<'_> {
        let bracket = bracket_of(nodes);
        Integration { wavenumbers_per_m: &self.wavenumbers_per_m, accuracy: ACCURACY, bracket }
    }
}

/// S of double reflections at the own edges of their facets, over frequency.
struct DoubleReflections {
    /// Including diffraction by edges.
    with_edges: Vec<Complex64>,
    /// Facets alone.
    without: Vec<Complex64>,
}

impl DoubleReflections {
    fn of(&self, edges: Edges) -> &[Complex64] {
        match edges {
            Edges::FirstOrder => &self.with_edges,
            Edges::Ignored => &self.without,
        }
    }
}

/// S of the first orders with transmission through sheets; `None` if there are none.
fn through_sheets(
    models: &Models,
    plan: &Plan<'_>,
    frame: &SceneFrame,
    nodes: NodeRule,
) -> Result<Option<Vec<Complex64>>, BartError> {
    let mut header = plan.header.clone();
    header.materials.transmission = Transmission::Followed;
    let plan = &Plan::of(&header, frame, plan.progress).with_gains(plan.gains.clone());
    let world = World::posed(models, &header, frame, plan.check_s)?;
    if world.sheets().is_empty() {
        return Ok(None);
    }
    let ways = NeglectedPaths { bounces: TRANSMITTED_ORDERS, ..WAYS };
    let Some(tree) = ways.tree(&world, plan)? else { return Ok(None) };
    let snapshot = Snapshot::of(world, tree);
    let coarse = CoarseEcho::of(snapshot.scatterer(plan, Phase::Checking), plan, nodes);
    let by_order = coarse.ways(TRANSMITTED_ORDERS).into_iter().map(|of| total(of.into_iter(), FREQUENCIES));
    Ok(Some(total(by_order, FREQUENCIES)))
}
