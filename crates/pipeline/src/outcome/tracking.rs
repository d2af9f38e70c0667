//! Tracking of objects over the frames of a run, with its agreement with the truth.

use crate::chain::frame_result::FrameResult;
use crate::chain::link::{Chain, FrameProducts};
use crate::host::failure::Failure;
use crate::outcome::summary::TrackSummary;
use artifact::tracks::{Track, TracksFrame};
#[cfg(feature = "classifier")]
use classifier::track_evidence;
use dsp::{ROAD_TRAFFIC, Tracker};
use evaluation::{FrameTruth, Metrics, Score, bodies_of_tracks, confirmed_tracks};
use std::collections::BTreeMap;

/// A run's tracker and its score.
pub struct Tracking {
    tracker: Tracker,
    score: Score,
    classes: BTreeMap<u32, Evidence>,
}

/// Evidence of a track's class: the sums of the logarithms of its frames' probabilities, and the number of
/// frames.
#[derive(Debug, Clone, Copy, Default)]
struct Evidence {
    log_sums: [f64; 4],
    frames: u32,
}

/// Evidence of a frame; without the classifier no object has probabilities.
#[cfg(not(feature = "classifier"))]
fn track_evidence(_: [f64; 4]) -> [f64; 4] {
    [0.0; 4]
}

impl Evidence {
    fn add(&mut self, probabilities: &[f32; 4]) {
        let of_frame = track_evidence(probabilities.map(|p| f64::from(p).ln()));
        self.log_sums.iter_mut().zip(of_frame).for_each(|(sum, log)| *sum += log);
        self.frames += 1;
    }
}

impl Tracking {
    /// Begins to track a scene, before its first frame.
    pub fn of(chain: &Chain) -> Result<Self, Failure> {
        let tracker = Tracker::new(chain.cube_header(), ROAD_TRAFFIC).map_err(Failure::refused)?;
        Ok(Self { tracker, score: Score::default(), classes: BTreeMap::new() })
    }

    /// Updates the tracks from the frame's objects alone, and returns the summaries of confirmed and coasting
    /// ones beside the truth.
    pub fn step(
        &mut self,
        frame: &FrameProducts,
        truth: &FrameTruth,
    ) -> Result<(TracksFrame, Vec<TrackSummary>), Failure> {
        let result = &frame.result;
        let tracks = self.tracker.step(&result.points).map_err(Failure::refused)?;
        self.score.add(truth, &result.points.objects, &tracks);
        tracks.tracks.iter().for_each(|track| self.add_evidence(track, result));
        let confirmed_tracks = confirmed_tracks(&tracks);
        let bodies = bodies_of_tracks(truth, &confirmed_tracks);
        let told = confirmed_tracks.iter().zip(bodies).map(|(track, body)| {
            let target = body.and_then(|body| frame.view.targets.get(body)).map(|target| target.id.as_str());
            let evidence = self.classes.get(&track.id);
            let probabilities = evidence.map(|e| result.rule.combined(&e.log_sums, e.frames));
            TrackSummary::of(track, target, probabilities.as_ref(), &result.rule)
        });
        let told = told.collect();
        Ok((tracks, told))
    }

    /// Adds the probabilities of the strongest of a track's objects in this frame to the evidence.
    fn add_evidence(&mut self, track: &Track, result: &FrameResult) {
        let objects = track.objects.iter().map(|object| *object as usize);
        let snr_db =
            |object: &usize| result.points.objects.get(*object).map_or(f64::NEG_INFINITY, |o| o.snr_db);
        let strongest = objects.max_by(|a, b| snr_db(a).total_cmp(&snr_db(b)));
        if let Some(probabilities) = strongest.and_then(|object| result.classes.get(object)) {
            self.classes.entry(track.id).or_default().add(probabilities);
        }
    }

    /// Metrics of all frames so far.
    pub fn metrics(&self) -> Metrics {
        self.score.metrics()
    }
}

#[cfg(all(test, feature = "classifier"))]
mod tests {
    use super::*;
    use crate::chain::class_rule::ClassRule;
    use artifact::dataset::Split;
    use classifier::{Sighting, log_softmax, track_logits};

    #[test]
    fn a_run_gives_a_track_the_probabilities_that_an_evaluation_gives_it() {
        let frames: [[f32; 4]; 3] = [[1e-7, 1.0, 0.0, 0.0], [0.9, 0.05, 0.05, 0.0], [0.97, 0.01, 0.01, 0.01]];
        let rule = ClassRule { least_probability: 0.4, frame_correlation: 0.25 };
        let mut evidence = Evidence::default();
        frames.iter().for_each(|frame| evidence.add(frame));
        let in_run = rule.combined(&evidence.log_sums, evidence.frames);
        let seen = Sighting {
            features: vec![],
            cells: vec![],
            class: 0,
            model: String::new(),
            track: (0, 0, 0),
            split: Split::Test,
            has_rows: false,
        };
        // The logarithm of none is that of far less than any floor.
        let logits = frames.map(|frame| frame.map(|p| p.max(1e-6).ln()));
        let joined = track_logits(&[&seen; 3], &logits, 0.25)[0].1;
        let evaluated = log_softmax(joined.map(f64::from)).map(f64::exp);
        for (run, evaluated) in in_run.iter().zip(evaluated) {
            // Logits are f32 of up to 14, and those below 1e-6 add as much to the sum.
            assert!((f64::from(*run) - evaluated).abs() < 1e-5, "{in_run:?} {evaluated}");
        }
        assert_eq!(rule.predict(&in_run).name(), "car");
    }
}
