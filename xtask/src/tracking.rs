//! Objects followed over the frames of a run, and how that agrees with the truth.

use crate::chain::{Chain, FrameProducts};
use crate::failure::Failure;
use crate::frame_truth::FrameTruth;
use crate::metrics::{self, Score};
use artifact::tracks::{Track, TracksFrame};
use dsp::{ROAD_TRAFFIC, Tracker};
use serde_json::{Value, json};

/// A run's tracker and its score.
pub(crate) struct Tracking {
    tracker: Tracker,
    score: Score,
}

impl Tracking {
    /// Before the first frame.
    pub(crate) fn of(chain: &Chain) -> Result<Self, Failure> {
        let tracker = Tracker::new(&chain.cube_header, ROAD_TRAFFIC).map_err(Failure::refused)?;
        Ok(Self { tracker, score: Score::default() })
    }

    /// The frame's tracks, from its objects alone, and what `summary.json` tells of them beside the truth.
    pub(crate) fn follow(
        &mut self,
        frame: &FrameProducts,
        truth: &FrameTruth,
    ) -> Result<(TracksFrame, Value), Failure> {
        let result = &frame.result;
        let tracks = self.tracker.step(&result.points).map_err(Failure::refused)?;
        self.score.add(truth, |body| truth.number_of(body), &result.points.objects, &tracks);
        let told = told(&tracks, truth, |body| frame.view.targets.get(body).map(|t| t.id.as_str()));
        Ok((tracks, told))
    }

    /// Of all frames so far.
    pub(crate) fn metrics(&self) -> Value {
        self.score.told()
    }
}

fn told<'a>(tracks: &TracksFrame, truth: &FrameTruth, id_of: impl Fn(usize) -> Option<&'a str>) -> Value {
    let believed = metrics::believed(tracks);
    let bodies = metrics::bodies_of_tracks(truth, &believed);
    believed.iter().zip(bodies).map(|(track, body)| track_json(track, body.and_then(&id_of))).collect()
}

fn track_json(track: &Track, target: Option<&str>) -> Value {
    let ([x, y], [vx, vy], footprint) = (track.position_m, track.velocity_mps, &track.footprint);
    json!({
        "id": track.id,
        "state": track.state.name(),
        "age_frames": track.age_frames,
        "x_m": x,
        "y_m": y,
        "vx_mps": vx,
        "vy_mps": vy,
        "velocity_resolved": track.velocity_resolved,
        "lane": track.lane,
        "box": {
            "x_m": footprint.centre_m[0],
            "y_m": footprint.centre_m[1],
            "length_m": footprint.length_m,
            "width_m": footprint.width_m,
            "yaw_deg": footprint.heading_rad.to_degrees(),
        },
        "target": target,
    })
}
