//! A drawing made of a few kinds of marks. Colours are classes, so that a page or a dark screen may give them
//! other values.

use std::fmt::Write;

/// A picture of fixed size in pixels.
#[derive(Debug, Clone)]
pub struct Svg {
    /// Width in pixels.
    pub width: f64,
    /// Height in pixels.
    pub height: f64,
    /// Title, said to people who cannot see it.
    pub title: String,
    /// Layers from the undermost on.
    layers: Vec<Layer>,
}

/// Marks as SVG, or a picture between them.
#[derive(Debug, Clone)]
pub(crate) enum Layer {
    /// Lines, forms and words.
    Marks(String),
    /// A PNG stretched over a rectangle.
    Image { corner: [f64; 2], size: [f64; 2], png: Vec<u8> },
}

/// Size of all words but headings: what is smaller is not read on a telephone.
pub const TEXT_PX: f64 = 12.0;
/// Size of headings.
pub const HEADING_PX: f64 = 14.0;
/// Width of a letter, at most, in parts of the size: Ubuntu Light and the system's typefaces stay below
/// it on average.
const LETTER: f64 = 0.56;

/// Paper, ink and colours by day, and what changes in the dark.
const LIGHT: &str = include_str!("light.css");
const DARK: &str = include_str!("dark.css");
/// Lines and values under a pointer stand out, the other lines fade.
const POINTER: &str = include_str!("pointer.css");

/// The classes of all pictures, for a page that holds some.
pub fn stylesheet() -> String {
    format!("{LIGHT}@media (prefers-color-scheme:dark){{{DARK}}}@media (hover:hover){{{POINTER}}}")
}

/// Room that words take, about.
pub fn text_width_px(words: &str) -> f64 {
    LETTER * TEXT_PX * words.chars().count() as f64
}

