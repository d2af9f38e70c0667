//! Section on the error of each target's own echo, and its effect on the estimate.

use crate::report::tables::{rounded, scrolled};
use maud::{Markup, html};
use pipeline::outcome::summary::{EchoError, TargetSummary};

/// Section on a frame's targets; empty if no error of a target was measured.
pub(super) fn section(targets: &[TargetSummary]) -> Markup {
    let known: Vec<_> = targets.iter().filter_map(|target| Some((&target.id, target.error?))).collect();
    let heading = "Error of each target's echo";
    html! {
        @if !known.is_empty() {
            h3 { (heading) }
            (scrolled(heading, html! { table {
                thead { tr {
                    th { "target" } th { "echo, dB" } th { "range, ± m" }
                    th { "velocity, ± m/s" } th { "across, ± m" }
                } }
                tbody { @for (id, error) in &known { (row(id, error)) } }
            } }))
            p { "Numerical error relative to the target's own echo, and the standard errors that it causes in "
                "the estimates, to first order. Noise and what the model leaves out add to them." }
        }
    }
}

fn row(id: &str, error: &EchoError) -> Markup {
    html! { tr {
        td { (id) } td { (rounded(error.echo_db, 1)) } td { (rounded(error.range_m, 3)) }
        td { (rounded(error.radial_velocity_mps, 4)) } td { (rounded(error.across_m, 3)) }
    } }
}
