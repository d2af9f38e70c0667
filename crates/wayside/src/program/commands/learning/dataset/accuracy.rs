//! Whether the accuracy asked for was reached over all scenes of a dataset.

use crate::outcome::error_figures::decibels;
use serde_json::Value;
use std::collections::BTreeMap;

/// Lines on the accuracy asked for: how many scenes reached it, the worst error, and for those that missed it
/// how many there are of each cause, with what would help.
pub(super) fn lines(scenes: &[Value]) -> Vec<String> {
    let is_measured = |scene: &&Value| scene["measured_in"] == scene["scene"];
    let first = |scene: &Value| scene["frames"][0]["accuracy"].clone();
    let told: Vec<Value> =
        scenes.iter().filter(is_measured).map(first).filter(|t| t["met"].is_boolean()).collect();
    let reached_db = |told: &Value| told["reached_db"].as_f64().unwrap_or(f64::NEG_INFINITY);
    let Some(worst) = told.iter().max_by(|a, b| reached_db(a).total_cmp(&reached_db(b))) else {
        return vec!["numerical errors were not estimated".into()];
    };
    let met = told.iter().filter(|told| told["met"] == true).count();
    let (worst, asked) = (decibels(worst["reached_db"].as_f64()), decibels(worst["asked_db"].as_f64()));
    let mut causes: BTreeMap<&str, (usize, &str)> = BTreeMap::new();
    for told in told.iter().filter(|told| told["met"] == false) {
        let [cause, advice] = ["limited_by", "advice"].map(|key| told[key].as_str().unwrap_or_default());
        causes.entry(cause).or_insert((0, advice)).0 += 1;
    }
    let mut lines = vec![format!(
        "numerical error: {asked} asked, measured in {} of {} scenes, reached in {met}, missed in {}, the worst {worst}",
        told.len(),
        scenes.len(),
        told.len() - met
    )];
    lines.extend(causes.into_values().map(|(many, advice)| format!("{many} of these: {advice}")));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn scenes_that_missed_the_accuracy_are_counted_with_what_limits_them() {
        let scene = |number: u64, measured_in: u64, accuracy: Value| json!({ "scene": number, "measured_in": measured_in, "frames": [{ "accuracy": accuracy }] });
        let met = json!({ "asked_db": -20.0, "reached_db": -25.0, "met": true, "advice": null });
        let missed = json!({ "asked_db": -20.0, "reached_db": -12.5, "met": false, "limited_by": "freezing",
            "advice": "Limited by freezing." });
        let told = lines(&[scene(0, 0, met.clone()), scene(1, 1, missed), scene(2, 0, met)]);
        assert_eq!(
            told[0],
            "numerical error: −20.0 dB asked, measured in 2 of 3 scenes, reached in 1, missed in 1, the worst −12.5 dB"
        );
        assert_eq!(told[1], "1 of these: Limited by freezing.");
    }
}
