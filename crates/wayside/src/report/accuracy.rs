//! Section on the accuracy that was asked of a frame and the one that was reached.

use crate::outcome::verdict::AccuracyVerdict;
use crate::report::tables::{rounded, scrolled};
use maud::{Markup, html};

/// Section on an accuracy: asked, reached, what limits it and what would help.
pub(super) fn section(accuracy: &AccuracyVerdict) -> Markup {
    let (words, is_missed) = match accuracy.met {
        Some(true) => ("yes", false),
        Some(false) => ("no", true),
        None => ("not known: not all of it was estimated", false),
    };
    let level = |db: Option<f64>| db.map_or("not estimated".into(), |db| format!("{} dB", rounded(db, 1)));
    let reached = level(accuracy.reached_db);
    let asked_for = accuracy.goal.map_or(String::new(), |goal| format!(", for \"{}\"", goal.name()));
    let rows = html! { table { tbody {
        tr { th { "Asked" } td { (rounded(accuracy.asked_db, 1)) " dB" (asked_for) } }
        tr { th { "Reached" } td.bad[is_missed] { (reached) } }
        tr { th { "As good as asked" } td.bad[is_missed] { (words) } }
        tr { th { "Largest share" } td { (accuracy.limited_by.as_deref().unwrap_or("–")) } }
        tr { th { "Of use beside the model's method" } td { (level(accuracy.of_use_db)) } }
    } } };
    html! {
        h3 { "Accuracy asked and reached" }
        (scrolled("Accuracy asked and reached", rows))
        @if let Some(advice) = &accuracy.advice { p { (advice) } }
    }
}
