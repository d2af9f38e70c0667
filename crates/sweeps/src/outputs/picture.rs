//! Worth of each design over its cost, with the Pareto front.

use crate::answer::{Answer, DesignResult};
use crate::study::document::Study;
use plotting::axes::{Axes, Axis, Tick, tick_text};
use plotting::heat_map::draw_title;
use plotting::labels::Labels;
use plotting::layout::Layout;
use plotting::marks::{Legend, Mark};
use plotting::svg::Svg;

const HEIGHT_PX: f64 = 340.0;

/// Draws every design as a disc, the front joined, the interval of each of its designs, and the chosen one in
/// a ring.
pub(crate) fn draw(study: &Study, answer: &Answer, layout: Layout) -> Svg {
    let names: Vec<&str> = study.metrics.names().collect();
    let (metric, cost) = (names[study.goal.metric], names[study.goal.cost]);
    let title = format!("{metric} over {cost}");
    let mut sheet = Svg::new(title.clone(), layout.width_px(), 0.0);
    let note =
        "A disc is a design; numbers are those of designs.csv, bars the intervals of the front's means.";
    let gaps = "Means are of the situations that a design knows; the front is by those that two both know.";
    let notes = [note].into_iter().chain(answer.is_by_pairs().then_some(gaps));
    let top = draw_title(&mut sheet, &title, &notes.map(str::to_owned).collect::<Vec<_>>());
    let axes = axes(answer, layout, top);
    let numbers = axes.y.numbered();
    let axes = axes.with_room_beside(&numbers);
    axes.draw_with_ticks(&mut sheet, [cost, metric], [&costs(answer, &axes), &numbers]);
    let legend = marks(&mut sheet, answer, &axes);
    let [left, right] = layout.sides_px();
    legend.draw(&mut sheet, top + HEIGHT_PX + 68.0, [left - 44.0, right]);
    sheet
}

/// Scale from a cost to its position on the axis.
type AxisScale = fn(f64) -> f64;

/// Logarithm of the cost; the cost itself where some design costs nothing.
fn scale(answer: &Answer) -> AxisScale {
    let costs = || answer.results.iter().filter_map(|result| result.cost);
    if costs().all(|cost| cost > 0.0) { f64::log10 } else { |cost| cost }
}

/// Position of a design: cost on its scale, and the mean.
fn place(result: &DesignResult, scale: AxisScale) -> Option<[f64; 2]> {
    Some([scale(result.cost?), result.mean?.value])
}

fn axes(answer: &Answer, layout: Layout, top: f64) -> Axes {
    let scale = scale(answer);
    let places: Vec<[f64; 2]> = answer.results.iter().filter_map(|s| place(s, scale)).collect();
    let on_front = answer.front.iter().filter_map(|design| answer.results[*design].mean);
    let ends = on_front.flat_map(|mean| mean.ends.unwrap_or([mean.value; 2]));
    let [left, right] = layout.sides_px();
    let x = span(places.iter().map(|p| p[0]));
    let y = span(places.iter().map(|p| p[1]).chain(ends));
    Axes {
        x: Axis { from: x[0], to: x[1], start_px: left, end_px: right },
        y: Axis { from: y[0], to: y[1], start_px: top + HEIGHT_PX, end_px: top },
    }
}

/// Least and greatest value with a margin.
fn span(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let (low, high) =
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max));
    match high - low {
        width if !width.is_finite() => [0.0, 1.0],
        0.0 => [low - 0.5, high + 0.5],
        width => [low - 0.06 * width, high + 0.06 * width],
    }
}

/// Ticks at the designs' own costs, as far as there is room for their numbers.
fn costs(answer: &Answer, axes: &Axes) -> Vec<Tick> {
    let mut values: Vec<f64> = answer.results.iter().filter_map(|result| result.cost).collect();
    values.sort_by(f64::total_cmp);
    let scale = scale(answer);
    let step = step_of(&values);
    let mut ticks: Vec<Tick> = vec![];
    for cost in values {
        let at = scale(cost);
        if ticks.last().is_none_or(|(last, _)| axes.x.to_px(at) - axes.x.to_px(*last) >= 34.0) {
            ticks.push((at, tick_text(cost, step)));
        }
    }
    ticks
}

/// Step that costs are told to: thousandths, or hundredths of the least where that is less.
fn step_of(costs: &[f64]) -> f64 {
    const THOUSANDTH: f64 = 0.001;
    let least = costs.iter().map(|cost| cost.abs()).filter(|cost| *cost > 0.0).fold(f64::INFINITY, f64::min);
    if least < THOUSANDTH { 0.01 * least } else { THOUSANDTH }
}

fn marks(sheet: &mut Svg, answer: &Answer, axes: &Axes) -> Legend {
    let mut legend = Legend::default();
    let scale = scale(answer);
    let at = |design: usize| {
        place(&answer.results[design], scale).map(|[x, y]| [axes.x.to_px(x), axes.y.to_px(y)])
    };
    let others = (0..answer.results.len()).filter(|design| !answer.front.contains(design));
    others.filter_map(at).for_each(|place| Mark::Circle.draw(sheet, "plain", place));
    legend.add(Mark::Circle, "plain", "a design");
    let front: Vec<[f64; 2]> = answer.front.iter().copied().filter_map(at).collect();
    sheet.polyline("c0", 1.6, &front);
    front.iter().for_each(|place| Mark::Disc.draw(sheet, "c0", *place));
    legend.add_stacked(&[Mark::Line, Mark::Disc], "c0", "the front: none is better for as little");
    bars(sheet, answer, axes);
    if let Some(place) = answer.chosen.and_then(at) {
        Mark::SquareOutline.draw(sheet, "c1", place);
        legend.add(Mark::SquareOutline, "c1", "the answer");
    }
    labels(sheet, answer, axes, at);
    legend
}

/// Draws the intervals of the front's means.
fn bars(sheet: &mut Svg, answer: &Answer, axes: &Axes) {
    let scale = scale(answer);
    for design in &answer.front {
        let result = &answer.results[*design];
        let ends = result.mean.and_then(|mean| mean.ends);
        if let (Some([x, _]), Some(ends)) = (place(result, scale), ends) {
            sheet.polyline("c0", 1.2, &ends.map(|end| [axes.x.to_px(x), axes.y.to_px(end)]));
        }
    }
}

fn labels(sheet: &mut Svg, answer: &Answer, axes: &Axes, at: impl Fn(usize) -> Option<[f64; 2]>) {
    let mut labels = Labels::within([axes.x.start_px, axes.y.end_px, axes.x.end_px, axes.y.start_px]);
    let chosen = answer.chosen.filter(|chosen| !answer.front.contains(chosen));
    for design in answer.front.iter().copied().chain(chosen) {
        if let Some([x, y]) = at(design) {
            labels.place([x - 7.0, y - 7.0, x + 7.0, y + 7.0], &design.to_string());
        }
    }
    labels.draw(sheet);
}
