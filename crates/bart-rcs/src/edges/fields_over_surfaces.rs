//! Fields at an edge whose waves have met surfaces other than perfect mirrors.
//!
//! The scattering of an edge is linear in the fields of both its ends. It is computed for the real unit
//! fields that perfect mirrors would carry to the edge, and combined here with the components of the fields
//! that arrive over the materials.

use crate::integral::node::Leg;
use glam::DVec3;
use num_complex::Complex64;

/// Weights [vv, vh, hv, hh] for the fields that arrive at a wavenumber, from those for the fields over
/// perfect mirrors; legs, and directions of travel at the edge, of the field sent and of the field received.
pub(crate) fn over_surfaces(
    weights: [Complex64; 4],
    legs: [&Leg; 2],
    travel: [DVec3; 2],
    wavenumber_per_m: f64,
) -> [Complex64; 4] {
    if legs.iter().all(|leg| leg.steps.is_perfect()) {
        return weights;
    }
    let [sent, received] = [0, 1].map(|end| components(legs[end], travel[end], wavenumber_per_m));
    let [vv, vh, hv, hh] = weights;
    let arriving =
        [[vv, vh], [hv, hh]].map(|[v, h]| sent.map(|along: [Complex64; 2]| v * along[0] + h * along[1]));
    let of = |p: usize, q: usize| received[p][0] * arriving[0][q] + received[p][1] * arriving[1][q];
    [of(0, 0), of(0, 1), of(1, 0), of(1, 1)]
}

/// Length by which the surfaces of both legs turn the weights with the wavenumber, m.
pub(crate) fn turning_length_m(legs: [&Leg; 2]) -> f64 {
    legs.iter().map(|leg| leg.steps.turning_length_m()).sum()
}

/// Components of the fields that arrive for transmitted unit v and h, along those over perfect mirrors.
fn components(leg: &Leg, travel: DVec3, wavenumber_per_m: f64) -> [[Complex64; 2]; 2] {
    let perfect = leg.mirrors.fields_at_node(travel, leg.zenith_h);
    leg.arriving_fields(travel, wavenumber_per_m).map(|field| perfect.map(|unit| field.along(unit)))
}
