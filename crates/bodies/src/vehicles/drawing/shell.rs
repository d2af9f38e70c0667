//! Body shells: cross sections lofted along x, rounded and closed at both ends.

use crate::vehicles::drawing::curve::Curve;
use crate::vehicles::drawing::surface::{Material, Surface};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// Lines of a body as in a coachbuilder's drawing, each over x.
#[derive(Debug, Clone)]
pub(crate) struct Shell {
    /// Height of the underside.
    pub(crate) bottom_z: Curve,
    /// Height where the lower side ends and the upper side (windows) begins.
    pub(crate) waist_z: Curve,
    /// Height where the upper side meets the roof or bonnet.
    pub(crate) rail_z: Curve,
    /// Middle of roof or bonnet.
    pub(crate) top_z: Curve,
    /// Half width at the underside.
    pub(crate) sill_y: Curve,
    /// Half width half way up the lower side.
    pub(crate) belly_y: Curve,
    /// Half width at the waist.
    pub(crate) waist_y: Curve,
    /// Half width at the rail.
    pub(crate) rail_y: Curve,
    /// Outward bow of the upper side between waist and rail.
    pub(crate) upper_bow_m: f64,
    /// Exponent of the roof's superellipse: 2 an ellipse, larger flatter with tighter corners.
    pub(crate) roof_exponent: f64,
    /// Radius between side and underside.
    pub(crate) sill_radius_m: f64,
    /// Rounding of the edges around the front and the rear end.
    pub(crate) end_radius_m: [f64; 2],
    /// Front and rear end.
    pub(crate) ends_x: [f64; 2],
}

/// Resolution of a shell.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    /// Sections in any order; those of the rounded ends are added.
    pub(crate) stations_x: Vec<f64>,
    /// Fractions from sill to waist, with 0 and 1.
    pub(crate) lower: Vec<f64>,
    /// Fractions from waist to rail, with 0 and 1.
    pub(crate) upper: Vec<f64>,
    /// Cells across half of the roof.
    pub(crate) half_columns: usize,
}

/// Fractions from 0 to 1 in `count` equal steps.
pub(crate) fn even(count: usize) -> Vec<f64> {
    (0..=count).map(|k| k as f64 / count as f64).collect()
}

/// Values from `from` to `to` in equal steps of at most `step`.
pub(crate) fn spaced(from: f64, to: f64, step: f64) -> Vec<f64> {
    let count = ((to - from).abs() / step).ceil().max(1.0) as usize;
    (0..=count).map(|k| from + (to - from) * k as f64 / count as f64).collect()
}

/// Half-way angles of the rounded ends: 0 at the end face, 1 where the full section is reached.
const END_STEPS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

impl Shell {
    /// The closed skin, all `Paint`.
    pub(crate) fn skin(&self, layout: &Layout) -> Surface {
        let stations = self.stations(layout);
        let rings: Vec<Vec<DVec3>> = stations.iter().map(|x| self.ring(*x, layout)).collect();
        let closed = |ring: &Vec<DVec3>| ring.iter().chain(ring.first()).copied().collect::<Vec<_>>();
        let mut skin = Surface::from_rows(&rings.iter().map(closed).collect::<Vec<_>>(), Material::Paint);
        for (ring, turned) in [(rings.first(), false), (rings.last(), true)] {
            let Some(ring) = ring else { continue };
            let cap = cap(ring, layout);
            skin.append(if turned { cap.flipped() } else { cap });
        }
        skin.welded().outward()
    }

    /// Half width of the side at height `z`, without the rounding of the ends.
    pub(crate) fn side_y(&self, x: f64, z: f64) -> f64 {
        let (bottom, waist, rail) = (self.bottom_z.at(x), self.waist_z.at(x), self.rail_z.at(x));
        if z < waist {
            self.lower_y(x, (z - bottom) / (waist - bottom))
        } else {
            self.upper_y(x, (z - waist) / (rail - waist))
        }
    }

    fn stations(&self, layout: &Layout) -> Vec<f64> {
        let [front, rear] = self.ends_x;
        let [front_radius, rear_radius] = self.end_radius_m;
        let inner = rear + rear_radius + 1e-3..front - front_radius - 1e-3;
        let mut stations: Vec<f64> =
            layout.stations_x.iter().copied().filter(|x| inner.contains(x)).collect();
        for step in END_STEPS {
            let depth = 1.0 - (step * FRAC_PI_2).cos();
            stations.extend([front - front_radius * depth, rear + rear_radius * depth]);
        }
        stations.sort_by(f64::total_cmp);
        // Sections closer than a centimetre would only make slivers.
        stations.dedup_by(|b, a| (*b - *a).abs() < 0.2 * front_radius.min(rear_radius).min(0.05));
        stations
    }

