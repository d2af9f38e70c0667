//! Section on the requested and the reached accuracy of a frame.

use crate::report::tables::{rounded, scrolled};
use maud::{Markup, html};
use pipeline::outcome::verdict::AccuracyVerdict;

/// Section on an accuracy: request, result, limit and remedy; `of` completes the heading.
pub(super) fn section(of: &str, accuracy: &AccuracyVerdict) -> Markup {
    let (words, is_missed) = match accuracy.met {
        Some(true) => ("yes", false),
        Some(false) => ("no", true),
        None => ("unknown: some sources were not estimated", false),
    };
    let level = |db: Option<f64>| db.map_or("not estimated".into(), |db| format!("{} dB", rounded(db, 1)));
    let heading = format!("Accuracy asked and reached{of}");
    let asked_for = accuracy.goal.map_or(String::new(), |goal| format!(", for \"{}\"", goal.name()));
    let rows = html! { table { tbody {
        tr { th { "Asked" } td { (rounded(accuracy.asked_db, 1)) " dB" (asked_for) } }
        @if accuracy.planned_db.is_some() {
            tr { th { "Planned for what is computed" } td { (level(accuracy.planned_db)) } }
        }
        tr { th { "Reached" } td.bad[is_missed] { (accuracy.reached_in_words()) } }
        tr { th { "As good as asked" } td.bad[is_missed] { (words) } }
        tr { th { "Largest share" } td { (accuracy.limited_by.as_deref().unwrap_or("–")) } }
        tr { th { "Useful beside the model's own error" } td { (level(accuracy.of_use_db)) } }
    } } };
    html! {
        h3 { (heading) }
        (scrolled(&heading, rows))
        @if let Some(advice) = &accuracy.advice { p { (advice) } }
    }
}
