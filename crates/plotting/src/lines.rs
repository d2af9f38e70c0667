//! Lines over linear or logarithmic axes.

use crate::axes::{Axes, Axis, Tick, tick_text};
use crate::colours::{is_repeated, line_colour};
use crate::heat_map::draw_title;
use crate::layout::Layout;
use crate::marks::{Legend, Mark};
use crate::svg::Svg;

/// Division of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Equal steps are equally long.
    Linear,
    /// Powers of ten are equally far apart.
    Logarithmic,
}

/// A named line.
#[derive(Debug, Clone)]
pub struct Line {
    /// Name in the legend.
    pub name: String,
    /// Numbers `[x, y]`, in the order in which they are joined.
    pub points: Vec<[f64; 2]>,
    /// Whether its points are marked.
    pub has_markers: bool,
    /// Words of each point, shown while the pointer rests on its mark; of points beyond the last there are
    /// none.
    pub tooltips: Vec<String>,
}

/// Lines with axes and a legend.
#[derive(Debug, Clone)]
pub struct LinePlot {
    /// Title over the plot.
    pub title: String,
    /// Notes on what is to be known beforehand: scene, which side is better.
    pub notes: Vec<String>,
    /// Label below the horizontal axis.
    pub x_label: String,
    /// Label beside the vertical axis.
    pub y_label: String,
    /// Scale of the horizontal axis.
    pub x_scale: Scale,
    /// Scale of the vertical axis.
    pub y_scale: Scale,
    /// Lines in the order in which they are drawn.
    pub lines: Vec<Line>,
}

impl LinePlot {
    /// The picture; points that an axis cannot show are left out.
    pub fn draw(&self, layout: Layout) -> Svg {
        let mut sheet = Svg::new(self.title.clone(), layout.width_px(), 0.0);
        let top = draw_title(&mut sheet, &self.title, &self.notes);
        let lines: Vec<Vec<Point>> = self.lines.iter().map(|l| self.scaled(l)).collect();
        let all: Vec<[f64; 2]> = lines.concat().into_iter().map(|point| point.place).collect();
        let (x, y) = (span(&all, 0), span(&all, 1));
        let [left, right] = layout.sides_px();
        let axes = Axes {
            x: Axis { from: x.0, to: x.1, start_px: left, end_px: right },
            y: Axis { from: y.0, to: y.1, start_px: top + HEIGHT_PX, end_px: top },
        };
        let y_ticks = ticks(self.y_scale, &axes.y);
        let axes = axes.with_room_beside(&y_ticks);
        let x_ticks = ticks(self.x_scale, &axes.x);
        axes.draw_with_ticks(&mut sheet, [&self.x_label, &self.y_label], [&x_ticks, &y_ticks]);
        let mut legend = Legend::default();
        for (n, (line, points)) in self.lines.iter().zip(&lines).enumerate() {
            draw_line(&mut sheet, &axes, n, line, points);
            if !line.name.is_empty() {
                legend.add_stacked(&samples(n, line), line_colour(n), &line.name);
            }
        }
        legend.draw(&mut sheet, top + HEIGHT_PX + 68.0, [left - 44.0, right]);
        sheet
    }

    fn scaled<'l>(&self, line: &'l Line) -> Vec<Point<'l>> {
        let place = |[x, y]: &[f64; 2]| [number(self.x_scale, *x), number(self.y_scale, *y)];
        let words = line.tooltips.iter().map(String::as_str).chain(std::iter::repeat(""));
        let points =
            line.points.iter().zip(words).map(|(numbers, words)| Point { place: place(numbers), words });
        points.filter(|point| point.place.iter().all(|v| v.is_finite())).collect()
    }
}

/// A point of a line on the scales of its axes, with its words.
#[derive(Debug, Clone, Copy)]
struct Point<'l> {
    place: [f64; 2],
    words: &'l str,
}

const HEIGHT_PX: f64 = 320.0;

/// Marks that a line shows in the legend.
fn samples(n: usize, line: &Line) -> Vec<Mark> {
    let is_line = line.points.len() > 1;
    let value = line.has_markers.then(|| Mark::OF_LINES[n % Mark::OF_LINES.len()]);
    is_line.then(|| stroke_mark(n)).into_iter().chain(value).collect()
}

fn number(scale: Scale, value: f64) -> f64 {
    match scale {
        Scale::Linear => value,
        Scale::Logarithmic => value.log10(),
    }
}

