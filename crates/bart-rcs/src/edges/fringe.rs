//! Fringe currents of a wedge: the difference between the current at an edge and physical optics, as a line
//! source along it.
//!
//! Michaeli's equivalent currents for arbitrary directions (IEEE T-AP 34 (1986) 912, 34 (1986) 1252) in the
//! form of docs/physics.md §4, with the removable singularities eliminated: with ψ = π − α, h = (ψ − φ′)/2, m
//! = (ψ + φ′)/2 and c(z) = cot(z/N)/N − U cot z, which is smooth at 0,
//!
//! ```text
//! D − U sinφ′/(cosφ′ + μ) = ½[c(h) − c(m)]        G − U/(cosφ′ + μ) = ½[c(h) + c(m)]/sinψ
//! ```
//! so that the reflection boundary (cosφ′ + μ = 0; monostatically φ′ = 90°) needs no special case. At cosines
//! of α below −1, ψ is imaginary, c(h) = −conj c(m), and both stay real. The remaining singularity is μ = 1,
//! the direction of travel of the wave along the face: there the current on an unbounded face has no finite
//! sum, and is clamped by [`LEAST_GRAZING`].

use crate::mesh::wedges::wedge::Wedge;
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// A face with the directions of both legs in its coordinates: x̂ into the face, ŷ its normal, ẑ = x̂ × ŷ
/// along the edge.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FaceView {
    /// Exterior angle over π, N.
    pub(crate) exterior: f64,
    pub(crate) inward: DVec3,
    pub(crate) normal: DVec3,
    pub(crate) along: DVec3,
    /// Angle φ′ of the incident wave from this face.
    pub(crate) angle_in: f64,
    /// Cosine and sine of β′, the angle between the incident wave's direction of travel and ẑ.
    pub(crate) cos_in: f64,
    pub(crate) sin_in: f64,
    /// Direction of the receiver in these axes, sinβ·(cosφ, sinφ) and cosβ.
    pub(crate) out: DVec3,
    /// Distance 1 − μ of the receiver from the direction of the wave along the face, 1 − ŝ·σ̂ over sin²β′.
    pub(crate) off_grazing: f64,
}

/// Whether the incident wave reaches a face: U.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Lighting {
    Lit,
    Shadowed,
}

/// Minimum distance of a receiver from the direction of a wave along a face, as 1 − μ: 0.3 mrad at right
/// angles. Where the face ends, the wave's end is subtracted with the same value, and the remainder is exact
/// to 1e-16/√1e-9.
const LEAST_GRAZING: f64 = 1e-9;
/// Angle within which a facet counts as edge-on: directions are rounded to ε, and facets within 16 ε have no
/// shadow and no light (shadow.rs).
pub(crate) const EDGE_ON_RAD: f64 = 1e-9;
/// Sine within which a leg along the edge, which has no angle φ, is left out (its amplitude is bounded).
pub(crate) const LEAST_SINE: f64 = 1e-6;

/// Cosine above which planes belong to one flat patch.
const SAME_FACE_COSINE: f64 = 0.999;

impl Wedge {
    /// Exterior angle of a direction away from the edge, in [0, 2π).
    fn angle_of(&self, away: DVec3) -> f64 {
        let up = self.along.cross(self.inward[0]);
        let angle = away.dot(up).atan2(away.dot(self.inward[0]));
        if angle < 0.0 { angle + TAU } else { angle }
    }

    /// Views of both faces for a wave that arrives along `travel` and leaves along `out`; `None` if a leg
    /// lies along the edge or inside the wedge.
    pub(crate) fn faces(&self, travel: DVec3, out: DVec3) -> Option<[FaceView; 2]> {
        let span = self.exterior * PI;
        let (angle_in, angle_out) = (self.angle_of(-travel), self.angle_of(out));
        let sines = [travel, out].map(|d| d.cross(self.along).length());
        if angle_in > span || angle_out > span || sines.into_iter().any(|sine| sine < LEAST_SINE) {
            return None;
        }
        Some([self.face(0, travel, out, angle_in), self.face(1, travel, out, span - angle_in)])
    }

