//! Flat patches of a mesh: coplanar neighbours are one facet of the body, and the diagonals between them are
//! no edges; and the curvature of patches that are strips of a tessellated curve.

use crate::mesh::curve_bend::{may_be_a_step, may_be_of_one_curve};
use crate::mesh::mesh_edges::{MeshEdges, TriangleSide, sides_of};
use glam::DVec3;

/// Patches of a mesh: their triangles, and the edges inside them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Patches {
    /// Patch of each triangle, named after its largest one.
    patch_of: Vec<u32>,
    /// Bit i of each triangle: the patch continues beyond the edge from corner i to the next.
    inside: Vec<u8>,
    /// Curvature of each triangle's patch, 1/m.
    curvature_per_m: Vec<f64>,
}

/// Sine of the maximum angle between neighbours of a flat patch: over the Fresnel zone of 0.22 m (25 m, 77
/// GHz) a surface bent by less deviates from a plane by at most λ/16. Rounding of single-precision files is a
/// hundredth of it on triangles of a centimetre, 5 m from the origin.
const FLAT_SINE: f64 = 1e-3;

impl Patches {
    /// Flood-fills every patch from its largest triangle over edges whose two ends are the same points.
    ///
    /// Flatness is measured against that triangle, so that a finely tessellated cylinder does not become one
    /// patch, and patches of a slightly bent skin do not depend on the order of its triangles.
    pub(crate) fn of(triangles_m: &[[DVec3; 3]], edges: &MeshEdges) -> Self {
        let normals: Vec<DVec3> = triangles_m.iter().map(unit_normal).collect();
        let is_flat = |seed: u32, other: u32| {
            let [seed, other] = [seed, other].map(|triangle| normals[triangle as usize]);
            seed != DVec3::ZERO && other != DVec3::ZERO && seed.cross(other).length() <= FLAT_SINE
        };
        let patch_of = edges.connected_components(largest_first(triangles_m), is_flat);
        let mut patches = Self { patch_of, inside: vec![0; triangles_m.len()], curvature_per_m: Vec::new() };
        patches.mark_inside(triangles_m, edges, &normals);
        patches.curvature_per_m = curvatures(triangles_m, edges, &normals, &patches.patch_of);
        patches
    }

    /// Largest triangle of a triangle's patch.
    pub(crate) fn of_triangle(&self, triangle: u32) -> u32 {
        self.patch_of[triangle as usize]
    }

    /// Whether the patch continues beyond the edge from corner `edge` to the next.
    pub(crate) fn is_inside(&self, triangle: u32, edge: usize) -> bool {
        self.inside[triangle as usize] & (1 << edge) != 0
    }

    /// Curvature of the surface of which the triangle's patch is a facet, 1/m; 0 if the patch is flat itself.
    pub(crate) fn curvature_per_m(&self, triangle: u32) -> f64 {
        self.curvature_per_m[triangle as usize]
    }

    /// Marks an edge as inside if a triangle of the same patch lies on its other side; a twin of the triangle
    /// does not count.
    fn mark_inside(&mut self, triangles_m: &[[DVec3; 3]], edges: &MeshEdges, normals: &[DVec3]) {
        for side in (0..triangles_m.len() as u32).flat_map(sides_of) {
            let patch = self.patch_of[side.triangle as usize];
            let left_m3 = |triangle: u32| left_of_m3(triangles_m, side, normals[patch as usize], triangle);
            let own_m3 = left_m3(side.triangle);
            let goes_on =
                |other: u32| self.patch_of[other as usize] == patch && own_m3 * left_m3(other) < 0.0;
            if edges.neighbours(side).any(goes_on) {
                self.inside[side.triangle as usize] |= 1 << side.side;
            }
        }
    }
}

