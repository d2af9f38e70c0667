//! Openings, panes and trim cut out of a skin along exact outlines.
//!
//! An outline is an implicit function of position, positive inside. The skin's triangles are split at its
//! zero line; neighbours share the new points, so no T-junction arises. Points close to the outline are first
//! moved onto it along an edge, so no sliver arises either (after Labelle and Shewchuk 2007, "Isosurface
//! stuffing").

use crate::vehicles::drawing::surface::{Material, Surface, Triangle};
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// Change of the skin within an outline.
#[derive(Debug, Clone, Copy)]
pub(crate) enum CutTreatment {
    /// The skin becomes another material in place.
    Recoloured(Material),
    /// The skin becomes another material, lowered along its normal by `depth_m` with a wall of `rim`
    /// around.
    Inset { material: Material, rim: Material, depth_m: f64 },
    /// The skin becomes another material, lowered by `depth_m` straight down with a wall of `rim` around.
    Sunk { material: Material, rim: Material, depth_m: f64 },
    /// The skin is removed; along the opening of an upright skin a flange points inwards (−y on the left, +y
    /// on the right).
    Opened { flange_m: f64 },
}

/// Length of the shortest remaining edge: intersecting outlines leave shorter, unintended ones; all intended
/// ones are longer.
const SHORTEST_EDGE_M: f64 = 0.0025;

/// Cuts `skin` along the zero line of `outline`.
pub(crate) fn cut(skin: Surface, outline: impl Fn(DVec3) -> f64, inside: CutTreatment) -> Surface {
    let split = Split::along(skin, &outline);
    let result = match inside {
        CutTreatment::Recoloured(material) => split.recoloured(material),
        CutTreatment::Inset { material, rim, depth_m } => {
            let normals = split.whole().point_normals();
            split.moved(material, rim, |i| -depth_m * normals[i])
        }
        CutTreatment::Sunk { material, rim, depth_m } => split.moved(material, rim, |_| -depth_m * DVec3::Z),
        CutTreatment::Opened { flange_m } => split.opened(flange_m),
    };
    result.without_short_edges(SHORTEST_EDGE_M)
}

/// Triangles on either side of the outline, with common points.
struct Split {
    points_m: Vec<DVec3>,
    inner: Vec<Triangle>,
    outer: Vec<Triangle>,
}

impl Split {
    fn along(mut skin: Surface, outline: &impl Fn(DVec3) -> f64) -> Self {
        let mut values: Vec<f64> = skin.points_m.iter().map(|p| outline(*p)).collect();
        slide_onto_outline(&mut skin, &mut values, outline);
        let mut crossings = BTreeMap::new();
        let mut split = Self { points_m: skin.points_m, inner: Vec::new(), outer: Vec::new() };
        for t in &skin.triangles {
            let signs = t.corners.map(|i| values[i as usize]);
            if signs.iter().all(|v| *v <= 0.0) {
                split.outer.push(*t);
            } else if signs.iter().all(|v| *v >= 0.0) {
                split.inner.push(*t);
            } else {
                split.divide(t, &values, &mut crossings, outline);
            }
        }
        split
    }

    /// Walks around a triangle that the outline crosses and returns the polygon on each side.
    fn divide(
        &mut self,
        t: &Triangle,
        values: &[f64],
        crossings: &mut BTreeMap<(u32, u32), u32>,
        outline: &impl Fn(DVec3) -> f64,
    ) {
        let (mut inner, mut outer) = (Vec::with_capacity(4), Vec::with_capacity(4));
        for k in 0..3 {
            let (a, b) = (t.corners[k], t.corners[(k + 1) % 3]);
            let (value_a, value_b) = (values[a as usize], values[b as usize]);
            if value_a >= 0.0 {
                inner.push(a);
            }
            if value_a <= 0.0 {
                outer.push(a);
            }
            if value_a * value_b < 0.0 {
                let key = (a.min(b), a.max(b));
                let crossing = *crossings.entry(key).or_insert_with(|| {
                    let (low, high) = (self.points_m[key.0 as usize], self.points_m[key.1 as usize]);
                    self.points_m.push(zero_between(low, high, outline));
                    self.points_m.len() as u32 - 1
                });
                inner.push(crossing);
                outer.push(crossing);
            }
        }
        fan(&self.points_m, &inner, t.material, &mut self.inner);
        fan(&self.points_m, &outer, t.material, &mut self.outer);
    }

    fn recoloured(self, material: Material) -> Surface {
        let mut triangles = self.outer;
        triangles.extend(self.inner.into_iter().map(|t| Triangle { material, ..t }));
        Surface { points_m: self.points_m, triangles }
    }

    /// The skin with its inner side moved by `shift`, and a wall of `rim` around it.
    fn moved(self, material: Material, rim: Material, shift: impl Fn(usize) -> DVec3) -> Surface {
        let lowered: Vec<DVec3> = self.points_m.iter().enumerate().map(|(i, p)| *p + shift(i)).collect();
        let first = self.points_m.len() as u32;
        let mut result = self.walled(rim, &lowered);
        let down = |t: &Triangle| Triangle { corners: t.corners.map(|i| first + i), material };
        result.triangles.extend(self.inner.iter().map(down));
        result.welded()
    }

