//! The report's tables, filled from the summary alone.

use crate::console_lines;
use artifact::settings::Class;
use maud::{Markup, html};
use pipeline::outcome::summary::{FrameSummary, MapState, Predicted, RadarSummary, Stage, TargetSummary};
use std::fmt::Display;

/// A table that scrolls on a narrower page, also by keys; its first column stays.
pub fn scrolled(name: &str, table: Markup) -> Markup {
    html! { div.scroll tabindex="0" role="region" aria-label=(name) { (table) } }
}

/// Table of the radar's parameters in standard terms (the paper's Table 2).
pub(super) fn radar(radar: &RadarSummary, frames: &[FrameSummary]) -> Markup {
    let rows = [
        ("Carrier (centre of the sweep)", format!("{:.4} GHz", radar.carrier_hz * 1e-9)),
        ("Bandwidth", format!("{:.4} GHz", radar.bandwidth_hz * 1e-9)),
        ("Chirp interval", format!("{:.1} µs", radar.chirp_interval_s * 1e6)),
        ("Samples per chirp", radar.samples_per_chirp.to_string()),
        ("Chirps per frame × channels", format!("{} × {}", radar.chirps, radar.channels)),
        ("Range resolution", format!("{:.2} m", radar.range_resolution_m)),
        ("Maximum unambiguous range", format!("{:.1} m", radar.range_max_m)),
        ("Velocity resolution", format!("{:.3} m/s", radar.velocity_resolution_mps)),
        ("Maximum unambiguous velocity", format!("{:.2} m/s", radar.velocity_max_mps)),
        ("Velocity of some target aliased", aliased(frames)),
        ("Detected points, frame 0", whole(frames.first().map(|frame| frame.points))),
    ];
    html! {
        h3 { "Radar" }
        (scrolled("Radar", html! { table { tbody {
            @for (name, value) in rows { tr { th { (name) } td { (value) } } }
        } } }))
    }
}

/// Number of frames in whose maps a target's velocity is aliased, as text.
fn aliased(frames: &[FrameSummary]) -> String {
    let folded = frames.iter().filter(|frame| frame.rdm_state == MapState::Abnormal).count();
    match (folded, frames.len()) {
        (0, _) => "no".into(),
        (1, 1) => "yes".into(),
        (some, all) => format!("in {some} of {all} frames"),
    }
}

/// Table of the targets found over all frames, with their lanes.
pub(super) fn scene(radar: &RadarSummary, frames: &[FrameSummary]) -> Markup {
    let all = || frames.iter().flat_map(|frame| &frame.targets);
    let count = |of: &dyn Fn(&TargetSummary) -> bool| all().filter(|target| of(target)).count();
    let is_to_be_found = |t: &TargetSummary| t.found.is_some();
    let in_lane = |t: &TargetSummary| radar.tells_azimuth && t.estimate.is_some() && t.truth.lane.is_some();
    let lane_is_right = |t: &TargetSummary| in_lane(t) && t.estimate.is_some_and(|e| e.lane == t.truth.lane);
    let share = |part: usize, of: usize| format!("{part} of {of}");
    let rows = [
        ("Bodies in view, frame by frame", all().count().to_string()),
        ("To be found: with an echo, in range, not removed", share(count(&is_to_be_found), all().count())),
        ("Found, of these", share(count(&|t| t.found == Some(true)), count(&is_to_be_found))),
        ("In the right lane, of those found in a lane", share(count(&lane_is_right), count(&in_lane))),
    ];
    scrolled(
        "The whole scene",
        html! { table { tbody { @for (name, value) in rows { tr { th { (name) } td { (value) } } } } } },
    )
}

