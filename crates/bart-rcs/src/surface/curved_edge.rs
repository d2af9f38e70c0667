//! An edge of the curved skin under repeated halving, in closed forms of its two ends alone.
//!
//! Both triangles at an edge have the same values and so obtain the same bits: refined neighbours share every
//! vertex.

use glam::DVec3;

/// A curve between two vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CurvedEdge {
    pub(crate) ends_m: [DVec3; 2],
    pub(crate) curve: Curve,
    /// Number of times that the original edge was halved to obtain this part.
    pub(crate) halvings: u8,
}

/// Shape of an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Curve {
    /// A straight edge.
    Straight,
    /// An edge on a smooth skin with these unit normals at the ends.
    OnSkin([DVec3; 2]),
    /// An edge where two skins meet, with unit tangents at the ends, from the first to the second.
    Crease([DVec3; 2]),
}

/// Midpoint of an edge.
struct EdgeMidpoint {
    point_m: DVec3,
    /// Curves of both halves.
    curves: [Curve; 2],
}

impl CurvedEdge {
    /// Maximum distance of the curve from its chord, m: a quarter of the length times the larger slope at an
    /// end (the control polygon of a cubic), which an arc reaches.
    pub(crate) fn sagitta_m(&self) -> f64 {
        let chord = self.chord_m();
        match self.curve {
            Curve::Straight => 0.0,
            Curve::OnSkin(normals) => {
                0.25 * normals.map(|n| chord.dot(n).abs()).into_iter().fold(0.0, f64::max)
            }
            Curve::Crease(tangents) => {
                let across = handles_m(chord, tangents).map(|h| h.cross(chord).length() / chord.length());
                0.75 * across[0].max(across[1])
            }
        }
    }

    /// Angle between the curve's directions at its ends, rad: twice its larger angle with the chord.
    pub(crate) fn turn_rad(&self) -> f64 {
        let chord = self.chord_m();
        let sines = match self.curve {
            Curve::Straight => return 0.0,
            Curve::OnSkin(normals) => slopes(chord, normals).map(f64::abs),
            Curve::Crease(tangents) => tangents.map(|t| t.cross(chord).length() / chord.length()),
        };
        2.0 * sines[0].max(sines[1]).min(1.0).asin()
    }

    /// Distance between a cubic over a facet with this side and the skin, m.
    ///
    /// For an arc it is ρθ⁴/128 along the side, for a sphere ρθ⁴/72 = sagitta·θ²/9 at the centre of an
    /// equilateral facet; twice that, since both neighbours err in the same sense. The difference between the
    /// rise of the cubic and that of converging rulings ([`rise_m`]) is added.
    pub(crate) fn cubic_error_m(&self) -> f64 {
        let Curve::OnSkin(normals) = self.curve else { return 0.0 };
        let (chord, turn) = (self.chord_m(), self.turn_rad());
        let [a, b] = slopes(chord, normals);
        // The side of an inflected curve is that of the cubic.
        let harmonic = if a * b > 0.0 { 4.0 * a * b / (a + b) } else { a + b };
        self.sagitta_m() * turn * turn / 4.5 + 0.125 * chord.length() * (a + b - harmonic).abs()
    }

    /// Heights, over a plane through both ends, of the control points of a cubic, a third of the chord from
    /// the first end and from the second: there the tangent planes or tangents at the ends pass.
    pub(crate) fn control_heights_m(&self, normal: DVec3) -> [f64; 2] {
        let third = self.chord_m() / 3.0;
        let steps = [third, -third];
        [0, 1].map(|end| match self.curve {
            Curve::Straight => 0.0,
            Curve::OnSkin(normals) => -normals[end].dot(steps[end]) / normals[end].dot(normal),
            Curve::Crease(tangents) => {
                let along = tangents[end].dot(third) / third.length_squared();
                tangents[end].dot(normal) * (1.0 - 2.0 * end as f64) / along
            }
        })
    }

    /// Both halves, which meet at the same point on the curve.
    pub(crate) fn halves(&self) -> [Self; 2] {
        let EdgeMidpoint { point_m, curves } = self.middle();
        let half = |ends_m, curve| Self { ends_m, curve, halvings: self.halvings + 1 };
        [half([self.ends_m[0], point_m], curves[0]), half([point_m, self.ends_m[1]], curves[1])]
    }

