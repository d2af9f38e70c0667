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
        let step = self.step();
        let first = (low / step).ceil() as i64;
        let last = (high / step).floor() as i64;
        (first..=last).take(100).map(|i| i as f64 * step).collect()
    }

    /// [`Axis::ticks`] with their numbers in words.
    pub fn numbered(&self) -> Vec<Tick> {
        self.ticks().into_iter().map(|value| (value, tick_text(value, self.step()))).collect()
    }

    fn step(&self) -> f64 {
        round_step((self.to - self.from).abs() * 70.0 / (self.end_px - self.start_px).abs())
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
        self.draw_with_ticks(sheet, [x_label, y_label], [&self.x.numbered(), &self.y.numbered()]);
    }

    /// The axes with as much more room on their left as these ticks of the vertical one take with its label.
    pub fn with_room_beside(self, y_ticks: &[Tick]) -> Self {
        let start_px = self.x.start_px.max(room_beside_px(y_ticks));
        Self { x: Axis { start_px, ..self.x }, ..self }
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
        sheet.vertical_text([label_px(left, widest_px(ticks[1])), 0.5 * (top + bottom)], labels[1]);
    }
}

/// Least foot of the words beside a vertical axis: their letters reach up to the edge of the sheet.
const LABEL_PX: f64 = 12.0;
/// Distances of numbers from their axis, and of words from the numbers.
const NUMBERS_PX: f64 = 7.0;
const WORDS_PX: f64 = 6.0;

/// Least distance of a vertical axis from the left edge of the sheet, for the numbers of its ticks and its
/// label.
pub(crate) fn room_beside_px(ticks: &[Tick]) -> f64 {
    LABEL_PX + WORDS_PX + widest_px(ticks) + NUMBERS_PX
}

/// Foot of the words beside a vertical axis: left of its numbers, as far as the sheet allows.
fn label_px(axis_px: f64, numbers_px: f64) -> f64 {
    (axis_px - 40.0).min(axis_px - NUMBERS_PX - numbers_px - WORDS_PX).max(LABEL_PX)
}

fn widest_px(ticks: &[Tick]) -> f64 {
    ticks.iter().map(|(_, text)| text_width_px(text)).fold(0.0, f64::max)
}

/// A place on an axis and what is written there; a minor tick has no words.
pub type Tick = (f64, String);

fn tick_px(text: &str) -> f64 {
    if text.is_empty() { 2.5 } else { 4.0 }
}

/// Most digits behind the point of numbers below a hundredth, and least number with a power of ten.
const MOST_DIGITS: usize = 6;
const LARGE: f64 = 1e9;

/// A number beside others that differ from it by `step`, or more than thousandths, without digits that say
/// nothing; very small and very large ones by a power of ten.
pub fn tick_text(value: f64, step: f64) -> String {
    let (size, digits) = (value.abs(), (-decimal_power(step)).clamp(3, 17) as usize);
    let is_small = digits > MOST_DIGITS && (0.5 * step..0.01).contains(&size);
    let text = match is_small || size >= LARGE {
        true => with_power(value, decimal_power(size) - decimal_power(step)),
        false => trimmed(&format!("{value:.digits$}")).to_owned(),
    };
    if text == "-0" { "0".into() } else { text.replace('-', "−") }
}

/// A number with a power of ten and at most so many digits behind its point.
fn with_power(value: f64, digits: i32) -> String {
    let text = format!("{value:.digits$e}", digits = digits.clamp(0, 17) as usize);
    let (number, power) = text.split_once('e').unwrap_or((&text, "0"));
    format!("{}e{power}", trimmed(number))
}

/// Power of ten of the first digit of a number above zero.
fn decimal_power(number: f64) -> i32 {
    (number.max(f64::MIN_POSITIVE).log10() + 1e-9).floor() as i32
}

/// A number in words without zeros at its end, of which it has some digits behind a point or no point.
fn trimmed(number: &str) -> &str {
    match number.contains('.') {
        true => number.trim_end_matches('0').trim_end_matches('.'),
        false => number,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_an_axis_differ_however_small_or_large_its_steps_are() {
        for step in [1e-12, 2e-9, 5e-7, 1e-5, 2e-4, 0.001, 0.05, 2.0, 500.0, 1e6, 5e9, 1e15] {
            for from in [0.0, -3.0 * step, 40.0 * step] {
                let axis = Axis { from, to: from + 6.2 * step, start_px: 434.0, end_px: 0.0 };
                let texts: Vec<String> = axis.numbered().into_iter().map(|(_, text)| text).collect();
                let all: std::collections::BTreeSet<&String> = texts.iter().collect();
                assert!(all.len() == texts.len() && texts.len() > 5, "{step:e}: {texts:?}");
                assert!(texts.iter().all(|text| text.chars().count() < 12), "{step:e}: {texts:?}");
            }
        }
        let texts = [(2e-4, 2e-4), (-1.2e-8, 2e-9), (0.0, 2e-9), (2.5e9, 5e8), (1.0, 1e-4), (8e5, 1e5)];
        let texts = texts.map(|(value, step)| tick_text(value, step));
        assert_eq!(texts, ["0.0002", "−1.2e−8", "0", "2.5e9", "1", "800000"]);
    }

    #[test]
    fn an_axis_has_as_much_room_as_its_numbers_and_its_label_take_and_no_more() {
        let axes = |to: f64| Axes {
            x: Axis { from: 0.0, to: 1.0, start_px: 54.0, end_px: 342.0 },
            y: Axis { from: 0.0, to, start_px: 320.0, end_px: 0.0 },
        };
        let start_px = |axes: Axes| axes.with_room_beside(&axes.y.numbered()).x.start_px;
        assert_eq!(start_px(axes(1000.0)), 54.0);
        let wide = axes(0.0009);
        let numbers_px = text_width_px("0.0008");
        assert!(label_px(start_px(wide), numbers_px) + numbers_px + 12.0 <= start_px(wide));
    }

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
        let texts = [-0.25, 3.0, -0.0].map(|value| tick_text(value, 0.05));
        assert_eq!(texts, ["−0.25", "3", "0"]);
    }
}
