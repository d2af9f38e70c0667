//! Subdivision of triangles of the curved skin until they are close enough to it.
//!
//! An edge is halved depending only on itself, never on its triangle: both its triangles halve it, and no
//! crack opens.

use crate::surface::bend::ControlHeights;
use crate::surface::curved_edge::{Curve, CurvedEdge};
use glam::DVec3;

/// A triangle whose sides are curves of the skin.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BentTriangle {
    /// Corners in the triangle's winding.
    pub(crate) corners_m: [DVec3; 3],
    /// Unit normals of the skin at the corners.
    pub(crate) normals: [DVec3; 3],
    /// Side k runs from corner k to the next.
    pub(crate) sides: [BentSide; 3],
}

/// An edge as traversed by a triangle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BentSide {
    pub(crate) edge: CurvedEdge,
    pub(crate) walk: EdgeDirection,
}

/// Whether a triangle traverses an edge from its first end to its second.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EdgeDirection {
    Forth,
    Back,
}

/// Limits on the bend of sides; beyond them sides are halved.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BendLimits {
    /// Maximum sagitta of a flat facet in place of the skin, m.
    pub(crate) sagitta_m: f64,
    /// Maximum turn between the ends of a side, rad.
    pub(crate) turn_rad: f64,
    /// Maximum offset of a curved facet from the skin, and of a facet's outline in its own plane, m.
    pub(crate) offset_m: f64,
}

/// Maximum number of halvings: sides in 32 parts turn by a degree if the whole turned by 35°, and no triangle
/// becomes more than 1024.
const HALVINGS_MAX: u8 = 5;

/// Parts whose sides bend no more than the limits allow, with the original winding.
pub(crate) fn refined(whole: BentTriangle, limits: &BendLimits) -> Vec<BentTriangle> {
    let mut good = Vec::new();
    let mut left = vec![whole];
    while let Some(bent) = left.pop() {
        let split = bent.sides.map(|side| is_split(&side.edge, limits));
        if split == [false; 3] {
            good.push(bent);
        } else {
            bent.cut(split, &mut left);
        }
    }
    good
}

/// Number of triangles produced by [`refined`].
pub(crate) fn count(whole: &BentTriangle, limits: &BendLimits) -> usize {
    let mut left = vec![*whole];
    let mut good = 0;
    while let Some(bent) = left.pop() {
        match bent.sides.map(|side| is_split(&side.edge, limits)) {
            [false, false, false] => good += 1,
            split => bent.cut(split, &mut left),
        }
    }
    good
}

fn is_split(edge: &CurvedEdge, limits: &BendLimits) -> bool {
    edge.halvings < HALVINGS_MAX && halvings(edge, limits) > 0.0
}

/// Number of halvings of an edge: each reduces sagittas to a quarter, turns to a half, and the error of a
/// cubic over the facet to a sixteenth.
fn halvings(edge: &CurvedEdge, limits: &BendLimits) -> f64 {
    let (sagitta_m, turn) = (edge.sagitta_m(), edge.turn_rad());
    let offset_m = match edge.curve {
        Curve::Straight => return 0.0,
        Curve::OnSkin(_) => edge.cubic_error_m(),
        Curve::Crease(_) => sagitta_m * sagitta_m / limits.offset_m,
    };
    let by_sagitta = 0.5 * (sagitta_m / limits.sagitta_m).log2();
    let by_turn = (turn / limits.turn_rad).log2();
    let by_offset = 0.25 * (offset_m / limits.offset_m).log2();
    by_sagitta.max(by_turn).max(by_offset).ceil().clamp(0.0, f64::from(HALVINGS_MAX))
}

impl BentSide {
    fn straight(from: BentCorner, to: BentCorner, halvings: u8) -> Self {
        Self {
            edge: CurvedEdge { ends_m: [from.at_m, to.at_m], curve: Curve::Straight, halvings },
            walk: EdgeDirection::Forth,
        }
    }

    /// A side of a skin from `from` to `to`.
    fn within(from: BentCorner, to: BentCorner, halvings: u8) -> Self {
        let curve = Curve::OnSkin([from.normal, to.normal]);
        Self {
            edge: CurvedEdge { ends_m: [from.at_m, to.at_m], curve, halvings },
            walk: EdgeDirection::Forth,
        }
    }

    fn reversed(self) -> Self {
        let walk = if self.walk == EdgeDirection::Forth { EdgeDirection::Back } else { EdgeDirection::Forth };
        Self { walk, ..self }
    }

    /// Both halves in the order of traversal.
    fn halves(&self) -> [Self; 2] {
        let [first, second] = self.edge.halves().map(|edge| Self { edge, walk: self.walk });
        if self.walk == EdgeDirection::Forth { [first, second] } else { [second, first] }
    }
}

/// A vertex of a bent triangle.
#[derive(Debug, Clone, Copy)]
struct BentCorner {
    at_m: DVec3,
    normal: DVec3,
}

impl BentTriangle {
    /// Control heights of the skin over the flat triangle, from the slopes of its sides at their ends.
    pub(crate) fn control_heights_m(&self) -> ControlHeights {
        let [a, b, c] = self.corners_m;
        let normal = (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::ZERO);
        let mut heights = [0.0; 6];
        for (pair, side) in heights.chunks_exact_mut(2).zip(&self.sides) {
            let [first, second] = side.edge.control_heights_m(normal);
            pair.copy_from_slice(&if side.walk == EdgeDirection::Forth {
                [first, second]
            } else {
                [second, first]
            });
        }
        heights
    }

    fn corner(&self, k: usize) -> BentCorner {
        BentCorner { at_m: self.corners_m[k % 3], normal: self.normals[k % 3] }
    }

    /// Corner at which side `k` is halved, with this triangle's own normal there.
    fn middle(&self, k: usize, half: &BentSide) -> BentCorner {
        let end = if half.walk == EdgeDirection::Forth { 1 } else { 0 };
        let normal = self.sides[k].edge.normal_at_middle([self.normals[k], self.normals[(k + 1) % 3]]);
        BentCorner { at_m: half.edge.ends_m[end], normal }
    }

    fn of(corners: [BentCorner; 3], sides: [BentSide; 3]) -> Self {
        Self { corners_m: corners.map(|c| c.at_m), normals: corners.map(|c| c.normal), sides }
    }

    /// Triangle with its corners rotated so that corner `k` comes first.
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

    /// Halves side 0.
    fn cut_in_two(&self, into: &mut Vec<Self>) {
        let [first, second] = self.sides[0].halves();
        let m = self.middle(0, &first);
        let [a, b, c] = [0, 1, 2].map(|k| self.corner(k));
        let halvings = first.edge.halvings;
        let inner =
            if self.is_fan() { BentSide::straight(m, c, halvings) } else { BentSide::within(m, c, halvings) };
        into.push(Self::of([a, m, c], [first, inner, self.sides[2]]));
        into.push(Self::of([m, b, c], [second, self.sides[1], inner.reversed()]));
    }

    /// Whether sides 1 and 2 are rulings of a cone that meet at its apex, which has no meaningful normal, so
    /// that any line between them is a ruling too. They rise from their chords by less than a quarter of that
    /// of side 0.
    fn is_fan(&self) -> bool {
        let [base, left, right] = self.sides.each_ref().map(|side| side.edge.sagitta_m());
        left.max(right) < 0.25 * base
    }

    /// Halves sides 0 and 1: corner 1 is cut off, and the remainder is split along its shorter diagonal.
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
        // Inner side k is opposite corner k: from the midpoint of side k − 1 to that of side k.
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
