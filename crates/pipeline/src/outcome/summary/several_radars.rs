//! Summary of several radars of one scene, side by side.

use crate::host::failure::Failure;
use crate::host::frame_matching::{SAME_TIME_S, is_same_time};
use crate::outcome::summary::frame::FrameSummary;
use crate::outcome::summary::one_radar::{self, Summary};
use crate::outcome::summary::targets::TargetSummary;
use crate::outcome::verdict::AccuracyVerdict;
use artifact::settings::Class;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The `summary.json` in the folder above those of several radars.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RadarsSummary {
    /// Name of the scene.
    pub scene: String,
    /// Totals of each radar, in the scene's order.
    pub radars: Vec<RadarEntry>,
    /// Common frames in order, one for each time at which frames of all radars begin together
    /// ([`common_times_s`]).
    pub frames: Vec<CommonFrame>,
}

/// Totals of one of several radars over all of its frames.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RadarEntry {
    /// Id of the radar in the scene.
    pub id: String,
    /// Seed of the radar's noise.
    pub seed: u64,
    /// Number of virtual channels.
    pub channels: usize,
    /// Number of frames that the radar has.
    pub frames: usize,
    /// Number of targets in view, frame by frame.
    pub targets: usize,
    /// Number of targets with an object, frame by frame.
    pub found: usize,
    /// Number of targets without one, frame by frame.
    pub missed: usize,
    /// Number of objects of no target, frame by frame.
    #[serde(rename = "false")]
    pub false_ones: usize,
    /// Number of objects at rest that belong to no body, frame by frame.
    pub stationary: usize,
    /// Number of targets whose echoes were removed as echoes at rest, frame by frame.
    pub removed: usize,
    /// Number of points detected in all frames.
    pub points: usize,
    /// The largest total error of a frame, dB; `None` if none was estimated, or the error is zero.
    pub largest_error_db: Option<f64>,
    /// Accuracy of the frame with the largest error; `None` if none was estimated.
    pub accuracy: Option<AccuracyVerdict>,
    /// Wall-clock time of the radar's frames, s.
    pub frames_seconds: f64,
}

/// Frames that all radars have in common: those that begin together, and each radar's later sub-frames of the
/// cycle until the next such time.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CommonFrame {
    /// Time of the first sample, s.
    pub time_s: f64,
    /// Every target that some radar has in view.
    pub targets: Vec<CommonTarget>,
}

/// A target in view of some radar, with the radars that found it among those that receive an echo of it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CommonTarget {
    /// Id of the target in the scene.
    pub id: String,
    /// True class; `None` for a point target, or where the scene does not specify it.
    pub class: Option<Class>,
    /// Ids of the radars that found the target in some of their frames.
    pub found_by: Vec<String>,
    /// Ids of the radars that missed the target and found it in none of their frames.
    pub missed_by: Vec<String>,
}

impl RadarsSummary {
    /// Joins the summaries of radars, each given with the radar's id.
    pub fn of(radars: &[(&str, &Summary)]) -> Self {
        let scene = radars.first().map_or("", |(_, summary)| &summary.scene);
        let frames: Vec<(&str, &[FrameSummary])> =
            radars.iter().map(|(id, summary)| (*id, &summary.frames[..])).collect();
        Self {
            scene: scene.rsplit_once('/').map_or(scene, |(scene, _)| scene).to_owned(),
            radars: radars.iter().map(|(id, summary)| RadarEntry::of(id, summary)).collect(),
            frames: common_frames(&frames),
        }
    }

    /// Reads a `summary.json` of several radars; unknown keys are ignored.
    ///
    /// # Errors
    /// The file is unreadable, or is not such a summary.
    pub fn read(file: &Path) -> Result<Self, Failure> {
        one_radar::read(file)
    }

    /// Frames of one radar that belong to the common frame of this number.
    pub fn frames_of<'s>(&self, number: usize, summary: &'s Summary) -> &'s [FrameSummary] {
        let begin_s = |number: usize| self.frames.get(number).map_or(f64::INFINITY, |frame| frame.time_s);
        within(&summary.frames, [begin_s(number), begin_s(number + 1)])
    }

    /// The text of `summary.json`.
    ///
    /// # Errors
    /// None for a summary of a run.
    pub fn json(&self) -> Result<String, Failure> {
        one_radar::text(self)
    }
}

impl RadarEntry {
    fn of(id: &str, summary: &Summary) -> Self {
        let frames = &summary.frames;
        let sum = |of: &dyn Fn(&FrameSummary) -> usize| frames.iter().map(of).sum();
        let targets = |is: &dyn Fn(&TargetSummary) -> bool| {
            frames.iter().flat_map(|frame| &frame.targets).filter(|target| is(target)).count()
        };
        let errors = frames.iter().filter_map(|frame| Some((frame, frame.accuracy.level_db()?)));
        let worst = errors.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(frame, _)| frame);
        Self {
            id: id.to_owned(),
            seed: summary.seed,
            channels: summary.radar.channels,
            frames: frames.len(),
            targets: targets(&|_| true),
            found: targets(&|target| target.found == Some(true)),
            missed: targets(&|target| target.found == Some(false)),
            false_ones: sum(&|frame| frame.false_objects.len()),
            stationary: sum(&|frame| frame.stationary_objects.len()),
            removed: targets(&|target| target.removed),
            points: sum(&|frame| frame.points),
            largest_error_db: worst.and_then(|frame| frame.error_db.total),
            accuracy: worst.map(|frame| frame.accuracy.clone()),
            frames_seconds: summary.frames_seconds,
        }
    }
}