/// Triangles, largest first; areas equal to rounding are ordered by index.
fn largest_first(triangles_m: &[[DVec3; 3]]) -> impl Iterator<Item = u32> {
    let area_m2 = |&[a, b, c]: &[DVec3; 3]| (0.5 * (b - a).cross(c - a).length()) as f32;
    let areas_m2: Vec<f32> = triangles_m.iter().map(area_m2).collect();
    let mut order: Vec<u32> = (0..triangles_m.len() as u32).collect();
    order.sort_by(|&a, &b| areas_m2[b as usize].total_cmp(&areas_m2[a as usize]));
    order.into_iter()
}

/// Distance of another triangle's centre to the left of a side, seen along `normal`, times three lengths of
/// the side.
fn left_of_m3(triangles_m: &[[DVec3; 3]], side: TriangleSide, normal: DVec3, other: u32) -> f64 {
    let [from, to] = ends_m(triangles_m, side);
    let [a, b, c] = triangles_m[other as usize];
    (to - from).cross((a - from) + (b - from) + (c - from)).dot(normal)
}

fn ends_m(triangles_m: &[[DVec3; 3]], TriangleSide { triangle, side }: TriangleSide) -> [DVec3; 2] {
    let corners = triangles_m[triangle as usize];
    [corners[usize::from(side)], corners[(usize::from(side) + 1) % 3]]
}

/// Bend at the border of two patches.
#[derive(Clone, Copy)]
struct PatchSeam {
    patch: u32,
    neighbour: u32,
    /// Angle between the planes, positive if the neighbour rises towards the patch's normal.
    turn_rad: f64,
    curvature_per_m: f64,
}

/// Curvature of every triangle's patch: the largest of its bends that continues, in the same sense and by a
/// similar amount, at another neighbour; a bend at one side only is an edge of the body.
fn curvatures(
    triangles_m: &[[DVec3; 3]],
    edges: &MeshEdges,
    normals: &[DVec3],
    patch_of: &[u32],
) -> Vec<f64> {
    let bends = bends(triangles_m, edges, normals, patch_of);
    let mut of_patch = vec![0.0_f64; triangles_m.len()];
    for group in bends.chunk_by(|a, b| a.patch == b.patch) {
        let goes_on = |bend: &&PatchSeam| {
            let is_next = |next: &PatchSeam| {
                next.neighbour != bend.neighbour && may_be_of_one_curve(bend.turn_rad, next.turn_rad)
            };
            group.iter().any(is_next)
        };
        let curved = group.iter().filter(goes_on).map(|bend| bend.curvature_per_m);
        of_patch[group[0].patch as usize] = curved.fold(0.0, f64::max);
    }
    patch_of.iter().map(|&patch| of_patch[patch as usize]).collect()
}

/// Bends of all patches that may belong to a curve, by patch.
fn bends(
    triangles_m: &[[DVec3; 3]],
    edges: &MeshEdges,
    normals: &[DVec3],
    patch_of: &[u32],
) -> Vec<PatchSeam> {
    let middles = middles(triangles_m, patch_of);
    let centre_m = |triangle: u32| triangles_m[triangle as usize].iter().sum::<DVec3>() / 3.0;
    let bend = |side: TriangleSide, other: u32| {
        let [patch, neighbour] = [side.triangle, other].map(|triangle| patch_of[triangle as usize]);
        let [from, to] = ends_m(triangles_m, side);
        let across = |x: DVec3| (x - from).reject_from(to - from);
        let [normal, other_normal] = [patch, neighbour].map(|p| normals[p as usize]);
        let turn_rad = normal.cross(other_normal).length().atan2(normal.dot(other_normal).abs());
        let apart_m = (middles[neighbour as usize] - middles[patch as usize]).reject_from(to - from).length();
        let [own, beyond] = [side.triangle, other].map(|triangle| across(centre_m(triangle)));
        let is_bent = patch != neighbour && turn_rad > 0.0 && may_be_a_step(turn_rad);
        let turn_rad = turn_rad.copysign(normal.dot(beyond));
        let bend = PatchSeam { patch, neighbour, turn_rad, curvature_per_m: turn_rad.abs() / apart_m };
        (is_bent && own.dot(beyond) < 0.0 && apart_m > 0.0).then_some(bend)
    };
    let of_side = |side: TriangleSide| edges.neighbours(side).filter_map(move |other| bend(side, other));
    let mut bends: Vec<PatchSeam> =
        (0..triangles_m.len() as u32).flat_map(sides_of).flat_map(of_side).collect();
    bends.sort_by_key(|bend| bend.patch);
    bends
}

