//! Truncation of a double reflection at the own edges of its facets.
//!
//! Physical optics ends the current of a facet at its edge. Along an own edge of the node's facet the
//! integral over the polygon has the boundary term (Gordon 1975; Stokes' theorem with a slowly varying
//! weight)
//!
//! ```text
//! S_pq = −(1/√π) ∫ R_tR_r/(L₁L₂) · bracket · (g·ν)/|g|² · Φ · e^{−jk(L₁+L₂−R_t−R_r)} dl
//! ```
//! with g the gradient of L₁ + L₂ along the plane, ν the outward normal in it, the bracket of
//! [`crate::integral::physical_optics`] and Φ the field behind the other facet, [`Window::field`]. |g|² + h/k
//! in place of |g|², h = 1/L₁ + 1/L₂, keeps it finite at a stationary point, which belongs to the polygon.

use crate::edges::edge_node::{EdgePart, PER_ROOT_PI, amplitude_of};
use crate::edges::edge_scattering::{EDGE_JOINTS_PER_RUN, ReferencePath, over_band};
use crate::edges::line_integral::{Integrand, LinePiece, for_each_piece};
use crate::edges::mirror_window::{FlatPatch, OutlineSide, Window};
use crate::geometry::antenna::Antenna;
use crate::integral::field::Field;
use crate::integral::node::{Bracket, Estimate, Leg, Node};
use crate::joins::band;
use crate::joins::joint::Reverse;
use crate::joins::scatterer::{Integration, PathLengthRange, Scatterer, scaled, with_reverse};
use crate::joins::specular_separation::SpecularSeparation;
use artifact::paths::Amplitude;
use glam::{DVec2, DVec3};
use num_complex::Complex64;
use std::sync::Arc;

/// An own edge of the node's facet in a sequence of two.
#[derive(Debug, Clone)]
pub(crate) struct Truncation {
    /// Beams whose legs lead to the node's facet; one of them comes via the mirror.
    pub(crate) forward: u32,
    pub(crate) backward: u32,
    pub(crate) reverse: Reverse,
    pub(crate) side: OutlineSide,
    /// Other facet, with the antenna that it mirrors.
    pub(crate) mirror: Arc<FlatPatch>,
    pub(crate) mirrored: Antenna,
    pub(crate) separation: SpecularSeparation,
}

impl Truncation {
    pub(crate) fn length_m(&self) -> f64 {
        self.side.ends_m[0].distance(self.side.ends_m[1])
    }

    /// Point at `at_m` from the side's start.
    pub(crate) fn point_m(&self, at_m: f64) -> DVec3 {
        self.side.ends_m[0].lerp(self.side.ends_m[1], at_m / self.length_m())
    }
}

/// Amplitudes of a part of a truncation referred to its centre; the reverse is not included.
///
/// `accuracy` bounds the error as in [`crate::edges::edge_currents::edge_amplitudes`].
pub(crate) fn truncation_amplitudes(
    scatterer: &Scatterer<'_>,
    truncation: &Truncation,
    span_m: [f64; 2],
    wavenumbers_per_m: &[f64],
    accuracy: f64,
) -> (DVec3, Estimate<Vec<Amplitude>>) {
    let middle_m = truncation.point_m(0.5 * (span_m[0] + span_m[1]));
    let mut sums = vec![[Complex64::ZERO; 4]; wavenumbers_per_m.len()];
    let mut error_m = 0.0;
    let highest = wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
    for_each_end_part(scatterer, truncation, span_m, highest, accuracy, &mut |part, error| {
        error_m += error;
        part.add_to(wavenumbers_per_m, &mut sums);
    });
    let value = sums.iter().map(amplitude_of).collect();
    (middle_m, Estimate { value, error: error_m * PER_ROOT_PI })
}

/// Calls `give` with the parts of a truncation's integral over `span_m`, and an error bound for each, √π·m;
/// phases are relative to the span's middle.
fn for_each_end_part(
    scatterer: &Scatterer<'_>,
    truncation: &Truncation,
    span_m: [f64; 2],
    highest_per_m: f64,
    accuracy: f64,
    give: &mut dyn FnMut(&dyn EdgePart, f64),
) {
    let [transmit, receive] = scatterer.legs(truncation.forward, truncation.backward);
    let node = node(scatterer, truncation, [transmit, receive]);
    let middle_m = truncation.point_m(0.5 * (span_m[0] + span_m[1]));
    let field = Field::new(&node, middle_m, accuracy);
    let outward = field.frame.tangential(truncation.side.outward);
    let end = PatchEdge { field: &field, truncation, outward };
    let turning_m = truncation.separation.turning_m();
    for_each_piece(&end, span_m, highest_per_m, accuracy.max(1e-12), &mut |piece, error| {
        give(&EndPart { piece, turning_m }, error)
    });
}

/// A part of a truncation's integral.
struct EndPart<'a, 'b, 'c> {
    piece: &'a LinePiece<'b, PatchEdge<'c>>,
    /// Phase rotation of its weight over the band, as a spread of lengths.
    turning_m: f64,
}

impl EdgePart for EndPart<'_, '_, '_> {
    fn path_length_range(&self) -> PathLengthRange {
        let detours_m = self.piece.samples().each_ref().map(|sample| sample.window.detour_m());
        let detour_m = detours_m.into_iter().fold(0.0, f64::max);
        let extent_m = self.piece.extent_m() + detour_m + self.turning_m;
        PathLengthRange { length_m: self.piece.length_m(), extent_m }
    }

    fn add_to(&self, wavenumbers_per_m: &[f64], sums: &mut [[Complex64; 4]]) {
        self.piece.add_to(wavenumbers_per_m, sums);
    }
}

