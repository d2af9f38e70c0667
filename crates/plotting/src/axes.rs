//! A box with axes: where a number lies on the sheet.

use crate::svg::{Svg, text_width_px, wrap_text};

/// One axis: its range in numbers and in pixels.
#[derive(Debug, Clone, Copy)]
pub struct Axis {
    /// Number at the start of the axis.
    pub from: f64,
    /// Number at the end of the axis.
    pub to: f64,
    /// Pixel at the start of the axis.
    pub start_px: f64,
    /// Pixel at the end of the axis.
    pub end_px: f64,
}

impl Axis {
    /// Pixel of a number.
    pub fn to_px(&self, value: f64) -> f64 {
        self.start_px + (value - self.from) / (self.to - self.from) * (self.end_px - self.start_px)
    }

    /// Whether a pixel lies between its ends.
    pub fn contains_px(&self, pixel: f64) -> bool {
        (self.start_px.min(self.end_px)..=self.start_px.max(self.end_px)).contains(&pixel)
    }

    /// Round numbers inside, about one every 70 pixels.
    pub fn ticks(&self) -> Vec<f64> {
        let (low, high) = (self.from.min(self.to), self.from.max(self.to));
        let step = round_step((high - low) * 70.0 / (self.end_px - self.start_px).abs());
        let first = (low / step).ceil() as i64;
        let last = (high / step).floor() as i64;
        (first..=last).take(100).map(|i| i as f64 * step).collect()
    }
}

/// Step of 1, 2 or 5 times a power of ten, at least `step`.
fn round_step(step: f64) -> f64 {
    let power = 10.0_f64.powf(step.max(1e-300).log10().floor());
    let round = [1.0, 2.0, 5.0, 10.0].into_iter().find(|m| m * power >= step * (1.0 - 1e-9)).unwrap_or(10.0);
    round * power
}

/// A box with a horizontal and a vertical axis.
#[derive(Debug, Clone, Copy)]
pub struct Axes {
    /// Horizontal axis, to the right.
    pub x: Axis,
    /// Vertical axis, upwards: it starts at the lower pixel.
    pub y: Axis,
}

impl Axes {
    /// Frame, ticks, numbers and labels.
    pub fn draw(&self, sheet: &mut Svg, x_label: &str, y_label: &str) {
        self.draw_with_ticks(sheet, [x_label, y_label], [&numbered(&self.x), &numbered(&self.y)]);
    }

    /// Draws as [`Axes::draw`] does, with other ticks, [x, y].
    pub fn draw_with_ticks(&self, sheet: &mut Svg, labels: [&str; 2], ticks: [&[Tick]; 2]) {
        let (left, right) = (self.x.start_px, self.x.end_px);
        let (bottom, top) = (self.y.start_px, self.y.end_px);
        sheet.rectangle("ink", [left, top], [right - left, bottom - top]);
        for (value, text) in ticks[0] {
            let x = self.x.to_px(*value);
            sheet.line("ink", [x, bottom], [x, bottom + tick_px(text)]);
            sheet.text([x, bottom + 17.0], "middle", text);
        }
        for (value, text) in ticks[1] {
            let y = self.y.to_px(*value);
            sheet.line("ink", [left - tick_px(text), y], [left, y]);
            sheet.text([left - 7.0, y + 4.0], "end", text);
        }
        for (number, line) in wrap_text(labels[0], right - left).iter().enumerate() {
            sheet.text([0.5 * (left + right), bottom + 35.0 + 16.0 * number as f64], "middle", line);
        }
        let widest_px = ticks[1].iter().map(|(_, text)| text_width_px(text)).fold(0.0, f64::max);
        sheet.vertical_text([label_px(left, widest_px), 0.5 * (top + bottom)], labels[1]);
    }
}

/// Foot of the words beside a vertical axis: left of its numbers, as far as the sheet allows.
fn label_px(axis_px: f64, numbers_px: f64) -> f64 {
    (axis_px - 40.0).min(axis_px - 7.0 - numbers_px - 6.0).max(12.0)
}

/// A place on an axis and what is written there; a minor tick has no words.
pub type Tick = (f64, String);

fn numbered(axis: &Axis) -> Vec<Tick> {
    axis.ticks().into_iter().map(|value| (value, tick_text(value))).collect()
}

fn tick_px(text: &str) -> f64 {
    if text.is_empty() { 2.5 } else { 4.0 }
}

/// A number without digits that say nothing.
pub fn tick_text(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.replace('-', "−") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_beside_an_axis_leave_room_for_long_numbers() {
        assert_eq!(label_px(60.0, text_width_px("−15")), 20.0);
        let long_px = text_width_px("80000");
        assert!(label_px(60.0, long_px) <= 60.0 - 7.0 - long_px - 4.0, "{long_px}");
    }

    #[test]
    fn ticks_are_round_and_lie_inside() {
        let axis = Axis { from: -16.2, to: 16.2, start_px: 500.0, end_px: 0.0 };
        assert_eq!(axis.ticks(), [-15.0, -10.0, -5.0, 0.0, 5.0, 10.0, 15.0]);
        assert_eq!((axis.to_px(-16.2), axis.to_px(16.2)), (500.0, 0.0));
        assert_eq!([tick_text(-0.25), tick_text(3.0), tick_text(-0.0)], ["−0.25", "3", "0"]);
    }
}
