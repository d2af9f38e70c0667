//! Silhouettes by a union of projected triangles that shares nothing with the tracer.
//!
//! Triangles are projected to a plane (parallel, or from a point). Between two neighbouring heights of all
//! corners and crossings every outline is straight and none cross, so the union is a row of trapezoids, each
//! summed exactly.

use bart_rcs::Antenna;
use glam::{DVec2, DVec3};

/// Area across the direction, m², or solid angle, sr, of the union of the triangles, all of which lie before
/// the antenna.
pub(crate) fn silhouette(triangles: &[[DVec3; 3]], antenna: Antenna) -> f64 {
    let view = Projection::towards(triangles, antenna);
    let flat: Vec<[DVec2; 3]> = triangles.iter().map(|t| t.map(|v| view.flat(v))).collect();
    let heights = heights(&flat);
    heights.windows(2).map(|slab| union_in_slab(&flat, slab[0], slab[1], &view)).sum()
}

struct Projection {
    antenna: Antenna,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
}

impl Projection {
    fn towards(triangles: &[[DVec3; 3]], antenna: Antenna) -> Self {
        let middle = triangles.iter().flatten().sum::<DVec3>() / (3 * triangles.len()) as f64;
        let forward = antenna.travel_direction_at(middle);
        // Turned by an angle that puts no usual edge along a slab.
        let (a, b) = forward.any_orthonormal_pair();
        let (sin, cos) = 0.3_f64.sin_cos();
        Self { antenna, forward, right: cos * a + sin * b, up: cos * b - sin * a }
    }

    fn flat(&self, v: DVec3) -> DVec2 {
        match self.antenna {
            Antenna::Direction(_) => DVec2::new(self.right.dot(v), self.up.dot(v)),
            Antenna::Point(p) => {
                let arm = v - p;
                let depth = self.forward.dot(arm);
                assert!(depth > 0.0, "the referee looks forward only");
                DVec2::new(self.right.dot(arm), self.up.dot(arm)) / depth
            }
        }
    }

    /// Area or solid angle of a flat quadrilateral.
    fn measure(&self, quad: [DVec2; 4]) -> f64 {
        let triangle = |a: DVec2, b: DVec2, c: DVec2| match self.antenna {
            Antenna::Direction(_) => 0.5 * (b - a).perp_dot(c - a),
            Antenna::Point(_) => {
                let [a3, b3, c3] = [a, b, c].map(|v| v.extend(1.0));
                let (la, lb, lc) = (a3.length(), b3.length(), c3.length());
                let volume = (b - a).perp_dot(c - a);
                let below = la * lb * lc + a3.dot(b3) * lc + b3.dot(c3) * la + c3.dot(a3) * lb;
                2.0 * volume.atan2(below)
            }
        };
        (triangle(quad[0], quad[1], quad[2]) + triangle(quad[0], quad[2], quad[3])).abs()
    }
}

/// Every height at which the union's outline may bend.
fn heights(flat: &[[DVec2; 3]]) -> Vec<f64> {
    let edges: Vec<[DVec2; 2]> = flat.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    let mut heights: Vec<f64> = flat.iter().flatten().map(|v| v.y).collect();
    for (i, e) in edges.iter().enumerate() {
        heights.extend(edges[i + 1..].iter().filter_map(|f| crossing_height(*e, *f)));
    }
    heights.sort_by(f64::total_cmp);
    heights.dedup();
    heights
}

fn crossing_height([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> Option<f64> {
    if a.x.max(b.x) < c.x.min(d.x)
        || c.x.max(d.x) < a.x.min(b.x)
        || a.y.max(b.y) < c.y.min(d.y)
        || c.y.max(d.y) < a.y.min(b.y)
    {
        return None;
    }
    let (u, v) = (b - a, d - c);
    let t = (c - a).perp_dot(v) / u.perp_dot(v);
    let s = (c - a).perp_dot(u) / u.perp_dot(v);
    // A little beyond the ends does no harm: one height too many.
    ((-1e-9..=1.0 + 1e-9).contains(&t) && (-1e-9..=1.0 + 1e-9).contains(&s)).then_some(a.y + t * u.y)
}

/// A side of a triangle within a slab: x at its lower, middle and upper height.
type Side = [f64; 3];

fn union_in_slab(flat: &[[DVec2; 3]], low: f64, high: f64, view: &Projection) -> f64 {
    let middle = 0.5 * (low + high);
    let mut spans: Vec<[Side; 2]> = flat.iter().filter_map(|t| span(t, low, middle, high)).collect();
    spans.sort_by(|a, b| a[0][1].total_cmp(&b[0][1]));
    let mut sum = 0.0;
    let mut open: Option<[Side; 2]> = None;
    for span in spans {
        match &mut open {
            Some(row) if span[0][1] <= row[1][1] => {
                if span[1][1] > row[1][1] {
                    row[1] = span[1];
                }
            }
            _ => {
                sum += open.map_or(0.0, |row| trapezoid(row, low, high, view));
                open = Some(span);
            }
        }
    }
    sum + open.map_or(0.0, |row| trapezoid(row, low, high, view))
}

fn trapezoid([left, right]: [Side; 2], low: f64, high: f64, view: &Projection) -> f64 {
    let at = |x: f64, y: f64| DVec2::new(x, y);
    view.measure([at(left[0], low), at(right[0], low), at(right[2], high), at(left[2], high)])
}

/// Left and right side of a triangle in a slab that none of its corners lies inside.
fn span(t: &[DVec2; 3], low: f64, middle: f64, high: f64) -> Option<[Side; 2]> {
    let mut sides = [(0, 1), (1, 2), (2, 0)].into_iter().filter_map(|(i, j)| {
        let (a, b) = if t[i].y < t[j].y { (t[i], t[j]) } else { (t[j], t[i]) };
        (a.y < middle && middle < b.y)
            .then(|| [low, middle, high].map(|y| a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)))
    });
    let (first, second) = (sides.next()?, sides.next()?);
    Some(if first[1] < second[1] { [first, second] } else { [second, first] })
}
