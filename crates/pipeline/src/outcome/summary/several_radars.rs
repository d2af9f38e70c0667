//! Summary of several radars of one scene, side by side.

use crate::host::failure::Failure;
use crate::outcome::summary::frame::FrameSummary;
use crate::outcome::summary::one_radar::{self, Summary};
use crate::outcome::summary::targets::TargetSummary;
use crate::outcome::verdict::AccuracyVerdict;
use artifact::settings::Class;
use serde::{Deserialize, Serialize};

/// The `summary.json` above those of several radars.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RadarsSummary {
    /// Name of the scene.
    pub scene: String,
    /// Totals of each radar, in the scene's order.
    pub radars: Vec<OneOfRadars>,
    /// Frames in order, to the last that any radar has.
    pub frames: Vec<CommonFrame>,
}

/// Totals of one of several radars over all of its frames.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct OneOfRadars {
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
    /// Targets that have an object, frame by frame.
    pub found: usize,
    /// Targets that have none, frame by frame.
    pub missed: usize,
    /// Objects of no target, frame by frame.
    #[serde(rename = "false")]
    pub false_ones: usize,
    /// Objects at rest that are no body's, frame by frame.
    pub stationary: usize,
    /// Targets whose echoes were removed as echoes at rest, frame by frame.
    pub removed: usize,
    /// Number of points detected in all frames.
    pub points: usize,
    /// The largest total of a frame, dB; `None` where none was estimated, and of no error at all.
    pub largest_error_db: Option<f64>,
    /// Accuracy of the frame with the largest error; `None` where none was estimated.
    pub accuracy: Option<AccuracyVerdict>,
    /// Wall-clock time of the radar's frames, s.
    pub frames_seconds: f64,
}

/// One frame as all radars have it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CommonFrame {
    /// Time of the frame's first sample, s.
    pub time_s: f64,
    /// Every target that some radar has in view.
    pub targets: Vec<CommonTarget>,
}

/// A target that some radar has in view, and which radars found it of those that it sends something back to.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CommonTarget {
    /// Id of the target in the scene.
    pub id: String,
    /// True class; `None` of a point target, or where the scene does not tell.
    pub class: Option<Class>,
    /// Ids of the radars that found the target.
    pub found_by: Vec<String>,
    /// Ids of the radars that missed the target.
    pub missed_by: Vec<String>,
}

impl RadarsSummary {
    /// Joins the summaries of radars, each given with the radar's id.
    pub fn of(radars: &[(&str, &Summary)]) -> Self {
        let scene = radars.first().map_or("", |(_, summary)| &summary.scene);
        let frames = radars.iter().map(|(_, summary)| summary.frames.len()).max().unwrap_or(0);
        Self {
            scene: scene.rsplit_once('/').map_or(scene, |(scene, _)| scene).to_owned(),
            radars: radars.iter().map(|(id, summary)| OneOfRadars::of(id, summary)).collect(),
            frames: (0..frames).map(|i| CommonFrame::of(radars, i)).collect(),
        }
    }

    /// The text of `summary.json`.
    ///
    /// # Errors
    /// None that a summary of a run can make.
    pub fn json(&self) -> Result<String, Failure> {
        one_radar::text(self)
    }
}

impl OneOfRadars {
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

impl CommonFrame {
    fn of(radars: &[(&str, &Summary)], index: usize) -> Self {
        let frames = || radars.iter().filter_map(|(id, summary)| Some((*id, summary.frames.get(index)?)));
        let mut targets: Vec<CommonTarget> = vec![];
        for (radar, target) in frames().flat_map(|(id, frame)| frame.targets.iter().map(move |t| (id, t))) {
            let known = targets.iter().position(|known| known.id == target.id);
            let place = known.unwrap_or_else(|| {
                let (id, class) = (target.id.clone(), target.class);
                targets.push(CommonTarget { id, class, ..CommonTarget::default() });
                targets.len() - 1
            });
            match target.found {
                Some(true) => targets[place].found_by.push(radar.to_owned()),
                Some(false) => targets[place].missed_by.push(radar.to_owned()),
                None => {}
            }
        }
        Self { time_s: frames().next().map_or(0.0, |(_, frame)| frame.time_s), targets }
    }
}
