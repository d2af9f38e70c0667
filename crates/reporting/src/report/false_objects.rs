//! Tables of objects that belong to no body, with their causes.

use crate::report::tables::{rounded, scrolled};
use maud::{Markup, html};
use pipeline::outcome::summary::{Cause, FalseObject};

/// Tables with one row per false object, and per object marked as at rest; `of` completes the headings.
pub(super) fn section(of: &str, objects: &[FalseObject], standing: &[FalseObject]) -> Markup {
    let headings =
        ["False objects", "Objects at rest that belong to no body"].map(|what| format!("{what}{of}"));
    html! {
        h3 { (headings[0]) }
        @match (objects, standing) {
            ([], []) => p { "None: every object belongs to a body." },
            ([], _) => p { "None: every moving object belongs to a body." },
            _ => {
                (table(&headings[0], objects))
                @if objects.iter().any(is_unmarked_ghost) {
                    p { "What made an object is the truth; the share of its power that is marked as ghost is the \
                         radar's own word. It marks waves that leave by one direction and come back by another; \
                         those of three bounces that come back as they left look like a body's echo to it." }
                }
            }
        }
        @if !standing.is_empty() {
            h3 { (headings[1]) }
            p { "The radar reports them as static and assigns them to no vehicle, so they do not count as false." }
            (table(&headings[1], standing))
        }
    }
}

/// Whether a false object is truly a multipath ghost, but most of its power is not marked as one by the
/// radar.
fn is_unmarked_ghost(object: &FalseObject) -> bool {
    object.cause == Cause::Ghost && object.ghost_share.is_some_and(|share| share < 0.5)
}

fn table(name: &str, objects: &[FalseObject]) -> Markup {
    let table = html! { table {
        thead { tr {
            th { "object" } th.words { "what made it" } th { "range, m" } th { "velocity, m/s" } th { "x, m" } th { "y, m" }
            th { "SNR, dB" } th { "share marked as ghost" }
        } }
        tbody { @for object in objects { (row(object)) } }
    } };
    scrolled(name, table)
}

fn row(object: &FalseObject) -> Markup {
    html! { tr {
        td { "#" (object.object) }
        td.words { (object.cause_in_words()) }
        td { (rounded(object.range_m, 2)) } td { (rounded(object.radial_velocity_mps, 3)) }
        td { (rounded(object.x_m, 2)) } td { (rounded(object.y_m, 2)) } td { (rounded(object.snr_db, 1)) }
        td { (rounded(object.ghost_share, 2)) }
    } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_false_object_says_what_made_it() {
        let of = |object, cause, bodies: &[&str], bounces| FalseObject {
            object,
            cause,
            bodies: bodies.iter().map(|id| (*id).to_owned()).collect(),
            bounces: Some(bounces),
            ..FalseObject::default()
        };
        let text = section("", &[of(3, Cause::Ghost, &["bus-1", "truck-1"], 2)], &[]).into_string();
        for said in ["#3", "multipath ghost by bus-1 and truck-1, 2 bounces", "<td>–</td>"] {
            assert!(text.contains(said), "{said}: {text}");
        }
        assert!(!text.contains("the radar's own word"), "no share is told: {text}");
        assert!(section("", &[], &[]).into_string().contains("None"));
        let unmarked =
            FalseObject { ghost_share: Some(0.0), ..of(1, Cause::Ghost, &["car-1", "truck-1"], 3) };
        let text = section("", &[unmarked], &[]).into_string();
        assert!(text.contains("the radar's own word"), "{text}");
        let text = section(" of east", &[], &[of(5, Cause::Clutter, &["rail"], 1)]).into_string();
        assert!(
            text.contains("every moving object belongs to a body") && text.contains("clutter: rail"),
            "{text}"
        );
        assert!(text.contains("<h3>False objects of east</h3>"), "{text}");
    }
}