    /// Ring of a section, counter-clockwise seen from the front, from the middle of the underside: floor,
    /// left side, roof, right side, floor.
    fn ring(&self, x: f64, layout: &Layout) -> Vec<DVec3> {
        let mut half: Vec<(f64, f64)> = Vec::new();
        let floor_y = self.lower_y(x, 0.0);
        let floor = |k: usize| (floor_y * k as f64 / layout.half_columns as f64, self.bottom_z.at(x));
        half.extend((0..layout.half_columns).map(floor));
        half.extend(
            layout
                .lower
                .iter()
                .map(|t| (self.lower_y(x, *t), lerp(self.bottom_z.at(x), self.waist_z.at(x), *t))),
        );
        let upper = layout.upper.iter().skip(1);
        half.extend(upper.map(|t| (self.upper_y(x, *t), lerp(self.waist_z.at(x), self.rail_z.at(x), *t))));
        half.extend((1..=layout.half_columns).map(|k| self.roof(x, k as f64 / layout.half_columns as f64)));
        let shrink = self.end_shrink_m(x);
        let inset = |(y, z): (f64, f64)| self.inset(x, y, z, shrink);
        let left: Vec<DVec3> = half.into_iter().map(inset).collect();
        let right = left[1..left.len() - 1].iter().rev().map(|p| DVec3::new(p.x, -p.y, p.z));
        left.iter().copied().chain(right).collect()
    }

    /// Parabola through sill, belly and waist, with the sill's rounding.
    fn lower_y(&self, x: f64, t: f64) -> f64 {
        let (sill, belly, waist) = (self.sill_y.at(x), self.belly_y.at(x), self.waist_y.at(x));
        let parabola =
            sill * (1.0 - t) * (1.0 - 2.0 * t) + belly * 4.0 * t * (1.0 - t) + waist * t * (2.0 * t - 1.0);
        let height = t * (self.waist_z.at(x) - self.bottom_z.at(x));
        let below = (1.0 - height / self.sill_radius_m).max(0.0);
        parabola - self.sill_radius_m * (1.0 - (1.0 - below * below).max(0.0).sqrt())
    }

    fn upper_y(&self, x: f64, t: f64) -> f64 {
        lerp(self.waist_y.at(x), self.rail_y.at(x), t) + self.upper_bow_m * 4.0 * t * (1.0 - t)
    }

    /// Point (y, z) of the roof, from the rail (0) to the middle (1) along a quarter of a superellipse.
    fn roof(&self, x: f64, t: f64) -> (f64, f64) {
        let (rail_z, top_z) = (self.rail_z.at(x), self.top_z.at(x));
        let power = 2.0 / self.roof_exponent;
        let (sine, cosine) = if t >= 1.0 { (1.0, 0.0) } else { (t * FRAC_PI_2).sin_cos() };
        (self.rail_y.at(x) * cosine.powf(power), rail_z + (top_z - rail_z) * sine.powf(power))
    }

    /// Reduction of the section at `x` by the rounding of an end.
    fn end_shrink_m(&self, x: f64) -> f64 {
        let [front, rear] = self.ends_x;
        let quarter = |depth: f64, radius: f64| {
            let rest = (1.0 - depth / radius).clamp(0.0, 1.0);
            radius * (1.0 - (1.0 - rest * rest).sqrt())
        };
        quarter(front - x, self.end_radius_m[0]) + quarter(x - rear, self.end_radius_m[1])
    }

    fn inset(&self, x: f64, y: f64, z: f64, shrink: f64) -> DVec3 {
        let half_width = self.belly_y.at(x).max(self.waist_y.at(x));
        let (bottom, top) = (self.bottom_z.at(x), self.top_z.at(x));
        let (middle, half_height) = (0.5 * (bottom + top), 0.5 * (top - bottom));
        DVec3::new(x, y * (1.0 - shrink / half_width), middle + (z - middle) * (1.0 - shrink / half_height))
    }
}

fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// Closes a ring: floor, sides and roof blended over the face (Coons 1967).
fn cap(ring: &[DVec3], layout: &Layout) -> Surface {
    let (columns, rows) = (2 * layout.half_columns, layout.lower.len() + layout.upper.len() - 2);
    let at = |k: usize| ring[k % ring.len()];
    // The ring starts in the middle of the floor; the face's corners are the sills and rails.
    let half = layout.half_columns;
    let floor = |i: usize| at(ring.len() + i - half);
    let left = |j: usize| at(half + j);
    let roof = |i: usize| at(half + rows + (columns - i));
    let right = |j: usize| at(ring.len() - half - j);
    // By lengths along the outline, not by counts: rows are dense at the waist, and a grid by counts would
    // fold there.
    let across = shares(&(0..=columns).map(|i| 0.5 * (floor(i) + roof(i))).collect::<Vec<_>>());
    let up = shares(&(0..=rows).map(left).collect::<Vec<_>>());
    let point = |i: usize, j: usize| {
        let (u, v) = (across[i], up[j]);
        let ruled = right(j).lerp(left(j), u) + floor(i).lerp(roof(i), v);
        ruled - right(0).lerp(left(0), u).lerp(right(rows).lerp(left(rows), u), v)
    };
    let grid: Vec<Vec<DVec3>> = (0..=rows).map(|j| (0..=columns).map(|i| point(i, j)).collect()).collect();
    Surface::from_rows(&grid, Material::Paint).flipped()
}

/// Share of the polyline's length at each of its points, from 0 to 1.
fn shares(polyline: &[DVec3]) -> Vec<f64> {
    let steps = polyline.windows(2).map(|pair| pair[0].distance(pair[1]));
    let lengths: Vec<f64> = [0.0]
        .into_iter()
        .chain(steps)
        .scan(0.0, |sum, step| {
            *sum += step;
            Some(*sum)
        })
        .collect();
    let whole = lengths[lengths.len() - 1];
    lengths.into_iter().map(|length| length / whole).collect()
}