    /// Unit normal at the midpoint of a skin with `normals` at the ends.
    pub(crate) fn normal_at_middle(&self, normals: [DVec3; 2]) -> DVec3 {
        let sum = normals[0] + normals[1];
        let along = match self.curve {
            Curve::OnSkin(_) => return normal_at_middle(self.chord_m(), normals),
            Curve::Straight => self.chord_m(),
            Curve::Crease(tangents) => tangent_at_middle(self.chord_m(), tangents),
        };
        rejected(sum, along).try_normalize().unwrap_or(normals[0])
    }

    fn chord_m(&self) -> DVec3 {
        self.ends_m[1] - self.ends_m[0]
    }

    fn middle(&self) -> EdgeMidpoint {
        let chord = self.chord_m();
        let halfway = 0.5 * (self.ends_m[0] + self.ends_m[1]);
        match self.curve {
            Curve::Straight => EdgeMidpoint { point_m: halfway, curves: [Curve::Straight; 2] },
            Curve::OnSkin([a, b]) => {
                let m = normal_at_middle(chord, [a, b]);
                let point_m = halfway + rise_m(chord, [a, b]);
                EdgeMidpoint { point_m, curves: [Curve::OnSkin([a, m]), Curve::OnSkin([m, b])] }
            }
            Curve::Crease([a, b]) => {
                let [from_a, to_b] = handles_m(chord, [a, b]);
                let m = tangent_at_middle(chord, [a, b]);
                let point_m = halfway + 0.375 * (from_a - to_b);
                EdgeMidpoint { point_m, curves: [Curve::Crease([a, m]), Curve::Crease([m, b])] }
            }
        }
    }
}

/// Vector from the chord's midpoint to the skin.
///
/// With slopes a and b relative to the chord at its ends the rise is ¼·L·2ab/(a + b), their harmonic mean: on
/// a developable skin with converging rulings, a cone, the height along an oblique chord is K·t(1 − t)/(r₀(1
/// − t) + r₁t), whose value at the middle this is; for a = b it is the cubic's, and it differs from the
/// cubic's by fourth order, as the cubic does from the skin. The divisor 4 + 2|n₀ + n₁| = 8cos²¼γ in place of
/// 8, γ the angle between the normals, makes it exact on a sphere and, straight or oblique, on a cylinder:
/// ρ(1 − cos ½γ) = ρ(1 − cos γ)/(4cos²¼γ).
fn rise_m(chord: DVec3, normals: [DVec3; 2]) -> DVec3 {
    let sum = normals[0] + normals[1];
    let [a, b] = slopes(chord, normals);
    let both = if a * b > 0.0 { 4.0 * a * b / (a + b) } else { 0.0 };
    let rise = both * chord.length() / (4.0 + 2.0 * sum.length());
    rejected(sum, chord).try_normalize().map_or(DVec3::ZERO, |up| rise * up)
}

/// Slopes of a skin relative to its chord: its rise at the first end, and its descent to it at the second.
fn slopes(chord: DVec3, normals: [DVec3; 2]) -> [f64; 2] {
    let length = chord.length();
    [-normals[0].dot(chord) / length, normals[1].dot(chord) / length]
}

/// Normal at the midpoint: the ends' normals weighted by the slopes at the opposite ends, which is
/// perpendicular to the chord and on a cone the normal of the ruling there, tilted by the slope of
/// [`rise_m`]'s height at the middle; for an inflected curve the normal of a cubic.
fn normal_at_middle(chord: DVec3, normals: [DVec3; 2]) -> DVec3 {
    let [a, b] = slopes(chord, normals);
    let both = a.abs() + b.abs();
    // Below rounding of the normals there is no slope.
    if both < 1e-12 {
        return rejected(normals[0] + normals[1], chord).try_normalize().unwrap_or(normals[0]);
    }
    let weighted = (a.abs() * normals[1] + b.abs() * normals[0]) / both;
    let slope = if a * b > 0.0 {
        -a * b * (a - b) / (both * both)
    } else {
        -0.5 * (a - b) * a.abs().min(b.abs()) / both
    };
    let square = rejected(weighted, chord).try_normalize().unwrap_or(normals[0]);
    (square - slope * chord / chord.length()).try_normalize().unwrap_or(square)
}

/// Handles of the cubic: 2/3 of the chord's length over 1 + cos α for a tangent at angle α to the chord: for
/// an arc of angle 2α this is the 4/3·ρ·tan ½α of the cubic that deviates from it only by sixth order.
fn handles_m(chord: DVec3, tangents: [DVec3; 2]) -> [DVec3; 2] {
    let length = chord.length();
    tangents.map(|t| t * (2.0 * length / (3.0 * (1.0 + t.dot(chord) / length))))
}