/// Centroid of every patch, at the index of its largest triangle.
fn middles(triangles_m: &[[DVec3; 3]], patch_of: &[u32]) -> Vec<DVec3> {
    let mut sums = vec![(DVec3::ZERO, 0.0); triangles_m.len()];
    for ([a, b, c], &patch) in triangles_m.iter().zip(patch_of) {
        let area = (*b - *a).cross(*c - *a).length();
        let sum = &mut sums[patch as usize];
        *sum = (sum.0 + area * (*a + *b + *c) / 3.0, sum.1 + area);
    }
    sums.into_iter().map(|(sum, area)| if area > 0.0 { sum / area } else { DVec3::ZERO }).collect()
}

fn unit_normal([a, b, c]: &[DVec3; 3]) -> DVec3 {
    (*b - *a).cross(*c - *a).try_normalize().unwrap_or(DVec3::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::mesh_edges::exact_places;

    fn patches_of(triangles_m: &[[DVec3; 3]]) -> Patches {
        Patches::of(triangles_m, &MeshEdges::of(&exact_places(triangles_m)))
    }

    /// A square of two triangles in z = 0, and a wall of two on one of its sides, tilted by `sine` from
    /// coplanar.
    fn bent_strip(sine: f64) -> Vec<[DVec3; 3]> {
        let [a, b, c, d] =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let [e, f] = [b, c].map(|p| p + DVec3::new((1.0 - sine * sine).sqrt(), 0.0, sine));
        vec![[a, b, c], [a, c, d], [b, e, f], [b, f, c]]
    }

    #[test]
    fn a_square_is_one_patch_whose_diagonal_is_no_edge() {
        let patches = patches_of(&bent_strip(0.5));
        assert_eq!([0, 1, 2, 3].map(|t| patches.of_triangle(t)), [0, 0, 2, 2]);
        let inside = |triangle| [0, 1, 2].map(|edge| patches.is_inside(triangle, edge));
        assert_eq!([0, 1].map(inside), [[false, false, true], [true, false, false]]);
    }

    #[test]
    fn neighbours_that_differ_by_less_than_a_milliradian_are_one_patch() {
        for (sine, patch) in [(0.5e-3, 0), (2e-3, 2)] {
            assert_eq!(patches_of(&bent_strip(sine)).of_triangle(3), patch, "{sine}");
        }
    }

    #[test]
    fn patches_of_a_skin_that_is_bent_a_little_do_not_hang_on_the_order_of_its_triangles() {
        // Strips 0.7 mrad apart, of different widths.
        let mut edge = (0.0, 0.0);
        let mut skin = Vec::new();
        for (i, width) in (0..).zip([1.0, 1.3, 0.8, 1.1, 0.7, 1.2, 0.9]) {
            let (sin, cos) = (0.7e-3 * f64::from(i)).sin_cos();
            let next = (edge.0 + width * cos, edge.1 + width * sin);
            let [a, d] = [0.0, 1.0].map(|y| DVec3::new(edge.0, y, edge.1));
            let [b, c] = [0.0, 1.0].map(|y| DVec3::new(next.0, y, next.1));
            skin.extend([[a, b, c], [a, c, d]]);
            edge = next;
        }
        let strips = |triangles_m: &[[DVec3; 3]]| {
            let patches = patches_of(triangles_m);
            let strip = |t: usize| skin.iter().position(|other| *other == triangles_m[t]).unwrap() / 2;
            let mut of_strip = [0; 7];
            for t in 0..triangles_m.len() {
                of_strip[strip(t)] = strip(patches.of_triangle(t as u32) as usize);
            }
            of_strip
        };
        let backwards: Vec<_> = skin.iter().rev().copied().collect();
        assert_eq!(strips(&skin), strips(&backwards));
        assert_eq!(strips(&skin), [1, 1, 1, 3, 5, 5, 5]);
    }

    #[test]
    fn a_fine_cylinder_is_not_one_patch() {
        let step = 0.9e-3_f64;
        let point = |i: u32, z: f64| DVec3::new((step * f64::from(i)).cos(), (step * f64::from(i)).sin(), z);
        let strip = |i| {
            [
                [point(i, 0.0), point(i + 1, 0.0), point(i + 1, 1.0)],
                [point(i, 0.0), point(i + 1, 1.0), point(i, 1.0)],
            ]
        };
        let patches = patches_of(&(0..10).flat_map(strip).collect::<Vec<_>>());
        assert_eq!(patches.of_triangle(19), 16, "every second strip starts a patch");
    }

    #[test]
    fn the_curvature_of_a_cylinder_is_that_of_its_radius_and_panels_about_one_bend_have_none() {
        let (radius_m, step) = (0.5, 0.1_f64);
        let point = |i: u32, z: f64| {
            let (sin, cos) = (step * f64::from(i)).sin_cos();
            DVec3::new(radius_m * cos, radius_m * sin, z)
        };
        let strip = |i| {
            let [a, b, c, d] = [point(i, 0.0), point(i + 1, 0.0), point(i + 1, 1.0), point(i, 1.0)];
            [[a, b, c], [a, c, d]]
        };
        let patches = patches_of(&(0..10).flat_map(strip).collect::<Vec<_>>());
        for triangle in [8, 9] {
            let radius = 1.0 / patches.curvature_per_m(triangle);
            assert!((radius / radius_m - 1.0).abs() < 1e-2, "{radius}");
        }
        let panels = patches_of(&bent_strip(0.2));
        assert_eq!([0, 1, 2, 3].map(|triangle| panels.curvature_per_m(triangle)), [0.0; 4]);
    }

    #[test]
    fn a_corrugated_sheet_is_no_curve() {
        let at = |i: u32, y: f64| DVec3::new(f64::from(i), y, if i.is_multiple_of(2) { 0.1 } else { 0.0 });
        let strip = |i| {
            let [a, b, c, d] = [at(i, 0.0), at(i + 1, 0.0), at(i + 1, 1.0), at(i, 1.0)];
            [[a, b, c], [a, c, d]]
        };
        let patches = patches_of(&(0..6).flat_map(strip).collect::<Vec<_>>());
        assert_eq!([4, 5, 6, 7].map(|triangle| patches.curvature_per_m(triangle)), [0.0; 4]);
    }

    #[test]
    fn a_triangle_without_a_plane_joins_no_patches() {
        let mut triangles = bent_strip(0.5);
        let [_, b, c] = triangles[0];
        triangles.insert(0, [b, c, b]);
        let patches = patches_of(&triangles);
        assert_eq!([0, 1, 2, 3, 4].map(|t| patches.of_triangle(t)), [0, 1, 1, 3, 3]);
    }

    #[test]
    fn doubled_triangles_keep_their_rim() {
        let square = bent_strip(0.5)[..2].to_vec();
        let flipped = square.iter().map(|[a, b, c]| [*a, *c, *b]);
        let both: Vec<_> = square.iter().copied().chain(flipped).collect();
        let patches = patches_of(&both);
        assert!(!patches.is_inside(0, 0) && !patches.is_inside(0, 1) && patches.is_inside(0, 2));
        assert!(!patches.is_inside(2, 1) && !patches.is_inside(2, 2) && patches.is_inside(2, 0));
    }
}
