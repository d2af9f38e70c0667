//! Bodies that tests look at, and an independent referee of what is seen of them.
#![allow(dead_code, reason = "every test file takes what it needs")]

use artifact::scene::Mesh;
use artifact::settings::Sides;
use bart_rcs::{Antenna, BartError, BeamTree, TraceSettings, World};
use glam::{DMat3, DVec2, DVec3};

pub(crate) mod carts;
pub(crate) mod referee;
pub(crate) mod scenes;
pub(crate) mod sums;

/// Tracer that each test runs over: both of them.
pub(crate) type Tracer = fn(&World, Antenna, &TraceSettings) -> Result<BeamTree, BartError>;
pub(crate) const TRACERS: [(&str, Tracer); 2] =
    [("beam tree", BeamTree::trace), ("every facet against every other", BeamTree::trace_by_brute_force)];

/// Everything is kept.
pub(crate) fn settings(max_order: u8) -> TraceSettings {
    TraceSettings { max_order, sides: Sides::Two, least_area_m2: 0.0, least_mirror_area_m2: 0.0 }
}

/// Triangles by their corners.
#[derive(Clone, Default)]
pub(crate) struct Triangles(pub(crate) Vec<[DVec3; 3]>);

impl Triangles {
    pub(crate) fn mesh(&self) -> Mesh {
        let vertices_m = self.0.iter().flatten().map(|v| v.to_array()).collect();
        let triangles = (0..self.0.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        Mesh { name: "test".into(), vertices_m, triangles, ..Mesh::default() }
    }

    pub(crate) fn world(&self) -> World {
        World::of_mesh(&self.mesh()).expect("finite vertices, indices in range")
    }

    pub(crate) fn and(mut self, other: Self) -> Self {
        self.0.extend(other.0);
        self
    }

    pub(crate) fn map(&self, f: impl Fn(DVec3) -> DVec3) -> Self {
        Self(self.0.iter().map(|t| t.map(&f)).collect())
    }

    pub(crate) fn shifted(&self, by: DVec3) -> Self {
        self.map(|v| v + by)
    }

    pub(crate) fn flipped(&self) -> Self {
        Self(self.0.iter().map(|&[a, b, c]| [a, c, b]).collect())
    }

    /// Every triangle in four, `times` times.
    pub(crate) fn refined(&self, times: u32) -> Self {
        (0..times).fold(self.clone(), |t, _| Self(t.0.iter().flat_map(|t| quartered(*t)).collect()))
    }
}

fn quartered([a, b, c]: [DVec3; 3]) -> [[DVec3; 3]; 4] {
    // Midpoints are symmetric in their ends, so that neighbours agree bit by bit.
    let (ab, bc, ca) = (0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a));
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

/// A polygon fanned into triangles.
fn fan(points: &[DVec3]) -> Vec<[DVec3; 3]> {
    (1..points.len() - 1).map(|i| [points[0], points[i], points[i + 1]]).collect()
}

/// A closed box, seen from outside counter-clockwise.
pub(crate) fn cuboid(low: DVec3, high: DVec3) -> Triangles {
    extruded(
        &[
            DVec2::new(low.x, low.z),
            DVec2::new(high.x, low.z),
            DVec2::new(high.x, high.z),
            DVec2::new(low.x, high.z),
        ],
        low.y,
        high.y,
    )
}

/// A closed prism: a convex or star-shaped (about its first corner) outline in x–z, counter-clockwise seen
/// from −y.
pub(crate) fn extruded(outline: &[DVec2], y_low: f64, y_high: f64) -> Triangles {
    let at = |y: f64| move |p: &DVec2| DVec3::new(p.x, y, p.y);
    let near: Vec<DVec3> = outline.iter().map(at(y_low)).collect();
    let far: Vec<DVec3> = outline.iter().map(at(y_high)).collect();
    let mut triangles = fan(&near);
    triangles.extend(fan(&far).into_iter().map(|[a, b, c]| [a, c, b]));
    for i in 0..near.len() {
        let j = (i + 1) % near.len();
        triangles.extend([[near[i], far[j], near[j]], [near[i], far[i], far[j]]]);
    }
    Triangles(triangles)
}

/// A sphere of 20·4ⁿ facets.
pub(crate) fn sphere(radius_m: f64, refinements: u32) -> Triangles {
    let g = 0.5 * (1.0 + 5.0_f64.sqrt());
    let v: Vec<DVec3> = [(0.0, 1.0), (0.0, -1.0)]
        .iter()
        .flat_map(|&(_, s)| {
            [1.0, -1.0]
                .map(|t| [DVec3::new(0.0, s, t * g), DVec3::new(s, t * g, 0.0), DVec3::new(t * g, 0.0, s)])
        })
        .flatten()
        .collect();
    let edge = 2.0;
    let near = |a: DVec3, b: DVec3| (a.distance(b) - edge).abs() < 1e-9;
    let mut faces = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if near(v[i], v[j]) && near(v[j], v[k]) && near(v[k], v[i]) {
                    let outwards = (v[j] - v[i]).cross(v[k] - v[i]).dot(v[i]) > 0.0;
                    faces.push(if outwards { [v[i], v[j], v[k]] } else { [v[i], v[k], v[j]] });
                }
            }
        }
    }
    assert_eq!(faces.len(), 20);
    Triangles(faces).refined(refinements).map(|p| p.normalize_or_zero() * radius_m)
}

