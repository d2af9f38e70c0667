//! Triangles projected onto a view in single precision, with a conservative test of separation.

use glam::{DVec2, Vec4};

/// A triangle as its corners and the half-planes beyond its edges.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProjectedTriangle {
    /// Coordinates x and y of the corners, the third repeated.
    corners: [Vec4; 2],
    /// Half-plane beyond each edge, nx, ny, offset; a point with nx·x + ny·y below the offset is beyond the
    /// edge by more than rounding.
    edges: [[f32; 3]; 3],
}

impl ProjectedTriangle {
    /// Triangle whose corners' coordinates are known to within `slack` and have magnitudes up to `reach`,
    /// like those of all others.
    pub(crate) fn new(corners: [DVec2; 3], reach: f64, slack: f64) -> Self {
        let [a, b, c] = corners;
        let of = |values: [f64; 3]| Vec4::from_array([0, 1, 2, 2].map(|i| values[i] as f32));
        let edges = [(a, b, c), (b, c, a), (c, a, b)]
            .map(|(from, to, opposite)| beyond(from, to, opposite, reach, slack));
        Self { corners: [of([a.x, b.x, c.x]), of([a.y, b.y, c.y])], edges }
    }

    /// Whether an edge of one has all of the other beyond it; separated triangles overlap in rounding at
    /// most.
    #[inline]
    pub(crate) fn is_apart_from(&self, other: &Self) -> bool {
        self.has_beyond_an_edge(&other.corners) || other.has_beyond_an_edge(&self.corners)
    }

    #[inline]
    fn has_beyond_an_edge(&self, [x, y]: &[Vec4; 2]) -> bool {
        let is_beyond = |[nx, ny, offset]: &[f32; 3]| (*x * *nx + *y * *ny).cmplt(Vec4::splat(*offset)).all();
        self.edges.iter().any(is_beyond)
    }
}

/// Half-plane beyond an edge, for either winding; empty if rounding decides its side.
///
/// A coordinate, a product and a sum in single precision lose half an ε each, for nx·x and ny·y at most: 4ε
/// covers all.
fn beyond(from: DVec2, to: DVec2, opposite: DVec2, reach: f64, slack: f64) -> [f32; 3] {
    let edge = to - from;
    let normal = DVec2::new(-edge.y, edge.x);
    let lost = (4.0 * f64::from(f32::EPSILON) * reach + 2.0 * slack) * (normal.x.abs() + normal.y.abs());
    let side = normal.dot(opposite - from);
    if side.abs() <= lost {
        return [0.0, 0.0, f32::NEG_INFINITY];
    }
    let inwards = side.signum() * normal;
    [inwards.x as f32, inwards.y as f32, ((inwards.dot(from) - lost) as f32).next_down()]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fractional parts of multiples of irrational numbers, in cells of a view of 600.
    fn corners(i: usize) -> [DVec2; 3] {
        let at = |n: usize, step: f64| ((n as f64 + 1.0) * step).fract();
        let middle = 600.0 * DVec2::new(at(i / 2, 0.618_034), at(i / 2, 0.414_214));
        [0, 1, 2].map(|k| {
            let size = 10.0_f64.powf(3.0 * at(i, 0.259_921) - 1.0);
            let (x, y) = ([0.732_051, 0.236_068, 0.645_751][k], [0.316_625, 0.123_106, 0.872_983][k]);
            middle + size * (DVec2::new(at(i, x), at(i, y)) - 0.5)
        })
    }

    /// Twice the area of overlap of two triangles, by clipping one to the other's edges.
    fn shared(a: [DVec2; 3], b: [DVec2; 3]) -> f64 {
        let doubled = |p: &[DVec2]| (0..p.len()).map(|i| p[i].perp_dot(p[(i + 1) % p.len()])).sum::<f64>();
        let sign = doubled(&b).signum();
        let mut left = a.to_vec();
        for i in 0..3 {
            let (from, edge) = (b[i], b[(i + 1) % 3] - b[i]);
            let side = |x: DVec2| sign * edge.perp_dot(x - from);
            let mut kept = Vec::new();
            for (j, &p) in left.iter().enumerate() {
                let q = left[(j + 1) % left.len()];
                if side(p) >= 0.0 {
                    kept.push(p);
                }
                if (side(p) >= 0.0) != (side(q) >= 0.0) {
                    kept.push(p.lerp(q, side(p) / (side(p) - side(q))));
                }
            }
            left = kept;
        }
        doubled(&left).abs()
    }

    #[test]
    fn triangles_that_share_area_are_never_told_apart_and_most_others_are() {
        let (mut apart, mut alone) = (0, 0);
        for i in 0..4000 {
            let [a, b] = [corners(2 * i), corners(2 * i + 1)];
            let is_apart = [a, b].map(|c| ProjectedTriangle::new(c, 601.0, 1e-9));
            let is_apart = is_apart[0].is_apart_from(&is_apart[1]);
            let area = shared(a, b);
            assert!(!is_apart || area < 1e-9, "case {i} shares {area}");
            alone += usize::from(area < 1e-9);
            apart += usize::from(is_apart);
        }
        println!("{apart} of {alone} pairs without common area are told apart");
        assert!(alone < 3900 && apart > alone * 9 / 10);
    }
}
