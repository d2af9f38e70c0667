//! Section on the plan of a scene's physics: the modelled and the omitted parts, with their shares in the
//! echo.

use crate::report::tables::scrolled;
use maud::{Markup, html};
use pipeline::planning::plan_figures::{PartFigures, PlanFigures, level};

/// Section on a plan: the request, its use, and every part of the physics.
pub(super) fn section(plan: &PlanFigures) -> Markup {
    let heading = "Plan of the physics";
    html! {
        h3 { (heading) }
        p { "The " (plan.first_line()) ". Left out in all: " (level(Some(plan.left_out_db)))
            " of the echo; integrals, cells and echo: " (level(Some(plan.numerical_db))) "." }
        (scrolled(heading, html! { table {
            thead { tr { th { "Part" } th { "Share of the echo" } th { "In this run" } } }
            tbody { @for part in &plan.parts { (row(part)) } }
        } }))
    }
}

fn row(part: &PartFigures) -> Markup {
    html! { tr { th { (part.name) } td { (level(part.share_db)) } td { (part.verdict()) } } }
}
