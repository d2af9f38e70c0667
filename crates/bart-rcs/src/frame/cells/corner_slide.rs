//! Corners of a lit polygon that slide over its body: outlines of shadows and of what mirrors light.
//!
//! An outline moves as the antenna, the body that casts it and the one that it falls on move relative to each
//! other, and so does the phase of the terms of its corners: at 77 GHz an outline that slides by 4 mm along
//! the wave changes it by two turns. The apparent points of these terms move with the outline instead of the
//! body, and lie where elements of the array see their phases change as they do.

use crate::bodies::motion::Motion;
use artifact::paths::ArraySide;
use glam::{DQuat, DVec3};
use std::collections::BTreeMap;

/// Apparent points from the transmitter and from the receiver, with their motions.
pub(crate) type ApparentPoints = [(DVec3, Motion); 2];

/// Motion of a corner beyond that of its body's point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CornerSlide {
    /// Motion of the apparent points from the transmitter and from the receiver.
    pub(crate) motion: [Motion; 2],
    /// Change of the path length for each metre that either end moves along the array's row, on each side.
    pub(crate) by_row: [[f64; 2]; 2],
}

/// Pairs of elements by the end that is farther along the row. A polygon is lit from both ends; where a
/// shadow bounds it, that is the shadow of one end, on the other side of the row that of the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum RowSide {
    TransmitterFarther,
    ReceiverFarther,
}

/// Place on the border of a polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BorderPlace {
    /// Corners of the polygon at both ends of a stretch; `None` for an end that is none of its corners.
    pub(crate) corners: [Option<usize>; 2],
    /// Share of the stretch from its first end.
    pub(crate) share: f64,
}

/// Slides of the corners of one order's joints, by the joint's index.
pub(crate) type JointSlides = BTreeMap<usize, Vec<CornerSlide>>;

/// Slides of the outlines of a table, by order as its meetings are.
#[derive(Debug, Default)]
pub(crate) struct OutlineSlides {
    pub(crate) by_order: Vec<JointSlides>,
    /// Unit vector along the array's row.
    pub(crate) row: DVec3,
    /// Positions of the transmitter and the receiver.
    pub(crate) ends_m: [DVec3; 2],
}

/// Slides of one order of a table.
#[derive(Clone, Copy)]
pub(crate) struct SlidesOfOrder<'a> {
    all: &'a OutlineSlides,
    of_joints: &'a JointSlides,
}

impl CornerSlide {
    pub(crate) const NONE: Self = Self { motion: [Motion::REST; 2], by_row: [[0.0; 2]; 2] };

    /// Slide of a place on the border: between two corners points slide in proportion, and places that are no
    /// corners of the polygon are cuts at rest on the body.
    pub(crate) fn at(corners: &[Self], place: &BorderPlace) -> Self {
        let [first, last] =
            place.corners.map(|corner| corner.and_then(|i| corners.get(i)).copied().unwrap_or(Self::NONE));
        let weights = [1.0 - place.share, place.share];
        let motion = [0, 1].map(|end| {
            Motion::weighed([(weights[0], first.motion[end]), (weights[1], last.motion[end])].into_iter())
        });
        let between = |a: f64, b: f64| weights[0] * a + weights[1] * b;
        let by_row = RowSide::BOTH.map(|side| {
            let [first, last] = [first, last].map(|corner| corner.by_row[side as usize]);
            [0, 1].map(|end| between(first[end], last[end]))
        });
        Self { motion, by_row }
    }

    fn is_same_on_both_sides(&self) -> bool {
        const ROUNDING: f64 = 1e-5;
        let [one, other] = self.by_row;
        (0..2).all(|end| (one[end] - other[end]).abs() < ROUNDING)
    }
}

/// Slides of the corners of one joint.
#[derive(Clone, Copy)]
pub(crate) struct SlidesOfJoint<'a> {
    all: &'a OutlineSlides,
    corners: &'a [CornerSlide],
}

impl<'a> SlidesOfOrder<'a> {
    pub(crate) fn of_joint(self, joint: usize) -> Option<SlidesOfJoint<'a>> {
        let corners = self.of_joints.get(&joint)?;
        Some(SlidesOfJoint { all: self.all, corners })
    }
}

impl SlidesOfJoint<'_> {
    /// The apparent points of a term on the border of the polygon as they slide: for all pairs of elements,
    /// or for each side of the row where these differ.
    pub(crate) fn sliding(
        self,
        points: &ApparentPoints,
        place: &BorderPlace,
    ) -> Vec<(Option<RowSide>, ApparentPoints)> {
        let slide = CornerSlide::at(self.corners, place);
        if slide.is_same_on_both_sides() {
            return vec![(None, self.all.slid(points, &slide, RowSide::TransmitterFarther))];
        }
        RowSide::BOTH.map(|side| (Some(side), self.all.slid(points, &slide, side))).into()
    }
}

impl RowSide {
    pub(crate) const BOTH: [Self; 2] = [Self::TransmitterFarther, Self::ReceiverFarther];

    pub(crate) fn other(self) -> Self {
        match self {
            Self::TransmitterFarther => Self::ReceiverFarther,
            Self::ReceiverFarther => Self::TransmitterFarther,
        }
    }

    /// The pairs of a row along an axis as a path record holds them.
    pub(crate) fn of_row(self, axis: DVec3) -> ArraySide {
        let [transmit, receive] = match self {
            Self::TransmitterFarther => [axis, -axis],
            Self::ReceiverFarther => [-axis, axis],
        };
        ArraySide { transmit: transmit.to_array(), receive: receive.to_array(), from_m: 0.0 }
    }
}

impl OutlineSlides {
    pub(crate) fn of_order(&self, index: usize) -> SlidesOfOrder<'_> {
        SlidesOfOrder { all: self, of_joints: &self.by_order[index] }
    }

    fn slid(&self, points: &ApparentPoints, slide: &CornerSlide, side: RowSide) -> ApparentPoints {
        let by_row = slide.by_row[side as usize];
        [0, 1].map(|end| {
            let (at_m, body) = points[end];
            let motion = Motion::weighed([(1.0, body), (1.0, slide.motion[end])].into_iter());
            self.turned(self.ends_m[end], (at_m, motion), by_row[end])
        })
    }

    /// An apparent point as far away, turned about its end so that the length changes by `by_row` more for
    /// each metre along the row; the same where no direction does that.
    fn turned(&self, end_m: DVec3, (at_m, motion): (DVec3, Motion), by_row: f64) -> (DVec3, Motion) {
        let from_end_m = at_m - end_m;
        let range_m = from_end_m.length();
        let along_m = from_end_m.dot(self.row);
        let turned_m = along_m - by_row * range_m;
        let across_m = from_end_m - along_m * self.row;
        let rest_m = (range_m * range_m - turned_m * turned_m).max(0.0).sqrt();
        if by_row == 0.0 || rest_m == 0.0 || across_m == DVec3::ZERO {
            return (at_m, motion);
        }
        let to_m = turned_m * self.row + rest_m * across_m.normalize_or_zero();
        let turn = DQuat::from_rotation_arc(from_end_m / range_m, to_m / range_m);
        let turned = Motion {
            velocity_mps: turn * motion.velocity_mps,
            acceleration_mps2: turn * motion.acceleration_mps2,
        };
        (end_m + to_m, turned)
    }
}
