//! Nodes and mirrors that are not perfect conductors, from the tangential fields of both polarizations.
//!
//! If r_TE of E and r_TM of H are reflected (ŝ = unit(n × d) across the plane of incidence, p̂ = ŝ × d in
//! it), the sum of the incident and the reflected wave has (`docs/physics.md` §5)
//!
//! ```text
//! n×E = (1 + r_TE)(e·ŝ) n×ŝ + (1 − r_TM)(e·p̂) n×p̂      n×H = (1 + r_TM)(e·p̂) n×ŝ − (1 − r_TE)(e·ŝ) n×p̂
//! bracket = ½{ e_p·(n×H) + (d₂×e_p)·(n×E) }             e_r = r_TE(e·ŝ) ŝ + r_TM(e·p̂)(2n(n·p̂) − p̂)
//! ```

use crate::node::{Arrival, Bracket, Node};
use crate::plane_layers::reflection;
use artifact::material::Material;
use artifact::paths::Amplitude;
use glam::DVec3;
use num_complex::Complex64;
use radar::complex_vector::ComplexVector;

/// Fields for transmitted v and h, by frequency.
pub(crate) type Fields = Vec<[ComplexVector; 2]>;

/// Copies real fields to every frequency.
pub(crate) fn fields_at_all(fields: [DVec3; 2], wavenumbers_per_m: &[f64]) -> Fields {
    vec![fields.map(ComplexVector::from); wavenumbers_per_m.len()]
}

/// Weight of a node: its contribution to S per square metre at one frequency, replacing [`Node::weight`];
/// `sent` are the fields of the forward wave.
pub(crate) fn weight(
    node: &Node,
    (forward, sent): (&Arrival, &[ComplexVector; 2]),
    backward: &Arrival,
    surface: &Surface<'_>,
    bracket: Bracket,
) -> Amplitude {
    let received = backward.fields.map(ComplexVector::from);
    let forth = sent.map(|e| surface.current(node.normal, forward.travel, e));
    let back = received.map(|e| surface.current(node.normal, backward.travel, e));
    [0, 1].map(|p| {
        [0, 1].map(|q| {
            let plain = forth[q].radiated(backward.travel, received[p]);
            let bracket = match bracket {
                Bracket::Plain => plain,
                Bracket::Symmetrised => 0.5 * (plain + back[p].radiated(forward.travel, sent[q])),
            };
            node.spreading * bracket
        })
    })
}

/// A material at one frequency.
pub(crate) struct Surface<'a> {
    pub(crate) material: &'a Material,
    pub(crate) wavenumber_per_m: f64,
}

/// Tangential fields, rotated by n×.
#[derive(Clone, Copy)]
struct Current {
    n_by_e: ComplexVector,
    n_by_h: ComplexVector,
}

impl Surface<'_> {
    /// Field of a wave after the reflection.
    pub(crate) fn reflected(&self, normal: DVec3, travel: DVec3, e: ComplexVector) -> ComplexVector {
        let ([across, within], [te, tm]) = self.of(normal, travel);
        ComplexVector::of(across, te * e.along(across))
            + ComplexVector::of(2.0 * normal.dot(within) * normal - within, tm * e.along(within))
    }

    fn current(&self, n: DVec3, travel: DVec3, e: ComplexVector) -> Current {
        let ([across, within], [te, tm]) = self.of(n, travel);
        let (s, p) = (e.along(across), e.along(within));
        let (n_by_s, n_by_p) = (n.cross(across), n.cross(within));
        Current {
            n_by_e: ComplexVector::of(n_by_s, (1.0 + te) * s) + ComplexVector::of(n_by_p, (1.0 - tm) * p),
            n_by_h: ComplexVector::of(n_by_s, (1.0 + tm) * p) + ComplexVector::of(n_by_p, (te - 1.0) * s),
        }
    }

    /// Vectors ŝ and p̂ for a direction of travel, and r_TE and r_TM; along the normal any ŝ will do.
    fn of(&self, normal: DVec3, travel: DVec3) -> ([DVec3; 2], [Complex64; 2]) {
        let cross = normal.cross(travel);
        // Where ŝ is dominated by rounding both polarizations reflect alike to its square.
        let across =
            if cross.length() > 1e-9 { cross / cross.length() } else { travel.any_orthonormal_vector() };
        let r = reflection(self.material, normal.dot(travel).abs(), self.wavenumber_per_m);
        ([across, across.cross(travel)], r)
    }
}

impl Current {
    fn radiated(self, travel: DVec3, e: ComplexVector) -> Complex64 {
        0.5 * (e.dot(self.n_by_h) + e.crossed_by(travel).dot(self.n_by_e))
    }
}
