//! Estimate against truth over all vehicles of a dataset, as a table.

use serde_json::Value;

/// Median and 90 % point say more than a mean here: an object that took a ghost along is far off.
const HEAD: &str = "| vehicles | number | detected | range error, m: bias, median, 90 % | velocity error, m/s: median, 90 % \
| lateral error, m: median, 90 % | lane right |\n|---|---|---|---|---|---|---|\n";

/// Markdown: a row for each class, lane and range, and one for all.
pub(super) fn detection(vehicles: &[Value]) -> String {
    let mut table = String::from(HEAD);
    for class in ["car", "bus", "truck", "motorcycle"] {
        row(&mut table, class, vehicles, |s| s["class"] == class);
    }
    for lane in 1..=3_u64 {
        row(&mut table, &format!("lane {lane}"), vehicles, |s| s["lane"] == lane);
    }
    for [near, far] in [[25.0, 35.0], [35.0, 45.0], [45.0, 60.0]] {
        let within = |s: &Value| s["range_m"].as_f64().is_some_and(|r| (near..far).contains(&r));
        row(&mut table, &format!("{near}–{far} m"), vehicles, within);
    }
    row(&mut table, "all", vehicles, |_| true);
    table
}

fn row(table: &mut String, name: &str, vehicles: &[Value], picked: impl Fn(&Value) -> bool) {
    let picked: Vec<&Value> = vehicles.iter().filter(|s| picked(s)).collect();
    let found: Vec<&Value> = picked.iter().copied().filter(|s| !s["estimate"].is_null()).collect();
    let range = errors(&found, |s| (&s["estimate"]["range_m"], &s["echo_range_m"]));
    let velocity = errors(&found, |s| (&s["estimate"]["velocity_mps"], &s["echo_velocity_mps"]));
    let lateral = errors(&found, |s| (&s["estimate"]["x_m"], &s["x_m"]));
    let bias = range.iter().sum::<f64>() / range.len().max(1) as f64;
    let right = found.iter().filter(|s| s["estimate"]["lane"] == s["lane"]).count();
    let share = |part: usize, of: usize| format!("{:.1} %", 100.0 * part as f64 / of.max(1) as f64);
    table.push_str(&format!(
        "| {name} | {} | {} | {bias:+.2}, {} | {} | {} | {} |\n",
        picked.len(),
        share(found.len(), picked.len()),
        spread(&range),
        spread(&velocity),
        spread(&lateral),
        share(right, found.len()),
    ));
}

fn errors<'a>(scenes: &[&'a Value], pair: impl Fn(&'a Value) -> (&'a Value, &'a Value)) -> Vec<f64> {
    let error = |s: &&'a Value| {
        let (estimate, truth) = pair(s);
        Some(estimate.as_f64()? - truth.as_f64()?)
    };
    scenes.iter().filter_map(error).collect()
}

/// Median and 90 % point of the absolute values.
fn spread(errors: &[f64]) -> String {
    let mut sizes: Vec<f64> = errors.iter().map(|e| e.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let at = |share: f64| sizes.get((share * (sizes.len().max(1) - 1) as f64).round() as usize).copied();
    let text = |value: Option<f64>| value.map_or("–".into(), |v| format!("{v:.2}"));
    format!("{}, {}", text(at(0.5)), text(at(0.9)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vehicle_without_an_estimate_counts_as_missed_and_not_as_an_error() {
        let found = r#"{"class":"car","lane":2,"range_m":40.0,"x_m":5.75,"echo_range_m":38.0,"echo_velocity_mps":-3.0,
            "estimate":{"range_m":38.5,"velocity_mps":-3.1,"x_m":5.25,"lane":2}}"#;
        let missed = r#"{"class":"car","lane":2,"range_m":41.0,"x_m":5.75,"estimate":null}"#;
        let table = detection(&[found, missed].map(|line| serde_json::from_str(line).unwrap()));
        assert!(
            table.contains("| car | 2 | 50.0 % | +0.50, 0.50, 0.50 | 0.10, 0.10 | 0.50, 0.50 | 100.0 % |"),
            "{table}"
        );
    }
}
