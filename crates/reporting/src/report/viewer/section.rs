//! The part of the page with the view. Its script fills it; without one it stays hidden.

use crate::report::viewer::page_script::scripts;
use crate::report::viewer::viewed_frame::ViewerData;
use maud::{Markup, html};
use pipeline::outcome::summary::Summary;

/// Style of the view.
pub(crate) const STYLE: &str = include_str!("viewer.css");

/// The view's own scripts, each after those that it uses.
const SCRIPT: [&str; 11] = [
    include_str!("script/surroundings.js"),
    include_str!("script/ways.js"),
    include_str!("script/motion.js"),
    include_str!("script/space.js"),
    include_str!("script/map.js"),
    include_str!("script/cuts.js"),
    include_str!("script/panel.js"),
    include_str!("script/telling.js"),
    include_str!("script/names.js"),
    include_str!("script/listening.js"),
    include_str!("script/viewer.js"),
];

/// Kinds of things that can be shown or hidden: the script's name, and the text.
const LAYERS: [(&str, &str); 8] = [
    ("bodies", "vehicles"),
    ("boxes", "true boxes"),
    ("paths", "paths"),
    ("points", "points"),
    ("objects", "objects"),
    ("tracks", "tracks"),
    ("beam", "field of view"),
    ("names", "names"),
];

/// Places from which the scene is seen.
const PLACES: [(&str, &str); 3] =
    [("around", "from the side"), ("radar", "from the radar"), ("above", "from above")];

/// The view with its numbers and its script; empty if no frame is viewed.
pub(crate) fn section(data: &ViewerData, summary: &Summary) -> Markup {
    let Some(json) = data.json(summary) else { return html! {} };
    html! {
        noscript { p.made { "Scripts are disabled; the drawings and tables below show the same scene." } }
        section #viewer hidden {
            h2 { "Walk around" }
            p #viewer-told {}
            (controls())
            div.viewer-scene {
                div #viewer-space-place {
                    canvas #viewer-space tabindex="0" role="img" aria-label="The scene in three dimensions" {}
                    div #viewer-names {}
                }
                div #viewer-panel aria-live="polite" {}
            }
            p.made { "Drag to turn the view; drag with the right button or Shift to move it; use two fingers for both. Click the "
                "picture, then turn the wheel to zoom. Keys: arrows turn, W A S D walk, + and − zoom. Click a vehicle, a point "
                "target or its name for details." }
            (maps())
        }
        (scripts(&json, &SCRIPT))
    }
}

fn controls() -> Markup {
    html! {
        div.viewer-controls {
            label #viewer-frame-label { "frame " input #viewer-frame type="range" min="0" value="0" step="1"; output #viewer-frame-told {} }
            label #viewer-level-label { "paths down to " input #viewer-level type="range" min="-80" max="0" value="-30" step="1";
                output #viewer-level-told {} }
        }
        div.viewer-controls {
            @for (name, words) in LAYERS {
                label { input type="checkbox" data-layer=(name) checked[name != "boxes"]; " " (words) }
            }
        }
        div.viewer-controls {
            @for (place, words) in PLACES { button type="button" data-place=(place) { (words) } }
            span #viewer-orders {}
        }
    }
}

fn maps() -> Markup {
    html! {
        div.viewer-maps {
            div { canvas #viewer-map tabindex="0" role="img" aria-label="Range-Doppler map with a cursor" {}
                p.made { i #viewer-scale {} span #viewer-scale-told {} ", all channels summed. Outlined cells exceed the CFAR "
                    "threshold; rings are objects. Click here or in a cut to hold the cursor, click again to release it." } }
            div { canvas #viewer-doppler role="img" aria-label="Doppler cut at the cursor's range" {}
                p.made { "Doppler cut at the cursor's range." } }
            div { canvas #viewer-range role="img" aria-label="Range profile at the cursor's velocity" {}
                p.made { "Range profile at the cursor's velocity; the faint line is the maximum over all velocities." } }
            p #viewer-readout aria-live="polite" {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::viewer::page_script::reads_as_the_source_does;

    #[test]
    fn the_script_reads_as_the_rest_of_the_source_does() {
        reads_as_the_source_does(&SCRIPT);
    }
}
