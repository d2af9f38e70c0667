//! Own-edge weights: every node of a sequence counts by how much of its outline is its own facet's edge.
//!
//! The edges that truncate a multiple reflection belong to one of its facets, and only a node there has the right phase
//! along them. So each node is weighted by the share of its lit polygon's outline that is that flat patch's own edge or an
//! occluder's shadow line on it; what other facets' beams cut does not count (docs/physics.md §2, docs/decisions/node-rule.md).
//! Weights are normalised over the nodes that exist; where none has an edge of its own, the middle nodes share equally. Where
//! planes are exact all nodes are equal, and so is every normalised weight.

use crate::border::Border;
use crate::join::{Joint, Joints, Reverse, Trees};
use crate::world::World;
use artifact::paths::MAX_ORDER;
use glam::DVec2;
use std::collections::HashMap;

/// Outline of a polygon, or of many pieces together, m.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Outline {
    /// Along the facet's own edges and shadow lines on it.
    pub(crate) own_m: f64,
    /// All of it.
    pub(crate) whole_m: f64,
}

/// A convex polygon in a plane and what ends it from each corner to the next.
pub(crate) struct Bordered<'a> {
    pub(crate) corners_m: &'a [DVec2],
    pub(crate) borders: &'a [Border],
}

impl Outline {
    /// The outline of the overlap of two polygons; seams count negatively on one side, so that pieces add up to their
    /// union.
    ///
    /// Edges nearer to each other than `tolerance_m` are one line.
    pub(crate) fn of_overlap(overlap_m: &[DVec2], polygons: [&Bordered<'_>; 2], tolerance_m: f64) -> Self {
        let mut outline = Self::default();
        for (i, &from) in overlap_m.iter().enumerate() {
            let to = overlap_m[(i + 1) % overlap_m.len()];
            let borders = polygons.into_iter().filter_map(|polygon| polygon.border_along(from, to, tolerance_m));
            let Some(border) = borders.reduce(Border::and) else { continue };
            let length_m = border.sign() * from.distance(to);
            outline.whole_m += length_m;
            outline.own_m += if border.is_own() { length_m } else { 0.0 };
        }
        outline
    }

    fn add(&mut self, other: Self) {
        self.own_m += other.own_m;
        self.whole_m += other.whole_m;
    }

    /// Between 0 and 1.
    fn own_share(self) -> f64 {
        if self.whole_m > 0.0 { (self.own_m / self.whole_m).clamp(0.0, 1.0) } else { 0.0 }
    }
}

impl Bordered<'_> {
    /// What ends the polygon along a line that may lie on one of its edges; several edges of a polygon can lie in a line.
    fn border_along(&self, from: DVec2, to: DVec2, tolerance_m: f64) -> Option<Border> {
        let n = self.corners_m.len();
        let on_edge = |&i: &usize| {
            let (corner, edge) = (self.corners_m[i], self.corners_m[(i + 1) % n] - self.corners_m[i]);
            let near = |x: DVec2| edge.perp_dot(x - corner).abs() <= tolerance_m * edge.length();
            let along = edge.dot(0.5 * (from + to) - corner);
            near(from) && near(to) && (0.0..edge.length_squared()).contains(&along)
        };
        (0..n).filter(on_edge).map(|i| self.borders[i]).reduce(Border::and)
    }
}

/// Patches of a sequence from the transmitter on; places beyond its order are `u32::MAX`.
type Sequence = [u32; MAX_ORDER];

/// The nodes of one sequence, in the order of travel; `None` where there is none.
type Nodes = [Option<Outline>; MAX_ORDER];

/// Sets the weights of all joints of one order, of which `outlines` are in the joints' order.
pub(crate) fn weigh(world: &World, trees: Trees<'_>, order: u8, joints: &mut Joints, outlines: &[Outline]) {
    let mut nodes_of: HashMap<Sequence, Nodes> = HashMap::new();
    let count = usize::from(order);
    for (joint, outline) in joints.list.iter().zip(outlines) {
        let (sequence, node) = place(world, trees, joint);
        let mut take = |sequence: Sequence, node: usize| {
            nodes_of.entry(sequence).or_default()[node].get_or_insert_default().add(*outline);
        };
        take(sequence, node);
        if joint.reverse == Reverse::Included {
            take(reversed(sequence, count), count - 1 - node);
        }
    }
    for joint in &mut joints.list {
        let (sequence, node) = place(world, trees, joint);
        joint.weight = nodes_of.get(&sequence).map_or(0.0, |nodes| weight(&nodes[..count], node));
    }
    joints.drop_weightless();
}

