//! The report's section on tracks: agreement of objects and tracks with the truth over all frames.

use crate::report::tables::{rounded, scrolled};
use maud::{Markup, html};
use pipeline::outcome::summary::{Agreement, Metrics};

/// Name of a row, and its value for objects or tracks.
type Row<T> = (&'static str, fn(&Agreement) -> T);

/// Metrics of `summary.json` as a table: a column for the objects of single frames, one for tracks.
pub(super) fn section(metrics: &Metrics) -> Markup {
    let (objects, tracks, identities) = (&metrics.objects, &metrics.tracks, &metrics.identities);
    let numbers: [Row<Option<f64>>; 3] = [
        ("GOSPA, m", |of| of.gospa_m),
        ("OSPA, m", |of| of.ospa_m),
        ("Error of places found, m rms", |of| of.localisation_rms_m),
    ];
    let counts: [Row<usize>; 3] =
        [("Found, frame by frame", |of| of.found), ("Missed", |of| of.missed), ("False", |of| of.false_ones)];
    let table = html! { table {
        thead { tr { th { "mean over frames" } th { "objects" } th { "tracks" } } }
        tbody {
            @for (name, of) in numbers {
                tr { td { (name) } td { (rounded(of(objects), 2)) } td { (rounded(of(tracks), 2)) } }
            }
            @for (name, of) in counts { tr { td { (name) } td { (of(objects)) } td { (of(tracks)) } } }
            tr { td { "Lane right, of those found in a lane" }
                td { (rounded(objects.lane_rate, 3)) } td { (rounded(tracks.lane_rate, 3)) } }
            tr { td { "Bodies that had a track; tracks" }
                td {} td { (identities.bodies) "; " (identities.tracks) } }
            tr { td { "Changes of a body's track" } td {} td { (identities.switches) } }
            tr { td { "Purity of tracks" } td {} td { (rounded(identities.purity, 3)) } }
        }
    } };
    html! {
        section {
            h2 { "Objects and tracks" }
            (scrolled("Objects and tracks", table))
            p { "GOSPA (α = 2) and OSPA with p = 2 and a cut-off of " (rounded(tracks.cutoff_m, 1))
                " m for tracks, from the middles of their boxes, and " (rounded(objects.cutoff_m, 1))
                " m for objects, from the nearest part of a body." }
        }
    }
}
