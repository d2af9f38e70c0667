//! The page of a scene with several radars: the scene as all have it, and the way to each radar's own report.

use super::page::{figure, sheet};
use super::tables::{rounded, whole};
use crate::pictures::Svg;
use maud::{Markup, html};
use serde_json::Value;

/// Frames whose targets are listed: a page of more opens slowly.
const FRAMES_TOLD: usize = 24;

/// The whole page.
pub(super) fn page(summary: &Value, views: &[Svg]) -> String {
    let name = summary["scene"].as_str().unwrap_or_default();
    let frames: Vec<&Value> = summary["frames"].as_array().into_iter().flatten().collect();
    sheet(
        name,
        html! {
            p.lead { (lead(&frames)) }
            (radars(summary))
            @for (number, view) in views.iter().enumerate() {
                (figure(&format!("Frame {number}: outlines are the truth; points and objects (rings) in the colour of their radar"), view))
            }
            @for (number, frame) in frames.iter().take(FRAMES_TOLD).enumerate() { (targets(number, frame)) }
            footer { "Each radar's noise is its own, drawn from the scene's seed and its name." }
        },
    )
}

fn lead(frames: &[&Value]) -> String {
    let targets = || frames.iter().flat_map(|frame| frame["targets"].as_array().into_iter().flatten());
    let found_by = |least: usize| targets().filter(|t| t["found_by"].as_array().map_or(0, Vec::len) >= least).count();
    let (all, some, several) = (targets().count(), found_by(1), found_by(2));
    format!("{some} of {all} targets found by some radar in {} frames, {several} by two or more.", frames.len())
}

fn radars(summary: &Value) -> Markup {
    let radars: Vec<&Value> = summary["radars"].as_array().into_iter().flatten().collect();
    html! {
        div.scroll { table {
            thead { tr { th { "radar" } th { "targets found" } th { "points" } th { "largest error, dB" } th { "seconds" } } }
            tbody {
                @for radar in radars {
                    @let id = radar["id"].as_str().unwrap_or_default();
                    tr {
                        td { a href={ (id) "/report.html" } { (id) } }
                        td { (whole(&radar["found"])) " of " (whole(&radar["targets"])) }
                        td { (whole(&radar["points"])) }
                        td { (rounded(&radar["largest_error_db"], 1)) }
                        td { (rounded(&radar["frames_seconds"], 2)) }
                    }
                }
            }
        } }
    }
}

fn targets(number: usize, frame: &Value) -> Markup {
    let targets: Vec<&Value> = frame["targets"].as_array().into_iter().flatten().collect();
    let by = |target: &Value| {
        let names: Vec<&str> = target["found_by"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
        if names.is_empty() { "no radar".to_owned() } else { names.join(", ") }
    };
    html! {
        h2 { "Frame " (number) " at " (rounded(&frame["time_s"], 3)) " s" }
        div.scroll { table {
            thead { tr { th { "target" } th { "class" } th { "found by" } } }
            tbody {
                @for target in targets {
                    tr {
                        td { (target["id"].as_str().unwrap_or_default()) }
                        td { (target["class"].as_str().unwrap_or("–")) }
                        td { (by(target)) }
                    }
                }
            }
        } }
    }
}
