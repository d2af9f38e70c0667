//! Meetings of both ends in ways of one order: on facets and, where they are asked for, on edges.

use crate::beams::body_ways::BodyWays;
use crate::edges::edge_scattering::sum_of_edges;
use crate::edges::lit_edge::{EdgeJoint, edge_joints};
use crate::joins::band::add;
use crate::joins::joint::Joints;
use crate::joins::scatterer::{Integration, Scatterer, sequence};
use crate::table::joint_sum::sum_of_joints;
use artifact::paths::Amplitude;
use artifact::settings::{Edges, NodeRule};
use glam::DVec3;

/// The joints of one order.
pub(crate) struct OrderJoints {
    pub(crate) facets: Joints,
    pub(crate) edges: Vec<EdgeJoint>,
}

/// Settings of the meetings that are looked for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeetingSettings {
    pub(crate) nodes: NodeRule,
    pub(crate) edges: Edges,
    /// Overlaps of beams below are dropped.
    pub(crate) least_area_m2: f64,
    /// The highest that is asked for: sides narrower than its inverse are thin.
    pub(crate) wavenumber_per_m: f64,
}

impl OrderJoints {
    pub(crate) fn of(scatterer: &Scatterer<'_>, order: u8, settings: &MeetingSettings) -> Self {
        Self {
            facets: scatterer.joints(order, settings.nodes, settings.least_area_m2),
            edges: edge_meetings(scatterer, order, settings),
        }
    }

    /// Part of the meeting that is on edges.
    pub(crate) fn without_facets(self) -> Self {
        Self { facets: Joints::default(), ..self }
    }

    /// Part of the meeting that has its node on one body.
    pub(crate) fn on_body(&self, scatterer: &Scatterer<'_>, body: usize) -> Self {
        let is_there = |forward: u32| scatterer.node_body(forward) == body;
        Self {
            facets: self.facets.filtered(|joint| is_there(joint.forward)),
            edges: self.edges.iter().filter(|joint| is_there(joint.forward)).copied().collect(),
        }
    }

    /// Part of the meeting that is among some ways.
    pub(crate) fn along(&self, scatterer: &Scatterer<'_>, ways: &BodyWays) -> Self {
        let body = |facet: u32| scatterer.world.facet(facet).id.body;
        let is_there = |forward: u32, backward: u32| {
            let bodies: Vec<u32> = sequence(scatterer, forward, backward).into_iter().map(body).collect();
            ways.contain(&bodies)
        };
        Self {
            facets: self.facets.filtered(|joint| is_there(joint.forward, joint.backward)),
            edges: self
                .edges
                .iter()
                .filter(|joint| is_there(joint.forward, joint.backward))
                .copied()
                .collect(),
        }
    }

    /// S over frequency, 2 × 2, its phase referred to `origin_m`.
    pub(crate) fn sum(
        &self,
        scatterer: &Scatterer<'_>,
        origin_m: DVec3,
        integration: &Integration<'_>,
    ) -> Vec<Amplitude> {
        let [mut total, edges] = self.sums(scatterer, origin_m, integration);
        add(&mut total, &edges);
        total
    }

    /// Sums of facets and of edges, each as [`Self::sum`] has it.
    pub(crate) fn sums(
        &self,
        scatterer: &Scatterer<'_>,
        origin_m: DVec3,
        integration: &Integration<'_>,
    ) -> [Vec<Amplitude>; 2] {
        let facets = sum_of_joints(scatterer, &self.facets, origin_m, integration);
        [facets, sum_of_edges(scatterer, &self.edges, origin_m, integration)]
    }
}

/// Meetings of both ends on edges in ways of `order`; none where edges are ignored.
pub(crate) fn edge_meetings(
    scatterer: &Scatterer<'_>,
    order: u8,
    settings: &MeetingSettings,
) -> Vec<EdgeJoint> {
    let world = scatterer.world;
    match settings.edges {
        Edges::FirstOrder => {
            edge_joints(world, world.edges(settings.wavenumber_per_m), scatterer.trees, order)
        }
        Edges::Ignored => Vec::new(),
    }
}
