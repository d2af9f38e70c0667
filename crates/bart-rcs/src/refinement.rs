//! Triangles of the curved skin cut until they lie close enough to it.
//!
//! An edge is halved by what it is itself, never by what its triangle is: both its triangles halve it, and no crack opens.

use crate::curved_edge::{Curve, CurvedEdge};
use glam::DVec3;

/// A triangle whose sides are curves of the skin.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BentTriangle {
    /// In the triangle's winding.
    pub(crate) corners_m: [DVec3; 3],
    /// Unit normals of the skin at the corners.
    pub(crate) normals: [DVec3; 3],
    /// Side k runs from corner k to the next.
    pub(crate) sides: [BentSide; 3],
}

/// An edge as a triangle walks along it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BentSide {
    pub(crate) edge: CurvedEdge,
    pub(crate) walk: Walk,
}

/// Whether a triangle walks from an edge's first end to its second.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Walk {
    Forth,
    Back,
}

/// 2⁻¹⁰ of an edge: by then its sagitta is a millionth.
const HALVINGS_MAX: u8 = 10;

/// Triangles whose sides are nowhere further than `sagitta_m` from the skin's curves, in its winding.
pub(crate) fn refined(whole: BentTriangle, sagitta_m: f64) -> Vec<BentTriangle> {
    let mut good = Vec::new();
    let mut left = vec![whole];
    while let Some(bent) = left.pop() {
        let split = bent.sides.map(|side| is_split(&side.edge, sagitta_m));
        if split == [false; 3] {
            good.push(bent);
        } else {
            bent.cut(split, &mut left);
        }
    }
    good
}

/// About how many triangles [`refined`] makes: sagittas fall to a quarter with each halving.
pub(crate) fn expected(bent: &BentTriangle, sagitta_m: f64) -> f64 {
    let steps = |side: &BentSide| {
        let halvings = (side.edge.sagitta_m() / sagitta_m).log2().max(0.0) / 2.0;
        halvings.ceil().min(f64::from(HALVINGS_MAX)).exp2()
    };
    let mut steps = bent.sides.each_ref().map(steps);
    steps.sort_by(f64::total_cmp);
    // One curved side makes a fan, two make strips, three a grid.
    let [least, middle, most] = steps;
    most * middle.min(2.0 * least).max(1.0)
}

fn is_split(edge: &CurvedEdge, sagitta_m: f64) -> bool {
    edge.halvings < HALVINGS_MAX && edge.sagitta_m() > sagitta_m
}

impl BentSide {
    fn straight(from: Corner, to: Corner, halvings: u8) -> Self {
        Self { edge: CurvedEdge { ends_m: [from.at_m, to.at_m], curve: Curve::Straight, halvings }, walk: Walk::Forth }
    }

    /// A side of a skin from `from` to `to`.
    fn within(from: Corner, to: Corner, halvings: u8) -> Self {
        let curve = Curve::OnSkin([from.normal, to.normal]);
        Self { edge: CurvedEdge { ends_m: [from.at_m, to.at_m], curve, halvings }, walk: Walk::Forth }
    }

    fn reversed(self) -> Self {
        let walk = if self.walk == Walk::Forth { Walk::Back } else { Walk::Forth };
        Self { walk, ..self }
    }

    /// In the order of the walk.
    fn halves(&self) -> [Self; 2] {
        let [first, second] = self.edge.halves().map(|edge| Self { edge, walk: self.walk });
        if self.walk == Walk::Forth { [first, second] } else { [second, first] }
    }
}

/// A vertex of a bent triangle.
#[derive(Debug, Clone, Copy)]
struct Corner {
    at_m: DVec3,
    normal: DVec3,
}

impl BentTriangle {
    fn corner(&self, k: usize) -> Corner {
        Corner { at_m: self.corners_m[k % 3], normal: self.normals[k % 3] }
    }

    /// Where side `k` is halved, with this triangle's own normal there.
    fn middle(&self, k: usize, half: &BentSide) -> Corner {
        let end = if half.walk == Walk::Forth { 1 } else { 0 };
        let normal = self.sides[k].edge.normal_at_middle([self.normals[k], self.normals[(k + 1) % 3]]);
        Corner { at_m: half.edge.ends_m[end], normal }
    }

