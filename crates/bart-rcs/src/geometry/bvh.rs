//! Bounding volume hierarchy of one mesh (obvhs, single precision, four boxes side by side) and the traversal
//! that finds triangles within a beam.
//!
//! The hierarchy only proposes candidates: boxes are rounded outwards from double precision and planes are
//! moved back by the possible loss of single precision, and every decision is repeated in double precision on
//! the facets themselves.

use crate::geometry::plane::Plane;
use crate::geometry::sweep::{BeamSweep, SlabTest};
use glam::{DVec3, Vec3A, Vec4};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, builder::build_bvh2};
use std::ops::ControlFlow;
use std::time::Duration;

/// Hierarchy over the triangles of a mesh, body frame.
pub(crate) struct Hierarchy {
    /// Nodes, the root first; empty if there are no triangles.
    nodes: Vec<BvhNode>,
    /// Centre of all boxes: single-precision coordinates are relative to it, so that a distant body loses
    /// none.
    middle_m: DVec3,
    /// Extent |x| + |y| + |z| of the farthest corner from the centre, m.
    reach_m: f64,
}

/// Up to four boxes, coordinate by coordinate, so that one instruction tests all.
#[derive(Clone, Copy)]
struct BvhNode {
    /// Low x, y, z, high x, y, z.
    bounds: [Vec4; 6],
    /// Child in each box: a node, a triangle, or nothing.
    children: [Child; 4],
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Child {
    None,
    Node(u32),
    Triangle(u32),
}

/// A plane prepared for the traversal: for each axis the bound that lies farthest along the normal.
struct Test {
    bounds: [usize; 3],
    normal: [Vec4; 3],
    offset: Vec4,
}

/// Buffers of a traversal.
#[derive(Default)]
pub(crate) struct Stack {
    tests: Vec<Test>,
    open: Vec<Child>,
}

impl Hierarchy {
    /// Hierarchy over these triangles (body metres, finite).
    pub(crate) fn over(triangles: impl Iterator<Item = [DVec3; 3]> + Clone) -> Self {
        let start = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let [low, high] = triangles.clone().flatten().fold(start, |[low, high], c| [low.min(c), high.max(c)]);
        let middle_m = if low.is_finite() { 0.5 * low + 0.5 * high } else { DVec3::ZERO };
        let boxes: Vec<Aabb> = triangles.map(|corners| box_around(&corners.map(|c| c - middle_m))).collect();
        let mut unused = Duration::ZERO;
        // One box per triangle: no facet whose own box is outside is then tested.
        let params = BvhBuildParams { max_prims_per_leaf: 1, ..BvhBuildParams::fast_build() };
        let nodes =
            if boxes.is_empty() { Vec::new() } else { wide(&build_bvh2(&boxes, params, &mut unused)) };
        let reach_m = if low.is_finite() { (high - middle_m).element_sum() } else { 0.0 };
        Self { nodes, middle_m, reach_m }
    }

    /// Calls `visit` with every triangle whose box reaches the positive side of each of the `planes` and the
    /// `sweep` (body frame), roughly in order from the far end of `nearer` on, until it breaks.
    pub(crate) fn inside(
        &self,
        planes: &[Plane],
        sweep: Option<&BeamSweep>,
        nearer: DVec3,
        stack: &mut Stack,
        mut visit: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let Stack { tests, open } = stack;
        let slabs = sweep.map(|sweep| sweep.slabs(self.middle_m, self.reach_m));
        tests.clear();
        tests.extend(planes.iter().map(|plane| self.test(plane)));
        open.clear();
        open.extend((!self.nodes.is_empty()).then_some(Child::Node(0)));
        let nearer = nearer.as_vec3().to_array().map(Vec4::splat);
        while let Some(child) = open.pop() {
            match child {
                Child::None => {}
                Child::Triangle(triangle) => visit(triangle)?,
                Child::Node(index) => self.nodes[index as usize].open(tests, slabs.as_ref(), &nearer, open),
            }
        }
        ControlFlow::Continue(())
    }

    /// Approximate memory, bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.nodes.len() * size_of::<BvhNode>()
    }

    /// The plane relative to the centre, moved back by single-precision rounding: of the normal, three
    /// products, three sums and the offset, each at most ½ε of the sum of magnitudes; 8ε covers them all.
    fn test(&self, plane: &Plane) -> Test {
        let offset_m = plane.offset_m - plane.normal.dot(self.middle_m);
        let slack_m = 8.0 * f64::from(f32::EPSILON) * (self.reach_m + offset_m.abs());
        let normal = plane.normal.as_vec3().to_array();
        Test {
            bounds: [0, 1, 2].map(|axis| if normal[axis] < 0.0 { axis } else { axis + 3 }),
            normal: normal.map(Vec4::splat),
            offset: Vec4::splat((offset_m - slack_m) as f32),
        }
    }
}

