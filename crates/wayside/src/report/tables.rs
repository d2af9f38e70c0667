//! The report's tables, filled from `summary.json` alone.

use maud::{Markup, html};
use serde_json::Value;

/// A table that is scrolled where the page is narrower, by keys too; its first column stays.
pub(super) fn scrolled(name: &str, table: Markup) -> Markup {
    html! { div.scroll tabindex="0" role="region" aria-label=(name) { (table) } }
}

/// What the radar is, in the words of the field (the paper's Table 2).
pub(super) fn radar(radar: &Value, frames: &[&Value]) -> Markup {
    let number = |key: &str, factor: f64, digits: usize| scaled(&radar[key], factor, digits);
    let points = frames.first().map_or(Value::Null, |f| f["points"].clone());
    let rows = [
        ("Carrier (centre of the sweep)", format!("{} GHz", number("carrier_hz", 1e-9, 4))),
        ("Bandwidth", format!("{} GHz", number("bandwidth_hz", 1e-9, 4))),
        ("Chirp interval", format!("{} µs", number("chirp_interval_s", 1e6, 1))),
        ("Samples per chirp", radar["samples_per_chirp"].to_string()),
        ("Chirps per frame × channels", format!("{} × {}", radar["chirps"], radar["channels"])),
        ("Range resolution", format!("{} m", number("range_resolution_m", 1.0, 2))),
        ("Maximum unambiguous range", format!("{} m", number("range_max_m", 1.0, 1))),
        ("Velocity resolution", format!("{} m/s", number("velocity_resolution_mps", 1.0, 3))),
        ("Maximum unambiguous velocity", format!("{} m/s", number("velocity_max_mps", 1.0, 2))),
        ("Velocity of some target aliased", aliased(frames)),
        ("Detected points, frame 0", points.to_string()),
    ];
    html! {
        h3 { "Radar" }
        (scrolled("Radar", html! { table { tbody { @for (name, value) in rows { tr { th { (name) } td { (value) } } } } } }))
    }
}

/// In which frames the map shows a target's velocity folded.
fn aliased(frames: &[&Value]) -> String {
    let folded: Vec<usize> = (0..frames.len()).filter(|i| frames[*i]["rdm_state"] == "abnormal").collect();
    match (folded.len(), frames.len()) {
        (0, _) => "no".into(),
        (1, 1) => "yes".into(),
        (some, all) => format!("in {some} of {all} frames"),
    }
}

/// What was found of the targets over all frames, and in which lane.
pub(super) fn scene(frames: &[&Value]) -> Markup {
    let all = || frames.iter().flat_map(|frame| frame["targets"].as_array().into_iter().flatten());
    let count = |of: &dyn Fn(&&Value) -> bool| all().filter(|target| of(target)).count();
    let is_seen = |t: &&Value| !t["truth"]["nearest_range_m"].is_null();
    let is_found = |t: &&Value| !t["estimate"].is_null();
    let in_lane = |t: &&Value| is_found(t) && !t["truth"]["lane"].is_null();
    let lane_is_right = |t: &&Value| in_lane(t) && t["estimate"]["lane"] == t["truth"]["lane"];
    let share = |part: usize, of: usize| format!("{part} of {of}");
    let rows = [
        ("Bodies in view, frame by frame", all().count().to_string()),
        ("With a lit surface", share(count(&is_seen), all().count())),
        ("Found, of those with a lit surface", share(count(&|t| is_seen(t) && is_found(t)), count(&is_seen))),
        ("In the right lane, of those found in a lane", share(count(&lane_is_right), count(&in_lane))),
    ];
    scrolled(
        "The whole scene",
        html! { table { tbody { @for (name, value) in rows { tr { th { (name) } td { (value) } } } } } },
    )
}

/// Truth beside estimate with the error, a row per target.
pub(super) fn targets(frame: &Value) -> Markup {
    let targets = frame["targets"].as_array().cloned().unwrap_or_default();
    let table = html! { table {
        thead { tr {
            th { "target" } th { "range, m" } th { "true" } th { "error" } th { "velocity, m/s" } th { "true" } th { "error" }
            th { "x, m" } th { "true" } th { "error" } th { "lane" } th { "true" } th { "SNR, dB" } th { "points" }
            th { "multipath ghost share" }
        } }
        tbody { @for target in &targets { (target_row(target)) } }
    } };
    scrolled("Truth beside estimate", table)
}

