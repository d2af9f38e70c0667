//! Whether the accuracy asked for was reached over all scenes of a dataset.

use crate::verdict::decibels;
use serde_json::Value;
use std::collections::BTreeMap;

/// How many scenes reached it, the worst, and of those that did not what limits them and what would help.
pub(super) fn lines(scenes: &[String]) -> Vec<String> {
    let scenes: Vec<Value> = scenes.iter().filter_map(|line| serde_json::from_str(line).ok()).collect();
    let told: Vec<&Value> =
        scenes.iter().map(|scene| &scene["accuracy"]).filter(|told| told["met"].is_boolean()).collect();
    let reached_db = |told: &Value| told["reached_db"].as_f64().unwrap_or(f64::NEG_INFINITY);
    let Some(worst) = told.iter().max_by(|a, b| reached_db(a).total_cmp(&reached_db(b))) else {
        return vec!["numerical errors were not estimated".into()];
    };
    let met = told.iter().filter(|told| told["met"] == true).count();
    let (worst, asked) = (decibels(&worst["reached_db"]), decibels(&worst["asked_db"]));
    let mut causes: BTreeMap<&str, (usize, &str)> = BTreeMap::new();
    for told in told.iter().filter(|told| told["met"] == false) {
        let [cause, advice] = ["limited_by", "advice"].map(|key| told[key].as_str().unwrap_or_default());
        causes.entry(cause).or_insert((0, advice)).0 += 1;
    }
    let mut lines = vec![format!(
        "numerical error: {asked} asked, reached in {met} of {} scenes, missed in {}, the worst {worst}",
        told.len(),
        told.len() - met
    )];
    lines.extend(causes.into_values().map(|(many, advice)| format!("{many} of these: {advice}")));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_that_missed_the_accuracy_are_counted_with_what_limits_them() {
        let met = r#"{"accuracy":{"asked_db":-20.0,"reached_db":-25.0,"met":true,"advice":null}}"#;
        let missed = r#"{"accuracy":{"asked_db":-20.0,"reached_db":-12.5,"met":false,"limited_by":"freezing","advice":"Limited by freezing."}}"#;
        let told = lines(&[met.into(), missed.into(), "{}".into()]);
        assert_eq!(
            told[0],
            "numerical error: −20.0 dB asked, reached in 1 of 2 scenes, missed in 1, the worst −12.5 dB"
        );
        assert_eq!(told[1], "1 of these: Limited by freezing.");
    }
}