/// S of truncations over frequency, 2 × 2, with its phase referred to `origin_m`: from few frequencies, like
/// that of edges.
pub(crate) fn sum_of_truncations(
    scatterer: &Scatterer<'_>,
    truncations: &[Truncation],
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Vec<Amplitude> {
    let at_each = || sum_at_each(scatterer, truncations, origin_m, integration);
    over_band(truncations, integration, at_each, |truncation, band, groups| {
        let span_m = [0.0, truncation.length_m()];
        let (spread, length_m) = way_from(scatterer, truncation, origin_m);
        let whole = ReferencePath { spread, length_m, reverse: truncation.reverse };
        let (highest, accuracy) = (band.highest_per_m(), integration.accuracy);
        let mut some = Vec::new();
        for_each_end_part(scatterer, truncation, span_m, highest, accuracy, &mut |part, _| {
            whole.add_part(part, band, groups, &mut some);
        });
    })
}

/// Sums at every frequency separately: the reference of the interpolation.
fn sum_at_each(
    scatterer: &Scatterer<'_>,
    truncations: &[Truncation],
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Vec<Amplitude> {
    band::sum_at_each(truncations, EDGE_JOINTS_PER_RUN, integration.wavenumbers_per_m.len(), |truncation| {
        truncation_share(scatterer, truncation, origin_m, integration)
    })
}

/// Factor R_tR_r/(L₁L₂) and length L₁ + L₂ − R_t − R_r of a truncation's middle.
fn way_from(scatterer: &Scatterer<'_>, truncation: &Truncation, origin_m: DVec3) -> (f64, f64) {
    let middle_m = truncation.point_m(0.5 * truncation.length_m());
    let legs = scatterer.legs(truncation.forward, truncation.backward);
    let apparent_m = legs.map(|leg| leg.mirrors.unfolded(middle_m));
    scatterer.way_from(origin_m, [truncation.forward, truncation.backward], apparent_m)
}

fn node<'a>(scatterer: &Scatterer<'_>, truncation: &Truncation, legs: [&'a Leg; 2]) -> Node<'a> {
    let beam = &scatterer.trees.transmit().beams[truncation.forward as usize];
    Node {
        corners_m: &[],
        normal: beam.lit_normal,
        material: None,
        bend: None,
        transmit: legs[0],
        receive: legs[1],
        bracket: Bracket::Symmetrised,
    }
}

/// Contribution of a truncation to S over frequency, including its reverse, with its phase referred to
/// `origin_m`.
pub(crate) fn truncation_share(
    scatterer: &Scatterer<'_>,
    truncation: &Truncation,
    origin_m: DVec3,
    integration: &Integration<'_>,
) -> Vec<Amplitude> {
    let Integration { wavenumbers_per_m, accuracy, .. } = *integration;
    let span_m = [0.0, truncation.length_m()];
    let (_, estimate) = truncation_amplitudes(scatterer, truncation, span_m, wavenumbers_per_m, accuracy);
    let (spread, length_m) = way_from(scatterer, truncation, origin_m);
    let whole = |(amplitude, k): (&Amplitude, &f64)| {
        let factor = Complex64::from_polar(spread, -k * length_m);
        scaled(&with_reverse(truncation.reverse, amplitude), factor)
    };
    estimate.value.iter().zip(wavenumbers_per_m).map(whole).collect()
}

/// Boundary term along an own edge.
struct PatchEdge<'a> {
    field: &'a Field<'a>,
    truncation: &'a Truncation,
    /// Outward normal in the field's plane.
    outward: DVec2,
}

/// Frequency-independent values at a point of the edge.
#[derive(Clone)]
struct EdgePoint {
    length_m: f64,
    /// Brackets over the spread times −g·ν.
    weights: [f64; 4],
    gradient_squared: f64,
    bend_per_m: f64,
    window: Window,
}

impl Integrand for PatchEdge<'_> {
    type Sample = EdgePoint;

    fn sample(&self, at_m: f64) -> EdgePoint {
        let x_m = self.truncation.point_m(at_m);
        let at = self.field.surface_at(self.field.frame.plane_from_world(x_m));
        let gradient = self.field.length_gradient(&at);
        let outward = -gradient.dot(self.outward);
        EdgePoint {
            length_m: self.field.length_m(x_m),
            weights: self.field.weights(&at).map(|weight| weight * outward),
            gradient_squared: gradient.length_squared(),
            bend_per_m: self.field.ranges_m(x_m).map(f64::recip).iter().sum(),
            window: self.truncation.mirror.window(self.truncation.mirrored, x_m),
        }
    }

    fn length_m(sample: &EdgePoint) -> f64 {
        sample.length_m
    }

    fn weights(&self, sample: &EdgePoint, wavenumber_per_m: f64) -> [Complex64; 4] {
        let slope = sample.gradient_squared + sample.bend_per_m / wavenumber_per_m;
        if slope < f64::MIN_POSITIVE {
            return [Complex64::ZERO; 4];
        }
        let share = self.truncation.separation.of_ends(wavenumber_per_m) / slope;
        let field = sample.window.field(wavenumber_per_m) * share;
        sample.weights.map(|weight| weight * field)
    }
}
