//! Axes along which paths are traced: time, and the row of the array.

use crate::frame::path_plan::{MOMENTS_MAX, Plan, WHEEL_STEPS};
use crate::frame::path_sum::PathView;
use artifact::paths::{Path, Span};
use glam::DVec3;

/// Number of steps of the finest grid, in whose places all nodes are counted; its middle is that of the frame
/// and of the array.
pub(crate) const FINEST: u32 = WHEEL_STEPS;
/// Numbers of steps of the grids that are tried, the last if wheels rotate. The first blends by a parabola,
/// the others by cubics.
pub(crate) const GRID_STEPS: [u32; 6] = [2, 4, 8, 16, MOMENTS_MAX - 1, WHEEL_STEPS];
/// Number of steps of the first grid that has the probed places as nodes: finer ones have the same error at
/// the place of the check as over the frame.
pub(crate) const STEPS_OF_LOOKS: u32 = 8;
/// Share of the power missed by coarser grids at the probed places that is added to that missed at the place
/// of the check. There the cubics of four steps have 5 dB less error than over the frame.
pub(crate) const SHARE_OF_LOOKS: f64 = 0.6;
/// Places of every grid at which changes are probed, 3/8 of a frame before its middle and 1/4 after.
///
/// Errors proportional to the time from the middle are there within 1 dB of their mean square over the frame.
/// An outline that slides at a constant rate rotates the phase of its contribution at a constant rate as
/// well: whole cycles from the middle nothing seems to be missed. At both of these places that happens for 8,
/// 16 … cycles per frame, at both ends of the frame for 2, 4, 6 … (for a van behind a bus, three bounces, 4
/// dB less were missed there than over the frame, and nothing seemed to change).
pub(crate) const LOOKED_AT: [u32; 2] = [FINEST / 8, 3 * FINEST / 4];

/// Axis along which some paths are traced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BlendAxis {
    /// Moments from the frame's start to its end, as seen from the array's centre.
    Time,
    /// Places from one end of the array's row to the other, at the frame's middle.
    Array,
}

impl BlendAxis {
    /// Both axes in the order in which they are tried.
    pub(crate) const ALL: [Self; 2] = [Self::Time, Self::Array];

    /// Time after the frame's first sample, s, and positions of transmitter and receiver, for a place of the
    /// finest grid.
    pub(crate) fn at(self, plan: &Plan<'_>, place: u32) -> (f64, [DVec3; 2]) {
        let fraction = f64::from(place) / f64::from(FINEST);
        match self {
            Self::Time => (plan.header.radar.frame_duration_s() * fraction, [plan.position_m; 2]),
            Self::Array => {
                let off_m = plan.row.half_m * (2.0 * fraction - 1.0);
                let place = |moves: f64| plan.position_m + moves * off_m * plan.row.axis;
                (plan.middle_s, plan.row.ends.moves().map(place))
            }
        }
    }

    /// Path that represents the part of one node of a grid.
    pub(crate) fn part(self, plan: &Plan<'_>, mut path: Path, (node, steps): (u32, u32)) -> Path {
        match self {
            Self::Time => path.curve.span = Some(moment(plan, (node, steps))),
            Self::Array => path.curve.array_span = Some(plan.row.span(plan.position_m, (node, steps))),
        }
        path
    }

    /// Share of one node of a grid for a view.
    pub(crate) fn share(self, plan: &Plan<'_>, view: &PathView, (node, steps): (u32, u32)) -> f64 {
        match self {
            Self::Time => moment(plan, (node, steps)).share(view.seconds),
            Self::Array => plan.row.span(plan.position_m, (node, steps)).share(view.ends_m()),
        }
    }
}

/// Part of the frame represented by one moment of a grid.
fn moment(plan: &Plan<'_>, (moment, steps): (u32, u32)) -> Span {
    let step_s = plan.header.radar.frame_duration_s() / f64::from(steps);
    Span { first_s: 0.0, step_s, moments: steps + 1, moment }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::path_plan::check_offset_s;

    /// Mean square errors of a grid's blend of a power, whose derivative of that order is constant: over the
    /// frame, at the check's moment, and at the probed places.
    fn squares(steps: u32, power: i32) -> [f64; 3] {
        let span =
            |moment: u32| Span { first_s: 0.0, step_s: 1.0 / f64::from(steps), moments: steps + 1, moment };
        let square = |t: f64| {
            let traced_at_s = |i: u32| f64::from(i) * (1.0 / f64::from(steps));
            let of_nodes = (0..=steps).map(|i| span(i).share(t) * traced_at_s(i).powi(power));
            (of_nodes.sum::<f64>() - t.powi(power)).powi(2)
        };
        let over_frame = (0..4800).map(|i| square((f64::from(i) + 0.5) / 4800.0)).sum::<f64>() / 4800.0;
        let looks = LOOKED_AT.map(|place| square(f64::from(place) / f64::from(FINEST)));
        [over_frame, square(0.5 + check_offset_s(1.0)), 0.5 * (looks[0] + looks[1])]
    }

    #[test]
    fn at_the_moment_of_the_check_grids_of_nine_and_more_err_as_over_the_frame() {
        for steps in GRID_STEPS.into_iter().filter(|steps| *steps >= STEPS_OF_LOOKS) {
            let [over_frame, check, looks] = squares(steps, 4);
            let of_check_db = 10.0 * (check / over_frame).log10();
            println!("{steps} steps: {of_check_db:.2} dB");
            assert!(of_check_db.abs() < 1.5 && looks < 1e-20, "{steps} steps: {of_check_db}");
        }
    }

    #[test]
    fn coarser_grids_err_no_more_than_the_check_and_the_looks_tell_together() {
        for steps in GRID_STEPS.into_iter().filter(|steps| *steps < STEPS_OF_LOOKS) {
            let [over_frame, check, looks] = squares(steps, if steps == 2 { 3 } else { 4 });
            let [alone_db, told_db] =
                [check, check + SHARE_OF_LOOKS * looks].map(|told| 10.0 * (told / over_frame).log10());
            println!("{steps} steps: by the check alone {alone_db:.2} dB, with looks {told_db:.2} dB");
            assert!((-0.1..6.0).contains(&told_db), "{steps} steps: {told_db}");
        }
    }
}
