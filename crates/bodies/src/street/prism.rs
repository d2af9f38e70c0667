//! Prisms over outlines, the components of all street furniture.

use artifact::scene::{Mesh, MeshStatistics};

/// A point of an outline, metres.
pub(crate) type Point = [f64; 2];

/// Prisms beside each other, each closed.
#[derive(Default)]
pub(crate) struct Prisms {
    mesh: Mesh,
}

impl Prisms {
    /// Adds a prism whose outline is in (x, y), counter-clockwise seen from above, between two heights.
    pub(crate) fn upright(&mut self, outline: &[Point], heights_m: [f64; 2], material: &str) {
        self.add(outline, heights_m, material, |[x, y], z| [x, y, z]);
    }

    /// Adds a prism whose outline is in (y, z), counter-clockwise seen from ahead, between two places on
    /// the x axis.
    pub(crate) fn along(&mut self, outline: &[Point], ends_m: [f64; 2], material: &str) {
        self.add(outline, ends_m, material, |[y, z], x| [x, y, z]);
    }

    /// Adds a prism; `place` maps the outline's axes and the prism's to a right-handed triad. The ends are
    /// cut into strips between points number k from the start and k from the end: valid for convex outlines,
    /// and for sheets whose sides face each other in this way.
    fn add(
        &mut self,
        outline: &[Point],
        ends_m: [f64; 2],
        material: &str,
        place: impl Fn(Point, f64) -> [f64; 3],
    ) {
        let (first, n) = (self.mesh.vertices_m.len() as u32, outline.len() as u32);
        for end_m in ends_m {
            self.mesh.vertices_m.extend(outline.iter().map(|point| place(*point, end_m)));
        }
        let slot = self.slot(material);
        let (near, far) = (|i: u32| first + i % n, |i: u32| first + n + i % n);
        for i in 0..n {
            self.push([near(i), near(i + 1), far(i + 1)], slot);
            self.push([near(i), far(i + 1), far(i)], slot);
        }
        for i in 0..n / 2 - 1 {
            let [a, b, c, d] = [i, i + 1, n - 2 - i, n - 1 - i];
            self.push([far(a), far(b), far(c)], slot);
            self.push([far(a), far(c), far(d)], slot);
            self.push([near(a), near(c), near(b)], slot);
            self.push([near(a), near(d), near(c)], slot);
        }
    }

    fn push(&mut self, triangle: [u32; 3], slot: u16) {
        self.mesh.triangles.push(triangle);
        self.mesh.material_of_triangle.push(slot);
    }

    fn slot(&mut self, material: &str) -> u16 {
        let materials = &mut self.mesh.materials;
        let known = materials.iter().position(|known| known == material);
        let slot = known.unwrap_or_else(|| {
            materials.push(material.to_owned());
            materials.len() - 1
        });
        slot as u16
    }

    /// All prisms as one mesh, without normals: its faces are flat.
    pub(crate) fn into_mesh(self, name: &str) -> Mesh {
        let triangles_read = self.mesh.triangles.len() as u64;
        let statistics = MeshStatistics { triangles_read, ..MeshStatistics::default() };
        Mesh { name: name.to_owned(), statistics, ..self.mesh }
    }
}