    /// Whether it is the open edge of a sheet.
    pub(crate) fn is_of_sheet(&self) -> bool {
        self.exterior == 2.0
    }

    /// Whether one of its faces has this normal.
    pub(crate) fn has_face(&self, normal: DVec3) -> bool {
        self.normal.iter().any(|n| n.dot(normal) > SAME_FACE_COSINE)
    }

    /// Views of both faces for a wave arriving along `travel` on the face with this normal, at grazing
    /// incidence; `None` as for [`Self::faces`], and if no face of the wedge has this normal.
    pub(crate) fn faces_from_face(&self, travel: DVec3, normal: DVec3, out: DVec3) -> Option<[FaceView; 2]> {
        let span = self.exterior * PI;
        let is_seen = self.angle_of(out) <= span;
        let is_sound = [travel, out].iter().all(|d| d.cross(self.along).length() >= LEAST_SINE);
        let alignment = self.normal.map(|n| n.dot(normal));
        let first = if alignment[0] >= alignment[1] { 0.0 } else { span };
        let looks = self.has_face(normal);
        let faces = || [self.face(0, travel, out, first), self.face(1, travel, out, span - first)];
        (is_seen && is_sound && looks).then(faces)
    }

    fn face(&self, index: usize, travel: DVec3, out: DVec3, angle_in: f64) -> FaceView {
        let along = if index == 0 { self.along } else { -self.along };
        let (inward, normal) = (self.inward[index], self.normal[index]);
        let (cos_in, sin_in) = (travel.dot(along), travel.cross(along).length());
        let out = DVec3::new(out.dot(inward), out.dot(normal), out.dot(along));
        let off_grazing = ((1.0 - out.x * sin_in - out.z * cos_in) / (sin_in * sin_in)).max(LEAST_GRAZING);
        FaceView {
            exterior: self.exterior,
            inward,
            normal,
            along,
            angle_in,
            cos_in,
            sin_in,
            out,
            off_grazing,
        }
    }
}

impl FaceView {
    /// Lighting U of the face; one that is edge-on to within rounding has no lit polygon either.
    pub(crate) fn lighting(&self) -> Lighting {
        if (0.0..PI - EDGE_ON_RAD).contains(&self.angle_in) { Lighting::Lit } else { Lighting::Shadowed }
    }

    /// Unit direction of travel of the wave along the face.
    pub(crate) fn along_face(&self) -> DVec3 {
        self.inward * self.sin_in + self.along * self.cos_in
    }

    /// Components E and Z·H of the incident wave along the edge.
    pub(crate) fn incident(&self, travel: DVec3, field: DVec3) -> [f64; 2] {
        [field.dot(self.along), travel.cross(field).dot(self.along)]
    }

    /// Contribution of this face, taken as unbounded, in √π·dS/dl: for incident fields with E and Z·H along
    /// the edge, received along `out` in each of the unit fields `received`; by `[received][sent]`.
    ///
    /// S = (1/√π)∫[−A p·t + B p·(s×t)]dl with A, B the currents of docs/physics.md §4 without their 2j/k.
    pub(crate) fn coefficients<const N: usize>(
        &self,
        sent: [[f64; 2]; N],
        out: DVec3,
        received: [DVec3; 2],
    ) -> [[f64; N]; 2] {
        let (electric, magnetic) = self.fringe_functions();
        let cot_in = self.cos_in / self.sin_in;
        let square_out = 1.0 - self.out.z * self.out.z;
        let mu = 1.0 - self.off_grazing;
        let lit = if self.lighting() == Lighting::Lit { 1.0 } else { 0.0 };
        let turned = (mu * cot_in - self.out.z * self.out.x / square_out) * magnetic + lit * cot_in;
        let across = out.cross(self.along);
        received.map(|received| {
            let [parallel, square] = [received.dot(self.along), received.dot(across)];
            sent.map(|[e, h]| {
                let a = e * electric / (self.sin_in * self.sin_in) + h / self.sin_in * turned;
                let b = -h * self.out.y / (square_out * self.sin_in) * magnetic;
                -a * parallel + b * square
            })
        })
    }