/// A closed cylinder along y.
fn wheel(centre: DVec3, radius_m: f64, width_m: f64, sides: u32) -> Triangles {
    let corner =
        |i: u32| DVec2::from_angle(f64::from(i) / f64::from(sides) * std::f64::consts::TAU) * radius_m;
    let outline: Vec<DVec2> = (0..sides).map(corner).collect();
    extruded(&outline, -0.5 * width_m, 0.5 * width_m).shifted(centre)
}

/// A car of closed parts that touch, coincide in places and pass through each other: 4.6 × 1.8 × 1.5 m on z =
/// 0.
pub(crate) fn car(wheel_sides: u32) -> Triangles {
    let p = DVec2::new;
    let hull = [
        p(0.0, 0.55),
        p(-2.3, 0.5),
        p(-2.25, 0.25),
        p(2.2, 0.25),
        p(2.3, 0.55),
        p(2.1, 0.75),
        p(1.0, 0.9),
        p(-1.8, 0.95),
        p(-2.25, 0.9),
    ];
    let cabin = [p(0.0, 1.0), p(-1.7, 0.9), p(1.1, 0.85), p(0.4, 1.45), p(-0.9, 1.5)];
    let mut car = extruded(&hull, -0.9, 0.9).and(extruded(&cabin, -0.75, 0.75));
    for (x, y) in [(1.4, -0.85), (1.4, 0.85), (-1.4, -0.85), (-1.4, 0.85)] {
        car = car.and(wheel(DVec3::new(x, y, 0.32), 0.32, 0.22, wheel_sides));
    }
    for y in [-1.0, 1.0] {
        car = car.and(cuboid(DVec3::new(0.6, y - 0.1, 0.95), DVec3::new(0.75, y + 0.1, 1.1)));
    }
    // A plate that stands exactly on the bonnet's side and a bumper whose face coincides with the hull's.
    car.and(cuboid(DVec3::new(-2.4, -0.7, 0.3), DVec3::new(-2.1, 0.7, 0.45)))
        .and(cuboid(DVec3::new(1.2, -0.9, 0.3), DVec3::new(1.6, -0.6, 0.5)))
}

/// A rotation that no axis survives.
pub(crate) fn tumbled() -> DMat3 {
    DMat3::from_rotation_z(0.7) * DMat3::from_rotation_x(-0.4) * DMat3::from_rotation_y(1.1)
}

/// Directions that are symmetric to nothing, and some along the axes.
pub(crate) fn directions() -> Vec<DVec3> {
    let at = |azimuth: f64, elevation: f64| {
        let (sa, ca) = azimuth.to_radians().sin_cos();
        let (se, ce) = elevation.to_radians().sin_cos();
        DVec3::new(ca * ce, sa * ce, se)
    };
    vec![
        at(0.0, 0.0),
        at(90.0, 0.0),
        at(17.0, 11.0),
        at(133.0, 8.6),
        at(-71.0, 35.0),
        at(45.0, -20.0),
        at(0.0, 90.0),
    ]
}

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): enough to strew test geometry.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// A number in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A point in the cube [−1, 1)³.
    pub(crate) fn point(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }

    /// A number below `n`.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n - 1)
    }
}
