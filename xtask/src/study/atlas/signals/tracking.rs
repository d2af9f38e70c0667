//! The tracker on objects with known truth: crossing, hidden, late, beyond the velocity span.

use crate::study::atlas::methods;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::extent::Extent;
use crate::study::scenes::{cube_header, scene_of};
use artifact::points::{Height, Object, PointsFrame};
use artifact::tracks::{Track, TrackState, TracksFrame};
use dsp::{ROAD_TRAFFIC, Tracker};
use wayside::host::failure::Failure;

const STEP_S: f64 = 0.1;

/// Place and velocity on the ground.
type Body = ([f64; 2], [f64; 2]);

/// An object exactly as seen by a radar at the origin, 6 m up.
fn object(([x, y], [vx, vy]): Body) -> Object {
    let range_m = (x * x + y * y + 5.25 * 5.25_f64).sqrt();
    let radial_velocity_mps = (x * vx + y * vy) / range_m;
    Object {
        range_m,
        radial_velocity_mps,
        velocity_resolved: true,
        azimuth_rad: x.atan2(y),
        position_m: [x, y, 0.75],
        lane: None,
        snr_db: 30.0,
        points: 4,
        range_extent_m: [range_m - 0.5, range_m + 0.5],
        velocity_extent_mps: [radial_velocity_mps; 2],
        ghost_share: None,
        stationary: None,
        height: Height::Assumed,
    }
}

fn tracker() -> Result<Tracker, Failure> {
    let header = scene_of("[noise]\nnoise_figure_db = 12.0\n")?;
    Tracker::new(&cube_header(&header), ROAD_TRAFFIC).map_err(Failure::refused)
}

fn moved(([x, y], [vx, vy]): Body, seconds: f64) -> Body {
    ([x + vx * seconds, y + vy * seconds], [vx, vy])
}

/// Tracks of frames of bodies, each detected when `is_heard` is true.
fn followed(
    bodies: &[Body],
    frames: u32,
    is_heard: impl Fn(usize, u32) -> bool,
) -> Result<Vec<TracksFrame>, Failure> {
    let mut tracker = tracker()?;
    let step = |index: u32| {
        let time_s = STEP_S * f64::from(index);
        let heard = bodies.iter().enumerate().filter(|(body, _)| is_heard(*body, index));
        let objects = heard.map(|(_, body)| object(moved(*body, time_s))).collect();
        let frame = PointsFrame { index, time_s, points: vec![], objects };
        tracker.step(&frame).map_err(Failure::refused)
    };
    (0..frames).map(step).collect()
}

fn nearest(frame: &TracksFrame, ([x, y], _): Body) -> Option<&Track> {
    let away = |t: &&Track| (t.position_m[0] - x).hypot(t.position_m[1] - y);
    frame.tracks.iter().min_by(|a, b| away(a).total_cmp(&away(b)))
}

/// Two bodies pass each other in neighbouring lanes: error 1 for each that has the other's track afterwards.
pub(in crate::study::atlas) fn passing(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::TRACKS.trial("two bodies pass each other: identities lost", "apart_m, speeds m/s");
    let row = |(apart_m, speeds): (f64, [f64; 2])| {
        let bodies = [([3.0, 50.0], [0.0, -speeds[0]]), ([3.0 + apart_m, 20.0], [0.0, speeds[1]])];
        let frames = followed(&bodies, 30, |_, _| true)?;
        let id = |frame: usize, body: usize| {
            let at = moved(bodies[body], STEP_S * frame as f64);
            nearest(&frames[frame], at).map(|track| track.id)
        };
        let lost = (0..2).filter(|body| id(5, *body).is_none() || id(5, *body) != id(29, *body)).count();
        Ok(trial.answered(format!("{apart_m}, {speeds:?}"), lost as f64, ErrorStatement::Missing))
    };
    [(3.75, [10.0, 10.0]), (3.75, [10.0, -5.0]), (1.0, [10.0, 10.0])].into_iter().map(row).collect()
}

/// A body hidden for a while: its track coasts, and its place is predicted.
pub(in crate::study::atlas) fn hidden(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial =
        methods::TRACKS.trial("a body that is hidden for a while: its place then, of its way", "hidden_s");
    let row = |hidden_frames: u32| {
        let bodies = [([3.0, 55.0], [0.0, -10.0])];
        let frames = followed(&bodies, 20 + hidden_frames, |_, frame| frame < 20)?;
        let seconds = STEP_S * f64::from(19 + hidden_frames);
        let truth = moved(bodies[0], seconds);
        let last = frames.last().and_then(|frame| nearest(frame, truth));
        let hidden_s = STEP_S * f64::from(hidden_frames);
        let (error, statement) = match last {
            None => (1.0, ErrorStatement::Remark("the track is gone: no object for a quarter of its life")),
            Some(track) => {
                let ([x, y], _) = truth;
                let off_m = (track.position_m[0] - x).hypot(track.position_m[1] - y);
                let state = (track.state == TrackState::Coasting).then_some("state is coasting");
                (off_m / (10.0 * hidden_s), state.map_or(ErrorStatement::Missing, ErrorStatement::Remark))
            }
        };
        Ok(trial.answered(format!("{hidden_s:.1}"), error, statement))
    };
    [2, 4, 15].into_iter().map(row).collect()
}

/// Frames that no tracker can process.
pub(in crate::study::atlas) fn impossible_frames(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::TRACKS.trial("frames that cannot be followed", "frame");
    let after = |time_s: f64, change: &dyn Fn(&mut Object)| {
        let mut tracker = tracker()?;
        let mut one = object(([3.0, 40.0], [0.0, -10.0]));
        let frame = |index, time_s, one| PointsFrame { index, time_s, points: vec![], objects: vec![one] };
        tracker.step(&frame(0, 1.0, one)).map_err(Failure::refused)?;
        change(&mut one);
        tracker.step(&frame(1, time_s, one)).map_err(Failure::refused)
    };
    Ok(vec![
        trial.must_refuse("at the same time", after(1.0, &|_| ())),
        trial.must_refuse("before the last one", after(0.5, &|_| ())),
        trial.must_refuse("at no time", after(f64::NAN, &|_| ())),
        trial.must_refuse("an object without a range", after(1.1, &|o| o.range_m = f64::NAN)),
        trial.must_refuse(
            "an object of infinite speed",
            after(1.1, &|o| o.radial_velocity_mps = f64::INFINITY),
        ),
    ])
}
