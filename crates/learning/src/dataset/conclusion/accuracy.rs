//! Whether the accuracy asked for was reached over all scenes of a dataset.

use pipeline::outcome::error_figures::decibels;
use serde_json::Value;
use std::collections::BTreeMap;

/// Accuracy of the scenes in which it was measured, one after the other.
#[derive(Default)]
pub(super) struct ReachedAccuracy {
    scenes: usize,
    measured: usize,
    met: usize,
    /// Verdict on the scene of the greatest error.
    worst: Option<Value>,
    /// Number of scenes that missed it by each cause, and what would help.
    causes: BTreeMap<String, (usize, String)>,
}

impl ReachedAccuracy {
    /// Takes a scene's line in.
    pub(super) fn add(&mut self, scene: &Value) {
        self.scenes += 1;
        let told = &scene["frames"][0]["accuracy"];
        let Some(met) = told["met"].as_bool().filter(|_| scene["measured_in"] == scene["scene"]) else {
            return;
        };
        self.measured += 1;
        self.met += usize::from(met);
        if self.worst.as_ref().is_none_or(|worst| reached_db(worst) <= reached_db(told)) {
            self.worst = Some(told.clone());
        }
        if !met {
            let [cause, advice] =
                ["limited_by", "advice"].map(|key| told[key].as_str().unwrap_or_default().to_owned());
            self.causes.entry(cause).or_insert((0, advice)).0 += 1;
        }
    }

    /// Lines on the accuracy asked for: how many scenes reached it, the worst error, and for those that
    /// missed it how many there are of each cause, with what would help.
    pub(super) fn lines(&self) -> Vec<String> {
        let Some(worst) = &self.worst else { return vec!["numerical errors were not estimated".into()] };
        // What was measured and has no level is no error at all.
        let reached = worst["reached_db"].as_f64().map_or("none".into(), decibels);
        let asked = decibels(worst["asked_db"].as_f64());
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

fn reached_db(told: &Value) -> f64 {
    told["reached_db"].as_f64().unwrap_or(f64::NEG_INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn scenes_that_missed_the_accuracy_are_counted_with_what_limits_them() {
        let scene = |number: u64, measured_in: u64, accuracy: &Value| json!({ "scene": number, "measured_in": measured_in, "frames": [{ "accuracy": accuracy }] });
        let met = json!({ "asked_db": -20.0, "reached_db": -25.0, "met": true, "advice": null });
        let missed = json!({ "asked_db": -20.0, "reached_db": -12.5, "met": false, "limited_by": "freezing",
            "advice": "Limited by freezing." });
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
