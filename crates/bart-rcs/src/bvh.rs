//! Bounding volume hierarchy of one mesh (obvhs, single precision) and the walk that finds what reaches into a beam.
//!
//! The hierarchy only proposes: boxes are rounded outwards from double precision, and every decision is made again in
//! double precision on the facets themselves.

use crate::plane::Plane;
use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, builder::build_bvh2, node::Bvh2Node};
use std::ops::ControlFlow;
use std::time::Duration;

/// Hierarchy over the triangles of a mesh, body frame.
pub(crate) struct Hierarchy {
    tree: Bvh2,
}

impl Hierarchy {
    /// Over these triangles (body metres, finite).
    pub(crate) fn over(triangles: impl Iterator<Item = [DVec3; 3]>) -> Self {
        let boxes: Vec<Aabb> = triangles.map(|corners| box_around(&corners)).collect();
        let mut unused = Duration::ZERO;
        let tree = if boxes.is_empty() {
            Bvh2::default()
        } else {
            build_bvh2(&boxes, BvhBuildParams::fast_build(), &mut unused)
        };
        Self { tree }
    }

    /// Calls `visit` with every triangle whose leaf reaches the positive side of all `planes` (body frame), about in the
    /// order from the far end of `nearer` on, until it breaks.
    pub(crate) fn inside(
        &self,
        planes: &[Plane],
        nearer: DVec3,
        stack: &mut Vec<u32>,
        mut visit: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        stack.clear();
        stack.extend(self.tree.nodes.first().filter(|root| reaches(root, planes)).map(|_| 0));
        while let Some(index) = stack.pop() {
            let node = &self.tree.nodes[index as usize];
            let first = node.first_index as usize;
            if node.is_leaf() {
                let triangles = &self.tree.primitive_indices[first..first + node.prim_count as usize];
                triangles.iter().try_for_each(|&triangle| visit(triangle))?;
            } else {
                let children = [node.first_index, node.first_index + 1];
                let [a, b] = [0, 1].map(|i| &self.tree.nodes[first + i]);
                let is_a_nearer = nearer.dot(doubled_middle(a)) > nearer.dot(doubled_middle(b));
                let far_first = if is_a_nearer { [children[1], children[0]] } else { children };
                stack.extend(far_first.into_iter().filter(|&i| reaches(&self.tree.nodes[i as usize], planes)));
            }
        }
        ControlFlow::Continue(())
    }

    /// Bytes held, about.
    pub(crate) fn bytes(&self) -> usize {
        self.tree.nodes.len() * size_of::<Bvh2Node>() + self.tree.primitive_indices.len() * size_of::<u32>()
    }
}

/// Whether some corner of the node's box is on the positive side of every plane, one plane at a time.
fn reaches(node: &Bvh2Node, planes: &[Plane]) -> bool {
    let (low, high) = (node.aabb().min.as_dvec3(), node.aabb().max.as_dvec3());
    planes.iter().all(|plane| {
        let n = plane.normal;
        let corner = DVec3::select(n.cmpge(DVec3::ZERO), high, low);
        plane.distance_m(corner) >= 0.0
    })
}

fn doubled_middle(node: &Bvh2Node) -> DVec3 {
    (node.aabb().min + node.aabb().max).as_dvec3()
}

/// The smallest box of single-precision coordinates that holds the corners.
fn box_around(corners_m: &[DVec3; 3]) -> Aabb {
    let [a, b, c] = *corners_m;
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let down = |x: f64| if f64::from(x as f32) > x { (x as f32).next_down() } else { x as f32 };
    let up = |x: f64| if f64::from(x as f32) < x { (x as f32).next_up() } else { x as f32 };
    Aabb::new(Vec3A::new(down(low.x), down(low.y), down(low.z)), Vec3A::new(up(high.x), up(high.y), up(high.z)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_hold_their_corners_in_double_precision() {
        let corners = [DVec3::new(0.1, -0.2, 1e-30), DVec3::new(0.3, 1.0 / 3.0, -7.7), DVec3::splat(2.0_f64.sqrt())];
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
        let planes =
            [Plane { normal: DVec3::new(0.6, 0.8, 0.0), offset_m: 1.5 }, Plane { normal: -DVec3::Z, offset_m: -1.4 }];
        let (mut stack, mut found) = (Vec::new(), Vec::new());
        let _ = hierarchy.inside(&planes, DVec3::X, &mut stack, |triangle| {
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