impl BvhNode {
    /// Appends the children that reach the positive side of every plane and the sweep, nearest last.
    #[inline]
    fn open(&self, tests: &[Test], slabs: Option<&SlabTest>, nearer: &[Vec4; 3], open: &mut Vec<Child>) {
        let mut outside = slabs.map_or(0, |slabs| slabs.missed(&self.bounds));
        if outside == 0b1111 {
            return;
        }
        for Test { bounds, normal, offset } in tests {
            let [x, y, z] = bounds.map(|bound| self.bounds[bound]);
            // Overflow gives NaN, which does not count as outside.
            outside |= (x * normal[0] + y * normal[1] + z * normal[2]).cmplt(*offset).bitmask();
            if outside == 0b1111 {
                return;
            }
        }
        let [x, y, z] = [0, 1, 2].map(|axis| self.bounds[axis] + self.bounds[axis + 3]);
        let heights = (x * nearer[0] + y * nearer[1] + z * nearer[2]).to_array();
        let first = open.len();
        let mut sorted = [0.0; 4];
        for (lane, (&child, height)) in self.children.iter().zip(heights).enumerate() {
            if outside >> lane & 1 == 1 || child == Child::None {
                continue;
            }
            let mut at = open.len() - first;
            open.push(child);
            while at > 0 && sorted[at - 1] > height {
                open.swap(first + at, first + at - 1);
                sorted[at] = sorted[at - 1];
                at -= 1;
            }
            sorted[at] = height;
        }
    }
}

/// Merges two levels of a binary hierarchy into one: the largest boxes of a node are opened until there are
/// four.
fn wide(binary: &Bvh2) -> Vec<BvhNode> {
    let mut nodes = vec![BvhNode::of(binary, 0)];
    let mut done = 0;
    while done < nodes.len() {
        for lane in 0..4 {
            if let Child::Node(index) = nodes[done].children[lane] {
                nodes[done].children[lane] = Child::Node(nodes.len() as u32);
                nodes.push(BvhNode::of(binary, index as usize));
            }
        }
        done += 1;
    }
    nodes
}

impl BvhNode {
    /// Node from one of a binary hierarchy; children that are nodes still have their binary indices.
    fn of(binary: &Bvh2, index: usize) -> Self {
        let is_leaf = |i: usize| binary.nodes[i].is_leaf();
        let area = |i: usize| binary.nodes[i].aabb().half_area();
        let mut members = vec![index];
        while let Some(at) = (0..members.len())
            .filter(|&i| !is_leaf(members[i]) && members.len() < 4)
            .max_by(|&a, &b| area(members[a]).total_cmp(&area(members[b])))
        {
            let first = binary.nodes[members[at]].first_index as usize;
            members[at] = first;
            members.push(first + 1);
        }
        let mut bounds = [[0.0; 4]; 6];
        let mut children = [Child::None; 4];
        for (lane, &member) in members.iter().enumerate() {
            let (low, high) =
                (binary.nodes[member].aabb().min.to_array(), binary.nodes[member].aabb().max.to_array());
            (0..3).for_each(|axis| (bounds[axis][lane], bounds[axis + 3][lane]) = (low[axis], high[axis]));
            let first = binary.nodes[member].first_index;
            children[lane] = if is_leaf(member) {
                Child::Triangle(binary.primitive_indices[first as usize])
            } else {
                Child::Node(member as u32)
            };
        }
        Self { bounds: bounds.map(Vec4::from_array), children }
    }
}

/// Smallest box of single-precision coordinates that contains the corners.
fn box_around(corners_m: &[DVec3; 3]) -> Aabb {
    let [a, b, c] = *corners_m;
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let down = |x: f64| if f64::from(x as f32) > x { (x as f32).next_down() } else { x as f32 };
    let up = |x: f64| if f64::from(x as f32) < x { (x as f32).next_up() } else { x as f32 };
    Aabb::new(
        Vec3A::new(down(low.x), down(low.y), down(low.z)),
        Vec3A::new(up(high.x), up(high.y), up(high.z)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_hold_their_corners_in_double_precision() {
        let corners =
            [DVec3::new(0.1, -0.2, 1e-30), DVec3::new(0.3, 1.0 / 3.0, -7.7), DVec3::splat(2.0_f64.sqrt())];
        let aabb = box_around(&corners);
        for corner in corners {
            assert!(aabb.min.as_dvec3().cmple(corner).all() && aabb.max.as_dvec3().cmpge(corner).all());
        }
    }

    #[test]
    fn the_walk_leaves_out_no_triangle_that_reaches_the_planes() {
        let triangle = |i: i32| {
            let at = DVec3::new(f64::from(i % 10), f64::from(i / 10), f64::from(i % 7)) * 0.37;
            [at, at + DVec3::X * 0.2, at + DVec3::Y * 0.3]
        };
        let hierarchy = Hierarchy::over((0..100).map(triangle));
        let planes = [
            Plane { normal: DVec3::new(0.6, 0.8, 0.0), offset_m: 1.5 },
            Plane { normal: -DVec3::Z, offset_m: -1.4 },
        ];
        let (mut stack, mut found) = (Stack::default(), Vec::new());
        let _ = hierarchy.inside(&planes, None, DVec3::X, &mut stack, |triangle| {
            found.push(triangle);
            ControlFlow::Continue(())
        });
        assert!(found.len() < 100, "the walk prunes");
        for i in 0..100 {
            let reaches = planes.iter().all(|p| triangle(i).iter().any(|&c| p.distance_m(c) >= 0.0));
            assert!(!reaches || found.contains(&(i as u32)), "triangle {i}");
        }
    }
}
