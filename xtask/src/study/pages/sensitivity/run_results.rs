//! Results of runs: objects and tracks of every body, frame by frame, with the truth. Summaries of runs are
//! kept, so that an interrupted study of an hour resumes.

use crate::study::pages::row_cache::RowCache;
use crate::study::pages::sensitivity::scenes::Case;
use crate::study::pages::whole_runs::run_folder::RunFolder;
use crate::study::sources::{self, SourcePaths};
use artifact::settings::Class;
use std::collections::BTreeMap;
use std::path::Path;
use wayside::host::failure::Failure;
use wayside::outcome::summary::{FrameSummary, Predicted, TargetSummary, TrackSummary};
use wayside::{RadarOutcome, Summary};

/// Values for one body in one frame, by an object, by a track or by the truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BodyEstimate {
    pub(super) range_m: f64,
    pub(super) velocity_mps: f64,
    pub(super) azimuth_deg: f64,
    pub(super) lane: Option<u8>,
    pub(super) class: Option<Predicted>,
    /// Probability of the true class.
    pub(super) probability: Option<f64>,
}

/// Values by radar, frame and body.
pub(super) type EstimatesByBody = BTreeMap<(usize, usize, String), BodyEstimate>;

/// Results of a run.
#[derive(Default)]
pub(super) struct RunResult {
    pub(super) objects: EstimatesByBody,
    pub(super) tracks: EstimatesByBody,
    /// Truth of every body that can be compared with an object.
    pub(super) truth_of_objects: EstimatesByBody,
    /// The same truth on the ground, comparable with tracks.
    pub(super) truth_of_tracks: EstimatesByBody,
    /// Processor seconds of the frames including their pictures.
    pub(super) seconds: f64,
}

/// A summary for each radar, with the radar's position.
type Summaries = Vec<([f64; 3], Summary)>;

/// Results of runs: kept ones, and those of new runs.
pub(super) struct RunResults {
    cache: RowCache,
    runs: RunFolder,
}

impl RunResults {
    pub(super) fn open(sources: SourcePaths) -> Result<Self, Failure> {
        Ok(Self { cache: RowCache::of("sensitivity", &sources::hash(sources)?), runs: RunFolder::new()? })
    }

    /// Results of a scene at an accuracy.
    pub(super) fn of(&self, case: &Case, accuracy_db: f64, seed: Option<u64>) -> Result<RunResult, Failure> {
        let noise = seed.map_or(String::new(), |seed| format!("-{seed}"));
        let name = format!("{}{accuracy_db:.0}{noise}", case.name);
        let run = || self.run(&name, &case.scene_at(accuracy_db), seed);
        Ok(RunResult::of(&self.cache.get_or_make(&name, run)?))
    }

    fn run(&self, name: &str, text: &str, seed: Option<u64>) -> Result<Summaries, Failure> {
        let (file, outcome) = self.runs.outcome(name, text, |run| run.scene.seed = seed)?;
        // A scene with one radar has no name for it.
        let mut radars = scene::radars(&file).map_err(Failure::refused)?.into_iter();
        let of = |radar: &RadarOutcome| Ok((position_m(&file, radars.next())?, radar.summary().clone()));
        outcome.radars().iter().map(of).collect()
    }
}

impl RunResult {
    fn of(summaries: &Summaries) -> Self {
        let mut all = Self::default();
        for (radar, (position_m, summary)) in summaries.iter().enumerate() {
            all.add_summary(radar, *position_m, summary);
        }
        all
    }

    fn add_summary(&mut self, radar: usize, position_m: [f64; 3], summary: &Summary) {
        let position = RadarPosition { position_m };
        for (number, frame) in summary.frames.iter().enumerate() {
            for target in &frame.targets {
                let key = (radar, number, target.id.clone());
                self.add(&position, key, target, frame);
            }
        }
        self.seconds += summary.frames_processor_seconds.unwrap_or(summary.frames_seconds);
    }

    fn add(
        &mut self,
        position: &RadarPosition,
        key: (usize, usize, String),
        target: &TargetSummary,
        frame: &FrameSummary,
    ) {
        self.truth_of_tracks.insert(key.clone(), position.truth_on_ground(target));
        if target.found.is_some() {
            self.truth_of_objects.insert(key.clone(), position.truth(target));
        }
        if let Some(track) = frame.tracks.iter().find(|track| track.target.as_ref() == Some(&target.id)) {
            self.tracks.insert(key.clone(), position.track(track, target.class));
        }
        if let Some(object) = position.object(target).filter(|_| target.found.is_some()) {
            self.objects.insert(key, object);
        }
    }
}

fn position_m(file: &Path, radar: Option<String>) -> Result<[f64; 3], Failure> {
    let options = scene::ReadOptions { radar, ..scene::ReadOptions::names_only() };
    Ok(scene::read(file, &options).map_err(Failure::refused)?.radar.position_m)
}

/// Position of the radar.
struct RadarPosition {
    position_m: [f64; 3],
}

impl RadarPosition {
    /// Ground range and azimuth of a place; the azimuth from world +y towards +x.
    fn ground(&self, x_m: f64, y_m: f64) -> (f64, f64) {
        let (x_m, y_m) = (x_m - self.position_m[0], y_m - self.position_m[1]);
        (x_m.hypot(y_m), x_m.atan2(y_m).to_degrees())
    }

    fn object(&self, target: &TargetSummary) -> Option<BodyEstimate> {
        let estimate = target.estimate?;
        Some(BodyEstimate {
            range_m: estimate.range_m,
            velocity_mps: estimate.radial_velocity_mps,
            azimuth_deg: self.ground(estimate.x_m, estimate.y_m).1,
            lane: estimate.lane,
            class: target.predicted_class,
            probability: target.class.and_then(|class| target.probabilities.of_class(class)),
        })
    }

    fn truth(&self, target: &TargetSummary) -> BodyEstimate {
        let truth = &target.truth;
        BodyEstimate {
            range_m: truth.compared_range_m(),
            velocity_mps: truth.compared_radial_velocity_mps(),
            azimuth_deg: self.ground(truth.x_m, truth.y_m).1,
            lane: truth.lane,
            class: target.class.map(Predicted::Class),
            probability: target.class.map(|_| 1.0),
        }
    }

    fn truth_on_ground(&self, target: &TargetSummary) -> BodyEstimate {
        let (truth, (range_m, azimuth_deg)) =
            (&target.truth, self.ground(target.truth.x_m, target.truth.y_m));
        // The radial velocity of a body moving on the ground is smaller by the cosine of the depression
        // angle.
        let velocity_mps = truth.radial_velocity_mps * truth.range_m / range_m;
        BodyEstimate { range_m, velocity_mps, azimuth_deg, ..self.truth(target) }
    }

    fn track(&self, track: &TrackSummary, class: Option<Class>) -> BodyEstimate {
        let (range_m, azimuth_deg) = self.ground(track.footprint.x_m, track.footprint.y_m);
        let (sin, cos) = azimuth_deg.to_radians().sin_cos();
        BodyEstimate {
            range_m,
            velocity_mps: track.vx_mps * sin + track.vy_mps * cos,
            azimuth_deg,
            lane: track.lane,
            class: track.predicted_class,
            probability: class.and_then(|class| track.probabilities.of_class(class)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn azimuth_is_seen_from_the_radar_and_grows_towards_x() {
        let position = RadarPosition { position_m: [1.0, 2.0, 6.0] };
        let (range_m, azimuth_deg) = position.ground(4.0, 6.0);
        assert!((range_m - 5.0).abs() < 1e-12 && (azimuth_deg - 36.869_897_645_844).abs() < 1e-9);
    }
}