/// Table of truth, estimate and error, one row per target.
pub(super) fn targets(radar: &RadarSummary, targets: &[TargetSummary]) -> Markup {
    let table = html! { table {
        thead { tr {
            th { "target" } th { "range, m" } th { "true" } th { "error" }
            th { "velocity, m/s" } th { "true" } th { "error" }
            th { "x, m" } th { "true" } th { "error" } th { "lane" } th { "true" }
            th { "SNR, dB" } th { "points" } th { "share marked as ghost" }
        } }
        tbody { @for target in targets { (target_row(radar, target)) } }
    } };
    scrolled("Truth beside estimate", table)
}

fn target_row(radar: &RadarSummary, target: &TargetSummary) -> Markup {
    let (id, truth) = (&target.id, &target.truth);
    let Some(estimate) = &target.estimate else {
        let is_missed = target.found.is_some();
        let words = match (is_missed, target.removed) {
            (true, _) => "missed",
            (_, true) => "removed with the static clutter, as static in [dsp] asks",
            _ => "not detectable: hidden, without an echo of its own, or out of range",
        };
        return html! { tr { td { (id) } td.words.bad[is_missed] colspan="14" { (words) } } };
    };
    let is_wrong_lane = radar.tells_azimuth && estimate.lane != truth.lane;
    html! { tr {
        td { (id) }
        (compared(estimate.range_m, truth.compared_range_m(), 2))
        (compared(estimate.radial_velocity_mps, truth.compared_radial_velocity_mps(), 3))
        (compared(estimate.x_m, truth.x_m, 2))
        td.bad[is_wrong_lane] { (whole(estimate.lane)) } td { (whole(truth.lane)) }
        td { (rounded(estimate.snr_db, 1)) } td { (estimate.points) }
        td { (rounded(estimate.ghost_share, 2)) }
    } }
}

fn compared(estimate: f64, truth: f64, digits: usize) -> Markup {
    let error = format!("{:+.digits$}", estimate - truth).replace('-', "−");
    html! { td { (rounded(estimate, digits)) } td { (rounded(truth, digits)) } td { (error) } }
}

/// Table of probabilities as bars, one row per vehicle.
pub(super) fn classes(targets: &[TargetSummary]) -> Markup {
    let vehicles = targets.iter().filter_map(|target| Some((target, target.class?)));
    let table = html! { table {
        thead { tr {
            th { "target" } th.words { "true class" } th.words { "predicted class" }
            th.words { "predicted by track" }
            @for class in Class::ALL { th.words { "probability of " (class.name()) } }
        } }
        tbody { @for (target, class) in vehicles { (class_row(target, class)) } }
    } };
    scrolled("Classes", table)
}

fn class_row(target: &TargetSummary, class: Class) -> Markup {
    let (in_frame, by_track) = (target.predicted_class, target.track_class);
    let right = Predicted::Class(class);
    html! { tr {
        td { (target.id) }
        td.words { (class.name()) }
        td.words.bad[in_frame != Some(right)] { (in_frame.map_or("–", Predicted::name)) }
        td.words.bad[by_track.is_some_and(|told| told != right)] { (by_track.map_or("–", Predicted::name)) }
        @for class in Class::ALL { td.words { (bar(target.probabilities.of_class(class))) } }
    } }
}

fn bar(probability: Option<f64>) -> Markup {
    match probability {
        Some(p) => html! { span.bar style=(format!("width:{:.2}em", 4.0 * p)) {} (format!("{p:.3}")) },
        None => html! { "–" },
    }
}

