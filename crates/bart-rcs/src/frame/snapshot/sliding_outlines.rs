//! Slides of the outlines of large lit polygons over their bodies, from the same beams traced a moment
//! before and after, and a little to either side along the array's row.

mod shadow_lines; // which end's shadow bounds a polygon

use crate::beams::body_sequences::BodySequences;
use crate::bodies::motion::Motion;
use crate::frame::blends::axis::BlendAxis;
use crate::frame::cells::corner_slide::{CornerSlide, JointSlides, OutlineSlides};
use crate::frame::cells::critical_cells::LaidOut;
use crate::frame::cells::path_cells::{facets_of, motions};
use crate::frame::snapshot::sliding_outlines::shadow_lines::LitSides;
use crate::frame::snapshot::{BlendNode, TracedScene};
use crate::joins::joint::{Joint, Joints};
use crate::joins::scatterer::Scatterer;
use crate::run_control::error::BartError;
use crate::run_control::memory::with_joints;
use crate::run_control::progress::Phase;
use crate::table::order_joints::OrderJoints;
use artifact::paths::Facet;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// Share of the frame by which the beams before and after are apart from the moment.
const STEP_SHARE: f64 = 1.0 / 200.0;
/// Distance by which the beams to either side are apart from the position, m: to rounding of coordinates of
/// 100 m a slide is known to 1e-9.
const STEP_M: f64 = 1e-4;
/// Size of cells in which a polygon is large whose outline slides, relative to those that it is cut into: as
/// small as they may become.
const SHARE_OF_CELL: f64 = 0.25;
/// Distance within which a corner of a polygon is one of its facet's, m.
const SAME_CORNER_M: f64 = 1e-7;
/// Largest difference between the steps before and after, relative to both: with more the outline has changed
/// its corners meanwhile.
const UNEVEN: f64 = 0.2;

/// Whether some polygon is so large that cells of `size_m` are replaced by terms of its corners, and has a
/// corner that is none of its facet's.
pub(crate) fn has_sliding_corners(scatterer: &Scatterer<'_>, meetings: &[OrderJoints], size_m: f64) -> bool {
    let of = |joints: &Joints| joints.list.iter().any(|joint| may_slide(scatterer, joints, joint, size_m));
    meetings.iter().any(|meeting| of(&meeting.facets))
}

fn may_slide(scatterer: &Scatterer<'_>, joints: &Joints, joint: &Joint, size_m: f64) -> bool {
    let corners_m = joints.polygon(joint);
    let of_facet = scatterer.world.facet(scatterer.forward(joint).facet).corners_m;
    let is_own = |corner: &DVec3| of_facet.iter().any(|own| own.distance(*corner) < SAME_CORNER_M);
    !corners_m.iter().all(is_own) && LaidOut::of(scatterer, joint, corners_m).is_large(size_m)
}

