//! A part of an edge with the legs that lead to it, and the parts of its integrals.

use crate::edges::line_integral::{Integrand, LinePiece};
use crate::edges::wave_exit::WaveExit;
use crate::geometry::antenna::Antenna;
use crate::integral::node::Leg;
use crate::joins::scatterer::{EdgeWaves, PathLengthRange};
use crate::mesh::wedges::world_edges::{EdgeGeometry, WorldEdges};
use artifact::paths::Amplitude;
use glam::DVec3;
use num_complex::Complex64;

/// A part of an edge with its two legs.
#[derive(Clone, Copy)]
pub(crate) struct EdgeNode<'a> {
    pub(crate) edge: &'a EdgeGeometry,
    /// Edges of the world, at which its faces end.
    pub(crate) edges: &'a WorldEdges,
    pub(crate) span_m: [f64; 2],
    pub(crate) transmit: &'a Leg,
    pub(crate) receive: &'a Leg,
    /// Extent to which its waves across faces are followed.
    pub(crate) waves: EdgeWaves,
}

impl EdgeNode<'_> {
    /// Reference point of its amplitudes.
    pub(crate) fn middle_m(&self) -> DVec3 {
        self.edge.point_m(0.5 * (self.span_m[0] + self.span_m[1]))
    }

    pub(crate) fn legs(&self) -> [&Leg; 2] {
        [self.transmit, self.receive]
    }

    /// Whether the return leg equals the outgoing leg.
    pub(crate) fn has_one_leg(&self) -> bool {
        std::ptr::eq(self.transmit, self.receive)
    }
}

/// A part of an edge's integrals.
pub(crate) trait EdgePart {
    /// Length L₁ + L₂ at its centre, less that at the reference point.
    fn path_length_range(&self) -> PathLengthRange;
    /// Adds √π·S without the phase of the reference point: [vv, vh, hv, hh].
    fn add_to(&self, wavenumbers_per_m: &[f64], sums: &mut [[Complex64; 4]]);
    /// Point at which its wave leaves the body; `None` if it leaves from the edge itself.
    fn exit(&self) -> Option<WaveExit> {
        None
    }
}

impl<I: Integrand> EdgePart for LinePiece<'_, I> {
    fn path_length_range(&self) -> PathLengthRange {
        PathLengthRange { length_m: self.length_m(), extent_m: self.extent_m() + self.turning_m() }
    }

    fn add_to(&self, wavenumbers_per_m: &[f64], sums: &mut [[Complex64; 4]]) {
        LinePiece::add_to(self, wavenumbers_per_m, sums);
    }

    fn exit(&self) -> Option<WaveExit> {
        LinePiece::exit(self)
    }
}

/// Factor 1/√π.
pub(crate) const PER_ROOT_PI: f64 = std::f64::consts::FRAC_2_SQRT_PI * 0.5;

/// Amplitude from the sum built by [`EdgePart::add_to`].
pub(crate) fn amplitude_of(sum: &[Complex64; 4]) -> Amplitude {
    let [vv, vh, hv, hh] = sum.map(|s| s * PER_ROOT_PI);
    [[vv, vh], [hv, hh]]
}

/// Ratio L(reference)/L.
pub(crate) fn spread(image: Antenna, x_m: DVec3, reference_m: DVec3) -> f64 {
    match image {
        Antenna::Point(p) => p.distance(reference_m) / p.distance(x_m),
        Antenna::Direction(_) => 1.0,
    }
}
