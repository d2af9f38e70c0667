//! Interactive view of a study's designs: the place of each, its value by any metric, and the vehicles of its
//! trials. It is part of the study's report and hidden where no script runs.

use crate::report::viewer::body_view::BodyView;
use crate::report::viewer::page_script::{json, scripts};
use crate::report::viewer::surroundings::{MeshTable, RadarView, Surroundings};
use artifact::envelope::fingerprint;
use artifact::radar::Radar;
use artifact::scene::SceneHeader;
use maud::{Markup, html};
use radar::motion::pose_after;
use serde::Serialize;
use std::collections::BTreeMap;

/// A study for its view; designs and situations are referred to by their indices in its lists.
#[derive(Serialize)]
pub struct SweepView {
    /// Names of the varied parameters.
    pub axes: Vec<String>,
    /// Metrics in the order of the study's tables.
    pub metrics: Vec<Metric>,
    /// Metric by which the study chooses.
    pub goal: usize,
    /// Metric of a design's cost.
    pub cost: usize,
    /// Designs in the view.
    #[serde(skip)]
    pub designs: Vec<Design>,
    /// Number of designs in the study, more than in the view if that lacks room.
    #[serde(skip)]
    pub designs_all: usize,
    /// Design of the answer; `None` if the goal was never known.
    pub answer: Option<usize>,
    /// Design of the best mean; `None` if the goal was never known.
    pub best: Option<usize>,
    /// The first situations, at least one.
    #[serde(skip)]
    pub situations: Vec<Situation>,
    /// Number of situations in the study.
    pub situations_all: usize,
}

/// A metric of the study.
#[derive(Serialize)]
pub struct Metric {
    /// Name in the study's tables.
    pub name: String,
    /// Whether lower is better.
    pub is_lower_better: bool,
}

/// A design with its metrics.
#[derive(Serialize)]
pub struct Design {
    /// Number in the study.
    pub number: usize,
    /// Choice of each axis.
    pub labels: Vec<String>,
    /// Radar of the design.
    #[serde(skip)]
    pub radar: Radar,
    /// Mean of each metric and half the width of its interval; `None` if unknown.
    pub means: Vec<Option<(f64, Option<f64>)>>,
    /// Metric of the goal in each situation of the view.
    pub goal_by_situation: Vec<Option<f64>>,
    /// Number of its situations.
    pub situations: usize,
    /// Whether it is statistically indistinguishable from the best.
    pub is_candidate: bool,
    /// Whether no other design is both better and no more expensive.
    pub is_on_front: bool,
}

/// The first frame of a situation.
pub struct Situation {
    /// Words for the varied parameters.
    pub words: String,
    /// Scene of the situation.
    pub header: SceneHeader,
}

/// Numbers of the page.
#[derive(Serialize)]
struct SweepPage<'a> {
    #[serde(flatten)]
    view: &'a SweepView,
    radars: Vec<SharedRadar>,
    designs: Vec<PageDesign<'a>>,
    situations: Vec<PageSituation<'a>>,
    surroundings: Surroundings,
}

/// A radar of one design or of several.
#[derive(PartialEq, Serialize)]
struct SharedRadar {
    #[serde(flatten)]
    view: RadarView,
    stands: String,
}

#[derive(Serialize)]
struct PageDesign<'a> {
    #[serde(flatten)]
    design: &'a Design,
    /// Index among the radars.
    radar: usize,
}

#[derive(Serialize)]
struct PageSituation<'a> {
    words: &'a str,
    bodies: Vec<BodyView>,
}

/// The view's own scripts, in the order in which they use each other.
const SCRIPT: [&str; 8] = [
    include_str!("viewer/script/surroundings.js"),
    include_str!("viewer/script/map.js"),
    include_str!("viewer/script/cuts.js"),
    include_str!("viewer/script/panel.js"),
    include_str!("viewer/script/names.js"),
    include_str!("viewer/script/listening.js"),
    include_str!("viewer/script/sweep_chart.js"),
    include_str!("viewer/script/sweep_view.js"),
];

/// Words on reading and moving the view.
const HOW: &str = ". Each dot is a design; it has no colour where the metric is unknown. Designs at one place stand \
                   side by side. Click a dot, here or in the chart, to show that design's field of view and its \
                   metrics. Drag to turn the view; drag with the right button or Shift to move it. Click the \
                   picture, then turn the wheel to zoom.";

