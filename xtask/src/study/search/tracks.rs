//! The tracker on bodies that drive straight on, each detected with errors of the reported size.

use crate::study::scenes::{cube_header, scene_of};
use crate::study::search::differential_testing::{Outcome, Random};
use crate::study::search::random_bodies::within;
use artifact::points::{Height, Object, PointsFrame};
use artifact::tracks::{TrackState, TracksFrame};
use dsp::{ROAD_TRAFFIC, Tracker};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use wayside::host::failure::Failure;

const FRAMES: u32 = 25;
const STEP_S: f64 = 0.1;

/// Bodies in separate lanes, 6 m apart, that stay in view.
fn bodies(random: &mut Random) -> Vec<([f64; 2], f64)> {
    let count = random.random_range(1..4);
    let mut body = |i: u32| {
        let (y_m, speed_mps) = (within(random, 28.0, 50.0), within(random, -8.0, 4.0));
        ([-6.0 + 6.0 * f64::from(i), y_m], speed_mps)
    };
    (0..count).map(&mut body).collect()
}

fn object(([x, y], speed_mps): ([f64; 2], f64), random: &mut Random) -> Object {
    let mut noise = |deviation: f64| -> f64 {
        let value: f64 = StandardNormal.sample(random);
        deviation * value
    };
    let range_m = (x * x + y * y + 27.5625_f64).sqrt() + noise(0.1);
    let radial_velocity_mps = y * speed_mps / range_m + noise(0.1);
    let azimuth_rad = x.atan2(y) + noise(0.01);
    let ground_m = (range_m * range_m - 27.5625).max(0.0).sqrt();
    Object {
        range_m,
        radial_velocity_mps,
        velocity_resolved: true,
        azimuth_rad,
        position_m: [ground_m * azimuth_rad.sin(), ground_m * azimuth_rad.cos(), 0.75],
        lane: None,
        snr_db: 25.0,
        points: 3,
        range_extent_m: [range_m - 0.5, range_m + 0.5],
        velocity_extent_mps: [radial_velocity_mps; 2],
        ghost_share: None,
        stationary: None,
        height: Height::Assumed,
    }
}

/// Confirmed track nearest to a body in a frame: its id, and the distance.
fn nearest(frame: &TracksFrame, ([x, y], speed_mps): ([f64; 2], f64)) -> Option<(u32, f64)> {
    let y = y + speed_mps * frame.time_s;
    let believed = frame.tracks.iter().filter(|t| t.state != TrackState::Tentative);
    let away = believed.map(|t| (t.id, (t.position_m[0] - x).hypot(t.position_m[1] - y)));
    away.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// Requires one confirmed track per body, the same from the tenth frame to the last, within two metres of it.
pub(super) fn against_truth(random: &mut Random) -> Result<Outcome, Failure> {
    let header = scene_of("[noise]\nnoise_figure_db = 12.0\n")?;
    let mut tracker = Tracker::new(&cube_header(&header), ROAD_TRAFFIC).map_err(Failure::refused)?;
    let bodies = bodies(random);
    let mut frames = Vec::new();
    for index in 0..FRAMES {
        let time_s = STEP_S * f64::from(index);
        let moved = |([x, y], v): ([f64; 2], f64)| ([x, y + v * time_s], v);
        // Each body is missed in one frame of twenty.
        let heard: Vec<_> = bodies.iter().filter(|_| random.random_range(0..20) > 0).copied().collect();
        let objects = heard.into_iter().map(|body| object(moved(body), random)).collect();
        let frame = PointsFrame { index, time_s, points: vec![], objects };
        frames.push(tracker.step(&frame).map_err(Failure::refused)?);
    }
    let lost = bodies.iter().find_map(|body| {
        let (begin, end) = (nearest(&frames[10], *body), nearest(&frames[FRAMES as usize - 1], *body));
        match (begin, end) {
            (Some((a, _)), Some((b, off_m))) if a == b && off_m < 2.0 => None,
            (begin, end) => Some(format!("{body:?}: {begin:?}, then {end:?}")),
        }
    });
    Ok(lost.map_or(Outcome::Agreed, Outcome::Discrepancy))
}
