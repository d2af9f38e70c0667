//! Joints: polygons lit by a beam from either end, and the trees of these beams.

use crate::beams::beam::BeamTree;
use crate::beams::image_tree::RoadTree;
use crate::geometry::border::BorderLine;
use crate::joins::outline::Outline;
use crate::joins::shadow_sides::ShadowSide;
use crate::joins::specular_separation::SpecularSeparation;
use glam::DVec3;
use std::ops::Range;

/// Beams of both ends.
#[derive(Clone, Copy)]
pub(crate) enum Trees<'a> {
    /// Transmitter and receiver at one place.
    Shared(&'a BeamTree),
    /// Transmitter and receiver at different places.
    Apart(&'a BeamTree, &'a BeamTree),
    /// Transmitter and receiver at one place above a road: waves arrive at the receiver via the road as well.
    ByRoad(&'a BeamTree, &'a RoadTree),
}

impl<'a> Trees<'a> {
    pub(crate) fn transmit(self) -> &'a BeamTree {
        match self {
            Self::Shared(tree) | Self::Apart(tree, _) | Self::ByRoad(tree, _) => tree,
        }
    }

    pub(crate) fn receive(self) -> &'a BeamTree {
        match self {
            Self::Shared(tree) | Self::Apart(_, tree) => tree,
            Self::ByRoad(_, received) => &received.tree,
        }
    }

    /// Memory of the beams of both ends, bytes.
    pub(crate) fn bytes(self) -> usize {
        match self {
            Self::Shared(tree) => tree.bytes(),
            Self::Apart(transmit, receive) => transmit.bytes() + receive.bytes(),
            Self::ByRoad(tree, received) => tree.bytes() + received.bytes(),
        }
    }

    /// The receiver's beam as one of the transmitter's: the reverse of a joint (f, b) is the joint (twin of
    /// b, f), in the road's mirror if b came via the road. Meaningless if the ends are apart.
    pub(crate) fn twin(self, backward: u32) -> u32 {
        match self {
            Self::Shared(_) | Self::Apart(..) => backward,
            Self::ByRoad(_, received) => received.twins[backward as usize],
        }
    }
}

/// Whether a joint also represents its reverse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reverse {
    /// The joint also counts for the transposed amplitude of the reverse path.
    Included,
    /// The joint counts only for itself.
    Apart,
}

impl Reverse {
    /// Number of paths that the joint counts for.
    pub(crate) fn ways(self) -> u32 {
        match self {
            Self::Included => 2,
            Self::Apart => 1,
        }
    }
}

/// A polygon lit by a forward and by a backward beam.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Joint {
    /// Index of the transmitter's beam.
    pub(crate) forward: u32,
    /// Index of the receiver's beam.
    pub(crate) backward: u32,
    pub(crate) weight: f64,
    pub(crate) reverse: Reverse,
    /// Separation of its sequence from the specular.
    pub(crate) separation: SpecularSeparation,
    corners: Range<usize>,
}

/// All joints of one order.
#[derive(Debug, Clone, Default)]
pub(crate) struct Joints {
    pub(crate) list: Vec<Joint>,
    corners_m: Vec<DVec3>,
    /// Outlines of all joints, if the rule weights nodes by them.
    pub(crate) outlines: Vec<Outline>,
    /// Sides of the joints' polygons along lines that cut out shadows, if `outlines` are present.
    pub(crate) shadow_sides: Vec<SideOfJoint>,
    /// Area of overlaps dropped for their size, both directions: its sum, m², and the sum of its squares, m⁴.
    pub(crate) dropped_sections: [f64; 2],
}

/// A side of a joint's polygon along a line that cuts out a shadow.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SideOfJoint {
    /// Index of the joint.
    pub(crate) joint: u32,
    /// Corner at which the side starts; it ends at the next.
    pub(crate) corner: u32,
    pub(crate) border: BorderLine,
}

impl Joint {
    /// Weight of its polygon at a wavenumber.
    pub(crate) fn weight_at(&self, wavenumber_per_m: f64) -> f64 {
        self.weight * self.separation.of_polygons(wavenumber_per_m)
    }
}

impl Joints {
    /// Polygon of a joint: convex, counter-clockwise about the forward beam's lit normal, world metres.
    pub(crate) fn polygon(&self, joint: &Joint) -> &[DVec3] {
        &self.corners_m[joint.corners.clone()]
    }

    /// A side of a joint, in the world.
    pub(crate) fn side(&self, side: &SideOfJoint) -> ShadowSide {
        let corners_m = self.polygon(&self.list[side.joint as usize]);
        let corner = side.corner as usize;
        let ends_m = [corners_m[corner], corners_m[(corner + 1) % corners_m.len()]];
        ShadowSide { border: side.border, ends_m }
    }

    /// Removes joints of zero weight.
    pub(crate) fn drop_weightless(&mut self) {
        self.retain(|joint| joint.weight > 0.0);
    }

    /// Only the joints that are kept.
    pub(crate) fn filtered(&self, mut is_kept: impl FnMut(&Joint) -> bool) -> Self {
        let mut some = Self::default();
        for joint in self.list.iter().filter(|joint| is_kept(joint)) {
            let pair = (joint.forward, joint.backward);
            some.push(pair, joint.weight, joint.reverse, self.polygon(joint).iter().copied());
            if let Some(copy) = some.list.last_mut() {
                copy.separation = joint.separation;
            }
        }
        some
    }

    /// Removes all joints that are not kept.
    pub(crate) fn retain(&mut self, is_kept: impl FnMut(&Joint) -> bool) {
        self.list.retain(is_kept);
    }

    pub(crate) fn append(&mut self, other: Self) {
        let (shift, joints) = (self.corners_m.len(), self.list.len() as u32);
        let of_all = |side: SideOfJoint| SideOfJoint { joint: side.joint + joints, ..side };
        self.shadow_sides.extend(other.shadow_sides.into_iter().map(of_all));
        let moved =
            |joint: Joint| Joint { corners: joint.corners.start + shift..joint.corners.end + shift, ..joint };
        self.list.extend(other.list.into_iter().map(moved));
        self.corners_m.extend(other.corners_m);
        self.outlines.extend(other.outlines);
        (0..2).for_each(|i| self.dropped_sections[i] += other.dropped_sections[i]);
    }

    pub(crate) fn push(
        &mut self,
        pair: (u32, u32),
        weight: f64,
        reverse: Reverse,
        corners_m: impl IntoIterator<Item = DVec3>,
    ) {
        let start = self.corners_m.len();
        self.corners_m.extend(corners_m);
        let corners = start..self.corners_m.len();
        let (forward, backward) = pair;
        self.list.push(Joint {
            forward,
            backward,
            weight,
            reverse,
            separation: SpecularSeparation::NONE,
            corners,
        });
    }
}