/// Share of one node among those that exist.
fn weight(nodes: &[Option<Outline>], node: usize) -> f64 {
    let share = |node: &Option<Outline>| node.map_or(0.0, Outline::own_share);
    let all: f64 = nodes.iter().map(share).sum();
    if all > 0.0 {
        return share(&nodes[node]) / all;
    }
    let middles = [(nodes.len() - 1) / 2, nodes.len() / 2];
    let existing = middles.into_iter().filter(|&middle| nodes[middle].is_some());
    let here = existing.clone().filter(|&middle| middle == node).count();
    here as f64 / existing.count().max(1) as f64
}

/// The patches that a joint's path meets, and which of them is its node.
fn place(world: &World, trees: Trees<'_>, joint: &Joint) -> (Sequence, usize) {
    let (transmit, receive) = (trees.transmit(), trees.receive());
    let forward = &transmit.beams[joint.forward as usize];
    let backward = &receive.beams[joint.backward as usize];
    let node = usize::from(forward.order) - 1;
    let mut sequence = [u32::MAX; MAX_ORDER];
    for (place, beam) in (0..=node).rev().zip(transmit.way_back(forward)) {
        sequence[place] = world.patch(beam.facet);
    }
    for (place, beam) in (node..MAX_ORDER).zip(receive.way_back(backward)) {
        sequence[place] = world.patch(beam.facet);
    }
    (sequence, node)
}

fn reversed(mut sequence: Sequence, count: usize) -> Sequence {
    sequence[..count].reverse();
    sequence
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::antenna::Antenna;
    use crate::beam::{BeamTree, TraceSettings};
    use artifact::scene::Mesh;
    use artifact::settings::Sides;
    use glam::DVec3;

    /// Squares of this side about (x, y) at height z, seen from above.
    fn outline_of_lowest(squares: &[(f64, [f64; 3])]) -> Outline {
        let mut mesh = Mesh::default();
        for (side, [x, y, z]) in squares {
            let first = mesh.vertices_m.len() as u32;
            let corner = |i: f64, j: f64| [x + 0.5 * side * i, y + 0.5 * side * j, *z];
            mesh.vertices_m.extend([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]);
            mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
        let world = World::of_mesh(&mesh).unwrap();
        let settings = TraceSettings { max_order: 1, sides: Sides::Two, least_area_m2: 0.0, least_mirror_area_m2: 0.0 };
        let tree = BeamTree::trace(&world, Antenna::Direction(DVec3::Z), &settings).unwrap();
        let mut all = Outline::default();
        for beam in tree.beams.iter().filter(|beam| beam.facet < 2) {
            let corners_m: Vec<DVec2> = tree.polygon(beam).iter().map(|c| c.truncate()).collect();
            let bordered = Bordered { corners_m: &corners_m, borders: tree.borders(beam) };
            all.add(Outline::of_overlap(&corners_m, [&bordered, &bordered], 1e-9));
        }
        all
    }

    #[test]
    fn a_square_has_its_rim_and_not_its_diagonal() {
        let outline = outline_of_lowest(&[(2.0, [0.0; 3])]);
        assert!((outline.own_m - 8.0).abs() < 1e-12 && (outline.whole_m - 8.0).abs() < 1e-12, "{outline:?}");
    }

    #[test]
    fn seams_between_pieces_around_a_shadow_cancel() {
        // A shadow of 0.6 in the middle, and one that bites 0.1 × 0.4 out of the rim: 8 + 2.4 + 0.2.
        let outline = outline_of_lowest(&[(2.0, [0.0; 3]), (0.6, [0.1, 0.2, 0.3]), (0.4, [-1.1, -0.4, 0.2])]);
        assert!((outline.own_m - 10.6).abs() < 1e-9, "{outline:?}");
        assert_eq!(outline.own_m, outline.whole_m);
    }

    #[test]
    fn nodes_without_an_edge_of_their_own_leave_the_middle() {
        let node = |own_m: f64| Some(Outline { own_m, whole_m: 4.0 });
        assert_eq!([0, 1, 2].map(|i| weight(&[node(0.0), node(0.0), node(0.0)], i)), [0.0, 1.0, 0.0]);
        assert_eq!([0, 1, 2, 3].map(|i| weight(&[node(0.0); 4], i)), [0.0, 0.5, 0.5, 0.0]);
        assert_eq!([0, 1].map(|i| weight(&[None, node(0.0)], i)), [0.0, 1.0]);
        assert_eq!([0, 1, 2].map(|i| weight(&[node(1.0), None, node(3.0)], i)), [0.25, 0.0, 0.75]);
    }
}
