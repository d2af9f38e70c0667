//! Radiation of the fringe current beyond the end of a face, which a face of finite width lacks.
//!
//! The fringe current on a face is an edge wave. On a half-plane it is known exactly (docs/physics.md §4):
//! with x from the edge, κ = k sin²β′, μ the receiver's cosine, a = cosφ′ + μ, b = 1 − μ and W(x) =
//! e^{jx²}erfc(e^{jπ/4}x), the current beyond a distance d along the face radiates, at the phase of a ray
//! that runs along the face and leaves at its end, as
//!
//! ```text
//! ∫_d^∞ F dσ = ±τ/jκ      τ = [√((a + b)/b) W(√(κdb)) − W(√(κd(a + b)))]/a      ∫_d^∞ Q dσ = √(2/b) W(√(κdb))/sinβ′
//! ```
//! both finite at the reflection boundary a = 0. On a wedge the same functions are multiplied by the ratio of
//! its edge wave to that of the half-plane far from the edge (r_h for the value, r_s for the slope on the
//! face): exact for N = 2, uniform through the shadow boundary φ′ = π (where both ratios are 1), and at μ = 1
//! the singularities of the unbounded face and of its remainder cancel.

use crate::edges::fresnel::edge_wave;
use crate::edges::fringe::{FaceView, Lighting};
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::PI;

/// Current beyond a distance along a face as √π·dS/dl, with the phase of the ray along the face to there.
#[derive(Clone)]
pub(crate) struct EndCurrent {
    /// Parameters a + b = 1 + cosφ′ and b.
    ab: f64,
    b: f64,
    square_in: f64,
    /// Factors of τ and of √(2/b)·W by `[received][sent]`.
    of_wave: [f64; 4],
    of_edge: [f64; 4],
    /// Current along the ray far from the edge over W(√(κd(a + b))), by the transmitted field; per unit Z·H.
    pub(crate) along_ray: [f64; 2],
}

impl EndCurrent {
    /// Current on a face for both incident fields and both unit fields of the receiver.
    pub(crate) fn new(face: &FaceView, travel: DVec3, sent: &[DVec3; 2], received: &[DVec3; 2]) -> Self {
        let (n, s) = (face.exterior, face.sin_in);
        let half = 0.5 * (PI - face.angle_in);
        // cosφ′/N − cosπ/N = 2 sin((π + φ′)/2N) sin((π − φ′)/2N), so that φ′ = π needs no special case.
        let widened = if half.abs() < 1e-9 { n } else { half.sin() / (half / n).sin() };
        let ratio = (PI / n).sin() / n * widened / (0.5 * (PI + face.angle_in) / n).sin();
        let sign = if face.lighting() == Lighting::Lit { 1.0 } else { -1.0 };
        // r_h with the sign of F, and r_s·sin(φ′/2).
        let (hard, soft) = (sign * ratio, ratio * ratio * (face.angle_in / n).sin() / (PI / n).sin());
        let (ab, b, half_cosine) = (1.0 + face.angle_in.cos(), face.off_grazing, half.sin().abs());
        let (mut of_wave, mut of_edge) = ([0.0; 4], [0.0; 4]);
        for (i, (p, q)) in [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().enumerate() {
            let [e, h] = face.incident(travel, sent[q]);
            let [p_x, p_z] = [received[p].dot(face.inward), received[p].dot(face.along) / (s * s)];
            let z_hard = hard * face.cos_in * h;
            of_wave[i] =
                -0.5 * (p_x * hard * h / s + p_z * (2.0 * soft * half_cosine * e - z_hard * (ab - 1.0)));
            of_edge[i] = 0.5 * p_z * (soft * e - z_hard * half_cosine);
        }
        let along_ray = [0, 1].map(|q| -hard * face.incident(travel, sent[q])[1] / s);
        Self { ab, b, square_in: s * s, of_wave, of_edge, along_ray }
    }

    /// Root of κd(a + b)/k after a distance: the wave has decayed by W of it times √k.
    pub(crate) fn falloff_root(&self, way_m: f64) -> f64 {
        (self.square_in * way_m * self.ab).sqrt()
    }

    /// Current beyond a distance by `[received][sent]`, and W(√(κd(a + b))), the decay of the edge wave over
    /// the distance.
    pub(crate) fn beyond(&self, way_m: f64, wavenumber_per_m: f64) -> ([Complex64; 4], Complex64) {
        let kd = wavenumber_per_m * self.square_in * way_m;
        let [edge, falloff] = [self.b, self.ab].map(|share| edge_wave((kd * share).sqrt()));
        let (tau, edge_part) = (self.tau(kd, edge, falloff), (2.0 / self.b).sqrt() * edge);
        ([0, 1, 2, 3].map(|i| self.of_wave[i] * tau + self.of_edge[i] * edge_part), falloff)
    }

    fn tau(&self, kd: f64, edge: Complex64, falloff: Complex64) -> Complex64 {
        let of = |ab: f64, falloff: Complex64| ((ab / self.b).sqrt() * edge - falloff) / (ab - self.b);
        let step = 1e-4 * self.b;
        let a = self.ab - self.b;
        // 0/0 at the reflection boundary; linear interpolation between both sides errs by (1e-4)² of it.
        if a.abs() < step {
            let share = 0.5 * (1.0 + a / step);
            let at = |ab: f64| of(ab, edge_wave((kd * ab).sqrt()));
            at(self.b + step) * share + at(self.b - step) * (1.0 - share)
        } else {
            of(self.ab, falloff)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::wedges::wedge::Wedge;

    fn half_plane() -> Wedge {
        Wedge { along: DVec3::Z, inward: [DVec3::X; 2], normal: [DVec3::Y, -DVec3::Y], exterior: 2.0 }
    }

    /// The current beyond 0 is the entire one, which constitutes the half-plane's edge current.
    #[test]
    fn the_current_of_a_whole_half_plane_is_its_fringe_current_from_any_direction() {
        let unit = |x: f64, y: f64, z: f64| DVec3::new(x, y, z) / DVec3::new(x, y, z).length();
        let ways =
            [(-0.9, -0.3, 0.1), (0.4, -0.8, -0.4), (0.2, 0.7, 0.3), (-0.5, -0.6, 0.7), (0.0, -1.0, 0.0)];
        for (i, (x, y, z)) in ways.into_iter().enumerate() {
            for (u, v, w) in ways.into_iter().skip(i) {
                let (travel, out) = (unit(x, y, z), -unit(u, v, w));
                let fields = |d: DVec3| [d.any_orthonormal_vector(), d.cross(d.any_orthonormal_vector())];
                let (sent, received) = (fields(travel), fields(out));
                let faces = half_plane().faces(travel, out).unwrap();
                let mut whole = [0.0; 4];
                let mut from_currents = [Complex64::ZERO; 4];
                for face in &faces {
                    let shares =
                        face.coefficients(sent.map(|sent| face.incident(travel, sent)), out, received);
                    whole.iter_mut().zip(shares.as_flattened()).for_each(|(sum, share)| *sum += share);
                    let beyond = EndCurrent::new(face, travel, &sent, &received).beyond(0.0, 1.0).0;
                    from_currents.iter_mut().zip(beyond).for_each(|(sum, b)| *sum += b);
                }
                for (got, known) in from_currents.iter().zip(whole) {
                    assert!(
                        (got - known).norm() < 1e-6 * (1.0 + known.abs()),
                        "{travel} {out}: {got} {known}"
                    );
                }
            }
        }
    }
}