fn ticks(scale: Scale, axis: &Axis) -> Vec<Tick> {
    match scale {
        Scale::Linear => axis.numbered(),
        Scale::Logarithmic => powers(axis),
    }
}

/// Powers of ten in words, their multiples as minor ticks; an axis shorter than a power of ten has words at 2
/// and 5 too.
fn powers(axis: &Axis) -> Vec<Tick> {
    let (low, high) = (axis.from.min(axis.to), axis.from.max(axis.to));
    let is_short = high - low < 1.5;
    let places =
        (low.floor() as i32..=high.ceil() as i32).take(100).flat_map(|p| (1..10).map(move |m| (p, m)));
    places
        .map(|(power, multiple)| (power, multiple, f64::from(power) + f64::from(multiple).log10()))
        .filter(|(_, _, value)| (low..=high).contains(value))
        .map(|(power, multiple, value)| match multiple {
            1 => (value, power_text(power, multiple)),
            2 | 5 if is_short => (value, power_text(power, multiple)),
            _ => (value, String::new()),
        })
        .collect()
}

fn power_text(power: i32, multiple: i32) -> String {
    if (-3..5).contains(&power) {
        tick_text(f64::from(multiple) * 10.0_f64.powi(power), 10.0_f64.powi(power))
    } else {
        format!("{multiple}e{power}").replace('-', "−")
    }
}

/// Least and greatest, with a little room.
fn span(points: &[[f64; 2]], axis: usize) -> (f64, f64) {
    let values = || points.iter().map(|p| p[axis]);
    let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    match high - low {
        width if !width.is_finite() => (0.0, 1.0),
        0.0 => (low - 1.0, high + 1.0),
        width => (low - 0.04 * width, high + 0.04 * width),
    }
}

fn draw_line(sheet: &mut Svg, axes: &Axes, n: usize, line: &Line, points: &[Point]) {
    let on_sheet = |point: &Point| [axes.x.to_px(point.place[0]), axes.y.to_px(point.place[1])];
    let places: Vec<[f64; 2]> = points.iter().map(on_sheet).collect();
    sheet.group("series", &line.name, |sheet| {
        draw_stroke(sheet, n, 1.6, &places);
        if line.has_markers {
            let mark = Mark::OF_LINES[n % Mark::OF_LINES.len()];
            let draw = |(point, place): (&Point, &[f64; 2])| {
                sheet.group("value", point.words, |sheet| mark.draw(sheet, line_colour(n), *place));
            };
            points.iter().zip(&places).for_each(draw);
        }
    });
}

/// Draws the n-th line of a plot, whole, or broken where its colour is an earlier one's.
pub(crate) fn draw_stroke(sheet: &mut Svg, n: usize, width: f64, places: &[[f64; 2]]) {
    if is_repeated(n) {
        sheet.dashed_polyline(line_colour(n), width, places);
    } else {
        sheet.polyline(line_colour(n), width, places);
    }
}

/// The same in a legend.
pub(crate) fn stroke_mark(n: usize) -> Mark {
    if is_repeated(n) { Mark::DashedLine } else { Mark::Line }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_of_twenty_lines_look_alike_in_the_legend() {
        let line = |n: usize| Line {
            name: format!("{n}"),
            points: vec![[1.0, 1.0], [2.0, n as f64]],
            has_markers: false,
            tooltips: vec![],
        };
        let looks = |n: usize| format!("{} {:?}", line_colour(n), samples(n, &line(n)));
        let all: std::collections::BTreeSet<String> = (0..20).map(looks).collect();
        assert_eq!(all.len(), 20);
    }

    #[test]
    fn a_mark_under_the_pointer_says_its_own_words_though_points_before_it_cannot_be_drawn() {
        let line = Line {
            name: "a line".into(),
            points: vec![[1.0, 0.0], [2.0, 1.0], [3.0, 2.0]],
            has_markers: true,
            tooltips: vec!["not to be seen".into(), "the first".into(), "the second".into()],
        };
        let plot = LinePlot {
            title: "plot".into(),
            notes: vec![],
            x_label: String::new(),
            y_label: String::new(),
            x_scale: Scale::Linear,
            y_scale: Scale::Logarithmic,
            lines: vec![line],
        };
        let text = plot.draw(Layout::Wide).standalone();
        let titles: Vec<&str> =
            text.split("<title>").skip(1).filter_map(|part| part.split("</title>").next()).collect();
        assert_eq!(titles, ["plot", "a line", "the first", "the second"]);
    }
}