/// Times at which frames of all radars begin together, in order; each radar's list must be ascending.
///
/// Cycles of all radars begin together, so only later sub-frames fall between two of these times.
pub fn common_times_s(radars: &[Vec<f64>]) -> Vec<f64> {
    let [first, others @ ..] = radars else { return vec![] };
    let has = |own: &[f64], time_s: f64| {
        let place = own.partition_point(|own_s| *own_s < time_s - SAME_TIME_S);
        own.get(place).is_some_and(|own_s| is_same_time(*own_s, time_s))
    };
    first.iter().copied().filter(|time_s| others.iter().all(|own| has(own, *time_s))).collect()
}

fn common_frames(radars: &[(&str, &[FrameSummary])]) -> Vec<CommonFrame> {
    let times_s = |frames: &[FrameSummary]| frames.iter().map(|frame| frame.time_s).collect();
    let times_s: Vec<Vec<f64>> = radars.iter().map(|(_, frames)| times_s(frames)).collect();
    let begins_s = common_times_s(&times_s);
    let ends_s = begins_s.iter().copied().skip(1).chain([f64::INFINITY]);
    let frame = |(begin_s, end_s)| CommonFrame::of(radars, [begin_s, end_s]);
    begins_s.iter().copied().zip(ends_s).map(frame).collect()
}

/// Frames that begin within a half-open time span.
fn within(frames: &[FrameSummary], span_s: [f64; 2]) -> &[FrameSummary] {
    let [first, end] =
        span_s.map(|time_s| frames.partition_point(|frame| frame.time_s < time_s - SAME_TIME_S));
    &frames[first..end]
}

impl CommonFrame {
    /// Joins the targets of each radar's frames within a span.
    fn of(radars: &[(&str, &[FrameSummary])], span_s: [f64; 2]) -> Self {
        let mut joined = Self { time_s: span_s[0], targets: vec![] };
        for (radar, frames) in radars {
            for target in within(frames, span_s).iter().flat_map(|frame| &frame.targets) {
                joined.target(target).take(radar, target.found);
            }
        }
        joined
    }

    /// The record of a target, created on first use.
    fn target(&mut self, target: &TargetSummary) -> &mut CommonTarget {
        let known = self.targets.iter().position(|known| known.id == target.id);
        let place = known.unwrap_or_else(|| {
            let (id, class) = (target.id.clone(), target.class);
            self.targets.push(CommonTarget { id, class, ..CommonTarget::default() });
            self.targets.len() - 1
        });
        &mut self.targets[place]
    }
}

impl CommonTarget {
    /// Records whether a frame of a radar found the target.
    fn take(&mut self, radar: &str, found: Option<bool>) {
        let among = |radars: &[String]| radars.iter().any(|known| known == radar);
        let is_found = among(&self.found_by);
        match found {
            Some(true) if !is_found => {
                self.missed_by.retain(|known| known != radar);
                self.found_by.push(radar.to_owned());
            }
            Some(false) if !is_found && !among(&self.missed_by) => self.missed_by.push(radar.to_owned()),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames of one target, found or not at each of these times.
    fn frames(found: &[(f64, Option<bool>)]) -> Vec<FrameSummary> {
        let frame = |(time_s, found): &(f64, Option<bool>)| {
            let target = TargetSummary { id: "p".to_owned(), found: *found, ..TargetSummary::default() };
            FrameSummary { time_s: *time_s, targets: vec![target], ..FrameSummary::default() }
        };
        found.iter().map(frame).collect()
    }

    fn words(frame: &CommonFrame) -> (f64, String, String) {
        let target = &frame.targets[0];
        (frame.time_s, target.found_by.join(" "), target.missed_by.join(" "))
    }

    #[test]
    fn radars_of_which_one_has_sub_frames_are_joined_by_time() {
        let cycles = [0.0, 0.1, 0.2].map(|time_s| [(time_s, Some(false)), (time_s + 0.00056, Some(true))]);
        let (two, one) = (frames(&cycles.concat()), frames(&[0.0, 0.1, 0.2].map(|t| (t, Some(t < 0.15)))));
        for radars in [[("a", &two[..]), ("b", &one[..])], [("b", &one[..]), ("a", &two[..])]] {
            let joined = common_frames(&radars);
            let both = [radars[0].0, radars[1].0].join(" ");
            let told: Vec<_> = joined.iter().map(words).collect();
            let none = String::new;
            let last = (0.2, "a".to_owned(), "b".to_owned());
            assert_eq!(told, [(0.0, both.clone(), none()), (0.1, both, none()), last]);
        }
    }

    #[test]
    fn sub_frames_that_all_radars_have_at_the_same_times_are_told_apart() {
        let own = frames(&[(0.0, Some(true)), (0.001, Some(false)), (0.1, None), (0.101, Some(true))]);
        let joined = common_frames(&[("a", &own), ("b", &own)]);
        let told: Vec<_> = joined.iter().map(words).collect();
        let (none, both) = (String::new, || "a b".to_owned());
        assert_eq!(told[..2], [(0.0, both(), none()), (0.001, none(), both())]);
        assert_eq!(told[2..], [(0.1, none(), none()), (0.101, both(), none())]);
    }
}