    /// Fringe functions D − U sinφ′/(cosφ′ + μ) and G − U/(cosφ′ + μ).
    fn fringe_functions(&self) -> (f64, f64) {
        let of = |z: Complex64| cotangents(z, self.exterior, self.lighting());
        let mut mu = 1.0 - self.off_grazing;
        // At μ = −1 both functions are regular and sinψ is 0: evaluated 1e-6 rad aside.
        if (mu + 1.0).abs() < 1e-12 {
            mu = -1.0 + 1e-12;
        }
        if mu >= -1.0 {
            let psi = (-mu).acos();
            let [h, m] = [psi - self.angle_in, psi + self.angle_in].map(|z| of(Complex64::from(0.5 * z)).re);
            (0.5 * (h - m), 0.5 * (h + m) / psi.sin())
        } else {
            let eta = (-mu).acosh();
            let m = of(Complex64::new(0.5 * self.angle_in, 0.5 * eta));
            (-m.re, m.im / eta.sinh())
        }
    }
}

/// Difference c(z) = cot(z/N)/N − U cot z.
fn cotangents(z: Complex64, n: f64, lighting: Lighting) -> Complex64 {
    let cot = |z: Complex64| z.cos() / z.sin();
    match lighting {
        Lighting::Shadowed => cot(z / n) / n,
        // 1/z cancels: ⅓(1 − N⁻²)z + (1 − N⁻⁴)z³/45 + 2(1 − N⁻⁶)z⁵/945; the next term is below 2e-4·z⁷.
        Lighting::Lit if z.norm_sqr() < 1e-3 => {
            let (z2, n2) = (z * z, n.powi(-2));
            z * ((1.0 - n2) / 3.0 + z2 * ((1.0 - n2 * n2) / 45.0 + z2 * (2.0 / 945.0 * (1.0 - n2 * n2 * n2))))
        }
        Lighting::Lit => cot(z / n) / n - cot(z),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An edge along z whose face 1 lies along x with normal y.
    pub(crate) fn wedge(n: f64) -> Wedge {
        let (sin, cos) = (n * PI).sin_cos();
        Wedge {
            along: DVec3::Z,
            inward: [DVec3::X, DVec3::new(cos, sin, 0.0)],
            normal: [DVec3::Y, DVec3::new(sin, -cos, 0.0)],
            exterior: n,
        }
    }

    /// Fringe coefficients f¹ and g¹ at right angles to the edge.
    pub(crate) fn f_g(n: f64, angle_in: f64, angle_out: f64) -> [f64; 2] {
        let away = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 0.0);
        let (travel, out) = (-away(angle_in), away(angle_out));
        let faces = wedge(n).faces(travel, out).unwrap();
        let of = |field: DVec3, received: DVec3| -> f64 {
            faces.iter().map(|f| f.coefficients([f.incident(travel, field)], out, [received; 2])[0][0]).sum()
        };
        // E ∥: S = −(L/√π)f. H ∥: E is ẑ × out (as ĥ is), S = +(L/√π)g for H received as it was sent.
        let h = |r: DVec3| DVec3::Z.cross(r);
        [-of(DVec3::Z, DVec3::Z), of(h(-travel), h(out))]
    }

    #[test]
    fn e1_the_fringe_functions_have_their_known_values() {
        let known = [
            (
                2.0,
                [
                    [-0.131292, -0.868708],
                    [-0.380078, -0.619922],
                    [-0.608979, -0.391021],
                    [-0.891753, -0.108247],
                ],
            ),
            (
                1.5,
                [
                    [-0.133287, -0.636513],
                    [-0.411310, -0.358491],
                    [-0.546497, -0.223303],
                    [-0.556327, -0.213474],
                ],
            ),
        ];
        for (n, rows) in known {
            for (angle, expected) in [0.3, 1.1, 2.0, 2.9].into_iter().zip(rows) {
                let got = f_g(n, angle, angle);
                println!("N {n} φ {angle}: got {got:.7?}, known {expected:?}");
                assert!(got.iter().zip(expected).all(|(g, e)| (g - e).abs() < 1e-6));
            }
        }
    }

    #[test]
    fn an_open_edge_has_f_plus_g_of_minus_one_from_any_side() {
        for step in 1..72 {
            let angle = TAU * f64::from(step) / 72.0 + 1e-3;
            let [f, g] = f_g(2.0, angle, angle);
            assert!((f + g + 1.0).abs() < 1e-9, "{angle}: {f} + {g}");
        }
    }

    #[test]
    fn a_plane_has_no_fringe() {
        let travel = DVec3::new(-0.48, -0.6, 0.64);
        for out in [DVec3::new(0.36, 0.48, 0.8), DVec3::new(-0.6, 0.64, -0.48), -travel] {
            let faces = wedge(1.0).faces(travel, out).unwrap();
            let e = travel.any_orthonormal_vector();
            let received = [out.any_orthonormal_vector(); 2];
            let total: f64 =
                faces.iter().map(|f| f.coefficients([f.incident(travel, e)], out, received)[0][0]).sum();
            assert!(total.abs() < 1e-13, "{total:e}");
        }
    }

    #[test]
    fn nothing_jumps_where_a_singularity_was_removed() {
        for n in [2.0, 1.75, 1.5, 4.0 / 3.0] {
            // The reflection boundary of face 1 and of face 2, cosα = −1, and the switch to the series of c.
            for angle_in in [0.4, 0.5 * PI, 1.3] {
                for boundary in [PI - angle_in, 0.5 * PI] {
                    let near = |d: f64| f_g(n, angle_in, boundary + d);
                    let (below, at, above) = (near(-1e-7), near(0.0), near(1e-7));
                    for i in 0..2 {
                        assert!(
                            (at[i] - 0.5 * (below[i] + above[i])).abs() < 1e-6,
                            "{n} {angle_in}: {at:?} {below:?}"
                        );
                    }
                }
            }
        }
    }

    /// Reference data of wedges beside the checkout, or `None` with a message.
    fn wedge_rows(file: &str) -> Option<Vec<Vec<String>>> {
        let beside = || concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared").to_owned();
        let shared = std::env::var("WAYSIDE_SHARED").unwrap_or_else(|_| beside());
        let Ok(text) = std::fs::read_to_string(format!("{shared}/reference/wedge/{file}")) else {
            println!("skipped: ../shared is not here");
            return None;
        };
        Some(text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect())
    }

    /// Worst difference of f¹, g¹ from the last two columns.
    fn worst(rows: &[Vec<String>], angles: impl Fn(&[f64]) -> [f64; 2]) -> f64 {
        let of = |row: &Vec<String>| {
            let numbers: Vec<f64> = row[1..].iter().map(|cell| cell.parse().unwrap()).collect();
            let [angle_in, angle_out] = angles(&numbers).map(f64::to_radians);
            let got = f_g(numbers[0], angle_in, angle_out);
            let known = &numbers[numbers.len() - 2..];
            got.iter().zip(known).map(|(g, k)| (g - k).abs()).fold(0.0, f64::max)
        };
        rows.iter().map(of).fold(0.0, f64::max)
    }

    #[test]
    fn every_row_of_the_monostatic_wedge_table_is_met_to_1e_minus_6() {
        let Some(rows) = wedge_rows("monostatic.csv") else { return };
        let worst = worst(&rows, |n| [n[1], n[1]]);
        println!("{} rows, N = 2 to 7/6: asked 1e-6, got {worst:.1e}", rows.len());
        assert!(rows.len() > 400 && worst < 1e-6);
    }

    /// Near the shadow boundary behind the wedge the table's own optics part follows another convention; see
    /// the file's README.
    #[test]
    fn every_row_of_the_bistatic_wedge_table_is_met_to_1e_minus_6() {
        let Some(rows) = wedge_rows("bistatic.csv") else { return };
        let worst = worst(&rows, |n| [n[1], n[2]]);
        println!("{} rows: asked 1e-6, got {worst:.1e}", rows.len());
        assert!(rows.len() > 100 && worst < 1e-6);
    }
}