/// Words in lines that are no wider than `room_px`.
pub fn wrap_text(words: &str, room_px: f64) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    for word in words.split(' ') {
        match lines.last_mut() {
            Some(line) if text_width_px(line) + text_width_px(word) + LETTER * TEXT_PX <= room_px => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

impl Svg {
    /// An empty sheet.
    pub fn new(title: impl Into<String>, width: f64, height: f64) -> Self {
        Self { width, height, title: title.into(), layers: vec![] }
    }

    /// The whole file, for light and dark screens.
    pub fn standalone(&self) -> String {
        self.with_style(&format!("<style>{}</style>", stylesheet()))
    }

    /// Layers of the drawing, from the undermost on.
    pub(crate) fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// A file of its own of some marks, on transparent paper; the undermost lie on white paper.
    pub(crate) fn document_of_marks(&self, marks: &str, paper: Paper) -> String {
        self.file(&format!("<style>{LIGHT}</style>"), paper, marks)
    }

    /// A part of a page that holds [`stylesheet`].
    pub fn inline(&self) -> String {
        self.with_style("")
    }

    fn with_style(&self, style: &str) -> String {
        self.file(style, Paper::White, &self.layers.iter().map(Layer::markup).collect::<String>())
    }

    fn file(&self, style: &str, paper: Paper, body: &str) -> String {
        let (w, h) = (self.width, self.height);
        let title = escaped(&self.title);
        let paper = match paper {
            Paper::White => format!("<rect class=\"paper\" width=\"{w}\" height=\"{h}\"/>"),
            Paper::None => String::new(),
        };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"0 0 {w} {h}\" \
             width=\"{w}\" height=\"{h}\" role=\"img\" aria-label=\"{title}\"><title>{title}</title>{style}{paper}{body}</svg>"
        )
    }

    /// Marks that belong together, as a group of a class; its words, if there are any, are shown while the
    /// pointer rests on it.
    pub fn group(&mut self, class: &str, words: &str, draw: impl FnOnce(&mut Self)) {
        self.push(format_args!("<g class=\"{class}\">"));
        if !words.is_empty() {
            let words = escaped(words);
            self.push(format_args!("<title>{words}</title>"));
        }
        draw(self);
        self.push(format_args!("</g>"));
    }

    /// A straight line of a class.
    pub fn line(&mut self, class: &str, from: [f64; 2], to: [f64; 2]) {
        let ([x1, y1], [x2, y2]) = (from, to);
        self.push(format_args!(
            "<line class=\"{class}\" x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\"/>"
        ));
    }

    /// A rectangle of a class.
    pub fn rectangle(&mut self, class: &str, corner: [f64; 2], size: [f64; 2]) {
        let ([x, y], [w, h]) = (corner, size);
        self.push(format_args!(
            "<rect class=\"{class}\" x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\"/>"
        ));
    }

    /// A closed form of a class that fills it.
    pub fn polygon(&mut self, class: &str, points: &[[f64; 2]]) {
        let points = joined(points);
        self.push(format_args!("<polygon class=\"{class}\" points=\"{points}\"/>"));
    }

    /// Connected lines of a colour.
    pub fn polyline(&mut self, colour: &str, width: f64, points: &[[f64; 2]]) {
        let points = joined(points);
        self.push(format_args!(
            "<polyline class=\"{colour}\" points=\"{points}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"{width}\"/>"
        ));
    }

    /// Connected broken lines of a colour.
    pub fn dashed_polyline(&mut self, colour: &str, width: f64, points: &[[f64; 2]]) {
        let points = joined(points);
        self.push(format_args!(
            "<polyline class=\"{colour}\" points=\"{points}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"{width}\" \
             stroke-dasharray=\"5 4\"/>"
        ));
    }

    /// A closed outline, filled faintly.
    pub fn translucent_polygon(&mut self, colour: &str, points: &[[f64; 2]]) {
        let points = joined(points);
        self.push(format_args!(
            "<polygon class=\"{colour}\" points=\"{points}\" fill=\"currentColor\" fill-opacity=\"0.22\" stroke=\"currentColor\" \
             stroke-width=\"1.4\"/>"
        ));
    }

    /// The rim of a closed form.
    pub fn polygon_outline(&mut self, colour: &str, points: &[[f64; 2]]) {
        let points = joined(points);
        self.push(format_args!(
            "<polygon class=\"{colour}\" points=\"{points}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"2\"/>"
        ));
    }

    /// A closed form, filled.
    pub fn filled_polygon(&mut self, colour: &str, points: &[[f64; 2]]) {
        let points = joined(points);
        self.push(format_args!("<polygon class=\"{colour}\" points=\"{points}\" fill=\"currentColor\"/>"));
    }

    /// A disc of a colour.
    pub fn disc(&mut self, colour: &str, centre: [f64; 2], radius: f64) {
        let [x, y] = centre;
        self.push(format_args!(
            "<circle class=\"{colour}\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" fill=\"currentColor\" fill-opacity=\"0.85\"/>"
        ));
    }

    /// A ring of a colour; `stroke` holds further attributes of its line.
    pub fn ring(&mut self, colour: &str, centre: [f64; 2], radius: f64, stroke: &str) {
        let [x, y] = centre;
        self.push(format_args!(
            "<circle class=\"{colour}\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" fill=\"none\" stroke=\"currentColor\" \
             stroke-width=\"2\"{stroke}/>"
        ));
    }

    /// Words of the usual size; `anchor` is start, middle or end.
    pub fn text(&mut self, at: [f64; 2], anchor: &str, words: &str) {
        let ([x, y], words) = (at, escaped(words));
        self.push(format_args!(
            "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{TEXT_PX}\" text-anchor=\"{anchor}\">{words}</text>"
        ));
    }

    /// Words over other marks: with a rim of class `rim` (halo, or shade on maps), in the colour of `class`,
    /// which may be empty.
    pub fn text_with_halo(&mut self, at: [f64; 2], anchor: &str, words: &str, [class, rim]: [&str; 2]) {
        let ([x, y], words) = (at, escaped(words));
        let place = format!("x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{TEXT_PX}\" text-anchor=\"{anchor}\"");
        self.push(format_args!(
            "<text class=\"{rim}\" aria-hidden=\"true\" {place} stroke-width=\"3\" stroke-linejoin=\"round\">{words}</text>\
             <text class=\"{class}\" {place}>{words}</text>"
        ));
    }

    /// A heading.
    pub fn heading(&mut self, at: [f64; 2], words: &str) {
        let ([x, y], words) = (at, escaped(words));
        self.push(format_args!(
            "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{HEADING_PX}\" font-weight=\"600\">{words}</text>"
        ));
    }

    /// Words that run upwards.
    pub fn vertical_text(&mut self, at: [f64; 2], words: &str) {
        let ([x, y], words) = (at, escaped(words));
        self.push(format_args!(
            "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{TEXT_PX}\" text-anchor=\"middle\" transform=\"rotate(-90 {x:.2} {y:.2})\">\
             {words}</text>"
        ));
    }

    /// A PNG stretched over a rectangle, each of its pixels a rectangle of one colour.
    pub fn image(&mut self, corner: [f64; 2], size: [f64; 2], png: &[u8]) {
        self.layers.push(Layer::Image { corner, size, png: png.to_vec() });
    }

    fn push(&mut self, mark: std::fmt::Arguments) {
        if !matches!(self.layers.last(), Some(Layer::Marks(_))) {
            self.layers.push(Layer::Marks(String::new()));
        }
        if let Some(Layer::Marks(marks)) = self.layers.last_mut() {
            let _ = marks.write_fmt(mark); // writing to a String cannot fail
        }
    }
}

/// Paper that marks lie on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Paper {
    White,
    None,
}

