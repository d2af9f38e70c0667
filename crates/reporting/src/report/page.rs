//! The page around the figures and tables.

use crate::pictures::FrameFigures;
use crate::report::accuracy;
use crate::report::echo_errors;
use crate::report::false_objects;
use crate::report::figures::Figures;
use crate::report::plan;
use crate::report::provenance_paragraph::{PICTURES, ReportOrigin, origin_paragraph};
use crate::report::tables;
use crate::report::tracks;
use crate::report::viewer;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use pipeline::host::safe_text;
use pipeline::outcome::summary::{Agreement, FrameSummary, Metrics, Summary};
use plotting::layout::Figure;

const STYLE: &str = include_str!("style.css");

/// The whole page.
pub(super) fn page(summary: &Summary, figures: &Figures, origin: &ReportOrigin) -> String {
    let (frames, metrics) = (&summary.frames[..], &summary.metrics);
    let written: Vec<&str> = figures.artifacts.iter().copied().chain(["summary.json", PICTURES]).collect();
    sheet(
        &summary.scene,
        html! {
            p.lead { (lead(frames, metrics)) }
            (origin_paragraph(origin, &written))
            (viewer::section(&figures.viewer, summary))
            (tables::radar(&summary.radar, frames))
            @if let Some(told) = &summary.plan { (plan::section(told)) }
            @if frames.len() > 1 { (tracks::section(metrics)) }
            @if !figures.strip.is_empty() { (strip(summary, figures)) }
            @for number in 0..frames.len().min(FRAMES_TOLD) {
                (section(number, summary, figures.frames.get(number)))
            }
            @if frames.len() > FRAMES_TOLD {
                p { "Frames " (FRAMES_TOLD) " to " (frames.len() - 1) " are in "
                    a href="summary.json" { "summary.json" } "." }
            }
            footer { "Seed " (summary.seed) ". Ranges and velocities of the truth are power-weighted means "
                "over each target's echo; signs, axes and units as in docs/conventions.md." }
        },
    )
}

/// Mark that identifies a page of this program.
const GENERATOR: &str = "wayside";

/// Whether a page was made here: by its mark, or by the title of earlier versions; an empty one counts too,
/// because it holds no data.
pub fn is_report(page: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&page[..page.len().min(HEAD_BYTES)]);
    let mark = format!("name=\"generator\" content=\"{GENERATOR}\"");
    page.is_empty() || [mark.as_str(), "<title>Wayside: "].iter().any(|told| head.contains(told))
}

/// Largest part of the page that is searched: more than precedes the title.
const HEAD_BYTES: usize = 1024;

/// A page of this name around its content; control characters in user texts are replaced.
pub fn sheet(name: &str, content: Markup) -> String {
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="generator" content=(GENERATOR);
                title { "Wayside: " (name) }
                style { (PreEscaped(STYLE)) (PreEscaped(plotting::svg::stylesheet())) (PreEscaped(viewer::STYLE)) }
            }
            body {
                h1 { (name) }
                (content)
            }
        }
    };
    safe_text::in_lines(&markup.into_string()).into_owned()
}

/// Number of frames with tables in the report: a page with more opens slowly.
const FRAMES_TOLD: usize = 24;

/// Section on the whole of a long scene: detections by place, and every n-th frame from above.
fn strip(summary: &Summary, figures: &Figures) -> Markup {
    html! {
        section {
            h2 { "The whole scene" }
            (tables::scene(&summary.radar, &summary.frames))
            @for (number, plan) in &figures.strip {
                (figure(&format!("Frame {number}: truth, detected points and objects"), plan))
            }
        }
    }
}

fn lead(frames: &[FrameSummary], metrics: &Metrics) -> String {
    let points: usize = frames.iter().map(|frame| frame.points).sum();
    let Agreement { found, missed, false_ones, stationary, removed, .. } = metrics.objects;
    let over = if frames.len() == 1 { "one frame".into() } else { format!("{} frames", frames.len()) };
    let objects = if false_ones == 1 { "object is" } else { "objects are" };
    let more = [(stationary, "at rest and of no target"), (removed, "removed as echoes at rest")];
    let more = more.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("; {count} {what}"));
    format!(
        "{found} of {} bodies with an echo found in {over}; {false_ones} {objects} false{}; {points} points detected.",
        found + missed,
        more.collect::<String>()
    )
}

fn section(number: usize, summary: &Summary, figures: Option<&FrameFigures>) -> Markup {
    let frame = &summary.frames[number];
    html! {
        section {
            h2 { "Frame " (number) " at " (tables::rounded(frame.time_s, 3)) " s" }
            @if let Some(f) = figures { (figure("Truth, detected points and objects, to scale.", &f.plan)) }
            (accuracy::section("", &frame.accuracy))
            h3 { "Truth beside estimate" }
            (tables::targets(&summary.radar, &frame.targets))
            (false_objects::section("", &frame.false_objects, &frame.stationary_objects))
            @if let Some(f) = figures {
                (figure("Power summed over all channels. Crosses mark the truth, rings the detected objects.", &f.rdm))
                (figure("The strongest cell at each range.", &f.profile))
                (figure("Detected points, coloured by object, with the truth.", &f.points))
            }
            h3 { "Classes" }
            (tables::classes(&frame.targets))
            div.pair {
                div { h3 { "Error budget of this frame" } (tables::errors(frame)) }
                div { h3 { "What each stage cost" } (tables::costs(frame)) }
            }
            (echo_errors::section(&frame.targets))
        }
    }
}

/// A picture in the form that fits the available room, with its caption.
pub fn figure(caption: &str, picture: &Figure) -> Markup {
    html! { figure {
        div.wide { (PreEscaped(picture.wide.inline())) }
        div.narrow { (PreEscaped(picture.narrow.inline())) }
        figcaption { (caption) }
    } }
}