fn target_row(target: &Value) -> Markup {
    let (truth, estimate) = (&target["truth"], &target["estimate"]);
    let id = target["id"].as_str().unwrap_or_default();
    if estimate.is_null() {
        let is_missed = target["found"] == true || target["found"] == false;
        let words = match (is_missed, target["removed"] == true) {
            (true, _) => "missed",
            (_, true) => "removed with the echoes at rest, as static in [dsp] asks",
            _ => "not to be found: hidden, without an echo of its own, or out of range",
        };
        return html! { tr { td { (id) } td.words.bad[is_missed] colspan="14" { (words) } } };
    }
    let range = if truth["echo_range_m"].is_null() { &truth["range_m"] } else { &truth["echo_range_m"] };
    let echo = &truth["echo_radial_velocity_mps"];
    let velocity = if echo.is_null() { &truth["radial_velocity_mps"] } else { echo };
    let wrong_lane = estimate["lane"] != truth["lane"];
    html! { tr {
        td { (id) }
        (compared(&estimate["range_m"], range, 2))
        (compared(&estimate["radial_velocity_mps"], velocity, 3))
        (compared(&estimate["x_m"], &truth["x_m"], 2))
        td.bad[wrong_lane] { (whole(&estimate["lane"])) } td { (whole(&truth["lane"])) }
        td { (rounded(&estimate["snr_db"], 1)) } td { (whole(&estimate["points"])) }
        td { (rounded(&estimate["ghost_share"], 2)) }
    } }
}

fn compared(estimate: &Value, truth: &Value, digits: usize) -> Markup {
    let error = estimate.as_f64().zip(truth.as_f64()).map(|(e, t)| e - t);
    let error = error.map_or("–".into(), |e| format!("{e:+.digits$}").replace('-', "−"));
    html! { td { (rounded(estimate, digits)) } td { (rounded(truth, digits)) } td { (error) } }
}

/// Probabilities as bars, a row per vehicle.
pub(super) fn classes(frame: &Value) -> Markup {
    let targets = frame["targets"].as_array().cloned().unwrap_or_default();
    let table = html! { table {
        thead { tr {
            th { "target" } th.words { "true class" } th.words { "predicted class" } th.words { "predicted by track" }
            @for c in CLASSES { th.words { "probability of " (c) } }
        } }
        tbody { @for target in targets.iter().filter(|t| !t["class"].is_null()) { (class_row(target)) } }
    } };
    scrolled("Classes", table)
}

const CLASSES: [&str; 4] = ["car", "bus", "truck", "motorcycle"];

fn class_row(target: &Value) -> Markup {
    let wrong = target["predicted_class"] != target["class"];
    let wrong_by_track = !target["track_class"].is_null() && target["track_class"] != target["class"];
    html! { tr {
        td { (target["id"].as_str().unwrap_or_default()) }
        td.words { (target["class"].as_str().unwrap_or("–")) }
        td.words.bad[wrong] { (target["predicted_class"].as_str().unwrap_or("–")) }
        td.words.bad[wrong_by_track] { (target["track_class"].as_str().unwrap_or("–")) }
        @for class in CLASSES { td.words { (bar(&target["probabilities"][class])) } }
    } }
}

fn bar(probability: &Value) -> Markup {
    match probability.as_f64() {
        Some(p) => html! { span.bar style=(format!("width:{:.2}em", 4.0 * p)) {} (format!("{p:.3}")) },
        None => html! { "–" },
    }
}

/// Numerical error by source and what the model leaves out, dB.
pub(super) fn errors(frame: &Value) -> Markup {
    let rows = |group: &str| {
        let entries = frame[group].as_object().cloned().unwrap_or_default();
        entries.into_iter().map(|(name, value)| (name.replace('_', " "), value)).collect::<Vec<_>>()
    };
    let table = html! { table {
        thead { tr { th { "relative to the echo" } th { "dB" } } }
        tbody {
            @for (name, value) in rows("error_db") { tr { td { (name) } td { (rounded_or(&value, 1, "not estimated")) } } }
            @for (name, value) in rows("model_error_db") { tr { td { "model: " (name) } td { (rounded_or(&value, 1, "not estimated")) } } }
        }
    } };
    scrolled("Error budget", table)
}

/// Seconds by stage, memory at most.
pub(super) fn costs(frame: &Value) -> Markup {
    let stages = frame["stage_seconds"].as_object().cloned().unwrap_or_default();
    let cached = frame["cached"].as_array().cloned().unwrap_or_default();
    let table = html! { table {
        thead { tr { th { "stage" } th { "seconds" } th { "" } } }
        tbody {
            @for (stage, seconds) in &stages {
                tr { td { (stage.replace('_', "-")) } td { (rounded(seconds, 3)) }
                    td { @if cached.iter().any(|c| c == stage) { "cached" } } }
            }
            tr { td { "paths" } td { (whole(&frame["paths"])) } td {} }
            tr { td { "memory, MiB" } td { (rounded_or(&frame["peak_memory_mib"], 0, "–")) }
                td { "at most; " (rounded(&frame["memory_estimate_mib"], 0)) " said before" } }
        }
    } };
    scrolled("What each stage cost", table)
}

/// A number with so many digits; a dash where there is none.
pub(super) fn rounded(value: &Value, digits: usize) -> String {
    rounded_or(value, digits, "–")
}

fn rounded_or(value: &Value, digits: usize, otherwise: &str) -> String {
    value.as_f64().map_or(otherwise.into(), |v| format!("{v:.digits$}").replace('-', "−"))
}

fn scaled(value: &Value, factor: f64, digits: usize) -> String {
    value.as_f64().map_or("–".into(), |v| format!("{:.digits$}", v * factor))
}

pub(super) fn whole(value: &Value) -> String {
    value.as_i64().map_or("–".into(), |v| v.to_string())
}
