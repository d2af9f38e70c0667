//! The page around the figures and tables.

use super::{tables, tracks};
use crate::pictures::{FrameFigures, Svg};
use crate::products::Figures;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde_json::Value;

const STYLE: &str = include_str!("style.css");

/// The whole page.
pub(super) fn page(summary: &Value, figures: &Figures) -> String {
    let name = summary["scene"].as_str().unwrap_or_default();
    let frames: Vec<&Value> = summary["frames"].as_array().into_iter().flatten().collect();
    sheet(
        name,
        html! {
            p.lead { (lead(&frames)) }
            (tables::radar(&summary["radar"], &frames))
            @if frames.len() > 1 { (tracks::section(&summary["metrics"])) }
            @if !figures.strip.is_empty() { (strip(&frames, figures)) }
            @for (number, frame) in frames.iter().take(FRAMES_TOLD).enumerate() {
                (section(number, frame, figures.frames.get(number)))
            }
            @if frames.len() > FRAMES_TOLD {
                p { "Frames " (FRAMES_TOLD) " to " (frames.len() - 1) " stand in summary.json." }
            }
            footer { "Seed " (summary["seed"]) ". Ranges and velocities of the truth are power-weighted means over each "
                "target's echo; signs, axes and units as in docs/conventions.md." }
        },
    )
}

/// A page of this name around its content.
pub(super) fn sheet(name: &str, content: Markup) -> String {
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Wayside: " (name) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { (name) }
                (content)
            }
        }
    };
    markup.into_string()
}

/// Frames that have tables in the report: a page of more opens slowly.
const FRAMES_TOLD: usize = 24;

/// How a long scene goes on: what was found and where, and every n-th frame from above.
fn strip(frames: &[&Value], figures: &Figures) -> Markup {
    html! {
        section {
            h2 { "The whole scene" }
            (tables::scene(frames))
            @for (number, plan) in &figures.strip {
                (figure(&format!("Frame {number}: truth, detected points and objects"), plan))
            }
        }
    }
}

fn lead(frames: &[&Value]) -> String {
    let targets = || frames.iter().flat_map(|f| f["targets"].as_array().into_iter().flatten());
    let found = targets().filter(|t| !t["estimate"].is_null()).count();
    let points: u64 = frames.iter().filter_map(|f| f["points"].as_u64()).sum();
    format!("{} of {} targets found in {} frames, {points} points.", found, targets().count(), frames.len())
}

fn section(number: usize, frame: &Value, figures: Option<&FrameFigures>) -> Markup {
    html! {
        section {
            h2 { "Frame " (number) " at " (tables::rounded(&frame["time_s"], 3)) " s" }
            @if let Some(f) = figures { (figure("Scene from above: truth, detected points and objects", &f.plan)) }
            h3 { "Truth beside estimate" }
            (tables::targets(frame))
            @if let Some(f) = figures {
                div.pair {
                    (figure("Range-Doppler map, all channels; rings are objects", &f.rdm))
                    (figure("Range profile", &f.profile))
                }
                (figure("Point cloud in three views, coloured by object", &f.points))
            }
            h3 { "Classes" }
            (tables::classes(frame))
            div.pair {
                div { h3 { "Error budget of this frame" } (tables::errors(frame)) }
                div { h3 { "What each stage cost" } (tables::costs(frame)) }
            }
        }
    }
}

/// A picture and what it shows.
pub(super) fn figure(caption: &str, picture: &Svg) -> Markup {
    html! { figure { div.sheet { (PreEscaped(picture.text())) } figcaption { (caption) } } }
}
