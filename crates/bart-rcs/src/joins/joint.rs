//! Joints: polygons that a beam of either end lights, and the trees that these beams are of.

use crate::beams::beam::BeamTree;
use crate::beams::image_tree::Received;
use crate::geometry::border::BorderLine;
use crate::joins::outline::Outline;
use crate::joins::parting::Parting;
use crate::joins::shadow_sides::ShadowSide;
use glam::DVec3;
use std::ops::Range;

/// The beams of both ends.
#[derive(Clone, Copy)]
pub(crate) enum Trees<'a> {
    /// Transmitter and receiver at one place.
    Shared(&'a BeamTree),
    /// Transmitter, receiver.
    Apart(&'a BeamTree, &'a BeamTree),
    /// Transmitter and receiver at one place, and the road: what arrives at the receiver also comes over
    /// it.
    ByRoad(&'a BeamTree, &'a Received),
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

    /// Bytes of the beams of both ends.
    pub(crate) fn bytes(self) -> usize {
        match self {
            Self::Shared(tree) => tree.bytes(),
            Self::Apart(transmit, receive) => transmit.bytes() + receive.bytes(),
            Self::ByRoad(tree, received) => tree.bytes() + received.bytes(),
        }
    }

    /// The receiver's beam as one of the transmitter's: the way back of a joint (f, b) is the joint (twin of
    /// b, f), in the road's mirror where b came over the road. Where the ends are apart there is no such
    /// thing.
    pub(crate) fn twin(self, backward: u32) -> u32 {
        match self {
            Self::Shared(_) | Self::Apart(..) => backward,
            Self::ByRoad(_, received) => received.twins[backward as usize],
        }
    }
}

/// Whether a joint stands for its reverse as well.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reverse {
    /// The joint counts for the transposed amplitude of the way back too.
    Included,
    /// The joint counts for itself only.
    Apart,
}

impl Reverse {
    /// Number of ways that the joint counts for.
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
    /// How far its sequence is from the specular.
    pub(crate) parting: Parting,
    corners: Range<usize>,
}

/// All joints of one order.
#[derive(Debug, Clone, Default)]
pub(crate) struct Joints {
    pub(crate) list: Vec<Joint>,
    corners_m: Vec<DVec3>,
    /// Outlines of all joints, where the rule weighs nodes by them.
    pub(crate) outlines: Vec<Outline>,
    /// Sides of the joints' polygons along lines that cut out shadows, where `outlines` are.
    pub(crate) shadow_sides: Vec<SideOfJoint>,
    /// Area of overlaps that were given up for their size, both ways: its sum, m², and the sum of its
    /// squares, m⁴.
    pub(crate) given_up: [f64; 2],
}

/// A side of a joint's polygon along a line that cuts out a shadow.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SideOfJoint {
    /// Index of the joint.
    pub(crate) joint: u32,
    /// The side from this corner to the next.
    pub(crate) corner: u32,
    pub(crate) border: BorderLine,
}

impl Joint {
    /// Weight of its polygon at a wavenumber.
    pub(crate) fn weight_at(&self, wavenumber_per_m: f64) -> f64 {
        self.weight * self.parting.of_polygons(wavenumber_per_m)
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

    /// Forgets joints that count nothing.
    pub(crate) fn drop_weightless(&mut self) {
        self.retain(|joint| joint.weight > 0.0);
    }

    /// The joints alone that are kept.
    pub(crate) fn filtered(&self, mut is_kept: impl FnMut(&Joint) -> bool) -> Self {
        let mut some = Self::default();
        for joint in self.list.iter().filter(|joint| is_kept(joint)) {
            let pair = (joint.forward, joint.backward);
            some.push(pair, joint.weight, joint.reverse, self.polygon(joint).iter().copied());
            if let Some(copy) = some.list.last_mut() {
                copy.parting = joint.parting;
            }
        }
        some
    }

    /// Forgets all joints that are not kept.
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
        (0..2).for_each(|i| self.given_up[i] += other.given_up[i]);
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
        self.list.push(Joint { forward, backward, weight, reverse, parting: Parting::NONE, corners });
    }
}