impl Layer {
    /// The picture as a part of an SVG.
    fn markup(&self) -> String {
        use base64::Engine;
        match self {
            Self::Marks(marks) => marks.clone(),
            Self::Image { corner: [x, y], size: [w, h], png } => {
                let data = base64::engine::general_purpose::STANDARD.encode(png);
                format!(
                    "<image x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\" preserveAspectRatio=\"none\" \
                     image-rendering=\"optimizeSpeed\" xlink:href=\"data:image/png;base64,{data}\"/>"
                )
            }
        }
    }
}

fn joined(points: &[[f64; 2]]) -> String {
    points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect::<Vec<_>>().join(" ")
}

/// Text as XML takes it: marks by their names, and controls, which it does not take, as escapes.
fn escaped(text: &str) -> String {
    let sign = |sign: char| {
        let escape = sign.is_control().then(|| sign.escape_default());
        escape.into_iter().flatten().chain((!sign.is_control()).then_some(sign))
    };
    let text: String = text.chars().flat_map(sign).collect();
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_says_its_title_to_those_who_cannot_see_it_whatever_stands_in_it() {
        let text = Svg::new("a \"b\" < c & d\u{1b}", 10.0, 10.0).inline();
        let said = "a &quot;b&quot; &lt; c &amp; d\\u{1b}";
        assert!(
            text.contains(&format!("<title>{said}</title>"))
                && text.contains(&format!("aria-label=\"{said}\""))
        );
    }

    #[test]
    fn every_colour_has_a_value_in_the_dark() {
        let colours = LIGHT.split(['.', '{']).filter(|part| !part.contains([':', '}', '\n']));
        let on_maps = ["onmap", "truthmap", "shade", "shadow", "plate"];
        for colour in colours.filter(|c| !c.is_empty() && *c != "text" && !on_maps.contains(c)) {
            assert!(DARK.contains(&format!(".{colour}{{")), "{colour}");
        }
    }

    #[test]
    fn wrapped_words_fit_and_none_is_lost() {
        let words = "dashed ring: an object that is nobody's, numbered as in the table";
        let lines = wrap_text(words, 200.0);
        assert_eq!(lines.join(" "), words);
        assert!(lines.iter().all(|line| text_width_px(line) <= 200.0), "{lines:?}");
    }
}
