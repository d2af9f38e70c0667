//! The report's page on tracks: how objects and tracks agree with the truth over all frames.

use crate::report::tables::{rounded, scrolled, whole};
use maud::{Markup, html};
use serde_json::Value;

/// Metrics of `summary.json` as a table: a column for the objects of single frames, one for tracks.
pub(super) fn section(metrics: &Value) -> Markup {
    let (objects, tracks, identities) = (&metrics["objects"], &metrics["tracks"], &metrics["identities"]);
    let numbers = [
        ("GOSPA, m", "gospa_m", 2),
        ("OSPA, m", "ospa_m", 2),
        ("Error of places found, m rms", "localisation_rms_m", 2),
    ];
    let counts = [("Found, frame by frame", "found"), ("Missed", "missed"), ("False", "false")];
    let table = html! { table {
        thead { tr { th { "mean over frames" } th { "objects" } th { "tracks" } } }
        tbody {
            @for (name, key, digits) in numbers {
                tr { td { (name) } td { (rounded(&objects[key], digits)) } td { (rounded(&tracks[key], digits)) } }
            }
            @for (name, key) in counts { tr { td { (name) } td { (whole(&objects[key])) } td { (whole(&tracks[key])) } } }
            tr { td { "Lane right, of those found in a lane" }
                td { (rounded(&objects["lane_rate"], 3)) } td { (rounded(&tracks["lane_rate"], 3)) } }
            tr { td { "Bodies that had a track; tracks" }
                td {} td { (whole(&identities["bodies"])) "; " (whole(&identities["tracks"])) } }
            tr { td { "Changes of a body's track" } td {} td { (whole(&identities["switches"])) } }
            tr { td { "Purity of tracks" } td {} td { (rounded(&identities["purity"], 3)) } }
        }
    } };
    html! {
        section {
            h2 { "Objects and tracks" }
            (scrolled("Objects and tracks", table))
            p { "GOSPA (α = 2) and OSPA with p = 2 and a cut-off of " (rounded(&tracks["cutoff_m"], 1)) " m for tracks, from the middles of "
                "their boxes, and " (rounded(&objects["cutoff_m"], 1)) " m for objects, from the nearest part of a body." }
        }
    }
}
