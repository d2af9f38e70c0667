//! S of all edges that both ends light.

use crate::edge_currents::{EdgeNode, edge_amplitudes};
use crate::lit_edge::{EdgeJoint, edge_joints};
use crate::physical_optics::Estimate;
use crate::scatterer::{Integration, Scatterer, scaled, with_reverse};
use artifact::paths::Amplitude;
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
        run.iter().fold(zero(), |total, joint| added(total, &scattering(scatterer, joint, origin_m, integration).value))
    };
    let runs: Vec<Vec<Amplitude>> = joints.par_chunks(RUN).map(of_run).collect();
    runs.iter().fold(zero(), |total, run| added(total, run))
}

/// Where both ends meet on edges, in ways of `order`.
pub(crate) fn joints(scatterer: &Scatterer<'_>, order: u8) -> Vec<EdgeJoint> {
    edge_joints(scatterer.world, scatterer.trees, order)
}

/// An edge's share of S, its reverse included.
fn scattering(
    scatterer: &Scatterer<'_>,
    joint: &EdgeJoint,
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Estimate<Vec<Amplitude>> {
    let edges = scatterer.world.edges();
    let edge = &edges.edges[joint.edge as usize];
    let [transmit, receive] = scatterer.legs(joint.forward, joint.backward);
    let reference_m = edge.point_m(0.5 * (joint.span_m[0] + joint.span_m[1]));
    let node = EdgeNode {
        edge,
        ends_m: [0, 1].map(|face| edges.ends_of_face(edge, face)),
        span_m: joint.span_m,
        transmit,
        receive,
    };
    let mut estimate = edge_amplitudes(&node, reference_m, integration.wavenumbers_per_m, integration.accuracy);
    let apparent_m = [transmit, receive].map(|leg| leg.mirrors.unfolded(reference_m));
    let (spread, length_m) = scatterer.way_from(origin_m, apparent_m);
    for (amplitude, k) in estimate.value.iter_mut().zip(integration.wavenumbers_per_m) {
        *amplitude = scaled(&with_reverse(joint.reverse, amplitude), Complex64::from_polar(spread, -k * length_m));
    }
    estimate
}

fn added(mut total: Vec<Amplitude>, share: &[Amplitude]) -> Vec<Amplitude> {
    for (sum, s) in total.iter_mut().flatten().flatten().zip(share.iter().flatten().flatten()) {
        *sum += s;
    }
    total
}
