//! A drawing made of a few kinds of marks. Colours are classes, so that a page may give them other values in the dark.

use std::fmt::Write;

/// A picture of fixed size in pixels.
#[derive(Debug, Clone)]
pub(crate) struct Svg {
    pub(crate) width: f64,
    pub(crate) height: f64,
    /// Said to people who cannot see it.
    pub(crate) title: String,
    body: String,
}

/// Paper and ink of a picture that stands alone.
const STYLE: &str = ".paper{fill:#fff}.ink{stroke:#333;fill:none}.faint{stroke:#bbb;fill:none}\
text{fill:#222;font-family:'Ubuntu','Ubuntu Light',sans-serif}.road{fill:#eceff1}.lane{stroke:#b0bec5;fill:none}";

impl Svg {
    /// An empty sheet.
    pub(crate) fn new(title: impl Into<String>, width: f64, height: f64) -> Self {
        Self { width, height, title: title.into(), body: String::new() }
    }

    /// The whole file.
    pub(crate) fn text(&self) -> String {
        let (w, h) = (self.width, self.height);
        let title = escaped(&self.title);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"0 0 {w} {h}\" \
             width=\"{w}\" height=\"{h}\" role=\"img\"><title>{title}</title><style>{STYLE}</style>\
             <rect class=\"paper\" width=\"{w}\" height=\"{h}\"/>{}</svg>",
            self.body
        )
    }

    /// A straight line of a class.
    pub(crate) fn line(&mut self, class: &str, from: [f64; 2], to: [f64; 2]) {
        let ([x1, y1], [x2, y2]) = (from, to);
        self.put(format_args!("<line class=\"{class}\" x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\"/>"));
    }

    /// A rectangle of a class.
    pub(crate) fn rectangle(&mut self, class: &str, corner: [f64; 2], size: [f64; 2]) {
        let ([x, y], [w, h]) = (corner, size);
        self.put(format_args!(
            "<rect class=\"{class}\" x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\"/>"
        ));
    }

    /// Connected lines of a colour.
    pub(crate) fn polyline(&mut self, colour: &str, width: f64, points: &[[f64; 2]]) {
        let points = joined(points);
        self.put(format_args!(
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"/>"
        ));
    }

    /// A closed outline, filled faintly.
    pub(crate) fn outline(&mut self, colour: &str, points: &[[f64; 2]]) {
        let points = joined(points);
        self.put(format_args!(
            "<polygon points=\"{points}\" fill=\"{colour}\" fill-opacity=\"0.25\" stroke=\"{colour}\" stroke-width=\"1.2\"/>"
        ));
    }

    /// A disc of a colour.
    pub(crate) fn disc(&mut self, colour: &str, centre: [f64; 2], radius: f64) {
        let [x, y] = centre;
        self.put(format_args!(
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" fill=\"{colour}\" fill-opacity=\"0.8\"/>"
        ));
    }

    /// A ring of a colour.
    pub(crate) fn ring(&mut self, colour: &str, centre: [f64; 2], radius: f64) {
        let [x, y] = centre;
        self.put(format_args!(
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\"/>"
        ));
    }

    /// Words; `anchor` is start, middle or end.
    pub(crate) fn words(&mut self, at: [f64; 2], size: f64, anchor: &str, words: &str) {
        let ([x, y], words) = (at, escaped(words));
        self.put(format_args!(
            "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{size}\" text-anchor=\"{anchor}\">{words}</text>"
        ));
    }

    /// Words that run upwards.
    pub(crate) fn words_upwards(&mut self, at: [f64; 2], size: f64, words: &str) {
        let ([x, y], words) = (at, escaped(words));
        self.put(format_args!(
            "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{size}\" text-anchor=\"middle\" transform=\"rotate(-90 {x:.2} {y:.2})\">{words}</text>"
        ));
    }

    /// A PNG stretched over a rectangle.
    pub(crate) fn image(&mut self, corner: [f64; 2], size: [f64; 2], png: &[u8]) {
        use base64::Engine;
        let ([x, y], [w, h]) = (corner, size);
        let data = base64::engine::general_purpose::STANDARD.encode(png);
        self.put(format_args!(
            "<image x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\" preserveAspectRatio=\"none\" \
             image-rendering=\"optimizeSpeed\" xlink:href=\"data:image/png;base64,{data}\"/>"
        ));
    }

    fn put(&mut self, mark: std::fmt::Arguments) {
        let _ = self.body.write_fmt(mark); // writing to a String cannot fail
    }
}

fn joined(points: &[[f64; 2]]) -> String {
    points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect::<Vec<_>>().join(" ")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