    fn opened(self, flange_m: f64) -> Surface {
        // On a horizontal skin (a floor), a flange along y would lie in it: the wall has no width there and
        // is welded away.
        let normals = self.whole().point_normals();
        let upright = |i: usize| if normals[i].y.abs() > 0.4 { 1.0 } else { 0.0 };
        let inwards = |(i, p): (usize, &DVec3)| *p - DVec3::Y * flange_m * upright(i) * p.y.signum();
        let moved: Vec<DVec3> = self.points_m.iter().enumerate().map(inwards).collect();
        self.walled(Material::Paint, &moved).welded()
    }

    /// The outer side with a wall from the outline to the corresponding points in `moved`, which follow the
    /// present points.
    fn walled(&self, rim: Material, moved: &[DVec3]) -> Surface {
        let first = self.points_m.len() as u32;
        let mut surface = Surface { points_m: self.points_m.clone(), triangles: self.outer.clone() };
        surface.points_m.extend(moved);
        for (a, b) in self.outline_edges() {
            for corners in [[a, b, first + b], [a, first + b, first + a]] {
                surface.triangles.push(Triangle { corners, material: rim });
            }
        }
        surface
    }

    /// Directed edges of the inner side whose other side is outer.
    fn outline_edges(&self) -> Vec<(u32, u32)> {
        let outer: BTreeSet<(u32, u32)> = self.outer.iter().flat_map(|t| edges(t.corners)).collect();
        let inner = self.inner.iter().flat_map(|t| edges(t.corners));
        inner.filter(|(a, b)| outer.contains(&(*b, *a))).collect()
    }

    fn whole(&self) -> Surface {
        let triangles = self.inner.iter().chain(&self.outer).copied().collect();
        Surface { points_m: self.points_m.clone(), triangles }
    }
}

fn edges([a, b, c]: [u32; 3]) -> [(u32, u32); 3] {
    [(a, b), (b, c), (c, a)]
}

/// Moves points nearer to the outline than a quarter of their shortest edge onto it, along the edge with the
/// nearest crossing.
fn slide_onto_outline(skin: &mut Surface, values: &mut [f64], outline: &impl Fn(DVec3) -> f64) {
    let mut reach = vec![f64::INFINITY; values.len()];
    for (a, b) in skin.triangles.iter().flat_map(|t| edges(t.corners)) {
        let length = skin.points_m[a as usize].distance(skin.points_m[b as usize]);
        reach[a as usize] = reach[a as usize].min(0.25 * length);
        reach[b as usize] = reach[b as usize].min(0.25 * length);
    }
    let mut best: Vec<Option<(f64, DVec3)>> = vec![None; values.len()];
    for (a, b) in skin.triangles.iter().flat_map(|t| edges(t.corners)) {
        if a > b || values[a as usize] * values[b as usize] >= 0.0 {
            continue;
        }
        let zero = zero_between(skin.points_m[a as usize], skin.points_m[b as usize], outline);
        for i in [a as usize, b as usize] {
            let distance = zero.distance(skin.points_m[i]);
            if distance < reach[i] && best[i].is_none_or(|(d, _)| distance < d) {
                best[i] = Some((distance, zero));
            }
        }
    }
    for (i, slide) in best.into_iter().enumerate() {
        if let Some((_, zero)) = slide {
            skin.points_m[i] = zero;
            values[i] = 0.0;
        }
    }
}

/// Bisection to 2⁻³⁰ of the edge.
fn zero_between(a: DVec3, b: DVec3, outline: &impl Fn(DVec3) -> f64) -> DVec3 {
    let a_inside = outline(a) > 0.0;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if (outline(a.lerp(b, middle)) > 0.0) == a_inside { low = middle } else { high = middle }
    }
    a.lerp(b, 0.5 * (low + high))
}

/// Triangulates a triangle, or a quadrilateral along its shorter diagonal.
fn fan(points_m: &[DVec3], polygon: &[u32], material: Material, into: &mut Vec<Triangle>) {
    let at = |k: usize| points_m[polygon[k] as usize];
    let pieces: &[[usize; 3]] = match polygon.len() {
        3 => &[[0, 1, 2]],
        4 if at(0).distance_squared(at(2)) <= at(1).distance_squared(at(3)) => &[[0, 1, 2], [0, 2, 3]],
        4 => &[[0, 1, 3], [1, 2, 3]],
        _ => &[],
    };
    into.extend(pieces.iter().map(|p| Triangle { corners: p.map(|k| polygon[k]), material }));
}

/// Distance into a rectangle with rounded corners, in any two coordinates; negative outside.
pub(crate) fn rounded_rectangle(u: f64, v: f64, [u0, u1]: [f64; 2], [v0, v1]: [f64; 2], radius: f64) -> f64 {
    let (half_u, half_v) = (0.5 * (u1 - u0), 0.5 * (v1 - v0));
    let across = (u - 0.5 * (u0 + u1)).abs() - half_u + radius;
    let along = (v - 0.5 * (v0 + v1)).abs() - half_v + radius;
    radius - across.max(0.0).hypot(along.max(0.0)) - across.max(along).min(0.0)
}

/// Minimum of several distances, with corners rounded by about `radius` (quadratic soft minimum).
pub(crate) fn soft_minimum(distances: &[f64], radius: f64) -> f64 {
    distances.iter().copied().reduce(|a, b| blend(a, b, radius)).unwrap_or(f64::NEG_INFINITY)
}

fn blend(a: f64, b: f64, radius: f64) -> f64 {
    let overlap = (radius - (a - b).abs()).max(0.0) / radius;
    a.min(b) - 0.25 * radius * overlap * overlap
}