/// Table of the numerical error by source and of the model's errors, dB; parts with a level only.
pub(super) fn errors(frame: &FrameSummary) -> Markup {
    let numerical = frame.error_db.shares().into_iter().chain([("total", frame.error_db.total)]);
    let known = numerical.filter_map(|(name, db)| Some((name, db?)));
    let of_model = frame.model_error_db.sources().into_iter().filter_map(|(name, db)| Some((name, db?)));
    let table = html! { table {
        thead { tr { th { "relative to the echo" } th { "dB" } } }
        tbody {
            @for (name, db) in known { tr { td { (name) } td { (rounded(db, 1)) } } }
            @if let Some(db) = frame.model_error_db.small_parts {
                tr { td { "model: small parts drawn at random" } td { (rounded(db, 1)) } }
            }
            @for (name, db) in of_model { tr { td { "model: " (name) } td { (rounded(db, 1)) } } }
            @if console_lines::higher_orders_unknown(frame) {
                tr { td { "model: bounces" } td { "not estimated (one order alone)" } }
            }
        }
    } };
    html! {
        (scrolled("Error budget", table))
        p { "Sources without a row contribute no error or were not estimated." }
        @if console_lines::shading_left_out(frame) {
            p { "RCS tables describe each body alone: mutual shadowing is neglected and its error not estimated." }
        }
    }
}

/// Table of the seconds by stage and the peak memory.
pub(super) fn costs(frame: &FrameSummary) -> Markup {
    let mut stages: Vec<(Stage, f64)> = frame.stage_seconds.iter().map(|(stage, s)| (*stage, *s)).collect();
    stages.sort_by_key(|(stage, _)| stage.name());
    let table = html! { table {
        thead { tr { th { "stage" } th { "seconds" } th { "" } } }
        tbody {
            @for (stage, seconds) in &stages {
                tr { td { (stage.name().replace('_', "-")) } td { (rounded(*seconds, 3)) }
                    td { @if frame.cached.contains(stage) { "cached" } } }
            }
            tr { td { "paths" } td { (whole(frame.paths)) } td {} }
            tr { td { "memory, MiB" } td { (rounded(frame.peak_memory_mib, 0)) }
                td { "at most; " (rounded(frame.memory_estimate_mib, 0)) " predicted" } }
        }
    } };
    scrolled("What each stage cost", table)
}

/// A number with the given number of digits; a dash for `None`.
pub(super) fn rounded(value: impl Into<Option<f64>>, digits: usize) -> String {
    value.into().map_or("–".into(), |v| format!("{v:.digits$}").replace('-', "−"))
}

fn whole(value: Option<impl Display>) -> String {
    value.map_or("–".into(), |v| v.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use pipeline::outcome::summary::{Estimate, TruthSummary};

    /// Summary of a radar whose array tells an azimuth or not.
    fn radar(tells_azimuth: &str) -> RadarSummary {
        let numbers = "\"carrier_hz\":77e9,\"bandwidth_hz\":6e8,\"chirp_interval_s\":6e-5,\
                       \"samples_per_chirp\":256,\"chirps\":128,\"channels\":1,\"element_errors\":null,\
                       \"range_resolution_m\":0.24,\"range_max_m\":61.0,\"velocity_resolution_mps\":0.25,\
                       \"velocity_max_mps\":16.0,\"sample_rate_hz\":5e6,\"sampling\":\"complex\"";
        serde_json::from_str(&format!("{{{numbers},\"tells_azimuth\":{tells_azimuth}}}")).unwrap()
    }

    /// A target in lane 1 whose object is in none.
    fn target() -> TargetSummary {
        let estimate = Estimate {
            range_m: 30.0,
            radial_velocity_mps: 0.0,
            x_m: 0.0,
            y_m: 30.0,
            z_m: 0.75,
            lane: None,
            snr_db: 20.0,
            points: 1,
            ghost_share: None,
            stationary: None,
        };
        let truth = TruthSummary { lane: Some(1), ..TruthSummary::default() };
        TargetSummary { truth, estimate: Some(estimate), found: Some(true), ..TargetSummary::default() }
    }

    #[test]
    fn no_lane_is_wrong_where_the_array_tells_no_azimuth() {
        let marked = |tells_azimuth| {
            let table = targets(&radar(tells_azimuth), &[target()]).into_string();
            table.contains("<td class=\"bad\">–</td><td>1</td>")
        };
        assert_eq!([marked("true"), marked("false")], [true, false]);
    }
}