    fn of(corners: [Corner; 3], sides: [BentSide; 3]) -> Self {
        Self { corners_m: corners.map(|c| c.at_m), normals: corners.map(|c| c.normal), sides }
    }

    /// Turned so that corner `k` comes first.
    fn turned_to(&self, k: usize) -> Self {
        let turned = [0, 1, 2].map(|i| (k + i) % 3);
        Self {
            corners_m: turned.map(|i| self.corners_m[i]),
            normals: turned.map(|i| self.normals[i]),
            sides: turned.map(|i| self.sides[i]),
        }
    }

    fn cut(&self, split: [bool; 3], into: &mut Vec<Self>) {
        match split {
            [true, true, true] => self.cut_in_four(into),
            [true, false, false] => self.cut_in_two(into),
            [false, true, false] => self.turned_to(1).cut_in_two(into),
            [false, false, true] => self.turned_to(2).cut_in_two(into),
            [true, true, false] => self.cut_in_three(into),
            [false, true, true] => self.turned_to(1).cut_in_three(into),
            [true, false, true] => self.turned_to(2).cut_in_three(into),
            [false, false, false] => into.push(*self),
        }
    }

    /// Side 0 is halved. The other two are as good as straight, and so is what runs between them: a fan of a cone, whose
    /// apex has no normal that could tell.
    fn cut_in_two(&self, into: &mut Vec<Self>) {
        let [first, second] = self.sides[0].halves();
        let m = self.middle(0, &first);
        let [a, b, c] = [0, 1, 2].map(|k| self.corner(k));
        let inner = BentSide::straight(m, c, first.edge.halvings);
        into.push(Self::of([a, m, c], [first, inner, self.sides[2]]));
        into.push(Self::of([m, b, c], [second, self.sides[1], inner.reversed()]));
    }

    /// Sides 0 and 1 are halved: corner 1 is cut off, and what is left by its shorter diagonal.
    fn cut_in_three(&self, into: &mut Vec<Self>) {
        let ([from_a, to_b], [from_b, to_c]) = (self.sides[0].halves(), self.sides[1].halves());
        let (m, n) = (self.middle(0, &from_a), self.middle(1, &from_b));
        let [a, b, c] = [0, 1, 2].map(|k| self.corner(k));
        let halvings = from_a.edge.halvings.max(from_b.edge.halvings);
        let inner = BentSide::within(m, n, halvings);
        into.push(Self::of([m, b, n], [to_b, from_b, inner.reversed()]));
        if m.at_m.distance_squared(c.at_m) < n.at_m.distance_squared(a.at_m) {
            let diagonal = BentSide::within(m, c, halvings);
            into.push(Self::of([m, n, c], [inner, to_c, diagonal.reversed()]));
            into.push(Self::of([a, m, c], [from_a, diagonal, self.sides[2]]));
        } else {
            let diagonal = BentSide::within(n, a, halvings);
            into.push(Self::of([m, n, a], [inner, diagonal, from_a]));
            into.push(Self::of([a, n, c], [diagonal.reversed(), to_c, self.sides[2]]));
        }
    }

    fn cut_in_four(&self, into: &mut Vec<Self>) {
        let halves = self.sides.map(|side| side.halves());
        let middles = [0, 1, 2].map(|k| self.middle(k, &halves[k][0]));
        let halvings = halves.iter().map(|h| h[0].edge.halvings).fold(0, u8::max);
        // Inner side k is opposite to corner k: from the middle of side k − 1 to that of side k.
        let inner = [0, 1, 2].map(|k| BentSide::within(middles[(k + 2) % 3], middles[k], halvings));
        for k in 0..3 {
            let before = (k + 2) % 3;
            into.push(Self::of(
                [self.corner(k), middles[k], middles[before]],
                [halves[k][0], inner[k].reversed(), halves[before][1]],
            ));
        }
        into.push(Self::of([middles[2], middles[0], middles[1]], [inner[0], inner[1], inner[2]]));
    }
}