/// Slides of the corners of all large polygons, for cells of `size_m`, as traced at a node;
/// `meetings_of` has the meetings of other beams on some sequences of bodies.
pub(crate) fn outline_slides(
    scenery: &TracedScene<'_>,
    (scatterer, meetings): (&Scatterer<'_>, &[OrderJoints]),
    (node, size_m): (&BlendNode<'_>, f64),
    meetings_of: &dyn Fn(&Scatterer<'_>, &BodySequences) -> Vec<OrderJoints>,
) -> Result<OutlineSlides, BartError> {
    let plan = scenery.plan;
    let sliding = SlidingJoint::all(scatterer, meetings, SHARE_OF_CELL * size_m);
    let ways = ways_of(&sliding);
    let held_bytes = with_joints(scatterer.trees.bytes()) + scatterer.world.placed_bytes() as u64;
    let beside = scenery.with_held_bytes(held_bytes);
    let corners_at = |after_s: f64, off_m: [f64; 2]| {
        let ends_m = [0, 1].map(|end| node.ends_m[end] + off_m[end] * plan.row.axis);
        let moved = BlendNode { ways: Some(&ways), seconds: node.seconds + after_s, ends_m };
        let snapshot = beside.at_node(&moved)?;
        let scatterer = snapshot.scatterer(plan, Phase::Tracing);
        Ok(SlidingJoint::nearest(&sliding, &scatterer, &meetings_of(&scatterer, &ways)))
    };
    let probes = Probes::of(scenery, (&sliding, node), &corners_at)?;
    let lit_sides = lit_sides(scatterer, meetings, &sliding);
    let mut by_order = vec![JointSlides::new(); meetings.len()];
    for (index, of) in sliding.iter().enumerate() {
        let joints = &meetings[of.order].facets;
        let slides = probes.slides(scatterer, (of, &lit_sides[&of.way]), (joints, index));
        if slides.iter().any(|slide| *slide != CornerSlide::NONE) {
            by_order[of.order].insert(of.joint, slides);
        }
    }
    Ok(OutlineSlides { by_order, row: plan.row.axis, ends_m: node.ends_m })
}

/// The sequences of bodies of sliding joints.
fn ways_of(sliding: &[SlidingJoint]) -> BodySequences {
    let mut ways = BodySequences::default();
    for of in sliding {
        ways.add(&of.way.0.iter().map(|facet| facet.body).collect::<Vec<_>>());
    }
    ways
}

/// Apparent points of a corner from both ends.
type Corner = [DVec3; 2];
/// Facets of a sequence, and the order of its forward beam.
type Way = (Vec<Facet>, u8);
/// Corners of all sliding joints after a step; `None` of a corner whose way is not there.
type AfterStep = Vec<Vec<Option<Corner>>>;
/// Function that traces the corners some seconds later, with the ends so many metres farther along the row.
type CornersAt<'a> = dyn Fn(f64, [f64; 2]) -> Result<AfterStep, BartError> + 'a;

/// A joint whose outline may slide.
struct SlidingJoint {
    order: usize,
    joint: usize,
    way: Way,
    corners: Vec<Corner>,
}

impl SlidingJoint {
    /// The joints of every way on which a large polygon may slide: what one of its pieces loses another one
    /// has.
    fn all(scatterer: &Scatterer<'_>, meetings: &[OrderJoints], size_m: f64) -> Vec<Self> {
        let mut all = vec![];
        for (order, meeting) in meetings.iter().enumerate() {
            let joints = &meeting.facets;
            let sliding = joints.list.iter().filter(|joint| may_slide(scatterer, joints, joint, size_m));
            let ways: BTreeSet<Way> = sliding.map(|joint| way(scatterer, joint)).collect();
            for (index, joint) in joints.list.iter().enumerate() {
                let way = way(scatterer, joint);
                if ways.contains(&way) {
                    all.push(Self { order, joint: index, way, corners: corners(scatterer, joints, joint) });
                }
            }
        }
        all
    }

    /// The nearest corners of the same way in other beams. A polygon may start at another corner there, or be
    /// cut in other pieces.
    fn nearest(sliding: &[Self], scatterer: &Scatterer<'_>, meetings: &[OrderJoints]) -> AfterStep {
        let mut there: BTreeMap<Way, Vec<Corner>> =
            sliding.iter().map(|of| (of.way.clone(), vec![])).collect();
        for joints in meetings.iter().map(|meeting| &meeting.facets) {
            for joint in &joints.list {
                if let Some(all) = there.get_mut(&way(scatterer, joint)) {
                    all.extend(corners(scatterer, joints, joint));
                }
            }
        }
        let away_m2 = |a: &Corner, b: &Corner| a[0].distance_squared(b[0]) + a[1].distance_squared(b[1]);
        let nearest = |own: &Corner, all: &[Corner]| {
            all.iter().min_by(|a, b| away_m2(a, own).total_cmp(&away_m2(b, own))).copied()
        };
        let of_joint = |of: &Self| of.corners.iter().map(|own| nearest(own, &there[&of.way])).collect();
        sliding.iter().map(of_joint).collect()
    }
}

/// Sides of all polygons of each way on which outlines may slide.
fn lit_sides(
    scatterer: &Scatterer<'_>,
    meetings: &[OrderJoints],
    sliding: &[SlidingJoint],
) -> BTreeMap<Way, LitSides> {
    let mut all: BTreeMap<Way, LitSides> = BTreeMap::new();
    for of in sliding {
        let joints = &meetings[of.order].facets;
        let joint = &joints.list[of.joint];
        let lit = || LitSides::about(scatterer.forward(joint).lit_normal);
        all.entry(of.way.clone()).or_insert_with(lit).add(joints.polygon(joint));
    }
    all
}

fn way(scatterer: &Scatterer<'_>, joint: &Joint) -> Way {
    (facets_of(scatterer, joint.forward, joint.backward), scatterer.forward(joint).order)
}

fn corners(scatterer: &Scatterer<'_>, joints: &Joints, joint: &Joint) -> Vec<Corner> {
    joints.polygon(joint).iter().map(|corner_m| scatterer.apparent_m(joint, *corner_m)).collect()
}

/// Corners before and after a moment, and to either side.
struct Probes {
    in_time: Option<[AfterStep; 2]>,
    /// With both ends moved along the row, where they are at one place.
    by_both: Option<[AfterStep; 2]>,
    /// With one end moved along the row, indexed by that end.
    by_ends: Option<[[AfterStep; 2]; 2]>,
    step_s: f64,
    ends_m: [DVec3; 2],
}

impl Probes {
    /// The probes of a node that its joints need: in time if anything moves, along the row if the array has
    /// one, with each end alone where the ends are apart or the way has mirrors.
    fn of(
        scenery: &TracedScene<'_>,
        (sliding, node): (&[SlidingJoint], &BlendNode<'_>),
        corners_at: &CornersAt<'_>,
    ) -> Result<Self, BartError> {
        let step_s = STEP_SHARE * scenery.plan.header.radar.frame_duration_s();
        let in_time = match scenery.changes_along(BlendAxis::Time) {
            true => Some([corners_at(-step_s, [0.0; 2])?, corners_at(step_s, [0.0; 2])?]),
            false => None,
        };
        let along_row = |shares: [f64; 2]| {
            let off_m = shares.map(|share| share * STEP_M);
            Ok([corners_at(0.0, off_m.map(|off_m| -off_m))?, corners_at(0.0, off_m)?])
        };
        let is_row = scenery.changes_along(BlendAxis::Array);
        let at_one_place = node.ends_m[0] == node.ends_m[1];
        let by_both = if is_row && at_one_place { Some(along_row([1.0; 2])?) } else { None };
        let is_apart = |of: &SlidingJoint| !at_one_place || of.way.0.len() > 1;
        let by_ends = match is_row && sliding.iter().any(is_apart) {
            true => Some([along_row([1.0, 0.0])?, along_row([0.0, 1.0])?]),
            false => None,
        };
        Ok(Self { in_time, by_both, by_ends, step_s, ends_m: node.ends_m })
    }

    /// Slides of the corners of the joint at an index; none of a corner that does not move as far before as
    /// after.
    fn slides(
        &self,
        scatterer: &Scatterer<'_>,
        (of, lit): (&SlidingJoint, &LitSides),
        (joints, index): (&Joints, usize),
    ) -> Vec<CornerSlide> {
        let joint = &joints.list[of.joint];
        let slide = |(corner, corner_m): (usize, &DVec3)| {
            let now = of.corners[corner];
            let body = motions(scatterer, joint.forward, joint.backward, *corner_m);
            let steps = |both: &[AfterStep; 2]| {
                let [before, after] = both.each_ref().map(|step| step[index][corner]);
                is_even([before?, now, after?]).then_some([before?, after?])
            };
            let moved = self.in_time.as_ref().and_then(steps).map(|steps| self.motion(steps, now));
            let by_row = match &self.by_both {
                Some(both) if of.way.0.len() == 1 => {
                    let [before, after] = steps(both).unwrap_or([now; 2]);
                    let ends = lit.slides_of_ends(*corner_m, (after[0] - before[0]) / (2.0 * STEP_M));
                    ends.map(|of_ends| of_ends.map(|slide| self.longer_m(now, [slide; 2])))
                }
                _ => [self.by_each_end(now, steps); 2],
            };
            CornerSlide {
                motion: [0, 1].map(|end| moved.map_or(Motion::REST, |moved| beyond(&moved[end], &body[end]))),
                by_row,
            }
        };
        joints.polygon(joint).iter().enumerate().map(slide).collect()
    }

    /// Change of the path length for each metre that either end alone moves along the row, by the steps of a
    /// corner.
    fn by_each_end(&self, now: Corner, steps: impl Fn(&[AfterStep; 2]) -> Option<[Corner; 2]>) -> [f64; 2] {
        let of_end = |both: &[AfterStep; 2]| {
            let [before, after] = steps(both).unwrap_or([now; 2]);
            self.longer_m(now, [0, 1].map(|end| (after[end] - before[end]) / (2.0 * STEP_M)))
        };
        self.by_ends.as_ref().map_or([0.0; 2], |ends| ends.each_ref().map(of_end))
    }

    /// Motions of both apparent points of a corner.
    fn motion(&self, [before, after]: [Corner; 2], now: Corner) -> [Motion; 2] {
        [0, 1].map(|end| Motion {
            velocity_mps: (after[end] - before[end]) / (2.0 * self.step_s),
            acceleration_mps2: (after[end] + before[end] - 2.0 * now[end]) / (self.step_s * self.step_s),
        })
    }

    /// Change of the path length as the apparent points of a corner slide.
    fn longer_m(&self, now: Corner, slide: [DVec3; 2]) -> f64 {
        let of_end = |end: usize| (now[end] - self.ends_m[end]).normalize_or_zero().dot(slide[end]);
        of_end(0) + of_end(1)
    }
}

/// Excess of a motion over another one; none at all if that is rounding.
fn beyond(moved: &Motion, body: &Motion) -> Motion {
    const ROUNDING_MPS: f64 = 1e-5;
    let slide = Motion::weighed([(1.0, *moved), (-1.0, *body)].into_iter());
    if slide.velocity_mps.length() < ROUNDING_MPS { Motion::REST } else { slide }
}

/// Whether a corner moves as far before as after.
fn is_even([before, now, after]: [Corner; 3]) -> bool {
    (0..2).all(|end| {
        let [before, now, after] = [before[end], now[end], after[end]];
        (after + before - 2.0 * now).length() <= UNEVEN * after.distance(before) + SAME_CORNER_M
    })
}
