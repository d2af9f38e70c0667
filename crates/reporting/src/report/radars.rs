//! The page of a scene with several radars: the common scene, and links to each radar's own report.

use crate::report::accuracy;
use crate::report::false_objects;
use crate::report::page::{figure, sheet};
use crate::report::provenance_paragraph::{PICTURES, ReportOrigin, origin_paragraph};
use crate::report::tables::{rounded, scrolled};
use artifact::settings::Class;
use maud::{Markup, html};
use pipeline::outcome::summary::{CommonFrame, FrameSummary, RadarEntry, RadarsSummary, Summary};
use plotting::layout::Figure;

/// Number of frames with lists of targets: a page with more opens slowly.
const FRAMES_TOLD: usize = 24;

/// The whole page of radars, each with its id and summary.
pub(super) fn page(
    summary: &RadarsSummary,
    own: &[(&str, &Summary)],
    views: &[Figure],
    origin: &ReportOrigin,
) -> String {
    let frames = &summary.frames;
    let written: Vec<&str> =
        std::iter::once("summary.json").chain((!views.is_empty()).then_some(PICTURES)).collect();
    sheet(
        &summary.scene,
        html! {
            p.lead { (lead(frames)) }
            (origin_paragraph(origin, &written))
            (radars(&summary.radars))
            (accuracies(&summary.radars))
            @for (number, view) in views.iter().enumerate() {
                @let caption = format!("Frame {number}: truth; points and objects in the colour of the radar that found them.");
                (figure(&caption, view))
            }
            @for (number, frame) in frames.iter().take(FRAMES_TOLD).enumerate() {
                (targets(number, frame))
                (false_object_sections(number, summary, own))
            }
            footer { "Each radar's noise is its own, drawn from the scene's seed and its name." }
        },
    )
}

fn lead(frames: &[CommonFrame]) -> String {
    let targets = || frames.iter().flat_map(|frame| &frame.targets);
    let found_by = |least: usize| targets().filter(|target| target.found_by.len() >= least).count();
    let (all, some, several) = (targets().count(), found_by(1), found_by(2));
    let over = if frames.len() == 1 { "one frame".into() } else { format!("{} frames", frames.len()) };
    format!("{some} of {all} targets found by some radar in {over}, {several} by two or more.")
}

fn radars(radars: &[RadarEntry]) -> Markup {
    let table = html! { table {
        thead { tr {
            th { "radar" } th { "found" } th { "missed" } th { "false objects" } th { "points" }
            th { "largest error, dB" } th { "seconds" }
        } }
        tbody {
            @for radar in radars {
                tr {
                    td { a href={ (radar.id) "/report.html" } { (radar.id) } }
                    td { (radar.found) }
                    td.bad[radar.missed != 0] { (radar.missed) }
                    td { (radar.false_ones) }
                    td { (radar.points) }
                    td { (rounded(radar.largest_error_db, 1)) }
                    td { (rounded(radar.frames_seconds, 2)) }
                }
            }
        }
    } };
    scrolled("Radars", table)
}

/// Accuracy of each radar, in its frame of the largest error.
fn accuracies(radars: &[RadarEntry]) -> Markup {
    let of = |radar: &RadarEntry| match radar.frames {
        1 => format!(" of {}", radar.id),
        frames => format!(" of {}, in the worst of its {frames} frames", radar.id),
    };
    html! {
        @for radar in radars {
            @match &radar.accuracy {
                Some(told) => (accuracy::section(&of(radar), told)),
                None => p { "The numerical error of " (radar.id) " was not estimated." },
            }
        }
    }
}

/// Objects of a common frame that belong to no body, by radar and sub-frame, with their causes.
fn false_object_sections(number: usize, summary: &RadarsSummary, own: &[(&str, &Summary)]) -> Markup {
    let of = |id: &str, frame: &FrameSummary, frames: usize| match frames {
        1 => format!(" of {id}"),
        _ => format!(" of {id} at {} s", rounded(frame.time_s, 5)),
    };
    html! {
        @for (id, frames) in own.iter().map(|(id, own)| (id, summary.frames_of(number, own))) {
            @for frame in frames {
                @let of = of(id, frame, frames.len());
                (false_objects::section(&of, &frame.false_objects, &frame.stationary_objects))
            }
        }
    }
}

fn targets(number: usize, frame: &CommonFrame) -> Markup {
    let by = |names: &[String]| if names.is_empty() { "–".to_owned() } else { names.join(", ") };
    let table = html! { table {
        thead { tr {
            th { "target" } th.words { "true class" } th.words { "found by" } th.words { "missed by" }
        } }
        tbody {
            @for target in &frame.targets {
                tr {
                    td { (target.id) }
                    td.words { (target.class.map_or("–", Class::name)) }
                    td.words { (by(&target.found_by)) } td.words { (by(&target.missed_by)) }
                }
            }
        }
    } };
    html! {
        h2 { "Frame " (number) " at " (rounded(frame.time_s, 3)) " s" }
        (scrolled(&format!("Targets of frame {number}"), table))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pipeline::outcome::summary::AccuracyVerdict;

    #[test]
    fn a_radars_row_has_a_cell_under_every_heading() {
        let (found, missed, false_ones, points, largest_error_db) = (1, 2, 3, 11, Some(-13.4));
        let radar =
            RadarEntry { found, missed, false_ones, points, largest_error_db, ..RadarEntry::default() };
        let table = radars(&[radar]).into_string();
        assert_eq!(table.matches("<td").count(), table.matches("<th>").count(), "{table}");
        assert!(table.contains("<td class=\"bad\">2</td><td>3</td><td>11</td>"), "{table}");
    }

    #[test]
    fn every_radar_says_which_accuracy_it_reached_or_that_this_is_not_known() {
        let told = AccuracyVerdict { reached_db: Some(-3.6), met: Some(false), ..AccuracyVerdict::default() };
        let north =
            RadarEntry { id: "north".into(), frames: 2, accuracy: Some(told), ..RadarEntry::default() };
        let east = RadarEntry { id: "east".into(), frames: 2, ..RadarEntry::default() };
        let text = accuracies(&[north, east]).into_string();
        assert!(text.contains("reached of north, in the worst of its 2 frames</h3>"), "{text}");
        assert!(text.contains("−3.6 dB") && text.contains("The numerical error of east was not"), "{text}");
    }
}
