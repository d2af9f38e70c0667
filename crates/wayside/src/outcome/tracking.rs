//! Objects followed over the frames of a run, and how that agrees with the truth.

use crate::chain::frame_result::FrameResult;
use crate::chain::link::{Chain, FrameProducts};
use crate::host::failure::Failure;
use crate::outcome::summary;
use artifact::tracks::{Track, TracksFrame};
use dsp::{ROAD_TRAFFIC, Tracker};
use evaluation::{FrameTruth, Score, believed, bodies_of_tracks};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// A run's tracker and its score.
pub(crate) struct Tracking {
    tracker: Tracker,
    score: Score,
    classes: BTreeMap<u32, Evidence>,
}

/// What the frames of a track say of its class.
#[derive(Debug, Clone, Copy, Default)]
struct Evidence {
    log_sums: [f64; 4],
    frames: u32,
}

/// The logarithm of no probability is lower: one frame that is sure and wrong is outweighed by a few others.
const LEAST_PROBABILITY: f64 = 1e-3;

impl Evidence {
    fn add(&mut self, probabilities: &[f32; 4]) {
        for (sum, p) in self.log_sums.iter_mut().zip(probabilities) {
            *sum += f64::from(*p).max(LEAST_PROBABILITY).ln();
        }
        self.frames += 1;
    }
}

impl Tracking {
    /// Before the first frame.
    pub(crate) fn of(chain: &Chain) -> Result<Self, Failure> {
        let tracker = Tracker::new(&chain.cube_header, ROAD_TRAFFIC).map_err(Failure::refused)?;
        Ok(Self { tracker, score: Score::default(), classes: BTreeMap::new() })
    }

    /// The frame's tracks, from its objects alone, and what `summary.json` tells of them beside the truth.
    pub(crate) fn follow(
        &mut self,
        frame: &FrameProducts,
        truth: &FrameTruth,
    ) -> Result<(TracksFrame, Value), Failure> {
        let result = &frame.result;
        let tracks = self.tracker.step(&result.points).map_err(Failure::refused)?;
        self.score.add(truth, &result.points.objects, &tracks);
        tracks.tracks.iter().for_each(|track| self.hear(track, result));
        let class =
            |track: &Track| self.classes.get(&track.id).map(|e| result.rule.joined(&e.log_sums, e.frames));
        let told = told(
            &tracks,
            truth,
            |body| frame.view.targets.get(body).map(|t| t.id.as_str()),
            |track| {
                let probabilities = class(track);
                (probabilities.map(|p| result.rule.told(&p)), summary::probabilities(probabilities.as_ref()))
            },
        );
        Ok((tracks, told))
    }

    /// The strongest of a track's objects says what this frame knows of its class.
    fn hear(&mut self, track: &Track, result: &FrameResult) {
        let objects = track.objects.iter().map(|object| *object as usize);
        let snr_db =
            |object: &usize| result.points.objects.get(*object).map_or(f64::NEG_INFINITY, |o| o.snr_db);
        let strongest = objects.max_by(|a, b| snr_db(a).total_cmp(&snr_db(b)));
        if let Some(probabilities) = strongest.and_then(|object| result.classes.get(object)) {
            self.classes.entry(track.id).or_default().add(probabilities);
        }
    }

    /// Of all frames so far.
    pub(crate) fn metrics(&self) -> Value {
        json!(self.score.metrics())
    }
}

/// Gives each target the class of the track that follows it.
pub(crate) fn join(targets: &mut Value, tracks: &Value) {
    for target in targets.as_array_mut().into_iter().flatten() {
        let own = tracks.as_array().into_iter().flatten().find(|track| track["target"] == target["id"]);
        target["track_class"] = own.map_or(Value::Null, |track| track["predicted_class"].clone());
        target["track_probabilities"] = own.map_or(Value::Null, |track| track["probabilities"].clone());
    }
}

fn told<'a>(
    tracks: &TracksFrame,
    truth: &FrameTruth,
    id_of: impl Fn(usize) -> Option<&'a str>,
    class_of: impl Fn(&Track) -> (Option<&'static str>, Value),
) -> Value {
    let believed = believed(tracks);
    let bodies = bodies_of_tracks(truth, &believed);
    let of = |(track, body): (&&Track, Option<usize>)| {
        let mut told = track_json(track, body.and_then(&id_of));
        let (class, probabilities) = class_of(track);
        told["predicted_class"] = json!(class);
        told["probabilities"] = probabilities;
        told
    };
    believed.iter().zip(bodies).map(of).collect()
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
