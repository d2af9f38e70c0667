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
    /// Adds a scene's line.
    pub(super) fn add(&mut self, scene: &SceneLine) {
        self.scenes += 1;
        let told = scene.frames.first().map(|frame| &frame.accuracy);
        let told = told.filter(|_| scene.measured_in == scene.scene);
        let Some((told, met)) = told.and_then(|told| Some((told, told.met?))) else { return };
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
        [scene(0, 0, &met), scene(1, 1, &missed), scene(2, 0, &met)].iter().for_each(|s| reached.add(s));
        let told = reached.lines();
        assert_eq!(
            told[0],
            "numerical error: −20.0 dB asked, measured in 2 of 3 scenes, reached in 1, missed in 1, the \
             worst −12.5 dB"
        );
        assert_eq!(told[1], "1 of these: Limited by freezing.");
    }
}
