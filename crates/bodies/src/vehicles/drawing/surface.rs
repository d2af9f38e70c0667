//! Triangles of one part during drawing: shared points, a material per triangle.

use glam::DVec3;
use std::collections::BTreeMap;

/// Material of a facet; the names are in the meshes' material lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Material {
    Paint,
    Glass,
    Rubber,
    Steel,
    Aluminium,
    Chrome,
    Plastic,
    Lamp,
    TailLamp,
    Plate,
    Fabric,
    Leather,
}

impl Material {
    /// Every material.
    pub(crate) const ALL: [Self; 12] = [
        Self::Paint,
        Self::Glass,
        Self::Rubber,
        Self::Steel,
        Self::Aluminium,
        Self::Chrome,
        Self::Plastic,
        Self::Lamp,
        Self::TailLamp,
        Self::Plate,
        Self::Fabric,
        Self::Leather,
    ];

    /// Name as written to files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Paint => "paint",
            Self::Glass => "glass",
            Self::Rubber => "rubber",
            Self::Steel => "steel",
            Self::Aluminium => "aluminium",
            Self::Chrome => "chrome",
            Self::Plastic => "plastic",
            Self::Lamp => "lamp",
            Self::TailLamp => "tail_lamp",
            Self::Plate => "plate",
            Self::Fabric => "fabric",
            Self::Leather => "leather",
        }
    }
}

/// A triangle, counter-clockwise seen from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Triangle {
    pub(crate) corners: [u32; 3],
    pub(crate) material: Material,
}

/// One part of a vehicle.
#[derive(Debug, Clone, Default)]
pub(crate) struct Surface {
    pub(crate) points_m: Vec<DVec3>,
    pub(crate) triangles: Vec<Triangle>,
}

impl Surface {
    /// Rows of points joined by quadrilaterals, each split along its shorter diagonal. Rows have equal
    /// lengths; coincident points (a closed row's seam, a pole) become one point.
    pub(crate) fn from_rows(rows: &[Vec<DVec3>], material: Material) -> Self {
        let mut surface = Self::default();
        for pair in rows.windows(2) {
            for ((a, d), (b, c)) in pair[0].iter().zip(&pair[1]).zip(pair[0].iter().zip(&pair[1]).skip(1)) {
                surface.push_quad([*a, *b, *c, *d], material);
            }
        }
        surface.welded()
    }

    /// Adds a quadrilateral given counter-clockwise.
    pub(crate) fn push_quad(&mut self, [a, b, c, d]: [DVec3; 4], material: Material) {
        let first = self.points_m.len() as u32;
        self.points_m.extend([a, b, c, d]);
        let halves = if a.distance_squared(c) <= b.distance_squared(d) {
            [[0, 1, 2], [0, 2, 3]]
        } else {
            [[0, 1, 3], [1, 2, 3]]
        };
        for half in halves {
            self.triangles.push(Triangle { corners: half.map(|i| first + i), material });
        }
    }

    /// Adds everything of `other`.
    pub(crate) fn append(&mut self, other: Self) {
        let first = self.points_m.len() as u32;
        self.points_m.extend(other.points_m);
        let shifted = |t: Triangle| Triangle { corners: t.corners.map(|i| first + i), ..t };
        self.triangles.extend(other.triangles.into_iter().map(shifted));
    }

    /// Merges points of equal position (to 1 µm), and drops triangles without area.
    pub(crate) fn welded(self) -> Self {
        let mut points_m: Vec<DVec3> = Vec::new();
        let mut seen = BTreeMap::new();
        let index: Vec<u32> = self
            .points_m
            .iter()
            .map(|p| {
                *seen.entry(lattice(*p)).or_insert_with(|| {
                    points_m.push(*p);
                    points_m.len() as u32 - 1
                })
            })
            .collect();
        let renamed = |t: &Triangle| Triangle { corners: t.corners.map(|i| index[i as usize]), ..*t };
        let whole = |t: &Triangle| {
            let [a, b, c] = t.corners;
            a != b && b != c && c != a
        };
        let triangles = self.triangles.iter().map(renamed).filter(whole).collect();
        Self { points_m, triangles }
    }

    /// Collapses edges shorter than `shortest_m` to one of their ends, each point at most once.
    pub(crate) fn without_short_edges(self, shortest_m: f64) -> Self {
        let mut end_of: Vec<u32> = (0..self.points_m.len() as u32).collect();
        let mut touched = vec![false; end_of.len()];
        for t in &self.triangles {
            let [a, b, c] = t.corners;
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (low, high) = (from.min(to) as usize, from.max(to) as usize);
                if !touched[low]
                    && !touched[high]
                    && self.points_m[low].distance(self.points_m[high]) < shortest_m
                {
                    end_of[high] = low as u32;
                    (touched[low], touched[high]) = (true, true);
                }
            }
        }
        let points_m = end_of.iter().map(|i| self.points_m[*i as usize]).collect();
        Self { points_m, triangles: self.triangles }.welded()
    }

    /// Moves every point by `to`, which must preserve the handedness.
    pub(crate) fn map(mut self, to: impl Fn(DVec3) -> DVec3) -> Self {
        for p in &mut self.points_m {
            *p = to(*p);
        }
        self
    }

    /// Shifts the part.
    pub(crate) fn moved(self, x: f64, y: f64, z: f64) -> Self {
        self.map(|p| p + DVec3::new(x, y, z))
    }

    /// Mirrors the part to the other side: y → −y.
    pub(crate) fn mirrored(self) -> Self {
        self.map(|p| DVec3::new(p.x, -p.y, p.z)).flipped()
    }

    /// Turns the part inside out.
    pub(crate) fn flipped(mut self) -> Self {
        for t in &mut self.triangles {
            t.corners.swap(1, 2);
        }
        self
    }

    /// Winds a closed part outwards, by its signed volume.
    pub(crate) fn outward(self) -> Self {
        let six_volumes: f64 = self.triangles.iter().map(|t| self.corner_triple(t)).sum();
        if six_volumes < 0.0 { self.flipped() } else { self }
    }

    fn corner_triple(&self, t: &Triangle) -> f64 {
        let [a, b, c] = self.corners_m(t);
        // Relative to a corner of the part, so that the sum keeps its precision far from the origin.
        let o = self.points_m[0];
        (a - o).dot((b - o).cross(c - o))
    }

    /// Positions of a triangle's corners.
    pub(crate) fn corners_m(&self, t: &Triangle) -> [DVec3; 3] {
        t.corners.map(|i| self.points_m[i as usize])
    }

    /// Vector area of a triangle, twice its area times the normal.
    pub(crate) fn area_vector_m2(&self, t: &Triangle) -> DVec3 {
        let [a, b, c] = self.corners_m(t);
        (b - a).cross(c - a)
    }

    /// Unit normal at every point, weighted by area.
    pub(crate) fn point_normals(&self) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; self.points_m.len()];
        for t in &self.triangles {
            let area = self.area_vector_m2(t);
            for i in t.corners {
                sums[i as usize] += area;
            }
        }
        sums.into_iter().map(|n| n.try_normalize().unwrap_or(DVec3::ZERO)).collect()
    }
}

fn lattice(p: DVec3) -> [i64; 3] {
    (p * 1e6).round().to_array().map(|v| v as i64)
}