/// The part of the report with the view; empty for a study without situations.
pub fn section(view: &SweepView) -> Markup {
    let Some(page) = view.page() else { return html! {} };
    let Ok(numbers) = json(&page) else { return html! {} };
    html! {
        noscript { p.made { "Scripts are disabled; the drawing and the tables below show the same designs." } }
        section #viewer hidden {
            h2 { "Walk around" }
            (controls(view))
            div.viewer-scene {
                div #viewer-space-place {
                    canvas #viewer-space tabindex="0" role="img" aria-label="The designs in three dimensions" {}
                    div #viewer-names {}
                }
                div #viewer-panel aria-live="polite" {}
            }
            p.made { i #viewer-scale {} span #viewer-scale-told {} (HOW) }
            @if view.designs.len() < view.designs_all {
                p.made { (view.designs.len()) " of " (view.designs_all) " designs are shown: the front, the "
                    "candidates and the best of the others." }
            }
            canvas #viewer-chart role="img" aria-label="Designs by two metrics" {}
            p.made {
                "Every design by two metrics. The wide ring marks the answer, the other ring the chosen design."
            }
        }
        (scripts(&numbers, &SCRIPT))
    }
}

fn controls(view: &SweepView) -> Markup {
    let layers =
        [("designs", "designs"), ("bodies", "vehicles"), ("beam", "field of view"), ("names", "names")];
    let places = [("around", "from the side"), ("radar", "from the radar"), ("above", "from above")];
    let told = [(view.answer, "the answer"), (view.best, "the best mean")];
    html! {
        div.viewer-controls {
            label { "colours: " (metrics("metric", view, view.goal)) }
            label { "over: " (metrics("across", view, view.cost)) }
            label { "design " select #viewer-design {
                @for (place, design) in view.designs.iter().enumerate() {
                    option value=(place) { (design.number) ": " (design.labels.join(", ")) }
                }
            } }
            @for (design, words) in told {
                @if let Some(design) = design { button type="button" data-design=(design) { (words) } }
            }
        }
        div.viewer-controls {
            label { "situation "
                input #viewer-situation type="range" min="0" max=(view.situations.len() - 1) value="0" step="1";
                output #viewer-situation-told {} }
            label { input #viewer-alone type="checkbox"; " colours of this situation alone" }
        }
        div.viewer-controls {
            @for (name, words) in layers {
                label { input type="checkbox" data-layer=(name) checked; " " (words) }
            }
            @for (place, words) in places { button type="button" data-place=(place) { (words) } }
        }
    }
}

fn metrics(name: &str, view: &SweepView, chosen: usize) -> Markup {
    html! {
        select id={ "viewer-" (name) } {
            @for (place, metric) in view.metrics.iter().enumerate() {
                option value=(place) selected[place == chosen] { (metric.name) }
            }
        }
    }
}

impl SweepView {
    /// Data of the page; `None` for a study without situations.
    fn page(&self) -> Option<SweepPage<'_>> {
        let first = self.situations.first()?;
        let (situations, meshes) = self.bodies();
        let (designs, radars) = self.shared_radars();
        let surroundings = Surroundings::with_meshes(&first.header, meshes);
        Some(SweepPage { view: self, radars, designs, situations, surroundings })
    }

    /// Designs and the radars that they share.
    fn shared_radars(&self) -> (Vec<PageDesign<'_>>, Vec<SharedRadar>) {
        let mut radars: Vec<SharedRadar> = vec![];
        let mut index = |design: &Design| {
            let radar = SharedRadar::of(&design.radar);
            radars.iter().position(|known| *known == radar).unwrap_or_else(|| {
                radars.push(radar);
                radars.len() - 1
            })
        };
        let designs = self.designs.iter().map(|design| PageDesign { design, radar: index(design) }).collect();
        (designs, radars)
    }

    /// Bodies of each situation, and their meshes, each once.
    fn bodies(&self) -> (Vec<PageSituation<'_>>, MeshTable) {
        let (mut shelf, mut places) = (MeshTable::default(), BTreeMap::new());
        let situations = self.situations.iter().map(|Situation { words, header }| {
            let mut place = |mesh| *places.entry(fingerprint(mesh)).or_insert_with(|| shelf.put(mesh));
            let of_header: Vec<u32> = header.meshes.iter().map(&mut place).collect();
            PageSituation { words, bodies: bodies(header, &of_header) }
        });
        (situations.collect(), shelf)
    }
}

/// Bodies in the middle of the first frame, with their meshes' indices in the page.
fn bodies(header: &SceneHeader, meshes: &[u32]) -> Vec<BodyView> {
    let (view, frame) = (scene::frame_view(header, 0), scene::snapshot(header, 0));
    let middle_s = header.radar.frame_middle_s();
    let body = |(target, pose)| {
        BodyView::of(target, &pose_after(pose, middle_s)).with_mesh(|mesh| meshes[mesh as usize])
    };
    view.targets.iter().zip(&frame.poses).map(body).collect()
}

impl SharedRadar {
    fn of(radar: &Radar) -> Self {
        let [x, y, z] = radar.position_m.map(|m| format!("{m:.2}").replace('-', "−"));
        let [azimuth, elevation] = [radar.boresight_az_rad, radar.boresight_el_rad]
            .map(|angle| format!("{:.1}°", angle.to_degrees()).replace('-', "−"));
        let stands =
            format!("Stands at x {x}, y {y}, z {z} m; boresight: azimuth {azimuth}, elevation {elevation}.");
        Self { view: RadarView::of(radar), stands }
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
