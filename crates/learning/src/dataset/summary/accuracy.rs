//! Whether the requested accuracy was reached over all scenes of a dataset.

use crate::dataset::scene_line::SceneLine;
use pipeline::outcome::error_figures::decibels;
use pipeline::outcome::verdict::AccuracyVerdict;
use std::collections::BTreeMap;

/// Accuracy of the scenes in which it was measured.
#[derive(Default)]
pub(super) struct ReachedAccuracy {
    scenes: usize,
    measured: usize,
    met: usize,
    /// Verdict on the scene with the largest error.
    worst: Option<AccuracyVerdict>,
    /// Number of scenes that missed it by each cause, with a remedy.
    causes: BTreeMap<String, (usize, String)>,
}

impl ReachedAccuracy {
    /// Adds a scene's line. The errors of its first frames, as many as the radar's cycle has `sub_frames`,
    /// were measured each by itself; the worst of them counts.
    pub(super) fn add(&mut self, scene: &SceneLine, sub_frames: usize) {
        self.scenes += 1;
        let is_measured = scene.measured_in == scene.scene;
        let measured = scene.frames.iter().take(sub_frames).filter(|_| is_measured);
        let verdicts = measured.filter_map(|frame| Some((&frame.accuracy, frame.accuracy.met?)));
        let worst = verdicts
            .max_by(|(a, a_met), (b, b_met)| b_met.cmp(a_met).then(reached_db(a).total_cmp(&reached_db(b))));
        let Some((told, met)) = worst else { return };
        self.measured += 1;
        self.met += usize::from(met);
        if self.worst.as_ref().is_none_or(|worst| reached_db(worst) <= reached_db(told)) {
            self.worst = Some(told.clone());
        }
        if !met {
            let [cause, advice] =
                [&told.limited_by, &told.advice].map(|word| word.clone().unwrap_or_default());
            self.causes.entry(cause).or_insert((0, advice)).0 += 1;
        }
    }

    /// Lines on the requested accuracy: the number of scenes that reached it, the largest error, and for
    /// those that missed it the number by cause, with a remedy.
    pub(super) fn lines(&self) -> Vec<String> {
        let Some(worst) = &self.worst else { return vec!["numerical errors were not estimated".into()] };
        // A measured error without a level is zero.
        let reached = worst.reached_db.map_or("none".into(), decibels);
        let asked = decibels(worst.asked_db);
        let Self { scenes, measured, met, .. } = self;
        let missed = measured - met;
        let mut lines = vec![format!(
            "numerical error: {asked} asked, measured in {measured} of {scenes} scenes, reached in {met}, \
             missed in {missed}, the worst {reached}"
        )];
        lines.extend(self.causes.values().map(|(many, advice)| format!("{many} of these: {advice}")));
        lines
    }
}

fn reached_db(told: &AccuracyVerdict) -> f64 {
    told.reached_db.unwrap_or(f64::NEG_INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::scene_line::FrameLine;

    #[test]
    fn scenes_that_missed_the_accuracy_are_counted_with_what_limits_them() {
        let scene = |number: u64, measured_in: u64, accuracy: &AccuracyVerdict| SceneLine {
            scene: Some(number),
            measured_in: Some(measured_in),
            frames: vec![FrameLine { accuracy: accuracy.clone(), ..FrameLine::default() }],
            ..SceneLine::default()
        };
        let asked = AccuracyVerdict { asked_db: -20.0, ..AccuracyVerdict::default() };
        let met = AccuracyVerdict { reached_db: Some(-25.0), met: Some(true), ..asked.clone() };
        let missed = AccuracyVerdict {
            reached_db: Some(-12.5),
            met: Some(false),
            limited_by: Some("freezing".into()),
            advice: Some("Limited by freezing.".into()),
            ..asked
        };
        let mut reached = ReachedAccuracy::default();
        [scene(0, 0, &met), scene(1, 1, &missed), scene(2, 0, &met)].iter().for_each(|s| reached.add(s, 1));
        let told = reached.lines();
        assert_eq!(
            told[0],
            "numerical error: −20.0 dB asked, measured in 2 of 3 scenes, reached in 1, missed in 1, the \
             worst −12.5 dB"
        );
        assert_eq!(told[1], "1 of these: Limited by freezing.");
    }

    #[test]
    fn of_sub_frames_the_worst_of_those_that_were_measured_counts() {
        let frame = |reached_db: f64| FrameLine {
            accuracy: AccuracyVerdict {
                asked_db: -20.0,
                reached_db: Some(reached_db),
                met: Some(reached_db <= -20.0),
                limited_by: Some("freezing".into()),
                ..AccuracyVerdict::default()
            },
            ..FrameLine::default()
        };
        let frames = [-25.0, -18.0, -26.0, -10.0].map(frame).to_vec();
        let scene = SceneLine { scene: Some(0), measured_in: Some(0), frames, ..SceneLine::default() };
        let lines = |sub_frames: usize| {
            let mut reached = ReachedAccuracy::default();
            reached.add(&scene, sub_frames);
            reached.lines()
        };
        assert!(lines(1)[0].ends_with("reached in 1, missed in 0, the worst −25.0 dB"), "{:?}", lines(1));
        assert!(lines(2)[0].ends_with("reached in 0, missed in 1, the worst −18.0 dB"), "{:?}", lines(2));
    }
}
