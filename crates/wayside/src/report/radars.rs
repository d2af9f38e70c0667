//! The page of a scene with several radars: the scene as all have it, and the way to each radar's own report.

use crate::report::made::{Making, made};
use crate::report::page::{figure, sheet};
use crate::report::tables::{rounded, scrolled, whole};
use maud::{Markup, html};
use plotting::form::Figure;
use serde_json::Value;
use std::path::Path;

/// Frames whose targets are listed: a page of more opens slowly.
const FRAMES_TOLD: usize = 24;

/// The whole page; `out` is the folder in which it will lie.
pub(super) fn page(summary: &Value, views: &[Figure], making: &Making, out: &Path) -> String {
    let name = summary["scene"].as_str().unwrap_or_default();
    let frames: Vec<&Value> = summary["frames"].as_array().into_iter().flatten().collect();
    sheet(
        name,
        html! {
            p.lead { (lead(&frames)) }
            (made(making, out))
            (radars(summary))
            @for (number, view) in views.iter().enumerate() {
                @let caption = format!("Frame {number}: truth; points and objects in the colour of the radar that found them.");
                (figure(&caption, view))
            }
            @for (number, frame) in frames.iter().take(FRAMES_TOLD).enumerate() { (targets(number, frame)) }
            footer { "Each radar's noise is its own, drawn from the scene's seed and its name." }
        },
    )
}

fn lead(frames: &[&Value]) -> String {
    let targets = || frames.iter().flat_map(|frame| frame["targets"].as_array().into_iter().flatten());
    let found_by =
        |least: usize| targets().filter(|t| t["found_by"].as_array().map_or(0, Vec::len) >= least).count();
    let (all, some, several) = (targets().count(), found_by(1), found_by(2));
    let over = if frames.len() == 1 { "one frame".into() } else { format!("{} frames", frames.len()) };
    format!("{some} of {all} targets found by some radar in {over}, {several} by two or more.")
}

fn radars(summary: &Value) -> Markup {
    let radars: Vec<&Value> = summary["radars"].as_array().into_iter().flatten().collect();
    let table = html! { table {
        thead { tr {
            th { "radar" } th { "found" } th { "missed" } th { "false objects" } th { "points" } th { "largest error, dB" }
            th { "seconds" }
        } }
        tbody {
            @for radar in radars {
                @let id = radar["id"].as_str().unwrap_or_default();
                tr {
                    td { a href={ (id) "/report.html" } { (id) } }
                    td { (whole(&radar["found"])) }
                    td.bad[radar["missed"] != 0] { (whole(&radar["missed"])) }
                    td { (whole(&radar["false"])) }
                    td { (whole(&radar["points"])) }
                    td { (rounded(&radar["largest_error_db"], 1)) }
                    td { (rounded(&radar["frames_seconds"], 2)) }
                }
            }
        }
    } };
    scrolled("Radars", table)
}

fn targets(number: usize, frame: &Value) -> Markup {
    let targets: Vec<&Value> = frame["targets"].as_array().into_iter().flatten().collect();
    let by = |names: &Value| {
        let names: Vec<&str> = names.as_array().into_iter().flatten().filter_map(Value::as_str).collect();
        if names.is_empty() { "–".to_owned() } else { names.join(", ") }
    };
    let table = html! { table {
        thead { tr { th { "target" } th.words { "true class" } th.words { "found by" } th.words { "missed by" } } }
        tbody {
            @for target in targets {
                tr {
                    td { (target["id"].as_str().unwrap_or_default()) }
                    td.words { (target["class"].as_str().unwrap_or("–")) }
                    td.words { (by(&target["found_by"])) } td.words { (by(&target["missed_by"])) }
                }
            }
        }
    } };
    html! {
        h2 { "Frame " (number) " at " (rounded(&frame["time_s"], 3)) " s" }
        (scrolled(&format!("Targets of frame {number}"), table))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_radars_row_has_a_cell_under_every_heading() {
        let radar = json!({ "id": "north", "found": 1, "missed": 2, "false": 3, "points": 11, "largest_error_db": -13.4 });
        let table = radars(&json!({ "radars": [radar] })).into_string();
        assert_eq!(table.matches("<td").count(), table.matches("<th>").count(), "{table}");
        assert!(table.contains("<td class=\"bad\">2</td><td>3</td><td>11</td>"), "{table}");
    }
}
