//! What was asked of a frame and what was reached.

use crate::report::tables::{rounded, scrolled};
use maud::{Markup, html};
use serde_json::Value;

/// Asked, reached, what limits it and what would help; nothing where the summary does not tell.
pub(super) fn section(frame: &Value) -> Markup {
    let accuracy = &frame["accuracy"];
    if accuracy.is_null() {
        return html! {};
    }
    let (words, is_missed) = match accuracy["met"].as_bool() {
        Some(true) => ("yes", false),
        Some(false) => ("no", true),
        None => ("not known: not all of it was estimated", false),
    };
    let rows = html! { table { tbody {
        tr { th { "Asked" } td { (rounded(&accuracy["asked_db"], 1)) " dB" } }
        tr { th { "Reached" } td.bad[is_missed] { (reached(accuracy)) } }
        tr { th { "As good as asked" } td.bad[is_missed] { (words) } }
        tr { th { "Largest share" } td { (accuracy["limited_by"].as_str().unwrap_or("–")) } }
    } } };
    html! {
        h3 { "Accuracy asked and reached" }
        (scrolled("Accuracy asked and reached", rows))
        @if let Some(advice) = accuracy["advice"].as_str() { p { (advice) } }
    }
}

fn reached(accuracy: &Value) -> String {
    match accuracy["reached_db"].is_null() {
        true => "not estimated".into(),
        false => format!("{} dB", rounded(&accuracy["reached_db"], 1)),
    }
}
