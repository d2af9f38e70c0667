//! The physical-optics integrand at one surface point (docs/physics.md §1, node integral).

use crate::aspect::{AntennaPair, Leg};
use artifact::paths::Amplitude;
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::PI;

/// Form of the vector part: how both directions at a node enter it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bracket {
    /// The form e_p·[d₁ (n·e_q) − e_q (n·d₁)]: physical optics of the incident wave, reciprocal only in the
    /// specular direction.
    Plain,
    /// Mean of the plain form and the same with both directions exchanged: reciprocal everywhere.
    Symmetrised,
}

/// A wave incident at a surface point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Arrival {
    /// Unit direction of travel d.
    pub(crate) travel: DVec3,
    /// Unit fields for transmitted v and h.
    pub(crate) fields: [DVec3; 2],
    /// Path length less R.
    pub(crate) excess_m: f64,
    /// Path length; infinite at infinite range.
    pub(crate) length_m: f64,
}

/// Integrand at a node: its contribution to S per square metre, without frequency, S = Σ
/// j√(4π)/λ·`weight`·e^{−jk·excess}·dA.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node {
    /// Weight on a perfect conductor, for waves that have met only perfect conductors.
    pub(crate) weight: [[f64; 2]; 2],
    /// Product R_t·R_r over the lengths of both legs.
    pub(crate) spreading: f64,
    /// Unit normal of the facet, on the side of both waves.
    pub(crate) normal: DVec3,
    pub(crate) excess_m: f64,
    /// Sum d₁ + d₂: its tangential part is −∇φ/k.
    pub(crate) travel_sum: DVec3,
}

impl Arrival {
    /// Wave directly from an antenna along `leg` with its polarization vectors.
    pub(crate) fn direct(leg: &Leg, fields: [DVec3; 2]) -> Self {
        Self { travel: -leg.towards, fields, excess_m: leg.excess_m, length_m: leg.length_m }
    }
}

/// Node between a forward and a backward wave on a facet with unit normal `normal`; `None` if they meet
/// different sides of it.
pub(crate) fn node(
    ends: &AntennaPair,
    forward: &Arrival,
    backward: &Arrival,
    normal: DVec3,
    bracket: Bracket,
) -> Option<Node> {
    let normal = if normal.dot(forward.travel) < 0.0 { normal } else { -normal };
    if normal.dot(backward.travel) >= 0.0 {
        return None;
    }
    let spreading =
        ends.transmitter.spreading(forward.length_m) * ends.receiver().spreading(backward.length_m);
    let mut weight = [[0.0; 2]; 2];
    for (p, row) in weight.iter_mut().enumerate() {
        for (q, value) in row.iter_mut().enumerate() {
            let plain = one_way(forward.travel, forward.fields[q], backward.fields[p], normal);
            let swapped = one_way(backward.travel, backward.fields[p], forward.fields[q], normal);
            *value = spreading
                * match bracket {
                    Bracket::Plain => plain,
                    Bracket::Symmetrised => 0.5 * (plain + swapped),
                };
        }
    }
    let excess_m = forward.excess_m + backward.excess_m;
    Some(Node { weight, spreading, normal, excess_m, travel_sum: forward.travel + backward.travel })
}

/// Vector part e_out·[d (n·e_in) − e_in (n·d)].
fn one_way(travel: DVec3, field_in: DVec3, field_out: DVec3, normal: DVec3) -> f64 {
    field_out.dot(travel * normal.dot(field_in) - field_in * normal.dot(travel))
}

/// Wavenumber k for each frequency.
pub(crate) fn wavenumbers(frequencies_hz: &[f64]) -> Vec<f64> {
    frequencies_hz.iter().map(|f| 2.0 * PI * f / SPEED_OF_LIGHT_MPS).collect()
}

/// Shortest wavelength of the band, to which densities refer.
pub(crate) fn shortest_wavelength_m(frequencies_hz: &[f64]) -> f64 {
    SPEED_OF_LIGHT_MPS / frequencies_hz.iter().copied().fold(f64::MIN_POSITIVE, f64::max)
}

/// Phasor e^{−jk·excess}, with the cycles reduced before the sine.
pub(crate) fn phasor(wavenumber_per_m: f64, excess_m: f64) -> Complex64 {
    let cycles = wavenumber_per_m * excess_m / (2.0 * PI);
    Complex64::cis(-2.0 * PI * (cycles - cycles.round()))
}

/// Amplitudes j√(4π)/λ times the sums over nodes.
pub(crate) fn scaled(sums: &[Amplitude], wavenumbers_per_m: &[f64]) -> Vec<Amplitude> {
    let scale = |k: f64| Complex64::new(0.0, (4.0 * PI).sqrt() * k / (2.0 * PI));
    sums.iter().zip(wavenumbers_per_m).map(|(s, k)| s.map(|row| row.map(|v| v * scale(*k)))).collect()
}

/// Adds `term` to `sum`.
pub(crate) fn add(sum: &mut Amplitude, term: &Amplitude) {
    for (to, from) in sum.iter_mut().flatten().zip(term.iter().flatten()) {
        *to += from;
    }
}

/// Adds `value`·`weight` to `sum`, with complex weights.
pub(crate) fn add_with_phase(sum: &mut Amplitude, weight: &Amplitude, value: Complex64) {
    add(sum, &weight.map(|row| row.map(|w| w * value)));
}

/// Adds `value`·`weight` to `sum`.
pub(crate) fn add_weighted(sum: &mut Amplitude, weight: &[[f64; 2]; 2], value: Complex64) {
    for (to, w) in sum.iter_mut().flatten().zip(weight.iter().flatten()) {
        *to += value * w;
    }
}
