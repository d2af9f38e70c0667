//! Forms of marks: the same on the drawing and in its legend.

use crate::svg::{Svg, TEXT_PX, text_width_px, wrap_text};

/// A kind of mark; its colour is told apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A detected point.
    Dot,
    /// An object.
    Ring,
    /// An object that is no body's.
    DashedRing,
    /// A detected point at rest.
    SmallRing,
    /// An object at rest.
    SquareOutline,
    /// True place or value of a body.
    Cross,
    /// The rim of a body.
    Outline,
    /// A line of a plot.
    Line,
    /// A boundary or a direction.
    DashedLine,
    /// Place of a radar.
    Triangle,
    /// Direction to something beyond the edge.
    Arrow,
    /// The dark of a map below a mark.
    Backdrop,
    /// Value of a plot.
    Disc,
    /// Value of a plot.
    Square,
    /// Value of a plot.
    Diamond,
    /// Value of a plot.
    TriangleUp,
    /// Value of a plot.
    Circle,
}

impl Mark {
    /// Marks of the lines of a plot: told apart by more than colour.
    pub const OF_LINES: [Self; 5] = [Self::Disc, Self::Square, Self::Diamond, Self::TriangleUp, Self::Circle];

    /// Draws the mark at its place; lines and outlines as samples of what they are.
    pub fn draw(self, sheet: &mut Svg, colour: &str, [x, y]: [f64; 2]) {
        let around =
            |corners: &[[f64; 2]]| corners.iter().map(|[dx, dy]| [x + dx, y + dy]).collect::<Vec<_>>();
        match self {
            Self::Dot => sheet.disc(colour, [x, y], 2.2),
            Self::Ring => sheet.ring(colour, [x, y], 7.0, ""),
            Self::DashedRing => sheet.ring(colour, [x, y], 7.0, " stroke-dasharray=\"3 2.5\""),
            Self::SmallRing => sheet.ring(colour, [x, y], 2.4, ""),
            Self::SquareOutline => {
                sheet.polygon_outline(colour, &around(&[[-6.5, -6.5], [6.5, -6.5], [6.5, 6.5], [-6.5, 6.5]]))
            }
            Self::Cross => {
                sheet.polyline(colour, 2.0, &around(&[[-5.0, 0.0], [5.0, 0.0]]));
                sheet.polyline(colour, 2.0, &around(&[[0.0, -5.0], [0.0, 5.0]]));
            }
            Self::Outline => sheet
                .translucent_polygon(colour, &around(&[[-7.0, -4.0], [7.0, -4.0], [7.0, 4.0], [-7.0, 4.0]])),
            Self::Line => sheet.polyline(colour, 2.0, &around(&[[-8.0, 0.0], [8.0, 0.0]])),
            Self::DashedLine => sheet.dashed_polyline(colour, 1.5, &around(&[[-8.0, 0.0], [8.0, 0.0]])),
            Self::Triangle => sheet.filled_polygon(colour, &around(&[[-6.0, 5.0], [6.0, 5.0], [0.0, -6.0]])),
            Self::Arrow => sheet.filled_polygon(colour, &around(&[[-4.0, -5.0], [5.0, 0.0], [-4.0, 5.0]])),
            Self::Backdrop => {
                sheet.filled_polygon("plate", &around(&[[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]]))
            }
            Self::Disc => sheet.disc(colour, [x, y], 3.8),
            Self::Square => {
                sheet.filled_polygon(colour, &around(&[[-3.5, -3.5], [3.5, -3.5], [3.5, 3.5], [-3.5, 3.5]]))
            }
            Self::Diamond => {
                sheet.filled_polygon(colour, &around(&[[-4.8, 0.0], [0.0, -4.8], [4.8, 0.0], [0.0, 4.8]]))
            }
            Self::TriangleUp => {
                sheet.filled_polygon(colour, &around(&[[-4.2, 3.6], [4.2, 3.6], [0.0, -4.4]]))
            }
            Self::Circle => sheet.ring(colour, [x, y], 3.6, ""),
        }
    }
}

/// Legend of the marks of a drawing, in the order in which they were told.
#[derive(Debug, Clone, Default)]
pub struct Legend {
    entries: Vec<(Vec<Mark>, String, String)>,
}

/// Distances from a mark's middle to its words, and from words to the next mark.
const TO_WORDS_PX: f64 = 14.0;
const TO_NEXT_PX: f64 = 26.0;
const LINE_PX: f64 = 19.0;

impl Legend {
    /// Says once what a mark of a colour means.
    pub fn add(&mut self, mark: Mark, colour: &str, words: impl Into<String>) {
        self.add_stacked(&[mark], colour, words);
    }

    /// Says once what marks mean that lie one upon another.
    pub fn add_stacked(&mut self, marks: &[Mark], colour: &str, words: impl Into<String>) {
        let entry = (marks.to_vec(), colour.to_owned(), words.into());
        if !self.entries.contains(&entry) {
            self.entries.push(entry);
        }
    }

    /// Draws the legend below `top_px` between two sides; the sheet grows to hold it.
    pub fn draw(&self, sheet: &mut Svg, top_px: f64, [left, right]: [f64; 2]) {
        let (mut x, mut y) = (left + 9.0, top_px);
        for (marks, colour, words) in &self.entries {
            let lines = wrap_text(words, right - left - TO_WORDS_PX - 9.0);
            let wide = TO_WORDS_PX + lines.iter().map(|line| text_width_px(line)).fold(0.0, f64::max);
            if x + wide > right && x > left + 9.0 {
                (x, y) = (left + 9.0, y + LINE_PX);
            }
            marks.iter().for_each(|mark| mark.draw(sheet, colour, [x, y]));
            for (number, line) in lines.iter().enumerate() {
                sheet.text([x + TO_WORDS_PX, y + 4.0 + LINE_PX * number as f64], "start", line);
            }
            if lines.len() > 1 {
                (x, y) = (left + 9.0, y + LINE_PX * lines.len() as f64);
            } else {
                x += wide + TO_NEXT_PX;
            }
        }
        sheet.height = y + if x > left + 9.0 { LINE_PX } else { 0.0 } + 0.25 * TEXT_PX;
    }
}
