//! Answers to sightings, by frame and joined by track, with their metrics.

use crate::crops::network::Logits;
use crate::crops::samples::Example;
use crate::ensembles::vehicles::{Sighting, TrackKey};
use crate::evaluation::by_vehicle::{ByVehicle, ClassPrediction, by_vehicle};
use crate::evaluation::metrics::{Evaluation, evaluation, log_softmax};
use serde::Serialize;
use std::collections::BTreeMap;

/// Metrics of answers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClassificationMetrics {
    /// Mean over classes, with its spread over vehicles.
    pub by_vehicle: ByVehicle,
    /// Confusion, log loss, calibration.
    pub evaluation: Evaluation,
}

/// The correlation of frames with the best answers for tracks, in steps of a twentieth; of equally good ones
/// the highest: where no track has two frames, nothing shows that further frames tell anything new.
pub(crate) fn fitted_correlation(seen: &[&Sighting], logits: &[Logits]) -> f64 {
    best_correlation(&tracks(seen, logits))
}

fn best_correlation(tracks: &[Track<'_>]) -> f64 {
    let loss = |correlation: f64| -> f64 {
        tracks.iter().map(|t| -log_softmax(t.joined(correlation).map(f64::from))[t.class]).sum()
    };
    let steps = (0..=20).rev().map(|i| f64::from(i) / 20.0);
    steps.min_by(|a, b| loss(*a).total_cmp(&loss(*b))).unwrap_or(1.0)
}

/// Lower limit of a frame's probabilities in the sums over a track: a few other frames outweigh one that is
/// sure and wrong.
const LEAST_PROBABILITY: f64 = 1e-3;

/// Evidence of a track's class in one of its frames, from the logarithms of the frame's probabilities; that
/// of all its frames is summed.
pub fn track_evidence(log_probabilities: [f64; 4]) -> [f64; 4] {
    log_probabilities.map(|log| log.max(LEAST_PROBABILITY.ln()))
}

/// Combined answers of the frames of one track.
struct Track<'a> {
    class: usize,
    model: &'a str,
    log_sums: [f64; 4],
    frames: f64,
}

impl Track<'_> {
    /// Combined answer: n frames of correlation ρ count as n/(1 + (n − 1)ρ).
    fn joined(&self, correlation: f64) -> Logits {
        self.log_sums.map(|sum| (sum / (1.0 + (self.frames - 1.0) * correlation)) as f32)
    }
}

fn tracks<'a>(seen: &[&'a Sighting], logits: &[Logits]) -> Vec<Track<'a>> {
    let mut tracks: BTreeMap<TrackKey, Track<'a>> = BTreeMap::new();
    for (seen, logits) in seen.iter().zip(logits) {
        let new = Track { class: seen.class, model: &seen.model, log_sums: [0.0; 4], frames: 0.0 };
        let track = tracks.entry(seen.track).or_insert(new);
        let logs = track_evidence(log_softmax(logits.map(f64::from)));
        track.log_sums.iter_mut().zip(logs).for_each(|(sum, log)| *sum += log);
        track.frames += 1.0;
    }
    tracks.into_values().collect()
}

/// Class and combined answer of each track.
pub fn track_logits(seen: &[&Sighting], logits: &[Logits], correlation: f64) -> Vec<(usize, Logits)> {
    tracks(seen, logits).iter().map(|track| (track.class, track.joined(correlation))).collect()
}

/// Metrics by frame, and by track.
pub fn metrics_by_frame_and_track(
    seen: &[&Sighting],
    logits: &[Logits],
    correlation: f64,
) -> [ClassificationMetrics; 2] {
    let frames: Vec<(usize, &str)> = seen.iter().map(|s| (s.class, s.model.as_str())).collect();
    let tracks = tracks(seen, logits);
    let of_tracks: Vec<(usize, &str)> = tracks.iter().map(|t| (t.class, t.model)).collect();
    let joined: Vec<Logits> = tracks.iter().map(|t| t.joined(correlation)).collect();
    [classification_metrics(&frames, logits), classification_metrics(&of_tracks, &joined)]
}

fn classification_metrics(answers: &[(usize, &str)], logits: &[Logits]) -> ClassificationMetrics {
    let likeliest = |l: &Logits| (0..4).fold(0, |best, i| if l[i] > l[best] { i } else { best });
    let predictions = answers.iter().zip(logits).map(|((truth, model), l)| ClassPrediction {
        truth: *truth,
        model,
        predicted: likeliest(l),
    });
    let example =
        |(class, model): &(usize, &str)| Example { pooled: vec![], class: *class, model: (*model).into() };
    let examples: Vec<Example> = answers.iter().map(example).collect();
    ClassificationMetrics { by_vehicle: by_vehicle(predictions), evaluation: evaluation(&examples, logits) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::dataset::Split;

    fn track(class: usize, frames: f64) -> Track<'static> {
        Track {
            class,
            model: "a",
            log_sums: [frames * 0.5_f64.ln(), frames * 0.2_f64.ln(), 0.0, 0.0],
            frames,
        }
    }

    #[test]
    fn tracks_of_one_frame_tell_nothing_of_the_correlation_and_count_as_one_whatever_it_is() {
        let lone = [track(0, 1.0), track(1, 1.0)];
        assert_eq!(best_correlation(&lone), 1.0);
        assert_eq!(lone[0].joined(0.0), lone[0].joined(1.0));
    }

    #[test]
    fn a_frame_that_is_sure_and_wrong_is_outweighed_by_two_that_are_nearly_sure() {
        let seen = Sighting {
            features: vec![],
            cells: vec![],
            class: 0,
            model: "a".into(),
            track: (0, 0, 0),
            split: Split::Train,
            has_rows: false,
        };
        let p = |first: f32| [first, 1.0 - first, 0.0, 0.0].map(|p: f32| p.max(1e-9).ln());
        let logits = [p(1e-9), p(0.99), p(0.99)];
        let [(_, [right, wrong, ..])] = track_logits(&[&seen; 3], &logits, 0.0)[..] else {
            panic!("a track")
        };
        assert!((f64::from(right) - (1e-3_f64 * 0.99 * 0.99).ln()).abs() < 1e-3, "{right}");
        assert!(right > wrong, "{right} {wrong}");
    }
}
