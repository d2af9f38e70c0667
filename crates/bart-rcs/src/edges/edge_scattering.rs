//! S of all edges that both ends light.

use crate::edges::edge_currents::{EdgeNode, edge_amplitudes};
use crate::edges::lit_edge::{EdgeJoint, edge_joints};
use crate::integral::physical_optics::Estimate;
use crate::joins::scatterer::{Integration, Scatterer, scaled, with_reverse};
use crate::table::joint_sum::add;
use crate::table::meeting::MeetingSettings;
use artifact::paths::Amplitude;
use artifact::settings::Edges;
use glam::DVec3;
use num_complex::Complex64;
use rayon::prelude::*;

/// S of the edges in ways of `order` over frequency, 2 × 2, its phase referred to `origin_m`.
///
/// Fixed runs are added in their order: the same bits on any number of threads.
pub(crate) fn sum_of_edges(
    scatterer: &Scatterer<'_>,
    joints: &[EdgeJoint],
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Vec<Amplitude> {
    const RUN: usize = 64;
    let zero = || vec![Amplitude::default(); integration.wavenumbers_per_m.len()];
    let of_run = |run: &[EdgeJoint]| {
        run.iter().fold(zero(), |mut total, joint| {
            add(&mut total, &scattering(scatterer, joint, origin_m, integration).value);
            total
        })
    };
    let runs: Vec<Vec<Amplitude>> = joints.par_chunks(RUN).map(of_run).collect();
    runs.iter().fold(zero(), |mut total, run| {
        add(&mut total, run);
        total
    })
}

/// Where both ends meet on edges in ways of `order`; nowhere where edges are ignored.
pub(crate) fn edge_meetings(scatterer: &Scatterer<'_>, order: u8, settings: &MeetingSettings) -> Vec<EdgeJoint> {
    let world = scatterer.world;
    match settings.edges {
        Edges::FirstOrder => edge_joints(world, world.edges(settings.wavenumber_per_m), scatterer.trees, order),
        Edges::Ignored => Vec::new(),
    }
}

/// Amplitudes of a part of a joint about its middle, at that middle; the reverse is not included.
pub(crate) fn part_amplitudes(
    scatterer: &Scatterer<'_>,
    joint: &EdgeJoint,
    span_m: [f64; 2],
    wavenumbers_per_m: &[f64],
    accuracy: f64,
) -> (DVec3, Estimate<Vec<Amplitude>>) {
    let edges = scatterer.world.edges(highest(wavenumbers_per_m));
    let edge = &edges.edges[joint.edge as usize];
    let [transmit, receive] = scatterer.legs(joint.forward, joint.backward);
    let reference_m = edge.point_m(0.5 * (span_m[0] + span_m[1]));
    let node = EdgeNode { edge, edges, span_m, transmit, receive };
    (reference_m, edge_amplitudes(&node, reference_m, wavenumbers_per_m, accuracy))
}

/// An edge's share of S, its reverse included.
fn scattering(
    scatterer: &Scatterer<'_>,
    joint: &EdgeJoint,
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Estimate<Vec<Amplitude>> {
    let Integration { wavenumbers_per_m, accuracy, .. } = *integration;
    let (middle_m, mut estimate) = part_amplitudes(scatterer, joint, joint.span_m, wavenumbers_per_m, accuracy);
    let apparent_m = scatterer.legs(joint.forward, joint.backward).map(|leg| leg.mirrors.unfolded(middle_m));
    let (spread, length_m) = scatterer.way_from(origin_m, apparent_m);
    for (amplitude, k) in estimate.value.iter_mut().zip(wavenumbers_per_m) {
        *amplitude = scaled(&with_reverse(joint.reverse, amplitude), Complex64::from_polar(spread, -k * length_m));
    }
    estimate
}

fn highest(wavenumbers_per_m: &[f64]) -> f64 {
    wavenumbers_per_m.iter().copied().fold(0.0, f64::max)
}