fn tangent_at_middle(chord: DVec3, tangents: [DVec3; 2]) -> DVec3 {
    let [a, b] = handles_m(chord, tangents);
    (2.0 * chord - a - b).try_normalize().unwrap_or(tangents[0])
}

/// Component of `v` perpendicular to `direction`.
pub(crate) fn rejected(v: DVec3, direction: DVec3) -> DVec3 {
    v - direction * (v.dot(direction) / direction.length_squared())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Maximum distance of the points of a refined edge from the surface that its ends lie on.
    fn worst(edge: CurvedEdge, halvings: u32, off_m: &dyn Fn(DVec3) -> f64) -> f64 {
        if halvings == 0 {
            return off_m(edge.ends_m[1]).abs();
        }
        edge.halves().map(|half| worst(half, halvings - 1, off_m)).into_iter().fold(0.0, f64::max)
    }

    fn on_skin(ends_m: [DVec3; 2], normals: [DVec3; 2]) -> CurvedEdge {
        CurvedEdge { ends_m, curve: Curve::OnSkin(normals), halvings: 0 }
    }

    #[test]
    fn every_vertex_of_a_halved_edge_lies_on_its_sphere_or_cylinder_to_rounding() {
        let (a, b) = (DVec3::new(0.48, 0.6, 0.64), DVec3::new(0.36, -0.48, 0.8));
        let sphere = worst(on_skin([a, b], [a, b]), 6, &|x| x.length() - 1.0);
        let around = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 0.0);
        let slanting = [around(0.1), around(0.9) + 2.0 * DVec3::Z];
        let cylinder =
            worst(on_skin(slanting, [around(0.1), around(0.9)]), 6, &|x| x.truncate().length() - 1.0);
        println!("sphere {sphere:.1e}, cylinder {cylinder:.1e}");
        // A few roundings of coordinates of 1 and 2 per halving.
        assert!(sphere < 64.0 * f64::EPSILON && cylinder < 64.0 * f64::EPSILON);
    }

    #[test]
    fn an_edge_on_any_other_skin_errs_by_fourth_order() {
        // z = x² − ½y² + 0.3x³ + 0.4x⁴ along the line y = x: its fourth derivative there is that of 0.4x⁴.
        let z = |x: f64, y: f64| x * x - 0.5 * y * y + 0.3 * x.powi(3) + 0.4 * x.powi(4);
        let normal = |x: f64, y: f64| {
            DVec3::new(-2.0 * x - 0.9 * x * x - 1.6 * x.powi(3), y, 1.0).try_normalize().unwrap()
        };
        let error = |length: f64| {
            let at = |x: f64| DVec3::new(x, x, z(x, x));
            let edge =
                on_skin([at(0.1), at(0.1 + length)], [normal(0.1, 0.1), normal(0.1 + length, 0.1 + length)]);
            worst(edge, 5, &|x| x.z - z(x.x, x.y))
        };
        let (long, short) = (error(0.2), error(0.1));
        println!("0.2: {long:.1e}, 0.1: {short:.1e}, ratio {:.1}", long / short);
        assert!(long / short > 12.0 && short < 1e-5);
    }

    #[test]
    fn a_crease_with_the_tangents_of_a_circle_is_a_circle_to_sixth_order() {
        let around = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 0.0);
        for angle in [0.1, 0.2, 0.4_f64] {
            let tangents = [0.0, angle].map(|a| around(a + std::f64::consts::FRAC_PI_2));
            let edge = CurvedEdge {
                ends_m: [around(0.0), around(angle)],
                curve: Curve::Crease(tangents),
                halvings: 0,
            };
            let got = worst(edge, 5, &|x| x.length() - 1.0);
            // 4/27·sin⁶(¼θ)/cos²(¼θ) (Goldapp 1991), 1/64 of it at each further halving, and rounding.
            let bound = 4.0 / 27.0 * (0.25 * angle).sin().powi(6) / (0.25 * angle).cos().powi(2);
            println!("{angle} rad: {got:.1e}, bound {bound:.1e}");
            assert!(got < 1.02 * bound + 64.0 * f64::EPSILON);
        }
    }

    #[test]
    fn an_edge_walked_with_turned_normals_is_the_same_curve() {
        let (a, b) = (DVec3::new(0.48, 0.6, 0.64), DVec3::new(0.36, -0.48, 0.8));
        let [forth, _] = on_skin([a, b], [a, b]).halves();
        let [turned, _] = on_skin([a, b], [-a, -b]).halves();
        assert_eq!(forth.ends_m, turned.ends_m);
    }
}
